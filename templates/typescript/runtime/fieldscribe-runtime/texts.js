// SPDX-License-Identifier: 0BSD
/** Forms of words that hold characters, bytes, decimal digits or a time instead of a number. */
import { MalformedError, shown, UnknownValueError, WrongLengthError, WrongTypeError } from "./errors.js";
import { AroundForm, Form, namedList } from "./forms.js";
import { exactRatio, roundRatio, wholeNumber } from "./numbers.js";
import { numberName } from "./words.js";
import { WireType } from "./wire-types.js";

/** @typedef {import("./rules.js").Raws} Raws */
/** @typedef {{ perWord?: number, padding?: number, lowFirst?: boolean }} TextFacts */

const BLANK = 0x20;
const NO_TEXT_COUNTS = "a text has no counts: use raw numbers or values";

/** Characters in words; the raw number is all words, the first one highest. Blanks or zeros (`padding`) fill it up. */
class TextForm extends Form {
  /** @param {number} characters @param {string} encoding @param {TextFacts} facts */
  constructor(characters, encoding, { perWord = 2, padding = BLANK, lowFirst = false }) {
    const size = encoding === "utf-16" ? 2 : 1;
    super(new WireType(16 * Math.ceil(characters / (size === 2 ? 1 : perWord)), {}));
    this.characters = characters;
    this.encoding = encoding;
    this.padding = padding;
    this.lowFirst = lowFirst;
    this.size = size;
    this.step = size === 1 && perWord === 1 ? 2 : 1;
  }

  /** The bytes of all characters. @param {any} raw @returns {Uint8Array} */
  bytesOf(raw) {
    const data = new Uint8Array(this.wire.bits / 8);
    for (let at = data.length - 1, left = BigInt(raw); at >= 0; at--, left >>= 8n) {
      data[this.lowFirst ? at ^ 1 : at] = Number(left & 0xffn);
    }
    return data.filter((_, at) => at % this.step === this.step - 1).subarray(0, this.characters * this.size);
  }

  /** The words of bytes, filled up. @param {ArrayLike<number>} codes @param {readonly number[]} fill @returns {any} */
  wordsOf(codes, fill) {
    const data = new Uint8Array(this.wire.bits / 8);
    for (let at = 0; at * this.step < data.length; at++) {
      data[at * this.step + this.step - 1] = at < codes.length ? codes[at] : (fill[at % this.size] ?? 0);
    }
    const ordered = data.map((_, at) => data[this.lowFirst ? at ^ 1 : at]);
    return this.wire.raw(ordered.reduce((number, byte) => (number << 8n) | BigInt(byte), 0n));
  }

  /** @param {any} raw */
  decode(raw) {
    let codes = this.bytesOf(raw);
    for (let at = 0; at < codes.length && !this.padding; at += this.size) {
      if (!codes[at] && (this.size === 1 || !codes[at + 1])) codes = codes.subarray(0, at);
    }
    return this.textOf(codes).replace(/ +$/, "");
  }

  /** @param {Uint8Array} codes @returns {string} */
  textOf(codes) {
    if (!this.encoding.startsWith("utf")) return String.fromCharCode(...codes);
    try {
      const label = this.encoding === "utf-16" ? "utf-16be" : "utf-8";
      return new TextDecoder(label, { fatal: true, ignoreBOM: true }).decode(codes);
    } catch {
      throw new MalformedError(`the words are no ${this.encoding}`);
    }
  }

  /** The bytes of a text; undefined where the encoding lacks a character. @param {string} text
   * @returns {ArrayLike<number> | undefined} */
  codesOf(text) {
    if (/[\ud800-\udfff]/u.test(text)) return undefined;
    if (this.encoding === "utf-8") return new TextEncoder().encode(text);
    const units = Array.from({ length: text.length }, (_, at) => text.charCodeAt(at));
    if (this.encoding === "utf-16") return units.flatMap((unit) => [unit >> 8, unit & 0xff]);
    return units.every((unit) => unit < 0x100) ? units : undefined;
  }

