// SPDX-License-Identifier: 0BSD
/** What vectors say of points without a line: conversions, names, words and facts. */
import { FieldscribeError } from "../fieldscribe-runtime/errors.js";
import { lowestOf } from "../fieldscribe-runtime/places.js";
import { SpecialCode } from "../fieldscribe-runtime/special.js";
import { bitsOf, camelName } from "../fieldscribe-runtime/words.js";

/** @typedef {Record<string, any>} Vector */
/** @typedef {any} DeviceClass */
/** @typedef {(device: DeviceClass, vector: Vector) => boolean} CodecCheck */

const MICROSECOND = 1e-6;
const MILLISECOND = 1e-3;
const LAST_MOMENT = 8.64e12;

/** The status of a call, and its result or error; a special code as a value is the status `special`.
 * @param {() => unknown} work @returns {[string, any]} */
function outcome(work) {
  try {
    const result = work();
    return [result instanceof SpecialCode ? "special" : "ok", result];
  } catch (error) {
    if (error instanceof FieldscribeError) return [error.status, error];
    throw error;
  }
}

/** @param {DeviceClass} device @param {string} name @returns {any} */
export function pointNamed(device, name) {
  const { points } = device.table;
  const found = points.get(camelName(name)) ?? points.get(`${camelName(name)}_`);
  if (!found) throw new Error(`there is no point ${name}`);
  return found;
}

/** @param {Vector} vector */
function rawsWith(vector) {
  return Object.fromEntries(Object.entries(vector.with ?? {}).map(([name, raw]) => [camelName(name), BigInt(raw)]));
}

/** Whether a number of any type is the one of a vector. @param {any} found @param {any} expected */
function isNumber(found, expected) {
  return (typeof found === "number" || typeof found === "bigint") && BigInt(found) === BigInt(expected);
}

/** Whether two binary64 numbers have the same bits; all that are none are the same. @param {any} found @param {any} expected */
function isBits(found, expected) {
  return Object.is(Number(found), expected);
}

/** @param {any} one @param {any} other */
function isList(one, other) {
  return JSON.stringify(one) === JSON.stringify(other);
}

/** A raw number as the point has it. @param {any} point @param {any} raw */
function rawFor(point, raw) {
  return point.form.wire.raw(raw);
}

/** The value as a number. @param {any} value */
function plainValue(value) {
  return typeof value === "object" && "raw" in value ? value.raw : value;
}

/** @type {CodecCheck} */
function decodes(device, vector) {
  const point = pointNamed(device, vector.point);
  const [status, value] = outcome(() => point.decode(rawFor(point, vector.raw), rawsWith(vector)));
  if (value instanceof Date) {
    const seconds = (value.getTime() - Number(timeForm(point).epoch)) / 1000;
    const error = Math.abs(seconds - vector.value);
    return vector.status === "ok" && error <= MILLISECOND / 2 + MICROSECOND;
  }
  if (status === "malformed") return timeForm(point) !== undefined && Math.abs(vector.value) > LAST_MOMENT / 2;
  if (status === "special" && value instanceof SpecialCode) {
    return vector.status === status && value.name === vector.special && isNumber(value.raw, vector.raw);
  }
  return status === vector.status && (status !== "ok" || isBits(plainValue(value), vector.value));
}

/** What a point means where it is a time. @param {any} point */
function timeForm(point) {
  return [point.form, point.form.form].find((form) => form && "epoch" in form);
}

/** @type {CodecCheck} */
function encodes(device, vector) {
  const point = pointNamed(device, vector.point);
  const [status, raw] = outcome(() => point.encode(vector.value, rawsWith(vector)));
  return status === vector.status && (status !== "ok" || isNumber(raw, vector.raw));
}

/** @type {CodecCheck} */
function decodesCount(device, vector) {
  const point = pointNamed(device, vector.point);
  const raw = rawFor(point, vector.raw);
  const [status, count] = outcome(() => point.decodeCount(raw, rawsWith(vector)));
  if (status === "special") {
    const { name } = point.decode(raw, rawsWith(vector));
    return vector.status === status && count.special === vector.special && name === vector.special;
  }
  return status === vector.status && (status !== "ok" || (typeof count === "bigint" && count === BigInt(vector.count)));
}

/** @type {CodecCheck} */
function encodesCount(device, vector) {
  const point = pointNamed(device, vector.point);
  const [status, raw] = outcome(() => point.encodeCount(BigInt(vector.count), rawsWith(vector)));
  return status === vector.status && (status !== "ok" || isNumber(raw, vector.raw));
}

/** @type {CodecCheck} */
function checks(device, vector) {
  const point = pointNamed(device, vector.point);
  const [status] = outcome(() => point.check(rawFor(point, vector.raw), rawsWith(vector)));
  return status === vector.status;
}

