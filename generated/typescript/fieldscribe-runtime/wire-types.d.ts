/** A wire type. @param {number} bits @param {{ signed?: boolean, lowByteFirst?: boolean, coding?: string }} [facts] */
export function wireType(bits: number, facts?: {
    signed?: boolean;
    lowByteFirst?: boolean;
    coding?: string;
}): WireType;
/** How many bits a number has, and how these hold it: two's complement if `signed`, else as `coding` says. */
export class WireType {
    /** @param {number} bits @param {{ signed?: boolean, lowByteFirst?: boolean, coding?: string }} facts */
    constructor(bits: number, { signed, lowByteFirst, coding }: {
        signed?: boolean;
        lowByteFirst?: boolean;
        coding?: string;
    });
    bits: number;
    signed: boolean;
    lowByteFirst: boolean;
    coding: string;
    /** Whether raw numbers are bigint. */
    isBig: boolean;
    /** Two to that power, as a raw number. @param {number} power @returns {any} */
    power(power: number): any;
    /** A number as raw numbers of the type are. @param {RawNumber} number @returns {any} */
    raw(number: RawNumber): any;
    /** The least and the greatest number in `width` bits. @param {number} width @returns {[any, any]} */
    limits(width: number): [any, any];
    /** The number that the lowest `width` bits of a pattern hold; a pattern is not negative.
     * @param {any} whole @param {number} width @returns {any} */
    number(whole: any, width: number): any;
    /** The bits of a number, those above `width` its sign, in `size` words. @param {any} raw @param {number} width
     * @param {number} size @returns {any} */
    pattern(raw: any, width: number, size: number): any;
    /** Words with their high byte first, or as on the wire. @param {readonly number[]} words @returns {readonly number[]} */
    ordered(words: readonly number[]): readonly number[];
    /** Words, the high one first, as one number. @param {readonly number[]} words @returns {any} */
    joined(words: readonly number[]): any;
    /** A pattern as words, the low one first. @param {any} pattern @param {number} size @returns {number[]} */
    split(pattern: any, size: number): number[];
}
export const BIT: WireType;
export const U8: WireType;
export const U16: WireType;
export const U32: WireType;
export const U64: WireType;
export const S8: WireType;
export const S16: WireType;
export const S32: WireType;
export const S64: WireType;
export const F32: WireType;
export const F64: WireType;
export type RawNumber = number | bigint;
