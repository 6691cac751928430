// SPDX-License-Identifier: 0BSD
/**
 * What a device is asked, in which order: the part of all devices that knows no bus. How words travel is the family's
 * part: a subclass with `_get` and `_store`. Names with an underscore are for subclasses and commands.
 */
import { giveCommand, paused, stepTestHolds } from "./commands.js";
import {
  AbsentError,
  AccessError,
  EchoError,
  ExceptionReplyError,
  FieldscribeError,
  MalformedError,
  NoReplyError,
  OtherDeviceError,
  RefusedError,
  RequestError,
  shown,
} from "./errors.js";
import { ascending, placeLabel, placesOverlap } from "./places.js";
import { labelOf, pointExists, PointTable } from "./table.js";
import { camelName } from "./words.js";

/** @typedef {import("./places.js").Place} Place */
/** @typedef {import("./table.js").AnyPoint} AnyPoint */
/** @typedef {Map<AnyPoint, FieldscribeError>} Refusals */
/** @typedef {Map<AnyPoint, number | bigint>} PointRaws */

/**
 * What is common to the options of all devices: the unit, and variants and given numbers by name.
 * @typedef {{ unit: number, [name: string]: unknown }} DeviceOptions
 */

/** Exceptions that say that a request does not suit the device: no such function, address, or number of words. */
const LASTING_CODES = [0x01, 0x02, 0x03];

/** @param {FieldscribeError} error */
function isLasting(error) {
  return error instanceof ExceptionReplyError && LASTING_CODES.includes(error.code);
}

/** When a point exists, as alternatives of tests that hold together. @param {AnyPoint} point
 * @returns {NonNullable<import("./commands.js").Step["when"]>} */
function conditionOf(point) {
  return point.facts.when ?? [];
}

/** A device on a bus: its unit number, its variants, and what was read before. One operation at a time. */
export class Session {
  /** The points of the device; `defineDevice` sets it. @type {PointTable} */
  get table() {
    throw new RequestError("bad_device", "takes the class of a generated device");
  }

  /** @param {any} line @param {DeviceOptions} options */
  constructor(line, options) {
    if (typeof line?.exchange !== "function") {
      throw new RequestError("bad_transport", `a line has a method exchange(request, reply); ${shown(line)} has none`);
    }
    if (typeof options !== "object" || options === null) {
      throw new RequestError("bad_unit", `takes options as { unit: 1 }, not ${shown(options)}`);
    }
    this.line = line;
    this.unit = options.unit;
    this.variants = this.table.variants(options);
    /** How often a request is repeated after it or its reply was lost; a command is never repeated. */
    this.retries = 0;
    /** Seconds between a failure and the repetition. */
    this.retryPause = 0;
    /** Requests, valid replies, and failures by status. */
    this.traffic = { requests: 0, replies: 0, errors: /** @type {Record<string, number>} */ ({}) };
    this._profile = this.table.facts.profile;
    /** @type {PointRaws} */
    this._kept = new Map();
    /** The current selection, by point; forgotten when an exchange fails or something else is written.
     * @type {Map<string, number>} */
    this._selected = new Map();
    /** Refusals that last: `readMany` does not request these points again. @type {Refusals} */
    this._refused = new Map();
    this._isFirstDue = true;
    this._isOnce = false;
    /** @type {Promise<unknown>} */
    this._turn = Promise.resolve();
    /** @type {Map<AnyPoint, any>} */
    this._handles = new Map();
  }

  /** Read the words or bits of a place, in ascending order of address. @param {Place} at
   * @returns {Promise<number[]>} */
  async _get(at) {
    throw new RequestError("bad_space", `${placeLabel(at)} cannot be read`);
  }

  /** Write words or bits at a place, in ascending order of address. @param {Place} at
   * @param {readonly number[]} words */
  async _store(at, words) {
    throw new RequestError("bad_space", `${placeLabel(at)} cannot take ${words.length} words`);
  }