  /** @param {any} value */
  converted(value) {
    if (typeof value !== "string") return undefined;
    const [all, codes] = [this.codesOf(value), this.codesOf(value.replace(/ +$/, ""))];
    if (!all || !codes || all.length / this.size > this.characters || !this.isPrintable(value)) return undefined;
    return this.wordsOf(codes, this.size === 2 ? [0, this.padding] : [this.padding]);
  }

  /** Whether every character is one of the encoding, and none a control character. @param {string} text */
  isPrintable(text) {
    const isWide = this.encoding.startsWith("utf");
    return Array.from(text, (char) => char.codePointAt(0) ?? 0).every((code) => {
      if (code >= 0x20 && code < 0x7f) return true;
      if (this.encoding === "ascii") return false;
      return (code >= 0xa0 && code < 0x100) || (isWide && code >= 0x100);
    });
  }

  /** @param {any} raw @returns {any} */
  checked(raw) {
    if (raw < 0 || raw >= this.wire.power(this.wire.bits)) return undefined;
    try {
      return this.isPrintable(this.decode(raw)) ? raw : undefined;
    } catch {
      return undefined;
    }
  }

  /** @returns {bigint} */
  decodeCount() {
    throw new WrongTypeError(NO_TEXT_COUNTS);
  }

  convertedCount() {
    throw new WrongTypeError(NO_TEXT_COUNTS);
  }

  /** @param {any} raw */
  shown(raw) {
    return this.decode(raw);
  }

  choices() {
    const units = { "utf-8": "bytes of utf-8", "utf-16": "words of utf-16" };
    const what = units[/** @type {keyof typeof units} */ (this.encoding)] ?? `printable ${this.encoding} characters`;
    return `no text of at most ${this.characters} ${what}`;
  }
}

/** Bytes in words as a text in a notation: hex, ipv4, ipv6, eui48, eui64, version, or version of nibbles. */
class BytesForm extends TextForm {
  /** @param {Uint8Array} data */
  textOf(data) {
    const bytes = [...data];
    if (this.encoding === "ipv6") return ipv6Text(bytes);
    if (this.encoding === "ipv4" || this.encoding === "version") return bytes.join(".");
    if (this.encoding.startsWith("version")) return bytes.flatMap((byte) => [byte >> 4, byte & 15]).join(".");
    const digits = bytes.map((byte) => byte.toString(16).toUpperCase().padStart(2, "0"));
    return digits.join(this.encoding.startsWith("eui") ? ":" : "");
  }

  /** @param {any} raw */
  decode(raw) {
    return this.textOf(this.bytesOf(raw));
  }

  /** @param {any} value */
  converted(value) {
    const data = typeof value === "string" ? this.parsed(value) : undefined;
    return data?.length === this.characters ? this.wordsOf(data, [0]) : undefined;
  }

  /** The bytes of a text; undefined for what is none. @param {string} text @returns {number[] | undefined} */
  parsed(text) {
    if (this.encoding === "ipv4") return ipv4Bytes(text.trim());
    if (this.encoding === "ipv6") return ipv6Bytes(text.trim());
    if (!this.encoding.startsWith("version")) {
      const digits = text.replace(/[:\s-]/g, "");
      if (!/^(?:[0-9a-f]{2})*$/i.test(digits)) return undefined;
      return (digits.match(/../g) ?? []).map((pair) => parseInt(pair, 16));
    }
    if (!/^[0-9]{1,3}(?:\.[0-9]{1,3})*$/.test(text)) return undefined;
    const parts = text.split(".").map(Number);
    if (this.encoding === "version") return parts.every((part) => part < 256) ? parts : undefined;
    if (parts.length % 2 || parts.some((part) => part > 15)) return undefined;
    return parts.filter((_, at) => at % 2 === 0).map((part, at) => (part << 4) | parts[2 * at + 1]);
  }

  /** @param {any} raw @returns {any} */
  checked(raw) {
    return raw >= 0 && raw < this.wire.power(this.wire.bits) ? raw : undefined;
  }

