/** @param {bigint} number @returns {bigint} */
export function absolute(number: bigint): bigint;
/** The integer nearest to a quotient, halves away from zero. @param {bigint} num @param {bigint} den @returns {bigint} */
export function roundRatio(num: bigint, den: bigint): bigint;
/** The binary64 nearest to a quotient; its divisor is positive. Infinite beyond binary64.
 * @param {bigint} num @param {bigint} den @returns {number} */
export function nearestQuotient(num: bigint, den: bigint): number;
/** A finite binary64 as an exact quotient. @param {number} value @returns {[bigint, bigint]} */
export function exactRatio(value: number): [bigint, bigint];
/** The integer nearest to a finite number, halves away from zero; never -0. @param {number} value */
export function roundNumber(value: number): number;
/** @param {bigint} one @param {bigint} other @returns {bigint} */
export function greatestDivisor(one: bigint, other: bigint): bigint;
/** A quotient with some decimals, to nearest, halves away from zero; never `-0`.
 * @param {bigint} num @param {bigint} den @param {number} decimals @returns {string} */
export function decimalText(num: bigint, den: bigint, decimals: number): string;
/** A number with a limited number of significant digits, ties to even: `50`, `0.1`, `1.5e+20`.
 * @param {number} value @param {number} [digits] @returns {string} */
export function significant(value: number, digits?: number): string;
/** A value for messages. @param {unknown} value @returns {string} */
export function valueText(value: unknown): string;
/**
 * The number, if it is an integer. Raises OutOfRangeError for any other number, and WrongTypeError
 * for anything else, such as a boolean, which is usually a mistake.
 * @param {unknown} number @returns {Raw}
 */
export function wholeNumber(number: unknown): Raw;
/** A raw number, also of a bit as a boolean; raises WrongTypeError. @param {unknown} number @param {number} width
 * @returns {Raw} */
export function rawNumber(number: unknown, width: number): Raw;
/** A value that was computed; raises ResultOverflowError for one beyond binary64. @param {number} value @param {Raw} raw */
export function finite(value: number, raw: Raw): number;
/**
 * A raw number: a bigint if the type has more than 32 bits.
 */
export type Raw = number | bigint;