  /** After earlier operations, send the commands that must come first, then carry out this one.
   * @template T @param {() => Promise<T>} work @param {boolean} [prepares] @returns {Promise<T>} */
  _run(work, prepares = true) {
    const turn = this._turn.then(async () => {
      if (this._isFirstDue && prepares) {
        await this._automatic("first");
        this._isFirstDue = false;
      }
      return work();
    });
    this._turn = turn.catch(() => undefined);
    return turn;
  }

  /** Give the commands that a device gives by itself. @param {string} run */
  async _automatic(run) {
    for (const [name, given] of Object.entries(this.table.facts.commands ?? {})) {
      if ("requests" in given && given.run === run) await giveCommand(this, name, given);
    }
  }

  /** Turn off repetitions inside, so that no command is carried out twice.
   * @template T @param {() => Promise<T>} work @returns {Promise<T>} */
  async _once(work) {
    this._isOnce = true;
    try {
      return await work();
    } finally {
      this._isOnce = false;
    }
  }

  /** Add to errors raised inside what was requested. @template T
   * @param {AnyPoint | readonly AnyPoint[] | string} what @param {() => Promise<T>} work @returns {Promise<T>} */
  async _about(what, work) {
    try {
      return await work();
    } catch (error) {
      if (!(error instanceof FieldscribeError)) throw error;
      const asked = Array.isArray(what) ? what : [what];
      const labels = asked.slice(0, 4).map((one) => (typeof one === "string" ? one : labelOf(one)));
      const more = asked.length > 4 ? ` and ${asked.length - 4} more` : "";
      throw error.about({ point: labels.join(", ") + more });
    }
  }

  /** Carry out one request; repeat it while it or its reply is lost, and count failures. What was selected
   * is selected again first: the device may have restarted meanwhile.
   * @template T @param {number} left @param {() => Promise<T>} ask @returns {Promise<T>} */
  async _retried(left, ask) {
    const selected = [...this._selected];
    for (; ; left--) {
      try {
        const result = await ask();
        this.traffic.replies++;
        return result;
      } catch (error) {
        if (!(error instanceof FieldscribeError)) throw error;
        this.traffic.errors[error.status] = (this.traffic.errors[error.status] ?? 0) + 1;
        this._selected.clear();
        if (left <= 0 || this._isOnce || !error.lost) throw error;
      }
      if (this.retryPause) await paused(this.retryPause);
      await this._select(selected);
    }
  }

  /** One exchange over the line; `awaited` is the text for a missing reply. @param {any} request @param {any} reply
   * @param {string} awaited @returns {Promise<any>} */
  async _exchange(request, reply, awaited) {
    this.traffic.requests++;
    try {
      return await this.line.exchange(request, reply);
    } catch (error) {
      const isTimeout = error instanceof NoReplyError || /** @type {any} */ (error)?.name === "TimeoutError";
      if (!isTimeout) throw error;
      const { text = "", received = undefined } = error instanceof NoReplyError ? error : {};
      throw new NoReplyError(text ? `${awaited}: ${text}` : awaited, received);
    }
  }

  /** The operand of a test: the value of an axis, or the raw number of a point. @param {string} of
   * @returns {Promise<number | string>} */
  async _compared(of) {
    if (!(of in (this.table.facts.variants ?? {}))) {
      return Number(await this._readRaw(this.table.resolved(of, this.variants)));
    }
    const value = this.variants[of];
    if (value === undefined) throw new AccessError(`depends on ${of}: pass it when the device is made`);
    return value;
  }

  /** @param {AnyPoint} point @returns {Promise<number | bigint>} */
  async _readRaw(point) {
    await this._select(point.facts.selects);
    return this._existing(point, () =>
      this._about(point, async () => this._taken(point, await this._get(point.at))),
    );
  }

  /** The raw number in received words; remembered if the description says how often it changes.
   * @param {AnyPoint} point @param {readonly number[]} words @returns {number | bigint} */
  _taken(point, words) {
    const raw = point.fromWords(words);
    const { changes, changesWith } = point.facts;
    if (changes === "never" || changes === "rarely" || changesWith?.length) this._kept.set(point, raw);
    this._refused.delete(point);
    return raw;
  }

