// SPDX-License-Identifier: 0BSD
/** Points: pure conversion between values, raw numbers and words. */
import {
  CodecError,
  OutOfRangeError,
  shown,
  SpecialCodeError,
  UnknownValueError,
  WrongLengthError,
  WrongTypeError,
} from "./errors.js";
import { withFixed } from "./forms.js";
import { rawNumber, significant, valueText, wholeNumber } from "./numbers.js";
import { highEnd, lowEnd, MovingLimit, NO_RAWS, outsideText } from "./rules.js";
import { SpecialCode } from "./special.js";

/** @typedef {import("./rules.js").Raws} Raws */
/** @typedef {import("./forms.js").Form} Form */
/** @typedef {import("./places.js").Place} Place */
/**
 * The facts of a point. `name` is the description's, `item` differs from that of other variants;
 * `allowed` are the raw numbers that may be written, `fixed` a mask and the bits that are always written there.
 * @typedef {{ name: string, item?: string, at: Place, writeAt?: Place, bits?: readonly [number, number], group?: string,
 *   code?: string, references?: Readonly<Record<string, number | string>>, unit?: string, display?: number,
 *   allowed?: import("./rules.js").Allowed, default?: number, fixed?: readonly [number, number], changes?: string,
 *   changesWith?: readonly string[], variant?: readonly [string, string],
 *   onlyFor?: readonly [string, readonly string[]], uncertain?: boolean,
 *   when?: import("./commands.js").Step["when"], conditions?: readonly string[], takesEffect?: string,
 *   selects?: readonly (readonly [string, number])[],
 *   writeWith?: readonly string[], keeps?: string }} FactsOfPoint
 */

/** One data point. Its methods need no device; they depend on its access. */
class Codec {
  /** @param {Form} form @param {FactsOfPoint} facts */
  constructor(form, facts) {
    const { name, item = name, at, code, group = "", unit = "", bits, references = {} } = facts;
    this.facts = facts;
    this.form = facts.fixed && !bits ? withFixed(form, facts.fixed) : form;
    this.name = name;
    /** The name, with the variant if only one has the point. */
    this.item = item;
    this.at = at;
    this.code = code;
    this.group = group;
    this.unit = unit;
    this.references = references;
    this.lowestBit = bits ? bits[1] : 0;
    /** The number of bits of the raw number. */
    this.width = bits ? bits[0] - bits[1] + 1 : form.wire.bits;
    /** The number of its words (or single bits). */
    this.size = bits ? 1 : Math.ceil(form.wire.bits / 16);
    const [least, greatest] = form.wire.limits(this.width);
    this.least = least;
    this.greatest = greatest;
  }

  get access() {
    return `${"decode" in this ? "r" : ""}${"encode" in this ? "w" : ""}`;
  }

  /** Code and name, for messages. */
  get label() {
    return this.code ? `${this.code} ${this.item}` : this.item;
  }

  /** Counts are in units of 10^-decimals; undefined if there are none. */
  get decimals() {
    return this.form.decimals;
  }

  /** The names of its numbers or flags, if they have names. */
  get names() {
    return this.form.names;
  }

  /** The special codes by name. */
  get special() {
    return this.form.codes.byName;
  }

  /** The special code that a raw number is; undefined for a quantity. @param {any} raw */
  specialOf(raw) {
    return this.form.codes.of(this._number(raw));
  }

  /** The points whose raw numbers decoding needs. */
  get scaleNeeds() {
    return this.form.needs;
  }

  /** The points whose raw numbers checking needs. @returns {readonly string[]} */
  get limitNeeds() {
    const bounds = (this.facts.allowed ?? []).flat();
    return [...new Set(bounds.flatMap((bound) => (bound instanceof MovingLimit ? bound.needs : [])))];
  }

  /** The raw numbers that may be written. @returns {import("./rules.js").Allowed} */
  get allowed() {
    return this.facts.allowed ?? [[this.least, this.greatest]];
  }

  /** The least and the greatest raw number that is ever allowed, whatever other points hold. @returns {[any, any]} */
  get rawLimits() {
    const { allowed } = this.facts;
    if (!allowed) return this.form.limits(this.width);
    const lows = allowed.map(([low]) => (low instanceof MovingLimit ? low.least : low));
    const highs = allowed.map(([, high]) => (high instanceof MovingLimit ? high.greatest : high));
    const raw = (/** @type {any} */ number) => this.form.wire.raw(number);
    return [raw(lows.reduce((one, other) => (other < one ? other : one))), raw(highs.reduce((one, other) => (other > one ? other : one)))];
  }

  /** The least value that is ever allowed; undefined if there is none, or other points decide. */
  get minimum() {
    return this._bounds()?.[0];
  }

