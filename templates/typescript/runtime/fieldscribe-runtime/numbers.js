// SPDX-License-Identifier: 0BSD
/** Exact numbers: rounding, quotients to the nearest binary64, and numbers as text; all of it by integers. */
import { OutOfRangeError, ResultOverflowError, shown, WrongTypeError } from "./errors.js";

/** A raw number: a bigint if the type has more than 32 bits. @typedef {number | bigint} Raw */

const VIEW = new DataView(new ArrayBuffer(8));
const SIGNIFICAND_BITS = 53;
const LEAST_EXPONENT = -1074;

/** @param {bigint} number @returns {bigint} */
export function absolute(number) {
  return number < 0n ? -number : number;
}

/** How many bits a positive number has. @param {bigint} number @returns {number} */
function bitLength(number) {
  const digits = number.toString(16);
  return 4 * digits.length - (Math.clz32(parseInt(digits[0], 16)) - 28);
}

/** The integer nearest to a quotient, halves away from zero. @param {bigint} num @param {bigint} den @returns {bigint} */
export function roundRatio(num, den) {
  const [size, divisor] = [absolute(num), absolute(den)];
  const rounded = (2n * size + divisor) / (2n * divisor);
  return num < 0n === den < 0n ? rounded : -rounded;
}

/** The binary64 nearest to a quotient; its divisor is positive. Infinite beyond binary64.
 * @param {bigint} num @param {bigint} den @returns {number} */
export function nearestQuotient(num, den) {
  const plain = Number(num);
  if (Number.isSafeInteger(plain) && Number.isSafeInteger(Number(den))) return plain / Number(den);
  const size = absolute(num);
  const bits = bitLength(size) - bitLength(den);
  const isLarger = bits >= 0 ? size >= den << BigInt(bits) : size << BigInt(-bits) >= den;
  const unit = Math.max(bits - SIGNIFICAND_BITS + (isLarger ? 1 : 0), LEAST_EXPONENT);
  const [over, under] = unit < 0 ? [size << BigInt(-unit), den] : [size, den << BigInt(unit)];
  let whole = over / under;
  const rest = 2n * (over % under);
  if (rest > under || (rest === under && whole & 1n)) whole += 1n;
  return (num < 0n ? -1 : 1) * Number(whole) * 2 ** unit;
}

/** A finite binary64 as an exact quotient. @param {number} value @returns {[bigint, bigint]} */
export function exactRatio(value) {
  VIEW.setFloat64(0, value);
  const pattern = VIEW.getBigUint64(0);
  const exponent = Number((pattern >> 52n) & 0x7ffn);
  const fraction = pattern & 0xfffffffffffffn;
  const size = exponent ? fraction | (1n << 52n) : fraction;
  const shift = (exponent || 1) - 1075;
  const num = value < 0 ? -size : size;
  return shift < 0 ? [num, 1n << BigInt(-shift)] : [num << BigInt(shift), 1n];
}

/** The integer nearest to a finite number, halves away from zero; never -0. @param {number} value */
export function roundNumber(value) {
  const whole = Math.trunc(value);
  const rest = value - whole;
  return whole + (rest >= 0.5 ? 1 : rest <= -0.5 ? -1 : 0) + 0;
}

/** @param {bigint} one @param {bigint} other @returns {bigint} */
export function greatestDivisor(one, other) {
  let [large, small] = [absolute(one), absolute(other)];
  while (small) [large, small] = [small, large % small];
  return large;
}

/** A quotient with some decimals, to nearest, halves away from zero; never `-0`.
 * @param {bigint} num @param {bigint} den @param {number} decimals @returns {string} */
export function decimalText(num, den, decimals) {
  const count = roundRatio(num * 10n ** BigInt(decimals), den);
  const digits = String(absolute(count)).padStart(decimals + 1, "0");
  const split = digits.length - decimals;
  const sign = count < 0n ? "-" : "";
  return decimals ? `${sign}${digits.slice(0, split)}.${digits.slice(split)}` : sign + digits;
}

/** A number with a limited number of significant digits, ties to even: `50`, `0.1`, `1.5e+20`.
 * @param {number} value @param {number} [digits] @returns {string} */
export function significant(value, digits = 12) {
  if (Number.isNaN(value)) return "nan";
  if (!Number.isFinite(value)) return value < 0 ? "-inf" : "inf";
  const sign = value < 0 || Object.is(value, -0) ? "-" : "";
  const size = Math.abs(value);
  let [mantissa, exponent] = size.toExponential(digits - 1).split("e");
  const exact = size.toExponential(60).split("e")[0].replace(".", "");
  if (/^50*$/.test(exact.slice(digits)) && Number(exact[digits - 1]) % 2 === 0) {
    [mantissa, exponent] = [`${exact[0]}.${exact.slice(1, digits)}`, size.toExponential(60).split("e")[1]];
  }
  const power = Number(exponent);
  const kept = mantissa.replace(".", "").replace(/0+$/, "") || "0";
  if (power < -4 || power >= digits) {
    const tail = kept.length > 1 ? `.${kept.slice(1)}` : "";
    return `${sign}${kept[0]}${tail}e${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`;
  }
  if (power < 0) return `${sign}0.${"0".repeat(-power - 1)}${kept}`;
  const whole = kept.slice(0, power + 1).padEnd(power + 1, "0");
  return sign + whole + (kept.length > power + 1 ? `.${kept.slice(power + 1)}` : "");
}

/** A value for messages. @param {unknown} value @returns {string} */
export function valueText(value) {
  if (typeof value === "number") return significant(value);
  return typeof value === "string" ? shown(value) : String(value);
}

/**
 * The number, if it is an integer. Raises OutOfRangeError for any other number, and WrongTypeError
 * for anything else, such as a boolean, which is usually a mistake.
 * @param {unknown} number @returns {Raw}
 */
export function wholeNumber(number) {
  if (typeof number === "bigint") return number;
  if (typeof number !== "number") throw new WrongTypeError(`takes a number, not ${shown(number)}`);
  if (!Number.isInteger(number)) throw new OutOfRangeError(`${number} is no integer: only whole numbers are taken`);
  return number + 0;
}

/** A raw number, also of a bit as a boolean; raises WrongTypeError. @param {unknown} number @param {number} width
 * @returns {Raw} */
export function rawNumber(number, width) {
  if (typeof number === "boolean" && width === 1) return number ? 1 : 0;
  if (typeof number === "bigint" || Number.isInteger(number)) return /** @type {Raw} */ (number);
  throw new WrongTypeError(`takes a raw number, which is an integer, not ${shown(number)}`);
}

/** A value that was computed; raises ResultOverflowError for one beyond binary64. @param {number} value @param {Raw} raw */
export function finite(value, raw) {
  if (!Number.isFinite(value)) throw new ResultOverflowError(`raw ${raw} gives no binary64`);
  return value;
}
