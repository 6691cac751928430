// SPDX-License-Identifier: 0BSD
/** Forms of dates and times whose parts are numbers in some bits of the words. */
import { MalformedError, shown, WrongTypeError } from "./errors.js";
import { Form } from "./forms.js";
import { wholeNumber } from "./numbers.js";
import { WireType } from "./wire-types.js";

/** @typedef {[name: string, word: number, high: number, low: number, base?: number]} DatePart */
/** @typedef {{ bcd?: boolean, lowFirst?: boolean }} DateFacts */

const DATE = ["year", "month", "day"];
const TIME = ["hour", "minute", "second", "millisecond"];
const MINUTE = 60000;

/** Parts of a date, a time, or both, as `Temporal` names them; `base` is the year that 0 means, or the number of Sunday. */
class DatedForm extends Form {
  /** @param {number} words @param {readonly DatePart[]} parts @param {DateFacts} facts @param {string[]} fields @param {string} what */
  constructor(words, parts, { bcd = false, lowFirst = false }, fields, what) {
    super(new WireType(16 * words, {}));
    this.words = words;
    this.fields = fields;
    this.what = what;
    this.part = new WireType(16, { coding: bcd ? "bcd" : "" });
    this.lowFirst = lowFirst;
    const names = new Set(parts.map(([name]) => name));
    this.written = fields.filter((name) => names.has(name) || (name === "second" && names.has("millisecond")));
    this.hasSecond = names.has("second");
    this.parts = parts.map(([name, word, high, low, base = 0]) => {
      const width = high - low + 1;
      return { name, word, low, base, width, most: (bcd ? 10 ** (width / 4) : 2 ** width) - 1 };
    });
  }

  /** Words with their high byte first, or as on the wire. @param {number[]} words */
  ordered(words) {
    return this.lowFirst ? words.map((word) => ((word & 0xff) << 8) | (word >> 8)) : words;
  }

  /** @param {any} raw @returns {any} */
  decode(raw) {
    const all = BigInt(raw);
    const travelled = Array.from({ length: this.words }, (_, at) => Number((all >> BigInt(16 * (this.words - 1 - at))) & 0xffffn));
    const words = this.ordered(travelled);
    /** @type {Record<string, number>} */
    const held = Object.fromEntries(this.fields.map((name) => [name, 0]));
    for (const { name, word, low, base, width, most } of this.parts) {
      const number = this.part.number(words[word] >> low, width);
      if (name !== "weekday") held[name] = number > most ? NaN : number + base;
    }
    if (!this.hasSecond && this.fields.includes("second")) {
      held.second = Math.floor(held.millisecond / 1000);
      held.millisecond %= 1000;
    }
    if (!this.isReal(held)) throw new MalformedError(`raw ${raw} is no ${this.what}`);
    return Object.freeze(held);
  }

  /** Whether there is such a date and time. @param {Record<string, number>} held */
  isReal({ year = 1, month = 1, day = 1, hour = 0, minute = 0, second = 0, millisecond = 0 }) {
    const days = month === 2 ? 28 + Number(isLeap(year)) : 30 + ((month + (month >> 3)) & 1);
    const isDate = year >= 1 && year <= 9999 && month >= 1 && month <= 12 && day >= 1 && day <= days;
    return isDate && hour < 24 && minute < 60 && 1000 * second + millisecond < MINUTE && millisecond < 1000;
  }

  /** @param {any} value */
  converted(value) {
    if (value === null || typeof value !== "object" || value instanceof Date) {
      throw new WrongTypeError(`takes an object with ${this.fields.join(", ")}, not ${shown(value)}`);
    }
    /** @type {Record<string, number>} */
    const held = {};
    for (const name of this.written) held[name] = Number(wholeNumber(TIME.indexOf(name) > 0 ? (value[name] ?? 0) : value[name]));
    if (!this.isReal(held) || Object.values(held).some((number) => number < 0)) return undefined;
    if (!this.hasSecond && "second" in held) held.millisecond += 1000 * held.second;
    const words = Array(this.words).fill(0);
    for (const { name, word, low, base, width, most } of this.parts) {
      const number = name === "weekday" ? weekday(held, base) : held[name] - base;
      if (number < 0 || number > most) return undefined;
      words[word] |= this.part.pattern(number, width, 1) << low;
    }
    return this.wire.raw(this.ordered(words).reduce((all, word) => (all << 16n) | BigInt(word), 0n));
  }

  /** @param {any} raw @returns {any} */
  checked(raw) {
    try {
      this.decode(raw);
      return raw >= 0 && raw < this.wire.power(this.wire.bits) ? raw : undefined;
    } catch (error) {
      if (error instanceof MalformedError) return undefined;
      throw error;
    }
  }

  /** @param {any} raw @returns {bigint} */
  decodeCount(raw) {
    throw new WrongTypeError(`a ${this.what} has no counts: use raw numbers or values (raw ${raw})`);
  }

  /** @param {unknown} count @returns {any} */
  convertedCount(count) {
    throw new WrongTypeError(`a ${this.what} has no counts: use raw numbers or values, not ${shown(count)}`);
  }

  /** The date and time: `2026-11-29T12:00:00`. @param {any} raw */
  shown(raw) {
    const { year, month, day, hour, minute, second, millisecond } = this.decode(raw);
    const date = this.fields.includes("year") ? `${padded(year, 4)}-${padded(month)}-${padded(day)}` : "";
    if (!this.fields.includes("hour")) return date;
    const time = `${padded(hour)}:${padded(minute)}:${padded(second)}`;
    return `${date}${date && "T"}${time}${millisecond ? `.${padded(millisecond, 3)}000` : ""}`;
  }

  choices() {
    return `no ${this.what} that the point can hold`;
  }
}

/** @param {number} number @param {number} [length] */
function padded(number, length = 2) {
  return String(number).padStart(length, "0");
}

/** @param {number} year */
function isLeap(year) {
  return year % 4 === 0 && (year % 100 !== 0 || year % 400 === 0);
}

/** The number of a weekday where Sunday has the number `sunday`: 0, 1, 6 or 7. @param {Record<string, number>} date @param {number} sunday */
function weekday({ year, month, day }, sunday) {
  const date = new Date(0);
  date.setUTCFullYear(year, month - 1, day);
  return sunday < 6 ? date.getUTCDay() + sunday : ((date.getUTCDay() + 6) % 7) + sunday - 6;
}

/** A date in parts. @param {number} words @param {readonly DatePart[]} parts @param {DateFacts} [facts] @returns {Form} */
export function dateParts(words, parts, facts = {}) {
  return new DatedForm(words, parts, facts, DATE, "date");
}

/** A time in parts. @param {number} words @param {readonly DatePart[]} parts @param {DateFacts} [facts] @returns {Form} */
export function timeParts(words, parts, facts = {}) {
  return new DatedForm(words, parts, facts, TIME, "time");
}

/** A date and time in parts. @param {number} words @param {readonly DatePart[]} parts @param {DateFacts} [facts] @returns {Form} */
export function dateTimeParts(words, parts, facts = {}) {
  return new DatedForm(words, parts, facts, [...DATE, ...TIME], "date and time");
}