  /** The raw numbers of others that a point needs, by name: known ones, remembered ones, or read now.
   *
   * Before a write, only numbers that never change are taken from memory: another master, or a person, may have
   * changed the others since.
   * @param {AnyPoint} point @param {Iterable<string>} names
   * @param {{ known?: PointRaws, refusals?: Refusals, writes?: boolean }} [how]
   * @returns {Promise<Record<string, number | bigint>>}
   */
  async _raws(point, names, { known, refusals, writes } = {}) {
    /** @type {Record<string, number | bigint>} */
    const raws = {};
    for (const name of names) {
      const other = this._needed(point, name);
      const isKept = this._kept.has(other) && (!writes || other.facts.changes === "never");
      const held = known?.get(other) ?? (isKept ? this._kept.get(other) : undefined);
      if (held !== undefined) {
        raws[name] = held;
        continue;
      }
      try {
        const refused = refusals?.get(other);
        if (refused) throw refused.copied();
        raws[name] = await this._readRaw(other);
      } catch (error) {
        throw error instanceof FieldscribeError ? error.needing(labelOf(point)) : error;
      }
    }
    return raws;
  }

  /** A point that another one needs; the AccessError names both. @param {AnyPoint} point @param {string} name
   * @returns {AnyPoint} */
  _needed(point, name) {
    const found = this.table.found(name, this.variants);
    if (found) return found;
    throw new AccessError(`${labelOf(point)} needs ${name}, which ${this.table.absence(name, this.variants)}`);
  }

  /** Read a point's value. @param {AnyPoint} point @returns {Promise<any>} */
  async _read(point) {
    const raws = await this._raws(point, point.scaleNeeds ?? []);
    return point.decode(await this._readRaw(point), raws);
  }

  /** Write a value, to the point's own place or a given one.
   * @param {AnyPoint} point @param {unknown} value @param {Place} [at] */
  async _write(point, value, at) {
    point.require?.(value);
    const needs = new Set([...(point.scaleNeeds ?? []), ...(point.limitNeeds ?? [])]);
    const raws = await this._raws(point, needs, { writes: true });
    await this._putRaw(point, point.encode(value, raws), raws, at);
  }

  /** Write a raw number that the range allows. @param {AnyPoint} point @param {number | bigint} raw
   * @param {Place} [at] */
  async _writeRaw(point, raw, at) {
    point.requireRaw?.(raw);
    const raws = await this._raws(point, point.limitNeeds ?? [], { writes: true });
    point.check(raw, raws);
    await this._putRaw(point, raw, raws, at);
  }

  /** Write a checked raw number; raises EchoError if the device confirms another one.
   * @param {AnyPoint} point @param {number | bigint} raw @param {Record<string, number | bigint>} raws
   * @param {Place} [at] */
  async _putRaw(point, raw, raws, at) {
    const isGroup = point.facts.bits !== undefined;
    this._requirePartners([point]);
    await this._automatic("before write");
    await this._select(point.facts.selects);
    await this._about(point, async () => {
      const words = isGroup ? [point.insert(await this._sharedWord(point), raw)] : point.toWords(raw);
      try {
        await this._existing(point, () => this._put(at ?? point.facts.writeAt ?? point.at, words));
      } catch (error) {
        if (!(error instanceof EchoError) || isGroup || error.answered.length !== point.size) throw error;
        const answered = point.fromWords(error.answered);
        if (point.same(raw, answered)) return;
        const [wrote, has] = [raw, answered].map((one) => point.told(one, raws));
        const text = `${wrote} was written, but the device answered ${has}`;
        throw new EchoError(text, error.written, error.answered);
      }
    });
    this._selected = new Map(point.facts.selects);
  }

