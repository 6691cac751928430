// SPDX-License-Identifier: 0BSD
/** CAN devices on a bus: parameters that are requested by messages, and cyclic telegrams. */
import {
  buildCanFrame,
  canFrameFault,
  canFrameOf,
  carriesRole,
  messageNamed,
  parameterRequest,
  parseCanFrame,
  SignalPacking,
  telegramNamed,
  wordPlaces,
} from "./can-frames.js";
import { EchoError, FieldscribeError, NoReplyError, RequestError, shown, TelegramError } from "./errors.js";
import { ascending, place, placeLabel } from "./places.js";
import { checkNumber } from "./receiving.js";
import { Session } from "./session.js";
import { checkUnit } from "./table.js";
import { camelName } from "./words.js";

/** @typedef {import("./places.js").Place} Place */
/** @typedef {import("./table.js").AnyPoint} AnyPoint */
/** @typedef {import("./can-frames.js").CanFrame} CanFrame */
/** @typedef {import("./can-frames.js").CanMessage} CanMessage */
/** @typedef {import("./can-frames.js").CanProfile} CanProfile */

/**
 * What a line must know of the frames that a device waits for. The line passes every received frame to `accepts`, and
 * resolves with the first one accepted; if none is within `patience` seconds, it rejects with NoReplyError.
 * Nobody answers a `broadcast`: the line resolves at once.
 * @typedef {{ framing: string, broadcast: boolean, patience: number,
 *   accepts: (frame: CanFrame) => boolean }} CanReplyShape
 */

/**
 * Carries frames to the bus and from it: sends the request, if there is one, and waits for `reply`.
 * @typedef {{ exchange: (request: CanFrame | null, reply: CanReplyShape) => Promise<CanFrame | undefined> }} CanLine
 */

/** After this many seconds, a received frame answers no earlier request. */
const SETTLED = 0.2;

/** @returns {number} seconds of a clock that only goes forward */
function seconds() {
  return performance.now() / 1000;
}

/** The last two frames of one multiplexer number; for signals, the words that come together.
 * @typedef {{ words: number[], number: number, wordsBefore: number[], numberBefore: number, moment: number }} Slot */

/** Takes the frames of a telegram from one unit, and returns its words once they have arrived. */
export class TelegramReceiver {
  /** @param {CanProfile} profile @param {string} telegram @param {number} unit */
  constructor(profile, telegram, unit) {
    checkUnit(unit, profile.units);
    const layout = telegramNamed(profile, telegram);
    this.telegram = layout.name;
    this.unit = unit;
    this.message = messageNamed(profile, layout.message);
    this.packing = this.message.signals.length
      ? new SignalPacking(this.message.signals, this.message.length)
      : undefined;
    this.places = wordPlaces(this.message);
    this.multiplexer = this.message.roles.findIndex((role) => role.kind === "multiplexer");
    /** The part of each word of the telegram, and its place in the part. @type {[number, number][]} */
    this.partOf = [];
    if (this.packing) {
      this.packing.parts.forEach(({ words }, part) => {
        for (let at = 0; at < words; at++) this.partOf.push([part, at]);
      });
    } else {
      const carried = this.places.length;
      for (let at = 0; at < layout.words; at++) this.partOf.push([Math.floor(at / carried), at % carried]);
    }
    const count = this.packing ? this.packing.parts.length : Math.ceil(layout.words / this.places.length);
    /** @type {Slot[]} */
    this.slots = Array.from({ length: count }, () => ({
      words: [],
      number: 0,
      wordsBefore: [],
      numberBefore: 0,
      moment: 0,
    }));
    this.count = 0;
  }

  /** Take a frame at the time `moment` (in seconds) if it belongs to the telegram; returns whether it does.
   * @param {CanFrame} frame @param {number} [moment] @returns {boolean} */
  take(frame, moment = 0) {
    if (typeof frame?.id !== "number" || !(frame.data instanceof Uint8Array)) {
      throw new RequestError("bad_frame", `takes a frame as { id, data }, not ${shown(frame)}`);
    }
    if (canFrameFault(this.message, this.unit, frame)) return false;
    const parts = this.packing ? this.packing.coming(frame.data) : this.taken(frame.data);
    if (!this.packing && !parts.size) return false;
    this.count++;
    for (const [part, words] of parts) {
      const slot = this.slots[part];
      slot.wordsBefore = slot.words;
      slot.numberBefore = slot.number;
      slot.words = words;
      slot.number = this.count;
      slot.moment = moment;
    }
    return parts.size > 0;
  }