  /** The greatest value that is ever allowed. */
  get maximum() {
    return this._bounds()?.[1];
  }

  _bounds() {
    try {
      return this.form.bounds(...this.rawLimits);
    } catch {
      return undefined;
    }
  }

  /** The description's name for a raw number; undefined if it has none. @param {any} raw */
  nameOf(raw) {
    return this.form.nameOf(this._number(raw));
  }

  /** The raw number in unsigned words (or bits) in ascending order of address. @param {readonly number[]} words @returns {any} */
  fromWords(words) {
    if (!Array.isArray(words)) throw this._named(new WrongTypeError(`takes words, as in [1], not ${shown(words)}`));
    const found = words.map((word) => Number(this._within(word, 0, 0xffff)));
    if (found.length !== this.size) {
      throw this._named(new WrongLengthError(`takes ${this.size} words, not ${found.length}`));
    }
    const { wire } = this.form;
    const ordered = wire.ordered(found);
    if (this.facts.bits) return this.extract(found[0]);
    return wire.number(wire.joined(this._order(this.at).map((place) => ordered[place])), wire.bits);
  }

  /** The unsigned words of a raw number in ascending order of address. @param {any} raw @returns {number[]} */
  toWords(raw) {
    const { wire } = this.form;
    const pattern = wire.pattern(this._within(raw, ...wire.limits(this.width)), this.width, this.size);
    const order = this._order(this.facts.writeAt ?? this.at);
    const words = Array(this.size).fill(0);
    wire.split(pattern, this.size).forEach((word, part) => {
      words[order[this.size - 1 - part]] = word;
    });
    return [...wire.ordered(words)];
  }

  /** Where the words of the number stand among those in ascending order of address, the high one first. @param {Place} at */
  _order(at) {
    if (at.addresses.length === 1) return Array.from({ length: this.size }, (_, place) => place);
    const ascending = [...at.addresses].sort((one, other) => one - other);
    return at.addresses.map((address) => ascending.indexOf(address));
  }

  /** The raw number of a bit group, from its whole word. @param {number} word @returns {any} */
  extract(word) {
    const { wire } = this.form;
    return wire.number(wire.raw(wire.ordered([word])[0] >> this.lowestBit), this.width);
  }

  /** The whole word with this bit group replaced, and with the constant bits set. @param {number} word @param {any} raw
   * @returns {number} */
  insert(word, raw) {
    const { wire } = this.form;
    const mask = 2 ** this.width - 1;
    const held = wire.ordered([Number(this._number(word))])[0];
    const placed = Number(wire.pattern(this._number(raw), this.width, 1)) & mask;
    const [fixed, bits] = this.facts.fixed ?? [0, 0];
    const result = (held & ~(mask << this.lowestBit)) | (placed << this.lowestBit);
    return wire.ordered([(result & ~fixed & 0xffff) | bits])[0];
  }

  /** Whether two raw numbers mean the same. @param {any} raw @param {any} other */
  same(raw, other) {
    return this.form.same(raw, other);
  }

  /**
   * A value as text with its unit: `50 Hz`. It has the decimals of the description, or else as many as
   * needed. Raises as `encode` does, but also takes values that may not be written.
   * @param {any} value @param {Raws} [raws] @returns {string}
   */
  text(value, raws = NO_RAWS) {
    if (value instanceof SpecialCode) return value.name;
    const raw = this._about(value, () => {
      const found = this.form.converted(value, raws);
      if (found === undefined) throw new OutOfRangeError(`${valueText(value)} is no value of this point`);
      return found;
    });
    return this.told(this._within(raw, this.least, this.greatest), raws);
  }

  /** The value of a raw number as `text` does, or `raw ...` if `raws` lacks what the scale needs.
   * @param {any} raw @param {Raws} [raws] @returns {string} */
  told(raw, raws = NO_RAWS) {
    const number = this._number(raw);
    if (number < this.least || number > this.greatest) return `raw ${raw}`;
    const code = this.form.codes.of(number);
    if (code) return code.name;
    try {
      return this.form.shown(number, raws, this.facts.display) + this._unit;
    } catch (error) {
      if (error instanceof CodecError) return `raw ${raw}`;
      throw error;
    }
  }

  get _unit() {
    return this.unit ? ` ${this.unit}` : "";
  }

  /** The same as a raw number of the type; a boolean is one of a bit. @param {any} number @param {any} low @param {any} high
   * @returns {any} */
  _within(number, low, high) {
    return this._about(number, () => {
      const plain = typeof number === "boolean" && this.width === 1 ? Number(number) : wholeNumber(number);
      if (plain >= low && plain <= high) return this.form.wire.raw(plain);
      throw new OutOfRangeError(`${valueText(number)} is outside ${low}..${high}`);
    });
  }