  /** Raises RequestError (not_together) if a point is missing that one request has to write with these.
   * @param {readonly AnyPoint[]} points */
  _requirePartners(points) {
    for (const point of points) {
      const missing = [];
      for (const name of point.facts.writeWith ?? []) {
        const partner = this.table.found(name, this.variants);
        if (partner && !points.includes(partner)) missing.push(partner.name);
      }
      if (!missing.length) continue;
      const text = `${labelOf(point)} is written in one request with ${missing.join(", ")}`;
      throw new RequestError("not_together", `${text}: writeTogether takes them all`);
    }
  }

  /** The place of points that one request writes; raises RequestError (not_together).
   * @param {readonly AnyPoint[]} points @returns {Place} */
  _jointPlace(points) {
    this._requirePartners(points);
    const places = points.map((point) => point.facts.writeAt ?? point.at);
    const addresses = [...new Set(places.flatMap((at) => at.addresses))].sort((one, other) => one - other);
    const kinds = new Set(
      places.map((at, each) => JSON.stringify([at.space, at.base, at.function, points[each].facts.selects])),
    );
    const span = addresses[addresses.length - 1] - addresses[0] + 1;
    if (kinds.size !== 1 || !["holding", "coil"].includes(places[0].space) || span !== addresses.length) {
      throw new RequestError("not_together", "takes points that one request can write: side by side, in one space");
    }
    return { ...places[0], addresses };
  }

  /** Write several points in one request; each is checked with the new numbers of those before it.
   * @param {Map<AnyPoint, unknown>} values */
  async _writeTogether(values) {
    const points = [...values.keys()];
    const at = this._jointPlace(points);
    /** @type {PointRaws} */
    const raws = new Map();
    for (const [point, value] of values) {
      point.require?.(value);
      const needs = new Set([...(point.scaleNeeds ?? []), ...(point.limitNeeds ?? [])]);
      raws.set(point, point.encode(value, await this._raws(point, needs, { known: raws, writes: true })));
    }
    await this._automatic("before write");
    await this._select(points[0].facts.selects);
    await this._about(points, async () => {
      /** @type {Map<number, number>} */
      const words = new Map();
      for (const [point, raw] of raws) {
        const addresses = ascending(point.facts.writeAt ?? point.at);
        const held = words.get(addresses[0]);
        if (point.facts.bits === undefined) {
          point.toWords(raw).forEach((/** @type {number} */ word, /** @type {number} */ each) => {
            words.set(addresses[each], word);
          });
        } else words.set(addresses[0], point.insert(held ?? (await this._sharedWord(point)), raw));
      }
      await this._put(
        at,
        at.addresses.map((address) => words.get(address) ?? 0),
      );
    });
    this._selected = new Map(points[0].facts.selects);
  }

  /** The word that a bit group shares with other points, read before the group is written. @param {AnyPoint} point
   * @returns {Promise<number>} */
  async _sharedWord(point) {
    if (!point.decode) throw new AccessError("the other bits of its word cannot be read back");
    return (await this._get(point.at))[0];
  }

  /** Write words or bits at a place, and forget what they change. @param {Place} at @param {readonly number[]} words */
  async _put(at, words) {
    for (const kept of [...this._kept.keys()]) {
      const names = kept.facts.changesWith ?? [];
      const changing = [...this.table.points.values()].filter((point) => names.includes(point.name));
      const places = [kept, ...changing].flatMap((point) => [point.at, point.facts.writeAt ?? point.at]);
      if (places.some((one) => placesOverlap(at, one))) this._kept.delete(kept);
    }
    for (const point of [...this._refused.keys()]) if (point.facts.when) this._refused.delete(point); // it may exist now
    await this._store(at, words);
    this._selected.clear();
  }

  /** Write what points must hold before the address of another one means it, unless they hold it.
   * @param {readonly (readonly [string, number])[]} [selects] */
  async _select(selects = []) {
    const before = new Map(this._selected);
    for (const [count, [name, raw]] of selects.entries()) {
      if (before.get(name) === raw) continue;
      this._selected = new Map(selects.slice(0, count));
      await this._putRaw(this.table.resolved(name, this.variants), raw, {});
    }
    this._selected = selects.length ? new Map(selects) : before;
  }