  /** @private @param {Uint8Array} data @returns {Map<number, number[]>} */
  taken(data) {
    const part = this.multiplexer < 0 ? 0 : data[this.multiplexer];
    if (part >= this.slots.length) return new Map();
    return new Map([[part, this.places.map(([high, low]) => (data[high] << 8) | data[low])]]);
  }

  /** Whether all frames with these words arrived at `moment` or later. @param {readonly number[]} positions
   * @param {number} moment */
  isNewer(positions, moment) {
    return positions.every((position) => this.slot(position).number && this.slot(position).moment >= moment);
  }

  /** Whether any frame of the telegram arrived at `moment` or later. @param {number} moment */
  isSent(moment) {
    return this.slots.some((slot) => slot.number && slot.moment >= moment);
  }

  /**
   * The words at these positions, the high one first; raises TelegramError, `missing` or `torn`.
   *
   * Two words of two frames are accepted only if the same high word arrived before and after the low one: a counter may
   * have changed in between. More words, such as texts, are returned as they arrived last.
   * @param {readonly number[]} positions @returns {number[]}
   */
  words(positions) {
    const found = positions.map((position) => this.slot(position));
    const at = positions.map((position) => this.partOf[position][1]);
    if (!found.length || found.some((slot) => !slot.number)) {
      throw new TelegramError(
        "missing",
        `not all frames of ${this.telegram} with words ${positions.join(", ")} came yet`,
      );
    }
    const high = found[0];
    const low = found[found.length - 1];
    if (high === low || found.length > 2) return found.map((slot, each) => slot.words[at[each]]);
    const first = high.words[at[0]];
    if (high.numberBefore && first === high.wordsBefore[at[0]]) {
      if (high.numberBefore < low.number && low.number < high.number) return [first, low.words[at[1]]];
      const isBetween = high.numberBefore < low.numberBefore && low.numberBefore < high.number;
      if (isBetween && high.number < low.number) return [first, low.wordsBefore[at[1]]];
    }
    const text = `words ${positions.join(", ")} of ${this.telegram} may belong to different values`;
    throw new TelegramError("torn", text);
  }

  /** @private @param {number} position @returns {Slot} */
  slot(position) {
    const part = this.partOf[position];
    if (part) return this.slots[part[0]];
    const text = `${this.telegram} has ${this.partOf.length} words, and none at ${shown(position)}`;
    throw new RequestError("bad_address", text);
  }

  /** The words at these positions in ascending order of position. @param {Place} at @returns {number[]} */
  ascending(at) {
    const words = this.words(at.addresses);
    return ascending(at).map((address) => words[at.addresses.indexOf(address)]);
  }
}

/**
 * The frame of a message with signals that have these values, by attribute; bits of signals without a value are 0.
 * Raises as encoding does, and RequestError for a point that is not in the message, or a message without signals.
 * @param {typeof Session} device @param {string} message @param {Readonly<Record<string, unknown>>} values
 * @param {{ unit?: number, raws?: Readonly<Record<string, number>> }} [how] @returns {CanFrame}
 */
export function packMessage(device, message, values, { unit = 0, raws } = {}) {
  const { table } = /** @type {any} */ (device);
  const { profile } = table.facts;
  const laidOut = messageNamed(profile, message);
  checkUnit(unit, profile.units);
  if (!laidOut.signals.length) throw new RequestError("bad_message", `${message} has no signals`);
  const packing = new SignalPacking(laidOut.signals, laidOut.length);
  /** @type {[number, number | bigint][]} */
  const found = [];
  for (const [name, value] of Object.entries(values)) {
    const point = table.points.get(camelName(name));
    if (point?.at.telegram !== message)
      throw new RequestError("bad_point", `${shown(name)} is no signal of ${message}`);
    if (!point.encode) throw new RequestError("bad_point", `${name} cannot be written`);
    found.push([packing.firsts().indexOf(point.at.addresses[0]), point.encode(value, raws)]);
  }
  return canFrameOf(laidOut, profile, unit, packing.pack(found));
}