  /** @param {any} raw @returns {any} */
  _number(raw) {
    return this._about(raw, () => this.form.wire.raw(rawNumber(raw, this.width)));
  }

  /** Add to errors raised meanwhile what was asked for. @template T @param {any} value @param {() => T} work @returns {T} */
  _about(value, work) {
    try {
      return work();
    } catch (error) {
      throw error instanceof CodecError ? this._named(error, value) : error;
    }
  }

  /** @param {CodecError} error @param {any} [value] */
  _named(error, value) {
    return error.about({ point: this.label, value, limits: this.rawLimits });
  }
}

/** The methods of points that can be read. */
const DECODING = {
  /** The slow way, which knows every case and words the errors. @this {Codec} @param {any} raw @param {Raws} [raws] */
  _decode(raw, raws = NO_RAWS) {
    return this._about(raw, () => this.form.decode(possible(this, raw), raws));
  },

  /** The value as a count of 10^-decimals units; raises SpecialCodeError for a special code.
   * @this {Codec} @param {any} raw @param {Raws} [raws] */
  decodeCount(raw, raws = NO_RAWS) {
    return this._about(raw, () => this.form.decodeCount(possible(this, raw), raws));
  },

  /** The value in bytes as words travel, from `offset` on. @this {any} @param {Uint8Array} bytes @param {number} [offset]
   * @param {Raws} [raws] */
  _decodeBytes(bytes, offset = 0, raws = NO_RAWS) {
    const length = 2 * this.size;
    if (!(offset >= 0 && offset + length <= bytes.length)) {
      throw this._named(new WrongLengthError(`takes ${length} bytes, not ${Math.max(0, bytes.length - offset)}`));
    }
    const words = Array.from({ length: this.size }, (_, at) => (bytes[offset + 2 * at] << 8) | bytes[offset + 2 * at + 1]);
    return this._decode(this.fromWords(words), raws);
  },
};

/** The same number; raises OutOfRangeError for what the point cannot hold. @param {Codec} point @param {any} raw */
function possible(point, raw) {
  const number = rawNumber(raw, point.width);
  if (number >= point.least && number <= point.greatest) return point.form.wire.raw(number);
  const hint = point.form.wire.signed ? ", with its sign: fromWords gives it" : "";
  throw new OutOfRangeError(`${raw} is no raw number, which is ${point.least}..${point.greatest}${hint}`);
}

/** The methods of points that can be written. */
const ENCODING = {
  /** The raw number for a value. @this {any} @param {any} value @param {Raws} [raws] */
  encode(value, raws = NO_RAWS) {
    this.require(value);
    return this._about(value, () => {
      const converted = this.form.converted(value, raws);
      const raw = converted === undefined ? undefined : this.form.checked(converted, this.allowed, raws);
      if (raw === undefined) throw this._refusal(valueText(value), raws);
      return raw;
    });
  },

  /** Raises an error for what is never written. @this {any} @param {any} value */
  require(value) {
    const { codes } = this.form;
    if (typeof value === "string" && (this.scaleNeeds.length || this.limitNeeds.length)) {
      const told = codes.spans.size ? codes.notAText(value) : `takes a number, not ${shown(value)}`;
      throw this._named(new WrongTypeError(told), value);
    }
    if (!(value instanceof SpecialCode)) return;
    if (!codes.has(value)) throw this._named(new UnknownValueError(`${value} is no special code of this point`), value);
    this._requireWritable(value);
  },

  /** The same for a raw number. @this {any} @param {any} raw */
  requireRaw(raw) {
    this._requireWritable(this.form.codes.of(rawNumber(raw, this.width)));
  },

  /** @this {any} @param {SpecialCode | undefined} code */
  _requireWritable(code) {
    if (!code || code.writable) return;
    throw this._named(new SpecialCodeError(code.name, `raw ${code.raw} is the special code ${code}: it is only read`), code);
  },

  /** The raw number for a count of 10^-decimals units, by integers alone. @this {any} @param {any} count @param {Raws} [raws] */
  encodeCount(count, raws = NO_RAWS) {
    return this._about(count, () => {
      const raw = this.form.checked(this.form.convertedCount(count, raws), this.allowed, raws);
      if (raw === undefined) throw this._refusal(significant(Number(count) / 10 ** (this.decimals ?? 0)), raws);
      return raw;
    });
  },

  /** Raises an error if this raw number may not be written. @this {any} @param {any} raw @param {Raws} [raws] */
  check(raw, raws = NO_RAWS) {
    this._about(raw, () => {
      const plain = typeof raw === "boolean" && this.width === 1 ? Number(raw) : wholeNumber(raw);
      const number = this.form.wire.raw(plain);
      if (this.form.checked(number, this.allowed, raws) !== undefined) return;
      const choices = this.form.choices(this._unit) ?? this._outside(String, "", raws);
      throw new this.form.refused(`raw ${raw} is ${choices}`);
    });
  },

  /** @this {any} @param {string} value @param {Raws} raws */
  _refusal(value, raws) {
    const told = (/** @type {any} */ raw) => this.form.shown(this.form.wire.raw(raw), raws);
    const choices = this.form.choices(this._unit) ?? this._outside(told, this._unit, raws);
    return new this.form.refused(`${value}${this._unit} is ${choices}`);
  },

  /** Why a number is refused, by the limits that other points set now.
   * @this {any} @param {(raw: any) => string} told @param {string} unit @param {Raws} raws */
  _outside(told, unit, raws) {
    /** @type {[any, any][]} */
    const ends = this.allowed.map((/** @type {any} */ [low, high]) => [lowEnd(low, raws), highEnd(high, raws)]);
    const texts = ends.map(([low, high]) => /** @type {[string, string]} */ ([told(low), told(high)]));
    const left = texts.filter((_, at) => ends[at][0] <= ends[at][1]);
    const setters = this.limitNeeds.join(" and ");
    if (left.length) return outsideText(left, unit) + (setters ? ` (set by ${setters})` : "");
    return `refused, as anything is now: ${setters} leave ${texts.map(([low, high]) => `${low}..${high}`).join(" or ")}${unit}`;
  },
};

