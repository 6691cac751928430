// SPDX-License-Identifier: 0BSD
/** Types on the wire: how words hold a number. */

/** @typedef {number | bigint} RawNumber */

const BIG_BITS = 32;
const WORD = 0x10000;

/** How many bits a number has, and how these hold it: two's complement if `signed`, else as `coding` says. */
export class WireType {
  /** @param {number} bits @param {{ signed?: boolean, lowByteFirst?: boolean, coding?: string }} facts */
  constructor(bits, { signed = false, lowByteFirst = false, coding = "" }) {
    this.bits = bits;
    this.signed = signed;
    this.lowByteFirst = lowByteFirst;
    this.coding = coding;
    /** Whether raw numbers are bigint. */
    this.isBig = bits > BIG_BITS;
  }

  /** Two to that power, as a raw number. @param {number} power @returns {any} */
  power(power) {
    return this.isBig ? 1n << BigInt(power) : 2 ** power;
  }

  /** A number as raw numbers of the type are. @param {RawNumber} number @returns {any} */
  raw(number) {
    return this.isBig ? BigInt(number) : Number(number);
  }

  /** The least and the greatest number in `width` bits. @param {number} width @returns {[any, any]} */
  limits(width) {
    const one = this.raw(1);
    if (!this.signed) return [this.raw(0), this.power(width) - one];
    return [-this.power(width - 1), this.power(width - 1) - one];
  }

  /** The number that the lowest `width` bits of a pattern hold; a pattern is not negative.
   * @param {any} whole @param {number} width @returns {any} */
  number(whole, width) {
    const pattern = whole % this.power(width);
    if (this.coding === "bcd") {
      const digits = pattern.toString(16);
      const most = this.raw(10n ** BigInt(width / 4));
      if (/^[0-9]+$/.test(digits)) return this.raw(BigInt(digits));
      return pattern > most ? pattern : most;
    }
    const half = this.power(width - 1);
    if (pattern < half || !(this.signed || this.coding)) return pattern;
    return this.coding ? half - pattern : pattern - this.power(width);
  }

  /** The bits of a number, those above `width` its sign, in `size` words. @param {any} raw @param {number} width
   * @param {number} size @returns {any} */
  pattern(raw, width, size) {
    if (this.coding === "bcd") return raw < this.raw(10n ** BigInt(width / 4)) ? this.raw(BigInt(`0x${raw}`)) : raw;
    if (raw >= 0) return raw;
    return this.coding ? this.power(width - 1) + (-raw % this.power(width - 1)) : raw + this.power(16 * size);
  }

  /** Words with their high byte first, or as on the wire. @param {readonly number[]} words @returns {readonly number[]} */
  ordered(words) {
    return this.lowByteFirst ? words.map((word) => ((word & 0xff) << 8) | (word >> 8)) : words;
  }

  /** Words, the high one first, as one number. @param {readonly number[]} words @returns {any} */
  joined(words) {
    if (!this.isBig) return words.reduce((number, word) => number * WORD + word, 0);
    return words.reduce((number, word) => (number << 16n) | BigInt(word), 0n);
  }

  /** A pattern as words, the low one first. @param {any} pattern @param {number} size @returns {number[]} */
  split(pattern, size) {
    const words = [];
    for (let left = BigInt(pattern); words.length < size; left >>= 16n) words.push(Number(left & 0xffffn));
    return words;
  }
}

/** A wire type. @param {number} bits @param {{ signed?: boolean, lowByteFirst?: boolean, coding?: string }} [facts] */
export function wireType(bits, facts = {}) {
  return new WireType(bits, facts);
}

const SIGNED = { signed: true };
export const BIT = /* @__PURE__ */ wireType(1);
export const U8 = /* @__PURE__ */ wireType(8);
export const U16 = /* @__PURE__ */ wireType(16);
export const U32 = /* @__PURE__ */ wireType(32);
export const U64 = /* @__PURE__ */ wireType(64);
export const S8 = /* @__PURE__ */ wireType(8, SIGNED);
export const S16 = /* @__PURE__ */ wireType(16, SIGNED);
export const S32 = /* @__PURE__ */ wireType(32, SIGNED);
export const S64 = /* @__PURE__ */ wireType(64, SIGNED);
export const F32 = /* @__PURE__ */ wireType(32);
export const F64 = /* @__PURE__ */ wireType(64);