  /** Read the raw numbers of several points, together where they need the same selection.
   * @param {readonly AnyPoint[]} points @param {string | undefined} group @param {Refusals} [refusals]
   * @returns {Promise<PointRaws>} */
  async _gatherSelected(points, group, refusals) {
    /** @type {Map<string, AnyPoint[]>} */
    const parts = new Map();
    for (const point of points) {
      const key = JSON.stringify(point.facts.selects ?? []);
      parts.set(key, [...(parts.get(key) ?? []), point]);
    }
    /** @type {PointRaws} */
    const raws = new Map();
    for (const [key, inside] of parts) {
      const gathered = await this._gather(inside, key === "[]" ? group : undefined, refusals);
      for (const [point, raw] of gathered) raws.set(point, raw);
    }
    return raws;
  }

  /** Read the raw numbers of several points (or of a whole group), place by place.
   * @param {readonly AnyPoint[]} points @param {string | undefined} group @param {Refusals} [refusals]
   * @returns {Promise<PointRaws>} */
  async _gather(points, group, refusals) {
    /** @type {Map<string, AnyPoint[]>} */
    const places = new Map();
    for (const point of points) {
      const key = JSON.stringify([
        point.at.space,
        point.at.telegram,
        point.at.base,
        point.at.index,
        point.at.addresses,
      ]);
      places.set(key, [...(places.get(key) ?? []), point]);
    }
    /** @type {PointRaws} */
    const raws = new Map();
    for (const inside of places.values()) {
      const ask = async () => {
        const words = await this._get(inside[0].at);
        return new Map(inside.map((point) => [point, this._taken(point, words)]));
      };
      for (const [point, raw] of await this._part(inside, refusals, ask)) raws.set(point, raw);
    }
    return raws;
  }

  /** Read some points in one request; if the device refuses it and `refusals` are collected, one request each.
   * @param {readonly AnyPoint[]} points @param {Refusals | undefined} refusals @param {() => Promise<PointRaws>} ask
   * @param {any} [block] @returns {Promise<PointRaws>} */
  async _part(points, refusals, ask, block) {
    let isRefusedForGood = false;
    try {
      await this._select(points[0].facts.selects);
      return await this._about(points, ask);
    } catch (error) {
      if (!(error instanceof FieldscribeError) || !refusals || error.lost) throw error;
      isRefusedForGood = isLasting(error);
      if (points.length === 1) {
        this._addCondition(points[0], error);
        refusals.set(points[0], error);
        if (isRefusedForGood) this._refused.set(points[0], error.copied());
        return new Map();
      }
    }
    /** @type {PointRaws} */
    const raws = new Map();
    for (const point of points) {
      for (const [one, raw] of await this._gather([point], undefined, refusals)) raws.set(one, raw);
    }
    if (block && isRefusedForGood && raws.size === points.length) this._noteGaps(points, block);
    return raws;
  }

  /** Record that the device refuses addresses between points; each point is read by itself from then on.
   * @param {readonly AnyPoint[]} points @param {any} block */
  _noteGaps(points, block) {
    void [points, block];
  }

  /** The points of a group that this device has; families with blocks look there. @param {AnyPoint[]} points
   * @returns {Promise<AnyPoint[]>} */
  async _there(points) {
    return points;
  }

  /** Whether the link, as it is set, carries the words of a point; families override it.
   * @param {AnyPoint} point @returns {boolean} */
  _isCarried(point) {
    return point !== undefined;
  }

