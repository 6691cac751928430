// SPDX-License-Identifier: 0BSD
/** Words of flags: each is read and composed by what it means. */
import { OutOfRangeError, shown, UnknownValueError } from "./errors.js";
import { wholeNumber } from "./numbers.js";

/** A name of a description as programs write it: base_frequency is baseFrequency. @param {string} name @returns {string} */
export function camelName(name) {
  return name.split("_").reduce((text, part) => {
    const apart = (/^[0-9]/.test(part) && /[0-9]$/.test(text)) || !part || !text;
    return text + (apart ? "_" : "") + part.slice(0, 1).toUpperCase() + part.slice(1);
  });
}

/** Some bits of a word; `active` is the state of a single bit in which its name is true, `names` names several.
 * @typedef {{ low: number, width: number, active?: 0 | 1, names?: Readonly<Record<string, number>> }} BitRange */

/** One bit of a word. @param {number} low @param {{ active?: 0 | 1 }} [facts] @returns {BitRange} */
export function bitFlag(low, { active = 1 } = {}) {
  return { low, width: 1, active };
}

/** Several bits of a word. @param {number} low @param {number} width @param {Readonly<Record<string, number>>} [names]
 * @returns {BitRange} */
export function bitField(low, width, names) {
  return { low, width, names };
}

/** The bits of a word, right-aligned. @param {BitRange} bits @param {number | bigint} raw @returns {number} */
export function bitsOf(bits, raw) {
  return Number((BigInt(raw) >> BigInt(bits.low)) & ((1n << BigInt(bits.width)) - 1n));
}

/** A number at the place of the bits. @param {BitRange} bits @param {unknown} given @returns {bigint} */
function placedBits(bits, given) {
  const number = bits.active === undefined ? wholeNumber(given) : (given ? bits.active : 1 - bits.active);
  if (number < 0 || BigInt(number) >> BigInt(bits.width)) {
    throw new OutOfRangeError(`${shown(number)} does not fit into ${bits.width} bits`);
  }
  return BigInt(number) << BigInt(bits.low);
}

/** A word of flags: what it means is in its properties, and `raw` is its number. */
export class Word {
  /** @param {number | bigint} raw */
  constructor(raw) {
    /** @type {number | bigint} */
    this.raw = raw;
  }

  valueOf() {
    return this.raw;
  }

  /** The number, and the names that are true. */
  toString() {
    const layout = /** @type {{ kind: WordLayout }} */ (/** @type {unknown} */ (this)).kind;
    const told = Object.entries(layout.flags).map(([name, bits]) => {
      const number = bitsOf(bits, this.raw);
      if (bits.active === undefined) return `${name}=${numberName(bits.names, number) ?? number}`;
      return number === bits.active ? name : "";
    });
    const number = `0x${this.raw.toString(16).toUpperCase().padStart(4, "0")}`;
    const names = told.filter(Boolean).join(", ");
    return names ? `${number} (${names})` : number;
  }
}

/** The name that a number has, in lower case. @param {Readonly<Record<string, number>> | undefined} names
 * @param {number | bigint} number @returns {string | undefined} */
export function numberName(names, number) {
  return Object.keys(names ?? {}).find((name) => names?.[name] === Number(number))?.toLowerCase();
}

/** What the bits of a word mean, and what makes words of it. */
export class WordLayout {
  /** @param {string} name @param {Readonly<Record<string, BitRange>>} flags
   * @param {{ constant?: number, closed?: readonly string[] }} facts */
  constructor(name, flags, { constant = 0, closed = [] }) {
    this.name = name;
    this.flags = flags;
    this.constant = constant;
    /** Flags whose bits are always written as a constant. */
    this.closed = closed;
    this.prototype = Object.create(Word.prototype, { kind: { value: this } });
    for (const [flag, bits] of Object.entries(flags)) {
      Object.defineProperty(this.prototype, flag, {
        enumerable: true,
        /** @this {Word} */
        get() {
          const number = bitsOf(bits, this.raw);
          return bits.active === undefined ? number : number === bits.active;
        },
      });
    }
  }

  /** The word that a raw number is. @param {number | bigint} raw @returns {Word} */
  from(raw) {
    return Object.freeze(Object.setPrototypeOf(new Word(raw), this.prototype));
  }

  /** The word in which exactly these flags are true, active-low bits included. @param {Readonly<Record<string, unknown>>} [given] */
  of(given = {}) {
    const free = Object.keys(this.flags).filter((name) => !this.closed.includes(name));
    const unknown = Object.keys(given).filter((name) => !free.includes(name));
    if (unknown.length) throw new UnknownValueError(`${this.name} has ${free.join(", ")}, not ${unknown.join(", ")}`);
    const parts = free.map((name) => placedBits(this.flags[name], given[name] ?? 0));
    const raw = parts.reduce((word, part) => word | part, BigInt(this.constant));
    return this.from(raw >> 32n ? raw : Number(raw));
  }
}

/** The kind of a word of flags. @param {string} name @param {Readonly<Record<string, BitRange>>} flags
 * @param {{ constant?: number, closed?: readonly string[] }} [facts] */
export function wordOf(name, flags, facts = {}) {
  return new WordLayout(name, flags, facts);
}
