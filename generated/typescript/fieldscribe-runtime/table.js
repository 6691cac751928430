// SPDX-License-Identifier: 0BSD
/** A device's points, found by what people call them: names, codes and groups, for the variants told. */
import { AbsentError, AccessError, RequestError, shown } from "./errors.js";
import { checkNumber } from "./receiving.js";
import { camelName } from "./words.js";

/** A point of any kind, as far as devices need to know. @typedef {any} AnyPoint */

/**
 * The facts of a device in generated code. `points` and `commands` are by attribute; `oldNames` are former names of
 * attributes, `documented` the reasons why points have none.
 * @typedef {object} DeviceFacts
 * @property {any} profile
 * @property {Readonly<Record<string, AnyPoint>>} points
 * @property {Readonly<Record<string, import("./commands.js").AnyCommand>>} [commands]
 * @property {Readonly<Record<string, readonly string[]>>} [variants]
 * @property {Readonly<Record<string, readonly import("./modbus.js").ModbusBlock[]>>} [blocks]
 * @property {Readonly<Record<string, import("./bases.js").ModbusBase>>} [bases]
 * @property {Readonly<Record<string, readonly [number, number]>>} [given]
 * @property {import("./bases.js").ModbusChain} [chain]
 * @property {readonly Identification[]} [identifications]
 * @property {Readonly<Record<string, { reason: string }>>} [documented]
 * @property {Readonly<Record<string, string>>} [oldNames]
 */

/**
 * What a point holds in a device, or in one of its variants: one of `values`, raw numbers or texts.
 * @typedef {{ point: string, values: readonly (number | string)[], variant?: readonly [string,
 *   string] }} Identification
 */

/** @param {string} point @param {readonly (number | string)[]} values @param {readonly [string, string]} [variant]
 * @returns {Identification} */
export function identification(point, values, variant) {
  return { point, values, variant };
}

/** The values of variants that are known, by axis. @typedef {Record<string, string | undefined>} Variants */

/** Whether the known variants have a point; false if its variant is not known.
 * @param {AnyPoint} point @param {Variants} variants @returns {boolean} */
export function pointExists(point, variants) {
  const { onlyFor, variant } = point.facts;
  if (onlyFor && variants[onlyFor[0]] !== undefined && !onlyFor[1].includes(variants[onlyFor[0]])) return false;
  return !variant || variants[variant[0]] === variant[1];
}

/** The label of a point for messages: code and name. @param {AnyPoint} point @returns {string} */
export function labelOf(point) {
  return point.label ?? (point.code ? `${point.code} ${point.name}` : point.name);
}

/** A device's points by name. */
export class PointTable {
  /** @param {DeviceFacts} facts */
  constructor(facts) {
    this.facts = facts;
    /** @type {Map<string, AnyPoint>} */
    this.points = new Map(Object.entries(facts.points));
    /** @type {Map<string, AnyPoint[]>} */
    this.byName = new Map();
    /** @type {Map<AnyPoint, string>} */
    this.attributes = new Map();
    for (const [attribute, point] of this.points) {
      this.attributes.set(point, attribute);
      for (const name of new Set([attribute, point.name, camelName(point.name)])) {
        this.byName.set(name, [...(this.byName.get(name) ?? []), point]);
      }
    }
  }

  /** The given variants by axis; raises RequestError (bad_variant). @param {Record<string, unknown>} options
   * @returns {Variants} */
  variants(options) {
    /** @type {Variants} */
    const chosen = {};
    for (const [axis, values] of Object.entries(this.facts.variants ?? {})) {
      const value = ownOf(options, camelName(axis)) ?? ownOf(options, axis);
      if (value !== undefined && !values.includes(/** @type {string} */ (value))) {
        throw new RequestError("bad_variant", `${axis} is one of ${values.join(", ")}, not ${shown(value)}`);
      }
      chosen[axis] = /** @type {string | undefined} */ (value);
    }
    return chosen;
  }

  /** The point of the known variant by name. @param {string} name @param {Variants} variants
   * @returns {AnyPoint | undefined} */
  found(name, variants) {
    const named = this.byName.get(ownOf(this.facts.oldNames, name) ?? name) ?? [];
    const item = this.points.get(name);
    return item ?? named.find((point) => pointExists(point, variants)) ?? named.find((point) => !point.facts.variant);
  }

  /** A point by name, old name or code (`P0731[1]` is an element of an array); raises AccessError.
   * @param {unknown} what @param {Variants} variants @returns {AnyPoint} */
  resolved(what, variants) {
    if (typeof what !== "string" || !what.trim())
      throw new AccessError(`a point is named by a text, not ${shown(what)}`);
    const found = this.found(what, variants) ?? [...this.points.values()].find((point) => labelOf(point) === what);
    if (found) return found;
    const coded = this.coded(what);
    const there = coded.filter((point) => pointExists(point, variants));
    const points = there.length ? there : coded;
    if (points.length > 1 && new Set(points.map((point) => point.name)).size > 1) {
      throw new AccessError(
        `${what} means several points: ${points.map((point) => this.attributes.get(point)).join(", ")}`,
      );
    }
    if (points.length !== 1) {
      const name = points.length ? points[0].name : what;
      throw new AbsentError(`${name} ${this.absence(name, variants)}`);
    }
    return points[0];
  }

  /** The points with a code, in capitals or not. @param {string} what @returns {AnyPoint[]} */
  coded(what) {
    const [, code, index] = /^(.*?)(?:\[(.*)\])?$/s.exec(what.toLowerCase()) ?? [];
    return [...this.points.values()].filter(
      (point) => point.code?.toLowerCase() === code && (index === undefined || index === String(point.at.index)),
    );
  }

  /** Why there is no such point, or not yet. @param {string} name @param {Variants} variants @returns {string} */
  absence(name, variants) {
    const axis = this.byName.get(name)?.[0]?.facts.variant?.[0];
    if (axis !== undefined) {
      if (variants[axis] === undefined) return `depends on ${axis}: pass it when the device is made`;
      return `does not exist for ${axis} ${variants[axis]}`;
    }
    const documented = ownOf(this.facts.documented, name) ?? ownOf(this.facts.documented, camelName(name));
    if (documented) return `is documented only: ${documented.reason}`;
    if (ownOf(this.facts.commands, name)) return `is a command of this device: ${name}.send() gives it`;
    if (this.groups().includes(name)) return `is a group of this device: readMany(${shown(name)}) reads it`;
    return "is no point of this device";
  }

  /** The names of the groups. @returns {string[]} */
  groups() {
    return [...new Set([...this.points.values()].map((point) => point.group))];
  }
}

/** The own property of an object with a name from a user, not an inherited one.
 * @template T @param {Readonly<Record<string, T>> | undefined} held @param {string} name @returns {T | undefined} */
export function ownOf(held, name) {
  return held && Object.prototype.hasOwnProperty.call(held, name) ? held[name] : undefined;
}

/** Raises RequestError for a unit number that the device cannot have. @param {number} unit
 * @param {readonly [number, number]} units */
export function checkUnit(unit, units) {
  checkNumber("bad_unit", "unit", unit, units);
}