  /** The points whose conditions may be true now; reads the points that conditions compare.
   * @param {AnyPoint[]} points @returns {Promise<AnyPoint[]>} */
  async _existingOf(points) {
    const names = points.flatMap((point) => {
      const selecting = Object.fromEntries(point.facts.selects ?? []);
      return conditionOf(point).flatMap((clause) => clause.map(([of]) => of).filter((of) => !(of in selecting)));
    });
    const compared = new Map([...new Set(names)].map((name) => [name, this.table.found(name, this.variants)]));
    const unknown = [...compared.values()].filter(
      (point) => point && this._isCarried(point) && !this._kept.has(point) && !this._refused.has(point),
    );
    const raws = unknown.length ? await this._gather(unknown, undefined, new Map()) : new Map();
    /** @type {Record<string, any>} */
    const held = { ...this.variants };
    for (const [name, point] of compared) {
      if (point) held[name] = raws.get(point) ?? this._kept.get(point);
    }
    return points.filter((point) => {
      const known = { ...held, ...Object.fromEntries(point.facts.selects ?? []) };
      const mayHold = (/** @type {import("./commands.js").StepTest} */ [of, test, than]) =>
        known[of] === undefined || stepTestHolds(known[of], test, than);
      return !point.facts.when || conditionOf(point).some((clause) => clause.every(mayHold));
    });
  }

  /** Read a point, and add to a refusal the condition under which it exists.
   * @template T @param {AnyPoint} point @param {() => Promise<T>} ask @returns {Promise<T>} */
  async _existing(point, ask) {
    try {
      return await ask();
    } catch (error) {
      this._addCondition(point, error);
      throw error;
    }
  }

  /** @param {AnyPoint} point @param {unknown} error */
  _addCondition(point, error) {
    if (!point.facts.when || !(error instanceof ExceptionReplyError || error instanceof RefusedError)) return;
    const told = (/** @type {import("./commands.js").StepTest} */ [of, test, than]) => {
      const other = this.table.found(of, this.variants);
      return `${of} ${test} ${than.map((one) => (other ? (other.nameOf(one) ?? other.told(one)) : one)).join(", ")}`;
    };
    const clauses = conditionOf(point).map((clause) => clause.map(told).join(" and "));
    error.about({ existsWhen: clauses.join(" or ") });
  }

  /** Read what the scales of points need, then return the values by name.
   * @param {readonly AnyPoint[]} points @param {string | undefined} group @param {Refusals} [refusals]
   * @returns {Promise<Record<string, any>>} */
  async _values(points, group, refusals) {
    const wanted = new Set(points);
    for (const point of points) {
      for (const name of point.scaleNeeds ?? []) {
        const other = refusals ? this.table.found(name, this.variants) : this._needed(point, name);
        if (other && !this._kept.has(other)) wanted.add(other);
      }
    }
    const raws = await this._gatherSelected(
      [...wanted].filter((point) => !refusals?.has(point)),
      group,
      refusals,
    );
    /** @type {Record<string, any>} */
    const values = {};
    for (const point of points) {
      try {
        const refused = refusals?.get(point);
        if (refused) throw refused.copied();
        const known = await this._raws(point, point.scaleNeeds ?? [], { known: raws, refusals });
        values[camelName(point.name)] = point.decode(raws.get(point), known);
      } catch (error) {
        if (!(error instanceof FieldscribeError) || !refusals || (error.lost && !refusals.size)) throw error;
        values[camelName(point.name)] = error.about({ group });
      }
    }
    return values;
  }

  /** @param {string} group @returns {AnyPoint[]} */
  _group(group) {
    const members = [...this.table.points.values()].filter(
      (point) => point.group === group && pointExists(point, this.variants),
    );
    if (!members.length) {
      const hint = this.table.found(group, this.variants) || this.table.coded(group).length;
      const known = hint
        ? `; it is a point: readMany([${shown(group)}]) reads it`
        : `, only ${this.table.groups().join(", ")}`;
      throw new AccessError(`there is no group ${group}${known}`);
    }
    const travels = (/** @type {AnyPoint} */ point) =>
      [
        point,
        ...(point.scaleNeeds ?? []).map((/** @type {string} */ name) => this.table.found(name, this.variants)),
      ].every((one) => !one || this._isCarried(one));
    return members.filter((point) => point.decode && travels(point));
  }

  /** Raises AccessError if the point belongs to another variant than this device, or is no point.
   * @param {AnyPoint} point @returns {AnyPoint} */
  _required(point) {
    const { variant, onlyFor } = point.facts;
    for (const [axis, values] of [variant && [variant[0], [variant[1]]], onlyFor].filter(Boolean)) {
      const chosen = this.variants[axis];
      if (chosen !== undefined && !values.includes(chosen)) {
        throw new AbsentError(`${labelOf(point)} exists only for ${axis} ${values.join(" or ")}`);
      }
    }
    return point;
  }

