// SPDX-License-Identifier: 0BSD
/** What raw numbers mean: forms turn values into raw numbers and back without any I/O. */
import {
  NotANumberError,
  OutOfRangeError,
  ResultOverflowError,
  shown,
  SpecialCodeError,
  UnknownValueError,
  WrongTypeError,
} from "./errors.js";
import {
  decimalText,
  exactRatio,
  finite,
  nearestQuotient,
  significant,
  wholeNumber,
} from "./numbers.js";
import { chosenRule, highEnd, LinearRule, lowEnd, NO_RAWS, outsideText } from "./rules.js";
import { NO_CODES, SpecialCode } from "./special.js";
import { numberName, Word } from "./words.js";
import { BIT, WireType } from "./wire-types.js";

/** @typedef {import("./rules.js").Raws} Raws */
/** @typedef {import("./rules.js").Allowed} Allowed */
/** @typedef {Readonly<Record<string, number>>} Names */
/** Converts the usual cases, and others by a slower function. @typedef {(number: any, raws?: Raws) => any} Way */

/** The meaning of raw numbers. They are bigint if the type has more than 32 bits. */
export class Form {
  /** @param {WireType} wire */
  constructor(wire) {
    this.wire = wire;
    /** The points whose raw numbers the scale needs. @type {readonly string[]} */
    this.needs = [];
    /** Counts are in units of 10^-decimals; undefined if there are none. @type {number | undefined} */
    this.decimals = 0;
    this.codes = NO_CODES;
    /** @type {Names | import("./words.js").WordLayout | undefined} */
    this.names = undefined;
    /** The error for what may not be written. @type {new (message: string) => Error} */
    this.refused = OutOfRangeError;
    /** Whether values can be encoded; numbers with too many bits can only be decoded. */
    this.encodes = true;
  }

  /** The value of a raw number. @param {any} raw @param {Raws} raws @returns {any} */
  decode(raw, raws) {
    void raws;
    return raw;
  }

  /** The raw number for a value, even if it may not be written; undefined if there is none.
   * @param {any} value @param {Raws} raws @returns {any} */
  converted(value, raws) {
    void raws;
    return this.wire.raw(wholeNumber(value));
  }

  /** A function that decodes raw numbers from `low` to `high` quickly. @param {any} low @param {any} high @param {Way} slow
   * @returns {Way} */
  quickDecode(low, high, slow) {
    void low, high;
    return slow;
  }

  /** A function that computes the value of an unsigned word, or undefined if there is none. @returns {((word: number) => any) | undefined} */
  quickWord() {
    return undefined;
  }

  /** The value as a count of 10^-decimals units. @param {any} raw @param {Raws} raws @returns {bigint} */
  decodeCount(raw, raws) {
    void raws;
    return BigInt(raw);
  }

  /** The raw number for a count, even if it may not be written. @param {unknown} count @param {Raws} raws @returns {any} */
  convertedCount(count, raws) {
    void raws;
    return this.wire.raw(wholeNumber(count));
  }

  /** The number; undefined if it may not be written. @param {any} raw @param {Allowed} allowed @param {Raws} raws
   * @returns {any} */
  checked(raw, allowed, raws) {
    const ends = allowed.map(([low, high]) => [lowEnd(low, raws), highEnd(high, raws)]); // all, whichever holds
    return ends.some(([low, high]) => low <= raw && raw <= high) ? raw : undefined;
  }

  /** The least and greatest number of the form in `width` bits.
   * @param {number} width @returns {[any, any]} */
  limits(width) {
    return this.wire.limits(width);
  }

  /** The least and greatest quantity for raw numbers of a range; undefined if there are none.
   * @param {any} low @param {any} high @returns {[number, number] | undefined} */
  bounds(low, high) {
    void low, high;
    return undefined;
  }

  /** The value of a raw number as text without the unit; a quantity with `display` decimals, if given.
   * @param {any} raw @param {Raws} raws @param {number} [display] @returns {string} */
  shown(raw, raws, display) {
    void raws;
    return display === undefined ? String(raw) : decimalText(BigInt(raw), 1n, display);
  }

