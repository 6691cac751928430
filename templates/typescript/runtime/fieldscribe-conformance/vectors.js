// SPDX-License-Identifier: 0BSD
/** Reads a file of conformance vectors, and runs all of them against the generated class of a device. */
import { CODEC_CHECKS } from "./codecs.js";
import { EXCHANGE_CHECKS } from "./exchanges.js";

/** @typedef {Record<string, any>} Vector */
/** A set or kind of vectors: its fields with their forms. @typedef {readonly (readonly [string, string])[]} VectorShape */

const LANGUAGE = "typescript";
const REAL_DIGITS = 16;
const REAL_VIEW = new DataView(new ArrayBuffer(8));

/** @param {string} field */
function vectorText(field) {
  if (field === "%") return "";
  const bytes = field.replace(/%([0-9a-f]{2})/gi, (_, code) => String.fromCharCode(parseInt(code, 16)));
  const isAscii = !/%[89a-f]/i.test(field);
  return isAscii ? bytes : decodeURIComponent(field);
}

/** @param {string} field @returns {Uint8Array} */
function vectorBytes(field) {
  return Uint8Array.from(field.match(/../g) ?? [], (pair) => parseInt(pair, 16));
}

/** An integer, as a bigint where a number is not exact. @param {string} field */
function vectorInteger(field) {
  const number = Number(field);
  return Number.isSafeInteger(number) ? number : BigInt(field);
}

/** @param {string} field @returns {number} */
function vectorReal(field) {
  REAL_VIEW.setBigUint64(0, BigInt(`0x${field.padEnd(REAL_DIGITS, "0")}`));
  return REAL_VIEW.getFloat64(0);
}

/** @template T @param {string} field @param {(left: string, right: string) => T} each @returns {T[]} */
function vectorPairs(field, each) {
  return field.split(",").map((pair) => {
    const at = pair.indexOf("=");
    return each(at < 0 ? pair : pair.slice(0, at), at < 0 ? "" : pair.slice(at + 1));
  });
}

/** How a field of each form is read, and what an absent one is. @type {Record<string, [(field: string) => any, () => any]>} */
const VECTOR_FORMS = {
  int: [vectorInteger, () => null],
  word: [vectorText, () => null],
  note: [vectorText, () => null],
  text: [vectorText, () => null],
  bytes: [vectorBytes, () => new Uint8Array(0)],
  real: [vectorReal, () => null],
  ints: [(field) => field.split(",").map(vectorInteger), () => []],
  names: [(field) => field.split(",").map(vectorText), () => []],
  pairs: [
    (field) => Object.fromEntries(vectorPairs(field, (key, part) => [vectorText(key), vectorText(part)])),
    () => ({}),
  ],
  frames: [(field) => vectorPairs(field, (id, data) => [Number(id), vectorBytes(data)]), () => []],
  script: [(field) => vectorPairs(field, (sent, came) => [vectorBytes(sent), vectorBytes(came)]), () => []],
};

/** @param {VectorShape} shape @param {readonly string[]} fields @returns {Vector} */
function readFields(shape, fields) {
  if (fields.length > shape.length) throw new Error(`more than ${shape.length} fields: ${fields.join(" ")}`);
  return Object.fromEntries(
    shape.map(([key, form], at) => {
      const [read, absent] = VECTOR_FORMS[form];
      const field = fields[at] ?? "-";
      return [key, field === "-" ? absent() : read(field)];
    }),
  );
}

/** The vectors of a text: what its head says, how many it announces of each kind, and all of them in order. */
export class VectorFile {
  /** @param {string} text */
  constructor(text) {
    /** @type {string[]} */
    this.head = [];
    /** @type {Record<string, number>} */
    this.counts = {};
    /** @type {Record<string, VectorShape>} */
    this.shapes = {};
    /** @type {string[]} */
    this.sets = [];
    this.lines = text.split("\n");
  }

  /** @returns {Generator<Vector>} */
  *[Symbol.iterator]() {
    /** @type {Record<string, Vector>} */
    let held = {};
    for (const line of this.lines) {
      const [name, ...fields] = line.split("\t");
      if (["", "vectors", "set", "kind"].includes(name)) this.declare(name, fields);
      else if (this.sets.includes(name)) {
        const kept = this.sets.slice(0, this.sets.indexOf(name)).filter((one) => one in held);
        const before = held;
        held = Object.fromEntries(kept.map((one) => [one, before[one]]));
        held[name] = readFields(this.shapes[name], fields);
      } else yield { kind: name, ...Object.assign({}, ...Object.values(held)), ...readFields(this.shapes[name], fields) };
    }
  }

  /** @param {string} what @param {readonly string[]} fields */
  declare(what, fields) {
    if (what === "vectors") this.head = [...fields];
    if (what !== "set" && what !== "kind") return;
    const [name, ...others] = fields;
    /** @type {[string, string][]} */
    const shape = others.slice(what === "kind" ? 1 : 0).map((field) => {
      const at = field.indexOf(":");
      return [field.slice(0, at), field.slice(at + 1)];
    });
    const only = shape.find(([key]) => key === "only")?.[1] ?? LANGUAGE;
    if (what === "kind" && only.split(".").includes(LANGUAGE)) this.counts[name] = Number(others[0]);
    if (what === "set") this.sets.push(name);
    this.shapes[name] = shape.filter(([key]) => key !== "only");
  }
}

/** How many vectors of each kind passed and failed, and the first that failed.
 * @typedef {{ passed: Record<string, number>, failed: Record<string, number>, shown: Vector[] }} VectorResults */

/** Run all vectors of a text against the generated class of a device.
 * @param {any} device @param {string} text @param {number} [most] so many failures are shown
 * @param {() => Promise<void> | undefined} [pause] awaited before each vector @returns {Promise<VectorResults>} */
export async function runVectors(device, text, most = 20, pause) {
  /** @type {VectorResults} */
  const results = { passed: {}, failed: {}, shown: [] };
  const file = new VectorFile(text);
  const fail = (/** @type {Vector} */ vector) => {
    results.failed[vector.kind] = (results.failed[vector.kind] ?? 0) + 1;
    if (results.shown.length < most) results.shown.push(vector);
  };
  for (const vector of file) {
    if (!(vector.kind in file.counts)) continue; // TypeScript has no such thing
    await pause?.();
    const [good, reason] = await passesVector(device, vector);
    if (good) results.passed[vector.kind] = (results.passed[vector.kind] ?? 0) + 1;
    else fail({ ...vector, reason });
  }
  for (const [kind, count] of Object.entries(file.counts)) {
    const ran = (results.passed[kind] ?? 0) + (results.failed[kind] ?? 0);
    if (ran !== count) fail({ kind: "incomplete", reason: `${ran} of ${count} ${kind}` });
  }
  const { version, digest } = device.facts;
  if (file.head[2] !== version || file.head[3] !== digest) fail({ kind: "of another description" });
  return results;
}

/** @param {any} device @param {Vector} vector @returns {Promise<[boolean, string]>} */
async function passesVector(device, vector) {
  const check = CODEC_CHECKS[vector.kind] ?? EXCHANGE_CHECKS[vector.kind];
  try {
    return [check !== undefined && (await check(device, vector)), ""];
  } catch (error) {
    return [false, String(error)]; // whatever generated code raises, the vector has failed
  }
}