/** @type {CodecCheck} */
function isTold(device, vector) {
  const point = pointNamed(device, vector.point);
  const [raw, raws] = [rawFor(point, vector.raw), rawsWith(vector)];
  const expected = vector.status === "ok" ? vector.text : `raw ${vector.raw}`;
  if (point.told(raw, raws) !== expected) return false;
  if (vector.status !== "ok" || !point.decode) return true;
  const value = point.decode(raw, raws);
  const [status, text] = outcome(() => point.text(value, raws));
  if (status === "ok") return text === expected || (value instanceof Date && /\.\d{6}/.test(expected));
  return value instanceof Date || !point.form.encodes || !Number.isFinite(plainValue(value));
}

/** @type {CodecCheck} */
function isEpoch(device, vector) {
  return isNumber(timeForm(pointNamed(device, vector.point)).epoch, BigInt(vector.seconds) * 1000n);
}

/** @type {CodecCheck} */
function isName(device, vector) {
  const point = pointNamed(device, vector.point);
  const number = rawFor(point, vector.raw);
  const isNamed = vector.name !== null;
  if ((point.nameOf(number) ?? null) !== vector.name) return false;
  if (isNamed && point.names[vector.name.toUpperCase()] !== Number(vector.raw)) return false;
  if (!isNamed && Object.values(point.names).includes(Number(vector.raw))) return false;
  const decoded = point.decode ? point.decode(number) : number;
  const found = Array.isArray(decoded) ? decoded[decoded.length - 1] : decoded;
  return found instanceof SpecialCode || isNumber(found, vector.raw);
}

/** @type {CodecCheck} */
function isSpecial(device, vector) {
  const point = pointNamed(device, vector.point);
  const names = [vector.low, vector.high].map((raw) => point.specialOf(rawFor(point, raw))?.name);
  const known = Object.values(point.special).some((code) => code.name === vector.special);
  return known === (vector.low === vector.high) && names.every((name) => name === vector.special);
}

/** @type {CodecCheck} */
function isSpecialName(device, vector) {
  const point = pointNamed(device, vector.point);
  const code = point.specialOf(rawFor(point, vector.raw));
  const found = code ? [code.name, Number(code.noValue)] : [null, null];
  return isList(found, [vector.name, vector.no_value]);
}

/** @param {any} kind @param {string} name @returns {string} */
function flagKey(kind, name) {
  return [camelName(name), `${camelName(name)}_`].find((key) => Object.keys(kind.flags).includes(key)) ?? name;
}

/** A flag on a word, and a word with that flag alone. @type {CodecCheck} */
function isFlag(device, vector) {
  const { names: kind, facts, encode } = pointNamed(device, vector.point);
  const key = flagKey(kind, vector.flag);
  const flag = kind.flags[key];
  const word = kind.from(vector.raw < 0 ? vector.raw + 2 ** 16 : vector.raw);
  if (bitsOf(flag, vector.raw) !== vector.number) return false;
  if (vector.truth !== null) {
    const listed = String(word).replace(/^0x[0-9A-F]+ ?/, "").replace(/[()]/g, "").split(", ").includes(key);
    if (word[key] !== Boolean(vector.truth) || listed !== Boolean(vector.truth)) return false;
  } else if (word[key] !== vector.number) return false;
  if (!encode) return true;
  const [mask, constant] = facts.fixed ?? [0, 0];
  if (kind.closed.includes(key)) return (Number(kind.of().raw) & mask) === constant;
  const state = vector.truth === null ? vector.number : Boolean(vector.truth);
  const made = kind.of({ [key]: state });
  if (vector.raw !== (vector.raw & ~mask) + constant) return true;
  return bitsOf(flag, made.raw) === vector.number;
}

/** @type {CodecCheck} */
function isFlagName(device, vector) {
  const kind = pointNamed(device, vector.point).names;
  const key = flagKey(kind, vector.flag);
  const { low, names } = kind.flags[key];
  const word = kind.from(BigInt(vector.raw) << BigInt(low));
  return names[vector.name.toUpperCase()] === word[key] && String(word).includes(`${key}=${vector.name}`);
}

/** @type {CodecCheck} */
function isBitGroup(device, vector) {
  const point = pointNamed(device, vector.point);
  const replaced = point.insert(vector.word, vector.replaced);
  return isNumber(point.extract(vector.word), vector.raw) && replaced === vector.result;
}

/** @type {CodecCheck} */
function isWords(device, vector) {
  const point = pointNamed(device, vector.point);
  return isNumber(point.fromWords(vector.words), vector.raw) && isList(point.toWords(rawFor(point, vector.raw)), vector.words);
}