  /** Whether two raw numbers mean the same. @param {any} raw @param {any} other */
  same(raw, other) {
    return raw === other;
  }

  /** Why a value is refused, if not for the range of raw numbers. @param {string} unit @returns {string | undefined} */
  choices(unit) {
    void unit;
    return undefined;
  }

  /** The name of a raw number. @param {any} raw @returns {string | undefined} */
  nameOf(raw) {
    void raw;
    return undefined;
  }
}

class IntegerForm extends Form {
  quickWord() {
    return (/** @type {number} */ word) => word;
  }

  /** @param {any} low @param {any} high @returns {[number, number]} */
  bounds(low, high) {
    return [Number(low), Number(high)];
  }
}

class BitForm extends Form {
  /** @param {any} raw */
  decode(raw) {
    return raw !== 0;
  }

  /** @param {any} value */
  converted(value) {
    return typeof value === "boolean" ? Number(value) : this.wire.raw(wholeNumber(value));
  }
}

/** Numbers of which some have names; the others survive as they are. `closed`: only named ones may be written. */
class NamedForm extends Form {
  /** @param {WireType} wire @param {Names} names @param {boolean} isClosed */
  constructor(wire, names, isClosed) {
    super(wire);
    this.names = names;
    this.isClosed = isClosed;
    /** @type {ReadonlySet<number>} */
    this.known = new Set(Object.values(names));
    if (isClosed) this.refused = UnknownValueError;
  }

  /** @param {any} value */
  converted(value) {
    if (typeof value === "string" || typeof value === "boolean") {
      const keys = Object.keys(this.names ?? {});
      const key = keys.find((name) => name === String(value).trim().toUpperCase()) ?? keys[0];
      throw new WrongTypeError(`takes one of its numbers, such as ${key}, not ${shown(value)}`);
    }
    return this.wire.raw(wholeNumber(value));
  }

  /** @param {any} raw @param {Allowed} allowed @param {Raws} raws */
  checked(raw, allowed, raws) {
    return this.isClosed && !this.known.has(Number(raw)) ? undefined : super.checked(raw, allowed, raws);
  }

  /** @param {number} width @returns {[any, any]} */
  limits(width) {
    if (!this.isClosed) return super.limits(width);
    return [this.wire.raw(Math.min(...this.known)), this.wire.raw(Math.max(...this.known))];
  }

  /** @param {any} raw */
  nameOf(raw) {
    return numberName(/** @type {Names} */ (this.names), raw);
  }

  choices() {
    return this.isClosed ? `none of ${namedList(/** @type {Names} */ (this.names))}` : undefined;
  }
}

/** @param {Names} names @returns {string} */
export function namedList(names) {
  return Object.entries(names).map(([name, raw]) => `${raw} ${name.toLowerCase()}`).join(", ");
}

/** Named bits in a word; bits without a name survive. */
class FlagsForm extends Form {
  /** @param {WireType} wire @param {import("./words.js").WordLayout} layout */
  constructor(wire, layout) {
    super(wire);
    this.names = layout;
    this.layout = layout;
  }

  /** @param {any} raw */
  decode(raw) {
    return this.layout.from(raw < 0 ? raw + this.wire.power(this.wire.bits) : raw);
  }

  /** @param {any} value */
  converted(value) {
    if (value instanceof Word && Object.getPrototypeOf(value) !== this.layout.prototype) {
      throw new UnknownValueError(`${value} is no ${this.layout.name}`);
    }
    const raw = this.wire.raw(wholeNumber(value instanceof Word ? value.raw : value));
    return this.wire.signed && raw >= 0 && raw < this.wire.power(this.wire.bits) ? this.wire.number(raw, this.wire.bits) : raw;
  }
}