class ReadOnlyCodec extends Codec {
  /** @param {Form} form @param {FactsOfPoint} facts */
  constructor(form, facts) {
    super(form, facts);
    specialise(this);
  }
}
class WriteOnlyCodec extends Codec {}
class ReadWriteCodec extends ReadOnlyCodec {}
Object.assign(ReadOnlyCodec.prototype, DECODING);
Object.assign(WriteOnlyCodec.prototype, ENCODING);
Object.assign(ReadWriteCodec.prototype, ENCODING);

/** Give a point the functions `decode` and `decodeBytes`, quick ones where its facts allow. @param {any} point */
function specialise(point) {
  const { form } = point;
  const slow = (/** @type {any} */ raw, /** @type {Raws | undefined} */ raws) => point._decode(raw, raws);
  const ofWord = point.size === 1 && form.wire.bits === 16 && !form.wire.coding && !form.wire.lowByteFirst && !point.facts.bits;
  const convert = ofWord ? form.quickWord() : undefined;
  const slowBytes = (/** @type {any} */ bytes, /** @type {any} */ offset, /** @type {any} */ raws) =>
    point._decodeBytes(bytes, offset, raws);
  let quick = slowBytes;
  if (convert && form.wire.signed) {
    quick = (bytes, offset = 0) =>
      offset + 2 <= bytes.length && offset >= 0
        ? convert(((bytes[offset] << 24) | (bytes[offset + 1] << 16)) >> 16)
        : slowBytes(bytes, offset, NO_RAWS);
  } else if (convert) {
    quick = (bytes, offset = 0) =>
      offset + 2 <= bytes.length && offset >= 0
        ? convert((bytes[offset] << 8) | bytes[offset + 1])
        : slowBytes(bytes, offset, NO_RAWS);
  }
  Object.defineProperty(point, "decode", { value: form.quickDecode(point.least, point.greatest, slow) });
  Object.defineProperty(point, "decodeBytes", { value: quick });
}

/** A point that can only be read. @param {Form} form @param {FactsOfPoint} facts */
export function readOnly(form, facts) {
  return new ReadOnlyCodec(form, facts);
}

/** A point that can only be written. @param {Form} form @param {FactsOfPoint} facts */
export function writeOnly(form, facts) {
  return new WriteOnlyCodec(form, facts);
}

/** A point that can be read and written. @param {Form} form @param {FactsOfPoint} facts */
export function readWrite(form, facts) {
  return new ReadWriteCodec(form, facts);
}

/** A point that a write may keep in EEPROM. @param {Form} form @param {FactsOfPoint} facts */
export function stored(form, facts) {
  return Object.assign(new ReadWriteCodec(form, facts), { isStored: true });
}

/** The same that can only be written. @param {Form} form @param {FactsOfPoint} facts */
export function storedWriteOnly(form, facts) {
  return Object.assign(new WriteOnlyCodec(form, facts), { isStored: true });
}

/** Why a point has no codec, and the addresses of its words, if they can be reached. @param {string} reason
 * @param {{ at?: Place, writeAt?: Place, code?: string }} [facts] */
export function documented(reason, facts = {}) {
  return Object.freeze({ reason, ...facts });
}