/** The raw number of words that are in the order of their characters. @param {any} point @param {readonly number[]} words */
function rawOfOrdered(point, words) {
  const { addresses } = point.at;
  if (words.length !== addresses.length) throw new Error(`${words.length} words for ${addresses.length} addresses`);
  const ascending = [...addresses].sort((one, other) => one - other);
  return point.fromWords(ascending.map((address) => words[addresses.indexOf(address)]));
}

/** @param {Uint8Array} bytes */
function latin(bytes) {
  return String.fromCharCode(...(bytes ?? []));
}

/** @type {CodecCheck} */
function decodesText(device, vector) {
  const point = pointNamed(device, vector.point);
  return point.decode(rawOfOrdered(point, vector.words)) === latin(vector.text);
}

/** @type {CodecCheck} */
function encodesText(device, vector) {
  const point = pointNamed(device, vector.point);
  const [status, raw] = outcome(() => point.encode(latin(vector.text)));
  if (status !== "ok") return status === vector.status && !vector.words.length;
  const { addresses } = point.facts.writeAt ?? point.at;
  const ascending = [...addresses].sort((one, other) => one - other);
  const words = point.toWords(raw);
  const ordered = addresses.map((/** @type {number} */ address) => words[ascending.indexOf(address)]);
  return status === vector.status && isList(ordered, vector.words);
}

/** @type {CodecCheck} */
function decodesUnicode(device, vector) {
  const point = pointNamed(device, vector.point);
  const [status, text] = outcome(() => point.decode(point.fromWords(vector.words)));
  if (status !== vector.status) return false;
  return status !== "ok" || isList([...new TextEncoder().encode(text)], [...(vector.text ?? [])]);
}

/** @type {CodecCheck} */
function encodesUnicode(device, vector) {
  const point = pointNamed(device, vector.point);
  const text = new TextDecoder("utf-8", { ignoreBOM: true }).decode(vector.text ?? new Uint8Array(0));
  const [status, raw] = outcome(() => point.encode(text));
  return status === vector.status && (status !== "ok" || isList(point.toWords(raw), vector.words));
}

const DATE_FIELDS = ["year", "month", "day", "hour", "minute", "second", "millisecond"];

/** @type {CodecCheck} */
function decodesDate(device, vector) {
  const point = pointNamed(device, vector.point);
  const [status, date] = outcome(() => point.decode(rawOfOrdered(point, vector.words)));
  if (status !== "ok") return status === vector.status;
  return status === vector.status && isList(DATE_FIELDS.map((name) => date[name] ?? 0), vector.numbers);
}

/** @type {CodecCheck} */
function encodesDate(device, vector) {
  const point = pointNamed(device, vector.point);
  const date = Object.fromEntries(DATE_FIELDS.map((name, at) => [name, vector.numbers[at]]));
  const [status, raw] = outcome(() => point.encode(date));
  return status === vector.status && (status !== "ok" || isNumber(raw, rawOfOrdered(point, vector.words)));
}

/** Bytes as people write them, and back. @type {CodecCheck} */
function isNotation(device, vector) {
  const point = pointNamed(device, vector.point);
  const held = rawOfOrdered(point, vector.words);
  if (point.decode && point.decode(held) !== vector.text) return false;
  return !point.encode || isNumber(point.encode(vector.text), held);
}

/** @type {CodecCheck} */
function isDigits(device, vector) {
  const point = pointNamed(device, vector.point);
  const [status, found] = outcome(() => point.decode(rawFor(point, vector.raw)));
  if (status === "special") return vector.status === status && found.name === vector.special;
  return status === vector.status && isList(found, vector.digits);
}

/** @type {CodecCheck} */
function encodesDigits(device, vector) {
  const point = pointNamed(device, vector.point);
  const [status, raw] = outcome(() => point.encode(vector.digits));
  return status === vector.status && (status !== "ok" || isNumber(raw, vector.raw));
}

/** Where a point is, and its limits. @type {CodecCheck} */
function isAddress(device, vector) {
  const point = pointNamed(device, vector.point);
  const references = Object.fromEntries(Object.entries(point.references).map(([key, number]) => [key, String(number)]));
  const found = [point.item, point.code ?? null, point.at.space, lowestOf(point.at), point.size, point.decimals || null];
  const expected = [vector.point, vector.code, vector.space, vector.address, vector.words, vector.decimals || null];
  const [low, high] = point.rawLimits;
  const inside = vector.raw_min === null || (isNumber(low, vector.raw_min) && isNumber(high, vector.raw_max));
  return inside && isList(found, expected) && isList(references, vector.references ?? {});
}

/** @type {CodecCheck} */
function isPlace(device, vector) {
  const { at } = pointNamed(device, vector.point);
  return isList([at.addresses, at.index ?? null, at.telegram ?? null], [vector.addresses, vector.index, vector.telegram]);
}