/** A quantity: raw = value by a rule, or by the first of several cases that fits. */
class ScaledForm extends Form {
  /** @param {WireType} wire @param {LinearRule | readonly import("./rules.js").ScaleCase[]} scale
   * @param {{ decimals: number | null, encodes?: boolean, most?: number | bigint }} facts */
  constructor(wire, scale, { decimals, encodes = true, most }) {
    super(wire);
    this.scale = scale;
    this.decimals = decimals ?? undefined;
    this.encodes = encodes;
    this.most = most;
    const cases = scale instanceof LinearRule ? [{ point: null, rule: scale }] : scale;
    const names = cases.flatMap((one) => [one.point, ...one.rule.factors.map((factor) => factor.point)]);
    this.needs = [...new Set(/** @type {string[]} */ (names.filter((name) => name !== null)))];
  }

  /** @param {any} low @param {any} high @param {Way} slow @returns {Way} */
  quickDecode(low, high, slow) {
    const steps = this.exactSteps();
    if (!steps) return slow;
    const [times, less, over] = steps; // adding 0 takes the sign of -0
    if (times === 1 && less === 0) {
      return (raw, raws) => (Number.isInteger(raw) && raw >= low && raw <= high ? raw / over : slow(raw, raws));
    }
    return (raw, raws) => (Number.isInteger(raw) && raw >= low && raw <= high ? (raw * times - less + 0) / over : slow(raw, raws));
  }

  quickWord() {
    const steps = this.exactSteps();
    if (!steps) return undefined;
    const [times, less, over] = steps;
    return times === 1 && less === 0
      ? (/** @type {number} */ word) => word / over
      : (/** @type {number} */ word) => (word * times - less + 0) / over;
  }

  /** The scale in binary64, where that is exact up to the division for all numbers of the type.
   * @returns {[number, number, number] | undefined} */
  exactSteps() {
    if (!(this.scale instanceof LinearRule) || this.scale.factors.length || this.most !== undefined || this.wire.isBig) {
      return undefined;
    }
    const line = this.scale.line(NO_RAWS);
    const [times, less, over] = line.map(Number);
    const largest = 2 ** this.wire.bits * Math.abs(times) + Math.abs(less);
    return largest <= Number.MAX_SAFE_INTEGER && over <= Number.MAX_SAFE_INTEGER ? [times, less, over] : undefined;
  }

  /** @param {Raws} raws */
  rule(raws) {
    return this.scale instanceof LinearRule ? this.scale : chosenRule(this.scale, raws);
  }

  /** The decimals of the counts; raises WrongTypeError where there are none. */
  counted() {
    if (this.decimals === undefined) {
      throw new WrongTypeError("no 64-bit integer holds the counts, so there are none: use raw numbers or values");
    }
    return this.decimals;
  }

  /** Raises ResultOverflowError where other languages cannot compute it exactly. @template T @param {any} raw @param {T} found */
  bounded(raw, found) {
    if (this.most !== undefined && (raw > this.most || raw < -this.most)) {
      throw new ResultOverflowError(`raw ${raw} is beyond ${this.most}, up to which the scale is exact`);
    }
    return found;
  }

  /** @param {any} raw @param {Raws} raws */
  decode(raw, raws) {
    const [times, less, over] = this.rule(raws).line(raws);
    return this.bounded(raw, finite(nearestQuotient(BigInt(raw) * times - less, over), raw));
  }

  /** @param {any} value @param {Raws} raws */
  converted(value, raws) {
    if (!this.encodes) {
      throw new WrongTypeError("numbers of this scale have more than 53 bits, so values are only decoded: use raw numbers");
    }
    if (isNan(value)) throw new NotANumberError("the value is NaN");
    const number = Number(value);
    const raw = this.rule(raws).encode(number, raws);
    return raw === undefined || !Number.isFinite(number) ? undefined : this.wire.raw(raw);
  }

  /** @param {any} raw @param {Raws} raws */
  decodeCount(raw, raws) {
    const decimals = this.counted();
    return this.bounded(raw, this.rule(raws).decodeCount(BigInt(raw), decimals, raws));
  }

  /** @param {unknown} count @param {Raws} raws */
  convertedCount(count, raws) {
    const raw = this.rule(raws).encodeCount(BigInt(wholeNumber(count)), this.counted(), raws);
    return this.wire.raw(raw);
  }

