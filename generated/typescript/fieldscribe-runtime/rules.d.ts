/** The raw number of another point; raises MissingRawError. @param {string} point @param {Raws | undefined} raws
 * @returns {bigint} */
export function rawOf(point: string, raws: Raws | undefined): bigint;
/** Whether a number lies in one of the bands. @param {number | bigint} number @param {readonly Band[]} bands */
export function inBands(number: number | bigint, bands: readonly Band[]): boolean;
/** A factor of a scale or limit. @param {string} point @param {Partial<Factor>} [facts] */
export function factor(point: string, facts?: Partial<Factor>): Factor;
/** A linear rule. @param {ConstructorParameters<typeof LinearRule>[0]} [facts] */
export function rule(facts?: ConstructorParameters<typeof LinearRule>[0]): LinearRule;
/** A rule that holds when the raw number of a point equals `raw`; without a point it always holds.
 * @typedef {{ point: string | null, raw: number | null, rule: LinearRule }} ScaleCase */
/** @param {string | null} point @param {number | null} raw @param {LinearRule} then @returns {ScaleCase} */
export function scaleCase(point: string | null, raw: number | null, then: LinearRule): ScaleCase;
/** The first rule whose case fits; raises NoCaseError. @param {readonly ScaleCase[]} cases @param {Raws} raws */
export function chosenRule(cases: readonly ScaleCase[], raws: Raws): LinearRule;
/** @param {LinearRule} from @param {ConstructorParameters<typeof MovingLimit>[1]} facts */
export function limit(from: LinearRule, facts: ConstructorParameters<typeof MovingLimit>[1]): MovingLimit;
/** @typedef {number | bigint | MovingLimit} Bound */
/** Closed intervals of raw numbers that may be written. @typedef {readonly (readonly [Bound, Bound])[]} Allowed */
/** The lower end of an interval as a raw number. @param {Bound} bound @param {Raws} raws @returns {number | bigint} */
export function lowEnd(bound: Bound, raws: Raws): number | bigint;
/** The upper end. @param {Bound} bound @param {Raws} raws @returns {number | bigint} */
export function highEnd(bound: Bound, raws: Raws): number | bigint;
/** Why a number is refused, with the limits as texts. @param {readonly (readonly [string, string])[]} intervals
 * @param {string} unit @returns {string} */
export function outsideText(intervals: readonly (readonly [string, string])[], unit: string): string;
/** Raw numbers of other points by name. @typedef {Readonly<Record<string, number | bigint>>} Raws */
/** First and last of a band of raw numbers. @typedef {readonly [number | bigint, number | bigint]} Band */
/** @type {Raws} */
export const NO_RAWS: Raws;
/** raw * slope + intercept of another point, to a power of 1 or -1; with `tenTo` it is ten to that number. */
export class Factor {
    /** @param {string} point @param {Partial<Factor>} facts */
    constructor(point: string, facts: Partial<Factor>);
    point: string;
    /** @type {number | bigint} */
    slope: number | bigint;
    /** @type {number | bigint} */
    intercept: number | bigint;
    power: number;
    /** The raw numbers where ten to that number applies. @type {Band | undefined} */
    tenTo: Band | undefined;
    /** Whether the raw number is the pattern of a binary32 number. */
    f32: boolean;
    /** Bands of raw numbers that are no quantity. @type {readonly Band[]} */
    codes: readonly Band[];
    /** The raw numbers where the scale is exact. @type {Band | undefined} */
    within: Band | undefined;
    /** The factor or exponent before `power`, exactly. @param {Raws} raws @returns {[bigint, bigint]} */
    number(raws: Raws): [bigint, bigint];
    /** Raises ResultOverflowError if the raw number is one with which nothing is computed. @param {Raws} raws */
    requireRange(raws: Raws): void;
}
/** A scale solved for the value: (raw * times - less) / over, exactly; `over` is positive.
 * @typedef {readonly [bigint, bigint, bigint]} ScaleLine */
/** raw = value * num / den * product(factors) + offset. */
export class LinearRule {
    /** @param {{ num?: number | bigint, den?: number | bigint, offset?: readonly [number | bigint, number | bigint],
     *   factors?: readonly Factor[] }} facts */
    constructor({ num, den, offset, factors }: {
        num?: number | bigint;
        den?: number | bigint;
        offset?: readonly [number | bigint, number | bigint];
        factors?: readonly Factor[];
    });
    num: bigint;
    den: bigint;
    offset: readonly [bigint, bigint];
    added: number;
    factors: readonly Factor[];
    /**
     * Numerator and denominator with all factors. Raises ZeroFactorError, ResultOverflowError and MissingRawError.
     * @param {Raws} raws @param {boolean} [isZeroAllowed] of the numerator @returns {[bigint, bigint]}
     */
    ratio(raws: Raws, isZeroAllowed?: boolean): [bigint, bigint];
    /** The raw number by steps in binary64, halves away from zero; undefined if infinite.
     * @param {number} value @param {Raws} raws @returns {number | undefined} */
    encode(value: number, raws: Raws): number | undefined;
    /** The rule solved for the value, in lowest terms. @param {Raws} raws @returns {ScaleLine} */
    line(raws: Raws): ScaleLine;
    /** The raw number of `count` units of 10^-decimals. @param {bigint} count @param {number} decimals @param {Raws} raws
     * @param {boolean} [isZeroAllowed] @returns {bigint} */
    encodeCount(count: bigint, decimals: number, raws: Raws, isZeroAllowed?: boolean): bigint;
    /** The count of 10^-decimals units; raises ResultOverflowError beyond 64 bits.
     * @param {bigint} raw @param {number} decimals @param {Raws} raws @returns {bigint} */
    decodeCount(raw: bigint, decimals: number, raws: Raws): bigint;
}
/** A limit that other points set: `rule` applied to 1; none while a point has a number in its bands of `unless`. */
export class MovingLimit {
    /** @param {LinearRule} from @param {{ least: number | bigint, greatest: number | bigint,
     *   unless: Readonly<Record<string, readonly Band[]>> }} facts */
    constructor(from: LinearRule, { least, greatest, unless }: {
        least: number | bigint;
        greatest: number | bigint;
        unless: Readonly<Record<string, readonly Band[]>>;
    });
    rule: LinearRule;
    least: number | bigint;
    greatest: number | bigint;
    unless: Readonly<Record<string, readonly Band[]>>;
    /** The points that decide it. @returns {string[]} */
    get needs(): string[];
    /** The limit as a raw number; undefined while it does not hold. @param {Raws} raws @returns {bigint | undefined} */
    raw(raws: Raws): bigint | undefined;
}
/**
 * A rule that holds when the raw number of a point equals `raw`; without a point it always holds.
 */
export type ScaleCase = {
    point: string | null;
    raw: number | null;
    rule: LinearRule;
};
export type Bound = number | bigint | MovingLimit;
/**
 * Closed intervals of raw numbers that may be written.
 */
export type Allowed = readonly (readonly [Bound, Bound])[];
/**
 * Raw numbers of other points by name.
 */
export type Raws = Readonly<Record<string, number | bigint>>;
/**
 * First and last of a band of raw numbers.
 */
export type Band = readonly [number | bigint, number | bigint];
/**
 * A scale solved for the value: (raw * times - less) / over, exactly; `over` is positive.
 */
export type ScaleLine = readonly [bigint, bigint, bigint];
