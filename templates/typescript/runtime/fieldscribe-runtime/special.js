// SPDX-License-Identifier: 0BSD
/** Special codes: raw numbers that are no quantity, and what decoding gives for them. */
import { inBands } from "./rules.js";
import { camelName } from "./words.js";

/** A special code, which a point holds instead of a quantity. @template {string} [Name=string] */
export class SpecialCode {
  /** @param {Name} name @param {number | bigint} raw @param {boolean} noValue @param {boolean} writable */
  constructor(name, raw, noValue, writable) {
    this.name = name;
    this.raw = raw;
    /** Whether it means that there is no value. */
    this.noValue = noValue;
    this.writable = writable;
    Object.freeze(this);
  }

  toString() {
    return this.name;
  }
}

/** The special codes of a point. A code is a raw number, or the first and the last one of a band. */
export class Codes {
  /** @param {Readonly<Record<string, number | bigint | readonly [number | bigint, number | bigint]>>} raws
   * @param {{ noValue?: readonly string[], writable?: readonly string[] }} facts */
  constructor(raws, { noValue = [], writable = [] }) {
    /** @type {Map<string, readonly [number | bigint, number | bigint]>} */
    this.spans = new Map(Object.entries(raws).map(([name, raw]) => [name, typeof raw === "object" ? raw : [raw, raw]]));
    this.noValue = noValue;
    this.writable = writable;
    /** @type {Map<number | bigint, SpecialCode>} */
    this.single = new Map();
    /** The codes of one raw number by name. @type {Readonly<Record<string, SpecialCode>>} */
    this.byName = Object.create(null);
    /** @type {string[]} */
    this.bands = [];
    for (const [name, [low, high]] of this.spans) {
      if (low !== high) this.bands.push(name);
      else this.single.set(low, this.made(name, low));
    }
    const named = [...this.single.values()].map((code) => /** @type {const} */ ([codeProperty(code.name), code]));
    this.byName = Object.freeze(Object.assign(Object.create(null), Object.fromEntries(named)));
  }

  /** The code that a raw number is; undefined for a quantity. @param {number | bigint} raw @returns {SpecialCode | undefined} */
  of(raw) {
    const found = this.single.get(raw) ?? this.single.get(otherType(raw));
    if (found || !this.bands.length) return found;
    const name = this.bands.find((one) => inBands(raw, [this.span(one)]));
    return name === undefined ? undefined : this.made(name, raw);
  }

  /** First and last raw number of a code. @param {string} name */
  span(name) {
    return /** @type {readonly [number | bigint, number | bigint]} */ (this.spans.get(name));
  }

  /** Whether a code is one of these. @param {SpecialCode} code */
  has(code) {
    const found = this.of(code.raw);
    return found !== undefined && found.name === code.name;
  }

  /** How a program names a code. @param {SpecialCode} code */
  said(code) {
    const [low, high] = this.span(code.name);
    return low === high ? `special.${codeProperty(code.name)}` : `specialOf(${code.raw})`;
  }

  /** Why a text is not taken for a value, and the code that is meant by it. @param {string} given */
  notAText(given) {
    const span = this.spans.get(given);
    const named = span && span[0] === span[1] ? codeProperty(given) : "name";
    return `takes a number or a special code, as in special.${named}, not '${given}'`;
  }

  /** @param {string} name @param {number | bigint} raw */
  made(name, raw) {
    return new SpecialCode(name, raw, this.noValue.includes(name), this.writable.includes(name));
  }
}

/** The same number as the other type of numbers. @param {number | bigint} raw */
function otherType(raw) {
  return typeof raw === "bigint" ? Number(raw) : BigInt(raw);
}

/** @param {string} name @returns {string} */
function codeProperty(name) {
  const found = camelName(name);
  return found in Object.prototype || found === "then" || found === "prototype" || found === "toJSON" ? `${found}_` : found;
}

/** Special codes. @param {ConstructorParameters<typeof Codes>[0]} raws @param {ConstructorParameters<typeof Codes>[1]} [facts] */
export function codes(raws, facts = {}) {
  return new Codes(raws, facts);
}

export const NO_CODES = /* @__PURE__ */ codes({});