  /** @param {any} low @param {any} high @returns {[number, number] | undefined} */
  bounds(low, high) {
    if (this.needs.length) return undefined;
    const ends = [this.decode(low, NO_RAWS), this.decode(high, NO_RAWS)];
    return [Math.min(...ends), Math.max(...ends)];
  }

  /** @param {any} raw @param {Raws} raws @param {number} [display] */
  shown(raw, raws, display) {
    if (display === undefined) return significant(this.decode(raw, raws));
    const rule = this.rule(raws);
    if (this.needs.length) {
      const count = this.bounded(raw, rule.decodeCount(BigInt(raw), display, raws)); // other languages compute in counts
      return decimalText(count, 10n ** BigInt(display), display);
    }
    const [times, less, over] = rule.line(raws);
    return decimalText(BigInt(raw) * times - less, over, display);
  }
}

/** Whether it is NaN; raises WrongTypeError for what is no number. @param {unknown} value */
function isNan(value) {
  if (typeof value !== "number" && typeof value !== "bigint") throw new WrongTypeError(`takes a number, not ${shown(value)}`);
  return Number.isNaN(value);
}

const NO_COUNTS = "a floating-point number has no counts: use raw numbers or values";

/** An IEEE 754 number: the raw number is its bit pattern; limits are in the unit, as the nearest numbers of the type. */
class FloatingForm extends Form {
  /** @param {WireType} wire @param {readonly (readonly [number, number])[]} units */
  constructor(wire, units) {
    super(wire);
    this.units = units;
    this.near = units.map(([low, high]) => [this.nearest(low), this.nearest(high)]);
    this.view = new DataView(new ArrayBuffer(8));
  }

  /** @param {any} raw */
  decode(raw) {
    if (this.wire.isBig) {
      this.view.setBigUint64(0, raw);
      return this.view.getFloat64(0);
    }
    this.view.setUint32(0, raw);
    return this.view.getFloat32(0);
  }

  /** The number of the type nearest to a value; infinity beyond the largest. @param {number} value */
  nearest(value) {
    return this.wire.isBig ? Number(value) : Math.fround(Number(value));
  }

  /** @param {any} value */
  converted(value) {
    if (isNan(value)) throw new NotANumberError("the value is NaN");
    const nearest = this.nearest(value);
    if (!Number.isFinite(nearest)) return undefined;
    if (this.wire.isBig) {
      this.view.setFloat64(0, nearest);
      return this.view.getBigUint64(0);
    }
    this.view.setFloat32(0, nearest);
    return this.view.getUint32(0);
  }

  /** @returns {[number, number] | undefined} */
  bounds() {
    if (!this.units.length) return undefined;
    return [Math.min(...this.units.map(([low]) => low)), Math.max(...this.units.map(([, high]) => high))];
  }

  /** @param {any} raw */
  checked(raw) {
    if (raw < 0 || raw >= this.wire.power(this.wire.bits)) return undefined;
    const number = this.decode(raw);
    if (Number.isNaN(number)) throw new NotANumberError("the value is NaN");
    const isInside = !this.near.length || this.near.some(([low, high]) => low <= number && number <= high);
    return isInside && Number.isFinite(number) ? raw : undefined;
  }

  /** @returns {bigint} */
  decodeCount() {
    throw new WrongTypeError(NO_COUNTS);
  }

  convertedCount() {
    throw new WrongTypeError(NO_COUNTS);
  }

  /** @param {any} raw @param {Raws} raws @param {number} [display] */
  shown(raw, raws, display) {
    const number = this.decode(raw);
    if (display !== undefined && Number.isFinite(number)) return decimalText(...exactRatio(number), display);
    for (let digits = 6; digits < 10 && !this.wire.isBig; digits++) {
      const rounded = Number(significant(number, digits));
      if (this.nearest(rounded) === number) return significant(rounded);
    }
    return significant(number);
  }