/**
 * A device on a CAN bus.
 *
 * While other frames keep arriving, an answer may take `patience` seconds. Words of a telegram that arrived up to
 * `freshFor` seconds ago are read without waiting for new ones.
 */
export class CanDevice extends Session {
  /** @param {CanLine} line @param {import("./session.js").DeviceOptions} options */
  constructor(line, options) {
    super(line, options);
    const profile = /** @type {CanProfile} */ (this._profile);
    checkUnit(this.unit, profile.units);
    this.patience = 10;
    this.freshFor = 1;
    this._receivers = new Map(
      profile.telegrams.map((one) => [one.name, new TelegramReceiver(profile, one.name, this.unit)]),
    );
    /** @type {number | undefined} */
    this._since = undefined;
    this._isWaitOver = false;
    this._isUnanswered = false;
  }

  /** Take a frame received elsewhere; returns whether it is of a telegram of this device. @param {CanFrame} frame */
  take(frame) {
    const moment = seconds();
    return [...this._receivers.values()].map((receiver) => receiver.take(frame, moment)).includes(true);
  }

  /** Read parameters by address, or words of the telegram that `space` names, as plain numbers.
   * @param {string} space @param {number} address @param {number} [count] @returns {Promise<number[]>} */
  readAt(space, address, count = 1) {
    return this._run(async () => {
      const at = this._placeOf(space, address, count);
      return this._about(placeLabel(at), () => this._get(at));
    });
  }

  /** Write parameters by address. Nothing is checked: this can set what no point allows.
   * @param {string} space @param {number} address @param {...number} values @returns {Promise<void>} */
  writeAt(space, address, ...values) {
    return this._run(async () => {
      const at = this._placeOf(space, address, values.length);
      for (const word of values) checkNumber("bad_value", "a word", word, [0, 0xffff]);
      await this._about(placeLabel(at), () => this._put(at, values));
    });
  }

  /** @param {string} space @param {number} address @param {number} count @returns {Place} */
  _placeOf(space, address, count) {
    checkNumber("bad_address", "address", address, [0, 0xffff]);
    checkNumber("bad_count", "the number of words", count, [1, 0x10000]);
    const addresses = Array.from({ length: count }, (_, at) => address + at);
    return this._receivers.has(space) ? place("telegram", addresses, { telegram: space }) : place(space, addresses);
  }

  /** Read parameters one by one, or listen for words of a telegram. @param {Place} at @returns {Promise<number[]>} */
  async _get(at) {
    if (at.telegram !== undefined) return this._listen(at);
    if (at.space !== "parameter") {
      throw new RequestError("bad_space", `the space ${shown(at.space)} cannot be read by address, only parameter`);
    }
    const request = parameterRequest(this._profile, false);
    const words = [];
    for (const address of ascending(at)) {
      words.push(await this._retried(this.retries, () => this._ask(request, address, 0)));
    }
    return words;
  }

  /** Write parameters one by one. @param {Place} at @param {readonly number[]} words */
  async _store(at, words) {
    if (at.space !== "parameter") {
      const instead = at.space === "signal" ? "; packMessage makes the frame of a message" : "";
      throw new RequestError("bad_space", `the space ${shown(at.space)} cannot be written, only parameter${instead}`);
    }
    const request = parameterRequest(this._profile, true);
    const answer = this._answer(request);
    const addresses = ascending(at);
    for (let each = 0; each < addresses.length; each++) {
      const word = words[each];
      const raw = await this._retried(this.retries, () => this._ask(request, addresses[each], word));
      if (answer && carriesRole(answer, "raw") && raw !== word) {
        const text = `${word} was written to ${addresses[each]}, but the device answered ${raw}`;
        throw new EchoError(text, [word], [raw]);
      }
    }
  }

  /** The message that answers a request, if any. @param {CanMessage} request @returns {CanMessage | undefined} */
  _answer(request) {
    return /** @type {CanProfile} */ (this._profile).messages.find((one) => one.answers === request.name);
  }

