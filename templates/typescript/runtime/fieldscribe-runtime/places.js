// SPDX-License-Identifier: 0BSD
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
export function place(space, addresses, facts) {
  return { space, addresses, ...facts };
}

/** @param {string} space @param {(number | PlaceFacts)[]} where @returns {Place} */
function placeIn(space, where) {
  const last = where[where.length - 1];
  const facts = typeof last === "object" ? last : {};
  return { space, addresses: where.filter((one) => typeof one === "number"), ...facts };
}

/** A bit that can be read and written. @param {...(number | PlaceFacts)} where */
export function coil(...where) {
  return placeIn("coil", where);
}

/** A bit that can be read. @param {...(number | PlaceFacts)} where */
export function discrete(...where) {
  return placeIn("discrete", where);
}

/** Registers that can be read and written. @param {...(number | PlaceFacts)} where */
export function holding(...where) {
  return placeIn("holding", where);
}

/** Registers that can be read. @param {...(number | PlaceFacts)} where */
export function inputRegister(...where) {
  return placeIn("input", where);
}

/** A parameter by its number, or an element of one; a text lies in several. @param {...(number | PlaceFacts)} where */
export function parameter(...where) {
  return placeIn("parameter", where);
}

/** Words of a telegram, counted from 0. @param {string} name @param {...(number | PlaceFacts)} where
 * @returns {Place} */
export function telegram(name, ...where) {
  return { ...placeIn("telegram", where), telegram: name };
}

/** The space and its base: equal addresses in one area are the same words. @param {Place} at */
export function areaOf(at) {
  return at.base === undefined ? at.space : `${at.space} from ${at.base}`;
}

/** The lowest address, which a request names. @param {Place} at @returns {number} */
export function lowestOf(at) {
  return Math.min(...at.addresses);
}

/** The highest address. @param {Place} at @returns {number} */
export function highestOf(at) {
  return Math.max(...at.addresses);
}

/** The addresses from the lowest on. @param {Place} at @returns {number[]} */
export function ascending(at) {
  return [...at.addresses].sort((one, other) => one - other);
}

/** The words of a place as places without gaps, from the lowest address on.
 * @param {Place} at @returns {Place[]} */
export function runsOf(at) {
  /** @type {number[][]} */
  const runs = [];
  for (const address of ascending(at)) {
    const run = runs[runs.length - 1];
    if (run && run[run.length - 1] === address - 1) run.push(address);
    else runs.push([address]);
  }
  return runs.map((addresses) => ({ ...at, addresses }));
}

/** Whether both places have a word or bit in common. @param {Place} one @param {Place} other @returns {boolean} */
export function placesOverlap(one, other) {
  if (areaOf(one) !== areaOf(other) || one.telegram !== other.telegram) return false;
  if (one.index !== undefined && other.index !== undefined && one.index !== other.index) return false;
  return one.addresses.some((address) => other.addresses.includes(address));
}

/** The place for messages: the first of several words. @param {Place} at @returns {string} */
export function placeLabel(at) {
  const address = lowestOf(at);
  if (at.telegram !== undefined) return `${at.telegram} word ${address}`;
  const number =
    at.space === "parameter" ? String(address) : `0x${address.toString(16).toUpperCase().padStart(4, "0")}`;
  const index = at.index === undefined ? "" : ` index ${at.index}`;
  return `${at.space} ${number}${index}${at.base === undefined ? "" : ` from ${at.base}`}`;
}