  /** @param {any} raw @param {any} other */
  same(raw, other) {
    return raw === other || this.decode(raw) === this.decode(other);
  }

  /** @param {string} unit */
  choices(unit) {
    if (!this.units.length) return `no finite binary${this.wire.bits}`;
    return outsideText(this.units.map(([low, high]) => [significant(low), significant(high)]), unit);
  }
}

/** A form that delegates to another one, except for what a subclass overrides. */
export class AroundForm extends Form {
  /** @param {Form} form */
  constructor(form) {
    super(form.wire);
    this.form = form;
    const { needs, decimals, codes, names, refused, encodes } = form;
    Object.assign(this, { needs, decimals, codes, names, refused, encodes });
  }

  /** @param {any} raw @param {Raws} raws */
  decode(raw, raws) {
    return this.form.decode(raw, raws);
  }

  /** @param {any} value @param {Raws} raws */
  converted(value, raws) {
    return this.form.converted(value, raws);
  }

  /** @param {any} raw @param {Raws} raws */
  decodeCount(raw, raws) {
    return this.form.decodeCount(raw, raws);
  }

  /** @param {unknown} count @param {Raws} raws */
  convertedCount(count, raws) {
    return this.form.convertedCount(count, raws);
  }

  /** @param {any} raw @param {Allowed} allowed @param {Raws} raws */
  checked(raw, allowed, raws) {
    return this.form.checked(raw, allowed, raws);
  }

  /** @param {number} width */
  limits(width) {
    return this.form.limits(width);
  }

  /** @param {any} low @param {any} high */
  bounds(low, high) {
    return this.form.bounds(low, high);
  }

  /** @param {any} raw @param {Raws} raws @param {number} [display] */
  shown(raw, raws, display) {
    return this.form.shown(raw, raws, display);
  }

  /** @param {any} raw @param {any} other */
  same(raw, other) {
    return this.form.same(raw, other);
  }

  /** @param {string} unit */
  choices(unit) {
    return this.form.choices(unit);
  }

  /** @param {any} raw */
  nameOf(raw) {
    return this.form.nameOf(raw);
  }
}

/** Another form beside special codes, some of which may be written. */
class CodedForm extends AroundForm {
  /** @param {Form} form @param {import("./special.js").Codes} codes @param {boolean} isWritten */
  constructor(form, codes, isWritten) {
    super(form);
    this.codes = codes;
    this.isWritten = isWritten;
  }

  /** @param {any} low @param {any} high @param {Way} slow @returns {Way} */
  quickDecode(low, high, slow) {
    const [plain, codes] = [this.form.quickDecode(low, high, slow), this.codes];
    if (plain === slow) return slow;
    if (codes.bands.length) return (raw, raws) => codes.of(raw) ?? plain(raw, raws);
    return (raw, raws) => codes.single.get(raw) ?? plain(raw, raws);
  }

  /** @param {any} raw @param {Raws} raws */
  decode(raw, raws) {
    return this.codes.of(raw) ?? this.form.decode(raw, raws);
  }

  /** @param {any} raw @param {Raws} raws */
  decodeCount(raw, raws) {
    const code = this.codes.of(raw);
    if (!code) return this.form.decodeCount(raw, raws);
    throw new SpecialCodeError(code.name, `raw ${raw} is the special code ${code}, which has no count: decode gives it`);
  }

  /** @param {any} value @param {Raws} raws */
  converted(value, raws) {
    if (this.isWritten && typeof value === "string") throw new WrongTypeError(this.codes.notAText(value));
    if (this.isWritten && value instanceof SpecialCode) {
      if (!this.codes.has(value)) throw new UnknownValueError(`${value} is no special code of this point`);
      return this.wire.raw(value.raw);
    }
    const raw = this.form.converted(value, raws);
    return raw === undefined ? undefined : this.quantity(raw, "would be");
  }

  /** @param {unknown} count @param {Raws} raws */
  convertedCount(count, raws) {
    return this.quantity(this.form.convertedCount(count, raws), "would be");
  }