  /** One request, and the raw number of its answer; the receivers take all other frames.
   * @param {CanMessage} request @param {number} address @param {number} raw @returns {Promise<number>} */
  async _ask(request, address, raw) {
    const answer = this._answer(request);
    const frame = buildCanFrame(request, this._profile, this.unit, address, raw);
    if (this._isUnanswered) await this._settle();
    if (!answer) {
      await this._exchange(frame, { framing: "can", broadcast: true, patience: 0, accepts: () => true }, "");
      return raw;
    }
    let word = 0;
    let fault = "";
    const accepts = (/** @type {CanFrame} */ heard) => {
      const found = canFrameFault(answer, this.unit, heard);
      if (found === "wrong_check") fault = ` (${found})`;
      const carried = found ? undefined : parseCanFrame(answer, this.unit, heard);
      if (carried && (carried.address === address || !carriesRole(answer, "address"))) {
        word = carried.raw;
        return true;
      }
      this.take(heard);
      return false;
    };
    this._isUnanswered = true; // until the answer came, whatever ends the wait
    await this._wait(frame, accepts, () => `unit ${this.unit} did not send ${answer.name} for ${address}${fault}`);
    this._isUnanswered = false;
    return word;
  }

  /** Wait for a late answer, so that it is not taken for the next one. */
  async _settle() {
    const accepts = (/** @type {CanFrame} */ heard) => {
      this.take(heard);
      return false;
    };
    const shape = { framing: "can", broadcast: false, patience: SETTLED, accepts };
    await this.line.exchange(null, shape).catch((/** @type {any} */ error) => {
      if (!(error instanceof NoReplyError) && error?.name !== "TimeoutError") throw error;
    });
    this._isUnanswered = false;
  }

  /** @param {CanFrame | null} frame @param {(frame: CanFrame) => boolean} accepts @param {() => string} awaited */
  async _wait(frame, accepts, awaited) {
    const shape = { framing: "can", broadcast: false, patience: this.patience, accepts };
    try {
      await this._exchange(frame, shape, "");
    } catch (error) {
      throw error instanceof NoReplyError ? new NoReplyError(awaited()) : error;
    }
  }

  /** Words of a telegram, as soon as all have arrived, are fresh, and belong together.
   * @param {Place} at @returns {Promise<number[]>} */
  async _listen(at) {
    const receiver = this._receivers.get(telegramNamed(this._profile, at.telegram).name);
    if (!receiver) throw new RequestError("bad_space", `there is no telegram ${at.telegram}`);
    const since = this._since ?? seconds() - this.freshFor;
    let trouble = "";
    /** @type {number[] | undefined} */
    let words;
    const look = () => {
      if (!receiver.isNewer(at.addresses, since)) return false;
      try {
        words = receiver.ascending(at);
      } catch (error) {
        if (!(error instanceof TelegramError)) throw error;
        trouble = ` (${error.text})`;
      }
      return words !== undefined;
    };
    const places = at.addresses.join(", ");
    const awaited = () => `unit ${this.unit} did not send ${receiver.telegram} with words ${places}${trouble}`;
    if (look()) return words ?? [];
    if (this._isWaitOver) throw new NoReplyError(awaited());
    await this._wait(null, (heard) => this.take(heard) && look(), awaited);
    return words ?? [];
  }

  /** Read several points; those of a telegram out of the same frames.
   * @param {readonly AnyPoint[]} points @param {string | undefined} group
   * @param {import("./session.js").Refusals} [refusals] @returns {Promise<import("./session.js").PointRaws>} */
  async _gather(points, group, refusals) {
    this._since = seconds() - this.freshFor;
    try {
      return await super._gather(points, group, refusals);
    } finally {
      this._since = undefined;
      this._isWaitOver = false;
    }
  }

  /** Read some points; if refusals are collected, also words that are missing in a telegram that is sent.
   * @param {readonly AnyPoint[]} points @param {import("./session.js").Refusals | undefined} refusals
   * @param {() => Promise<import("./session.js").PointRaws>} ask
   * @returns {Promise<import("./session.js").PointRaws>} */
  async _part(points, refusals, ask) {
    try {
      return await super._part(points, refusals, ask);
    } catch (error) {
      const receiver = this._receivers.get(points[0].at.telegram ?? "");
      const isSent = receiver?.isSent(this._since ?? 0);
      if (!(error instanceof NoReplyError) || !refusals || !isSent) throw error;
      this._isWaitOver = true;
      for (const point of points) refusals.set(point, /** @type {FieldscribeError} */ (error));
      return new Map();
    }
  }
}