  /** @param {unknown} what @returns {AnyPoint} */
  _readable(what) {
    const point = this.table.resolved(typeof what === "object" ? this._attributeOf(what) : what, this.variants);
    if (!this._required(point).decode) throw new AccessError(`${labelOf(point)} cannot be read`);
    return point;
  }

  /** @param {string} name @returns {AnyPoint} */
  _writable(name) {
    const point = this.table.resolved(name, this.variants);
    if (!this._required(point).encode) throw new AccessError(`${labelOf(point)} cannot be written`);
    return point;
  }

  /** The attribute of a point, or of one that is bound to this device. @param {any} one @returns {unknown} */
  _attributeOf(one) {
    const point = this.table.attributes.has(one) ? one : Object.getPrototypeOf(one);
    const attribute = this.table.attributes.get(point);
    const isOther = one !== point && this._handles.get(point) !== one;
    if (attribute === undefined || isOther) throw new AccessError(`${labelOf(one)} is a point of another device`);
    return attribute;
  }

  /** The point bound to this device. @param {AnyPoint} point @returns {any} */
  _bound(point) {
    let handle = this._handles.get(this._required(point));
    if (!handle) {
      handle = boundPoint(this, point);
      this._handles.set(point, handle);
    }
    return handle;
  }

  /** The place to write a point; families with several memories choose. @param {AnyPoint} point @param {boolean} keep
   * @returns {Place | undefined} */
  _writePlace(point, keep) {
    if (keep) throw new AccessError(`${labelOf(point)} has no choice of keeping its value`);
    return undefined;
  }

  /**
   * A point by its name, old name or code (`P0731[1]` is one element of an array), bound to this device. Raises
   * AccessError.
   * @param {string} what @returns {any}
   */
  point(what) {
    return this._bound(this.table.resolved(what, this.variants));
  }

  /**
   * Read a group by its name, or several points, with few requests; values by attribute.
   *
   * With `errors: "return"`, a point that is absent, refused or without a value has its error as its value; only a lost
   * line raises. A point that the device refused with exception 01h to 03h is not requested again but has the same
   * error, until it is read in another way or `forget()` is called.
   * @param {string | Iterable<string | object>} what @param {{ errors?: "raise" | "return" }} [how]
   * @returns {Promise<Record<string, any>>}
   */
  readMany(what, { errors = "raise" } = {}) {
    return this._run(async () => {
      const group = typeof what === "string" ? what : undefined;
      /** @type {Record<string, any>} */
      const absent = {};
      /** @type {AnyPoint[]} */
      let points = [];
      try {
        if (typeof what === "string") points = await this._existingOf(await this._there(this._group(what)));
        else {
          for (const one of what) {
            try {
              points.push(this._readable(one));
            } catch (error) {
              if (errors === "raise" || !(error instanceof AccessError) || typeof one !== "string") throw error;
              absent[one] = error;
            }
          }
        }
        const refusals = errors === "raise" ? undefined : new Map(this._refused);
        return { ...(await this._values(points, group, refusals)), ...absent };
      } catch (error) {
        throw error instanceof FieldscribeError ? error.about({ group }) : error;
      }
    });
  }

  /**
   * Write several points by one request, as `writeWith` asks for: values by the name of the point. Raises RequestError
   * (not_together) where a point is missing, or one request cannot write them.
   * @param {Readonly<Record<string, unknown>>} values @returns {Promise<void>}
   */
  writeTogether(values) {
    return this._run(() =>
      this._writeTogether(new Map(Object.entries(values).map(([name, value]) => [this._writable(name), value]))),
    );
  }