/** @type {CodecCheck} */
function isFixed(device, vector) {
  return isList(pointNamed(device, vector.point).facts.fixed, [vector.mask, vector.bits]);
}

/** @type {CodecCheck} */
function isDisplayed(device, vector) {
  return pointNamed(device, vector.point).facts.display === vector.decimals;
}

/** What a point belongs to, and what it has beside its numbers. @type {CodecCheck} */
function hasFacts(device, vector) {
  const point = pointNamed(device, vector.point);
  const { facts, unit, group, name } = point;
  const changes = [facts.changes ?? null, facts.changesWith ?? []];
  const where = [facts.keeps ?? null, facts.conditions ?? [], facts.writeAt?.space ?? null, facts.writeAt?.addresses ?? []];
  const only = [facts.onlyFor ? [facts.onlyFor[0], ...facts.onlyFor[1]] : [], facts.uncertain ? 1 : null];
  const found = [group, name, unit || null, facts.default ?? null, changes, facts.variant?.join("=") ?? null, only, where];
  const changing = [vector.changes, vector.changes_with.map(camelName)];
  const written = [vector.keeps, vector.conditions, vector.write_space, vector.write_addresses];
  const { symbol, variant } = vector;
  const expectedOnly = [vector.only_for, vector.uncertain];
  const expected = [vector.group, vector.name, symbol, vector.default, changing, variant, expectedOnly, written];
  return isList(found, expected) && isTyped(point.form.wire, vector.type);
}

/** @param {any} wire @param {string} type */
function isTyped({ bits, signed }, type) {
  if (type === "text" || type === "bytes") return true;
  return bits === (type === "bit" ? 1 : Number(type.slice(1))) && signed === (type[0] === "s");
}

/** An old name gives the same point. @type {CodecCheck} */
function isAlias(device, vector) {
  const { table } = device;
  const point = pointNamed(device, vector.point);
  const suffix = point.item.slice(point.name.length); // points of variants share their old names too
  const [old, now] = [vector.old, vector.new].map((name) => camelName(suffix ? name.slice(0, -suffix.length) : name));
  if (now !== camelName(point.name)) return false;
  return Boolean(suffix) || table.points.get(table.facts.oldNames[old]) === point;
}

/** The values of an axis of variants. @type {CodecCheck} */
function isVariant(device, vector) {
  return isList(device.table.facts.variants[vector.axis], vector.choices);
}

/** @type {CodecCheck} */
function isLeftOut(device, vector) {
  /** @type {[string, any][]} */
  const rows = Object.entries(device.table.facts.documented ?? {});
  const names = vector.names.map(camelName);
  const same = isList(rows.map(([name]) => name.replace(/_$/, "")), names);
  return same && isList(rows.map(([, one]) => one.code ?? "none"), vector.codes) && rows.every(([name]) => !(name in device.prototype));
}

/** @type {CodecCheck} */
function isDocumented(device, vector) {
  const rows = device.table.facts.documented;
  const { at } = rows[camelName(vector.name)] ?? rows[`${camelName(vector.name)}_`];
  const found = [at.space, lowestOf(at), at.addresses.length, at.index ?? null];
  return isList(found, [vector.space, vector.address, vector.words, vector.index]);
}

/** @type {CodecCheck} */
function identifies(device, vector) {
  const held = vector.text ?? vector.raw;
  const variant = Object.entries(vector.variant ?? {})[0];
  /** @type {any[]} */
  const rows = device.table.facts.identifications ?? [];
  return rows.some((one) => one.point === camelName(vector.of) && one.values.includes(held) && isList(one.variant, variant));
}

/** The checks by the kind of vector. @type {Readonly<Record<string, CodecCheck>>} */
export const CODEC_CHECKS = {
  decode: decodes,
  encode: encodes,
  encode_refused: encodes,
  decode_count: decodesCount,
  encode_count: encodesCount,
  check: checks,
  told: isTold,
  epoch: isEpoch,
  name: isName,
  special: isSpecial,
  special_name: isSpecialName,
  flag: isFlag,
  flag_name: isFlagName,
  bits: isBitGroup,
  words: isWords,
  text_decode: decodesText,
  text_encode: encodesText,
  unicode_decode: decodesUnicode,
  unicode_encode: encodesUnicode,
  date_decode: decodesDate,
  date_encode: encodesDate,
  notation: isNotation,
  digits: isDigits,
  digits_encode: encodesDigits,
  address: isAddress,
  place: isPlace,
  fixed: isFixed,
  display: isDisplayed,
  facts: hasFacts,
  alias: isAlias,
  variant: isVariant,
  left_out: isLeftOut,
  documented: isDocumented,
  identification: identifies,
};