  choices() {
    return `not ${this.characters} byte${this.characters > 1 ? "s" : ""} as ${this.encoding}`;
  }
}

/** @param {string} text @returns {number[] | undefined} */
function ipv4Bytes(text) {
  const parts = text.split(".");
  const isGood = parts.length === 4 && parts.every((part) => /^(?:0|[1-9][0-9]{0,2})$/.test(part) && Number(part) < 256);
  return isGood ? parts.map(Number) : undefined;
}

/** @param {string} text @returns {number[] | undefined} */
function ipv6Bytes(text) {
  const tail = /^(.*:)([0-9.]+\.[0-9.]+)$/.exec(text);
  const last = tail ? ipv4Bytes(tail[2]) : [];
  if (!last) return undefined;
  const packed = last.length ? `${((last[0] << 8) | last[1]).toString(16)}:${((last[2] << 8) | last[3]).toString(16)}` : "";
  const halves = (tail ? tail[1] + packed : text).split("::");
  if (halves.length > 2) return undefined;
  const [head, rest] = halves.map((half) => (half ? half.split(":") : []));
  const missing = 8 - head.length - (rest?.length ?? 0);
  if (rest ? missing < 1 : missing !== 0) return undefined;
  const groups = rest ? [...head, ...Array(missing).fill("0"), ...rest] : head;
  if (!groups.every((group) => /^[0-9a-f]{1,4}$/i.test(group))) return undefined;
  return groups.flatMap((group) => [parseInt(group, 16) >> 8, parseInt(group, 16) & 0xff]);
}

/** @param {readonly number[]} bytes @returns {string} */
function ipv6Text(bytes) {
  const groups = Array.from({ length: 8 }, (_, at) => ((bytes[2 * at] << 8) | bytes[2 * at + 1]).toString(16));
  let [start, longest] = [0, 1];
  for (let at = 0; at < 8; at++) {
    let end = at;
    while (end < 8 && groups[end] === "0") end++;
    if (end - at > longest) [start, longest] = [at, end - at];
  }
  if (longest < 2) return groups.join(":");
  return `${groups.slice(0, start).join(":")}::${groups.slice(start + longest).join(":")}`;
}

/** A word whose decimal digits, the highest first, are each one of an enum's numbers. */
class DigitsForm extends Form {
  /** @param {WireType} wire @param {Readonly<Record<string, number>>} names @param {number} count */
  constructor(wire, names, count) {
    super(wire);
    this.names = names;
    this.digitNames = names;
    this.count = count;
    this.refused = UnknownValueError;
    /** @type {ReadonlySet<number>} */
    this.known = new Set(Object.values(names));
  }

  /** The digits; the first one is whatever the others leave. @param {any} raw @returns {readonly number[]} */
  decode(raw) {
    const digits = [];
    for (let left = Number(raw); ; left = Math.floor(left / 10)) {
      if (digits.length === this.count - 1) return Object.freeze([left, ...digits.reverse()]);
      digits.push(((left % 10) + 10) % 10);
    }
  }

  /** @param {any} value */
  converted(value) {
    if (!Array.isArray(value)) throw new WrongTypeError(`takes ${this.count} digits, not ${shown(value)}`);
    if (value.length !== this.count) throw new WrongLengthError(`takes ${this.count} digits, not ${value.length}`);
    let raw = 0;
    for (const digit of value) {
      const number = Number(wholeNumber(digit));
      if (!this.known.has(number)) return undefined;
      raw = raw * 10 + number;
    }
    return raw < this.wire.power(this.wire.bits) ? this.wire.raw(raw) : undefined;
  }

  /** @param {any} raw @returns {any} */
  checked(raw) {
    const isInside = raw >= 0 && raw < this.wire.power(this.wire.bits);
    return isInside && this.decode(raw).every((digit) => this.known.has(digit)) ? raw : undefined;
  }

  /** @param {any} raw */
  nameOf(raw) {
    return numberName(this.digitNames, raw);
  }

  choices() {
    return `not made of ${this.count} digits out of ${namedList(this.digitNames)}`;
  }
}