  /**
   * Read the points that identify this device; returns the matching value of each variant axis. Raises
   * OtherDeviceError for another device.
   * @returns {Promise<Record<string, string>>}
   */
  identify() {
    return this._run(async () => {
      /** @type {Map<string, unknown>} */
      const held = new Map();
      /** @type {Record<string, string>} */
      const variants = {};
      const rows = [...(this.table.facts.identifications ?? [])];
      while (rows.length) {
        const [{ variant }] = rows;
        const end = rows.findIndex((row) => String(row.variant) !== String(variant));
        const alternative = rows.splice(0, end < 0 ? rows.length : end);
        if (variant && variant[0] in variants) continue;
        const misfit = await this._misfit(alternative, held);
        if (variant && !misfit) variants[variant[0]] = variant[1];
        else if (!variant && misfit) throw new OtherDeviceError(misfit);
      }
      return variants;
    }, false);
  }

  /** The first difference from what the points should hold. @param {import("./table.js").Identification[]} rows
   * @param {Map<string, unknown>} held @returns {Promise<string | undefined>} */
  async _misfit(rows, held) {
    for (const { point: name, values } of rows) {
      if (!held.has(name)) {
        const point = this.table.resolved(name, this.variants);
        try {
          const raw = await this._readRaw(point);
          held.set(name, typeof values[0] === "string" ? point.decode(raw) : raw);
        } catch (error) {
          if (!(error instanceof ExceptionReplyError || error instanceof MalformedError)) throw error;
          return `${name}: ${error.message}`;
        }
      }
      const found = /** @type {any} */ (held.get(name));
      if (!values.includes(found)) return `${name} is ${shown(found)}, not ${values.map(shown).join(" or ")}`;
    }
    return undefined;
  }

  /** Forget what was read and what the device has refused; first commands are sent again. */
  forget() {
    this._isFirstDue = true;
    this._kept.clear();
    this._selected.clear();
    this._refused.clear();
  }
}

/** @param {Session} session @param {AnyPoint} point @returns {any} */
function boundPoint(session, point) {
  const handle = Object.create(point);
  /** @type {Record<string, unknown>} */
  const methods = {};
  if (point.decode) {
    methods.read = () => session._run(() => session._read(point));
    methods.readRaw = () => session._run(() => session._readRaw(point));
  }
  if (point.encode) {
    const placed = (/** @type {{ keep?: boolean } | undefined} */ how) =>
      session._writePlace(point, how?.keep ?? false);
    methods.write = (/** @type {unknown} */ value, /** @type {{ keep?: boolean }} */ how) =>
      session._run(async () => session._write(point, value, placed(how)));
    methods.writeRaw = (/** @type {number} */ raw, /** @type {{ keep?: boolean }} */ how) =>
      session._run(async () => session._writeRaw(point, raw, placed(how)));
  }
  for (const [name, value] of Object.entries(methods)) Object.defineProperty(handle, name, { value });
  return handle;
}

/**
 * Set the facts of a class, and make points and commands attributes of its objects.
 * @template {typeof Session} T @param {T} kind @param {import("./table.js").DeviceFacts} facts @returns {T}
 */
export function defineDevice(kind, facts) {
  const table = new PointTable(facts);
  const define = (/** @type {string} */ name, /** @type {(this: any) => unknown} */ get) =>
    Object.defineProperty(kind.prototype, name, { get, configurable: true });
  define("table", () => table);
  Object.defineProperty(kind, "table", { value: table });
  Object.defineProperty(kind, "facts", { value: facts });
  for (const [attribute, point] of table.points) {
    define(attribute, function () {
      return this._bound(point);
    });
    const shared = camelName(point.name);
    if (point.facts.variant && !table.points.has(shared)) {
      define(shared, function () {
        return this.point(point.name);
      });
    }
  }
  for (const [old, now] of Object.entries(facts.oldNames ?? {})) {
    define(old, function () {
      return this[now];
    });
  }
  for (const [name, given] of Object.entries(facts.commands ?? {})) {
    define(name, function () {
      const send = (/** @type {any} */ value) => this._run(() => giveCommand(this, name, given, value));
      return { send, every: "every" in given ? given.every : undefined };
    });
  }
  return kind;
}