  /** @param {any} raw @param {Allowed} allowed @param {Raws} raws */
  checked(raw, allowed, raws) {
    return this.codes.of(raw)?.writable ? raw : this.form.checked(this.quantity(raw, "is"), allowed, raws);
  }

  /** The same number; raises SpecialCodeError for a code. @param {any} raw @param {string} how @returns {any} */
  quantity(raw, how) {
    const code = this.codes.of(raw);
    if (!code) return raw;
    const hint = code.writable ? `to write that, write ${this.codes.said(code)}` : "it is only read";
    throw new SpecialCodeError(code.name, `raw ${raw} ${how} the special code ${code}: ${hint}`);
  }
}

/** Another form, of a whole word in which some bits are always written as a constant. */
class FixedBitsForm extends AroundForm {
  /** @param {Form} form @param {number} mask @param {number} bits */
  constructor(form, mask, bits) {
    super(form);
    this.mask = BigInt(mask);
    this.bits = BigInt(bits);
  }

  /** @param {any} raw @returns {any} */
  put(raw) {
    return raw === undefined ? undefined : this.wire.raw((BigInt(raw) & ~this.mask) | this.bits);
  }

  /** @param {any} value @param {Raws} raws */
  converted(value, raws) {
    return this.put(this.form.converted(value, raws));
  }

  /** @param {unknown} count @param {Raws} raws */
  convertedCount(count, raws) {
    return this.put(this.form.convertedCount(count, raws));
  }

  /** @param {any} raw @param {Allowed} allowed @param {Raws} raws */
  checked(raw, allowed, raws) {
    if ((BigInt(raw) & this.mask) === this.bits) return this.form.checked(raw, allowed, raws);
    const [bits, mask] = [this.bits, this.mask].map((one) => one.toString(16).toUpperCase().padStart(4, "0"));
    throw new OutOfRangeError(`raw ${raw} has not ${bits}h in the bits ${mask}h, as it must`);
  }
}

/** The form with constant bits; special codes stay outermost.
 * @param {Form} form @param {readonly [number, number]} fixed @returns {Form} */
export function withFixed(form, [mask, bits]) {
  if (!(form instanceof CodedForm)) return new FixedBitsForm(form, mask, bits);
  return new CodedForm(new FixedBitsForm(form.form, mask, bits), form.codes, form.isWritten);
}

/** The raw number is the value. @param {WireType} wire @returns {Form} */
export function integer(wire) {
  return new IntegerForm(wire);
}

/** A coil or a single bit. @param {WireType} [wire] @returns {Form} */
export function bit(wire = BIT) {
  return new BitForm(wire);
}

/** Numbers with names. @param {WireType} wire @param {Names} names @param {{ closed?: boolean }} [facts] @returns {Form} */
export function named(wire, names, { closed = false } = {}) {
  return new NamedForm(wire, names, closed);
}

/** A word of flags. @param {WireType} wire @param {import("./words.js").WordLayout} layout @returns {Form} */
export function flags(wire, layout) {
  return new FlagsForm(wire, layout);
}

/** A quantity. @param {WireType} wire @param {LinearRule | readonly import("./rules.js").ScaleCase[]} scale
 * @param {{ decimals: number | null, encodes?: boolean, most?: number | bigint }} facts @returns {Form} */
export function scaled(wire, scale, facts) {
  return new ScaledForm(wire, scale, facts);
}

/** An IEEE 754 number. @param {WireType} wire @param {{ units?: readonly (readonly [number, number])[] }} [facts]
 * @returns {Form} */
export function floating(wire, { units = [] } = {}) {
  return new FloatingForm(wire, units);
}

/** A form with special codes, to which no value is encoded. @param {Form} form
 * @param {import("./special.js").Codes} codes @returns {Form} */
export function withCodes(form, codes) {
  return new CodedForm(form, codes, false);
}

/** The same with special codes that may be written. @param {Form} form
 * @param {import("./special.js").Codes} codes @returns {Form} */
export function withWritableCodes(form, codes) {
  return new CodedForm(form, codes, true);
}
