/** Where points are: spaces and addresses. */
/**
 * Where a point is: its space, its addresses (the high part first), and a function if it is not the usual one.
 *
 * An element of an array has its `index`, words of a telegram the name of that `telegram`; signals are words of the
 * telegram of their message. With a `base`, by its name, the addresses count from that.
 * @typedef {object} Place
 * @property {string} space
 * @property {readonly number[]} addresses
 * @property {number} [function]
 * @property {number} [index]
 * @property {string} [telegram]
 * @property {string} [base]
 */
/** @typedef {{ function?: number, index?: number, base?: string }} PlaceFacts */
/** A place in any space. @param {string} space @param {readonly number[]} addresses @param {Partial<Place>} [facts]
 * @returns {Place} */
export function place(space: string, addresses: readonly number[], facts?: Partial<Place>): Place;
/** A bit that can be read and written. @param {...(number | PlaceFacts)} where */
export function coil(...where: (number | PlaceFacts)[]): Place;
/** A bit that can be read. @param {...(number | PlaceFacts)} where */
export function discrete(...where: (number | PlaceFacts)[]): Place;
/** Registers that can be read and written. @param {...(number | PlaceFacts)} where */
export function holding(...where: (number | PlaceFacts)[]): Place;
/** Registers that can be read. @param {...(number | PlaceFacts)} where */
export function inputRegister(...where: (number | PlaceFacts)[]): Place;
/** A parameter by its number, or an element of one; a text lies in several. @param {...(number | PlaceFacts)} where */
export function parameter(...where: (number | PlaceFacts)[]): Place;
/** Words of a telegram, counted from 0. @param {string} name @param {...(number | PlaceFacts)} where
 * @returns {Place} */
export function telegram(name: string, ...where: (number | PlaceFacts)[]): Place;
/** The space and its base: equal addresses in one area are the same words. @param {Place} at */
export function areaOf(at: Place): string;
/** The lowest address, which a request names. @param {Place} at @returns {number} */
export function lowestOf(at: Place): number;
/** The highest address. @param {Place} at @returns {number} */
export function highestOf(at: Place): number;
/** The addresses from the lowest on. @param {Place} at @returns {number[]} */
export function ascending(at: Place): number[];
/** The words of a place as places without gaps, from the lowest address on.
 * @param {Place} at @returns {Place[]} */
export function runsOf(at: Place): Place[];
/** Whether both places have a word or bit in common. @param {Place} one @param {Place} other @returns {boolean} */
export function placesOverlap(one: Place, other: Place): boolean;
/** The place for messages: the first of several words. @param {Place} at @returns {string} */
export function placeLabel(at: Place): string;
/**
 * Where a point is: its space, its addresses (the high part first), and a function if it is not the usual one.
 *
 * An element of an array has its `index`, words of a telegram the name of that `telegram`; signals are words of the
 * telegram of their message. With a `base`, by its name, the addresses count from that.
 */
export type Place = {
    space: string;
    addresses: readonly number[];
    function?: number | undefined;
    index?: number | undefined;
    telegram?: string | undefined;
    base?: string | undefined;
};
export type PlaceFacts = {
    function?: number;
    index?: number;
    base?: string;
};
