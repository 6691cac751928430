// SPDX-License-Identifier: 0BSD
/** Exact linear rules between values and raw numbers, and limits that other points set. */
import {
  MissingRawError,
  NoCaseError,
  OutOfRangeError,
  ResultOverflowError,
  shown,
  WrongTypeError,
  ZeroFactorError,
} from "./errors.js";
import { absolute, exactRatio, greatestDivisor, nearestQuotient, roundNumber, roundRatio } from "./numbers.js";

/** Raw numbers of other points by name. @typedef {Readonly<Record<string, number | bigint>>} Raws */
/** First and last of a band of raw numbers. @typedef {readonly [number | bigint, number | bigint]} Band */

/** @type {Raws} */
export const NO_RAWS = Object.freeze({});
const WIDEST = 64n;
const MOST_COUNT = 1n << 63n;

/** The raw number of another point; raises MissingRawError. @param {string} point @param {Raws | undefined} raws
 * @returns {bigint} */
export function rawOf(point, raws) {
  if (typeof raws !== "object" || raws === null) {
    throw new WrongTypeError(`raws are raw numbers by name, as { ${point}: 1 }, not ${shown(raws)}`);
  }
  if (!Object.prototype.hasOwnProperty.call(raws, point)) {
    throw new MissingRawError(`needs the raw number of ${point}: pass raws as { ${point}: ... }`);
  }
  const raw = raws[point];
  if (typeof raw !== "bigint" && !Number.isInteger(raw)) {
    throw new WrongTypeError(`the raw number of ${point} is an integer, not ${shown(raw)}`);
  }
  const number = BigInt(raw);
  if (absolute(number) >> WIDEST) throw new OutOfRangeError(`${raw} is no raw number of ${point}: it has more than 64 bits`);
  return number;
}

/** Whether a number lies in one of the bands. @param {number | bigint} number @param {readonly Band[]} bands */
export function inBands(number, bands) {
  return bands.some(([first, last]) => first <= number && number <= last);
}

const PATTERN = new DataView(new ArrayBuffer(4));

/** raw * slope + intercept of another point, to a power of 1 or -1; with `tenTo` it is ten to that number. */
export class Factor {
  /** @param {string} point @param {Partial<Factor>} facts */
  constructor(point, facts) {
    this.point = point;
    /** @type {number | bigint} */
    this.slope = 1;
    /** @type {number | bigint} */
    this.intercept = 0;
    this.power = 1;
    /** The raw numbers where ten to that number applies. @type {Band | undefined} */
    this.tenTo = undefined;
    /** Whether the raw number is the pattern of a binary32 number. */
    this.f32 = false;
    /** Bands of raw numbers that are no quantity. @type {readonly Band[]} */
    this.codes = [];
    /** The raw numbers where the scale is exact. @type {Band | undefined} */
    this.within = undefined;
    Object.assign(this, facts);
  }

  /** The factor or exponent before `power`, exactly. @param {Raws} raws @returns {[bigint, bigint]} */
  number(raws) {
    const raw = rawOf(this.point, raws);
    if (!this.f32) return [raw * BigInt(this.slope) + BigInt(this.intercept), 1n];
    PATTERN.setUint32(0, Number(BigInt.asUintN(32, raw)));
    const value = PATTERN.getFloat32(0);
    return Number.isFinite(value) ? exactRatio(value) : [0n, 1n];
  }

  /** Raises ResultOverflowError if the raw number is one with which nothing is computed. @param {Raws} raws */
  requireRange(raws) {
    const [limits, raw] = [this.tenTo ?? this.within, rawOf(this.point, raws)];
    if (limits && !inBands(raw, [limits])) {
      throw new ResultOverflowError(`${this.point} is ${raw}, outside ${limits[0]}..${limits[1]}`);
    }
  }
}

/** A scale solved for the value: (raw * times - less) / over, exactly; `over` is positive.
 * @typedef {readonly [bigint, bigint, bigint]} ScaleLine */

/** raw = value * num / den * product(factors) + offset. */
export class LinearRule {
  /** @param {{ num?: number | bigint, den?: number | bigint, offset?: readonly [number | bigint, number | bigint],
   *   factors?: readonly Factor[] }} facts */
  constructor({ num = 1, den = 1, offset = [0, 1], factors = [] }) {
    this.num = BigInt(num);
    this.den = BigInt(den);
    this.offset = /** @type {const} */ ([BigInt(offset[0]), BigInt(offset[1])]);
    this.added = nearestQuotient(this.offset[0], this.offset[1]);
    this.factors = factors;
  }

  /**
   * Numerator and denominator with all factors. Raises ZeroFactorError, ResultOverflowError and MissingRawError.
   * @param {Raws} raws @param {boolean} [isZeroAllowed] of the numerator @returns {[bigint, bigint]}
   */
  ratio(raws, isZeroAllowed = false) {
    let [num, den] = [this.num, this.den];
    const numbers = this.factors.map((factor) => factor.number(raws));
    for (const factor of this.factors) {
      if (inBands(rawOf(factor.point, raws), factor.codes)) {
        throw new ZeroFactorError(`${factor.point} holds a special code, which is no quantity`);
      }
    }
    this.factors.forEach((factor, at) => {
      if (factor.tenTo) return;
      if (numbers[at][0] === 0n && !(isZeroAllowed && factor.power > 0)) {
        throw new ZeroFactorError(`${factor.point} is ${factor.f32 ? "no number or " : ""}zero`);
      }
      factor.requireRange(raws);
    });
    this.factors.forEach((factor, at) => {
      factor.requireRange(raws);
      let [over, under] = numbers[at];
      let power = BigInt(factor.power);
      if (factor.tenTo) [power, over] = [power * over, 10n ** absolute(over)];
      [num, den] = power >= 0n ? [num * over, den * under] : [num * under, den * over];
    });
    return [num, den];
  }