const MICRO = 1000000n;
const MILLI = 1000n;
const MOST_MILLISECONDS = 8640000000000000n;
const LAST_MICROSECOND = 253402300799999999n;
const FIRST_MICROSECOND = -62135596800000000n;

/** Another form whose value counts seconds from a date: a time in UTC; seconds are taken, too. */
class TimeForm extends AroundForm {
  /** @param {Form} form @param {string} epoch */
  constructor(form, epoch) {
    super(form);
    /** Milliseconds after 1970-01-01. */
    this.epoch = BigInt(Date.parse(epoch.includes("T") ? `${epoch}Z` : epoch));
    this.countsSeconds = form.constructor.name === "IntegerForm";
  }

  /** The time in parts of a second after 1970-01-01. @param {any} raw @param {Raws} raws @param {bigint} parts */
  partsOf(raw, raws, parts) {
    const seconds = this.form.decode(raw, raws);
    if (typeof seconds === "number" && !Number.isFinite(seconds)) throw new MalformedError(`raw ${raw} is no time`);
    const [num, den] = typeof seconds === "bigint" ? [seconds, 1n] : exactRatio(seconds);
    return (this.epoch * parts) / MILLI + roundRatio(num * parts, den);
  }

  /** @param {any} raw @param {Raws} raws */
  decode(raw, raws) {
    const count = this.partsOf(raw, raws, MILLI);
    if (count > MOST_MILLISECONDS || count < -MOST_MILLISECONDS) {
      throw new MalformedError(`raw ${raw} is a time that JavaScript does not have`);
    }
    return new Date(Number(count));
  }

  /** @param {any} value @param {Raws} raws */
  converted(value, raws) {
    if (!(value instanceof Date)) return this.form.converted(value, raws);
    const time = value.getTime();
    if (Number.isNaN(time)) throw new WrongTypeError("takes a valid time, not an invalid Date");
    const count = BigInt(time) - this.epoch;
    return this.form.converted(this.countsSeconds ? roundRatio(count, MILLI) : Number(count) / 1000, raws);
  }

  /** @param {any} raw @param {Raws} raws @param {number} [display] */
  shown(raw, raws, display) {
    if (display !== undefined) return this.form.shown(raw, raws, display);
    try {
      const count = this.partsOf(raw, raws, MICRO);
      if (count > LAST_MICROSECOND || count < FIRST_MICROSECOND) return this.form.shown(raw, raws);
      const micro = ((count % MICRO) + MICRO) % MICRO;
      const second = new Date(Number((count - micro) / MILLI)).toISOString().slice(0, 19);
      return `${second}${micro ? `.${String(micro).padStart(6, "0")}` : ""}+00:00`;
    } catch (error) {
      if (error instanceof MalformedError) return this.form.shown(raw, raws);
      throw error;
    }
  }
}

/** Characters. @param {number} characters @param {...(string | TextFacts)} more encoding, and how words hold it
 * @returns {Form} */
export function text(characters, ...more) {
  const [encoding, facts] = textArguments(more);
  return new TextForm(characters, encoding, facts);
}

/** Bytes in a notation. @param {number} count @param {...(string | TextFacts)} more notation, and how words hold it
 * @returns {Form} */
export function bytes(count, ...more) {
  const [notation, facts] = textArguments(more);
  return new BytesForm(count, notation, facts);
}

/** @param {(string | TextFacts)[]} more @returns {[string, TextFacts]} */
function textArguments(more) {
  const encoding = more.find((one) => typeof one === "string") ?? "ascii";
  const facts = more.find((one) => typeof one === "object") ?? {};
  return [/** @type {string} */ (encoding), /** @type {TextFacts} */ (facts)];
}

/** Decimal digits. @param {WireType} wire @param {Readonly<Record<string, number>>} names @param {{ count: number }} facts
 * @returns {Form} */
export function digits(wire, names, { count }) {
  return new DigitsForm(wire, names, count);
}

/** A time. @param {Form} form @param {string} epoch @returns {Form} */
export function time(form, epoch) {
  return new TimeForm(form, epoch);
}