  /** The raw number by steps in binary64, halves away from zero; undefined if infinite.
   * @param {number} value @param {Raws} raws @returns {number | undefined} */
  encode(value, raws) {
    const [num, den] = this.factors.length ? this.ratio(raws) : [this.num, this.den];
    const result = (value * Number(num)) / Number(den) + this.added;
    return Number.isFinite(result) ? roundNumber(result) : undefined;
  }

  /** The rule solved for the value, in lowest terms. @param {Raws} raws @returns {ScaleLine} */
  line(raws) {
    const [num, den] = this.ratio(raws);
    const [over, under] = this.offset;
    const found = [under * den, over * den, num * under];
    const shared = found.reduce(greatestDivisor) * (num > 0n ? 1n : -1n);
    return [found[0] / shared, found[1] / shared, found[2] / shared];
  }

  /** The raw number of `count` units of 10^-decimals. @param {bigint} count @param {number} decimals @param {Raws} raws
   * @param {boolean} [isZeroAllowed] @returns {bigint} */
  encodeCount(count, decimals, raws, isZeroAllowed = false) {
    const [num, den] = this.ratio(raws, isZeroAllowed);
    const [over, under] = this.offset;
    const scale = den * 10n ** BigInt(decimals);
    return roundRatio(count * num * under + over * scale, scale * under);
  }

  /** The count of 10^-decimals units; raises ResultOverflowError beyond 64 bits.
   * @param {bigint} raw @param {number} decimals @param {Raws} raws @returns {bigint} */
  decodeCount(raw, decimals, raws) {
    const [num, den] = this.ratio(raws);
    const [over, under] = this.offset;
    const count = roundRatio((raw * under - over) * den * 10n ** BigInt(decimals), num * under);
    if (count < -MOST_COUNT || count >= MOST_COUNT) throw new ResultOverflowError(`raw ${raw} gives a count beyond 64 bits`);
    return count;
  }
}

/** A factor of a scale or limit. @param {string} point @param {Partial<Factor>} [facts] */
export function factor(point, facts = {}) {
  return new Factor(point, facts);
}

/** A linear rule. @param {ConstructorParameters<typeof LinearRule>[0]} [facts] */
export function rule(facts = {}) {
  return new LinearRule(facts);
}

/** A rule that holds when the raw number of a point equals `raw`; without a point it always holds.
 * @typedef {{ point: string | null, raw: number | null, rule: LinearRule }} ScaleCase */

/** @param {string | null} point @param {number | null} raw @param {LinearRule} then @returns {ScaleCase} */
export function scaleCase(point, raw, then) {
  return { point, raw, rule: then };
}

/** The first rule whose case fits; raises NoCaseError. @param {readonly ScaleCase[]} cases @param {Raws} raws */
export function chosenRule(cases, raws) {
  const found = cases.find((one) => one.point === null || rawOf(one.point, raws) === BigInt(one.raw ?? 0));
  if (found) return found.rule;
  const points = new Set(cases.map((one) => one.point).filter(Boolean));
  throw new NoCaseError(`no scale for these raw numbers of ${[...points].join(", ")}`);
}

/** A limit that other points set: `rule` applied to 1; none while a point has a number in its bands of `unless`. */
export class MovingLimit {
  /** @param {LinearRule} from @param {{ least: number | bigint, greatest: number | bigint,
   *   unless: Readonly<Record<string, readonly Band[]>> }} facts */
  constructor(from, { least, greatest, unless }) {
    this.rule = from;
    this.least = least;
    this.greatest = greatest;
    this.unless = unless;
  }

  /** The points that decide it. @returns {string[]} */
  get needs() {
    return [...this.rule.factors.map((one) => one.point), ...Object.keys(this.unless)];
  }

  /** The limit as a raw number; undefined while it does not hold. @param {Raws} raws @returns {bigint | undefined} */
  raw(raws) {
    for (const [point, bands] of Object.entries(this.unless)) if (inBands(rawOf(point, raws), bands)) return undefined;
    return this.rule.encodeCount(1n, 0, raws, true);
  }
}

/** @param {LinearRule} from @param {ConstructorParameters<typeof MovingLimit>[1]} facts */
export function limit(from, facts) {
  return new MovingLimit(from, facts);
}

/** @typedef {number | bigint | MovingLimit} Bound */
/** Closed intervals of raw numbers that may be written. @typedef {readonly (readonly [Bound, Bound])[]} Allowed */

/** The lower end of an interval as a raw number. @param {Bound} bound @param {Raws} raws @returns {number | bigint} */
export function lowEnd(bound, raws) {
  if (!(bound instanceof MovingLimit)) return bound;
  const raw = bound.raw(raws);
  return raw === undefined || raw < bound.least ? bound.least : raw;
}

/** The upper end. @param {Bound} bound @param {Raws} raws @returns {number | bigint} */
export function highEnd(bound, raws) {
  if (!(bound instanceof MovingLimit)) return bound;
  const raw = bound.raw(raws);
  return raw === undefined || raw > bound.greatest ? bound.greatest : raw;
}

/** Why a number is refused, with the limits as texts. @param {readonly (readonly [string, string])[]} intervals
 * @param {string} unit @returns {string} */
export function outsideText(intervals, unit) {
  const texts = intervals.map(([low, high]) => (low === high ? low : `${low}..${high}`));
  if (intervals.every(([low, high]) => low !== high)) return `outside ${texts.join(" or ")}${unit}`;
  return `${texts.length === 1 ? "not" : "none of"} ${texts.join(", ")}${unit}`;
}
