// SPDX-License-Identifier: 0BSD
/** USS devices on a line: parameters, and process data that travels with every telegram. */
import { AccessError, EchoError, FrameError, RequestError, shown } from "./errors.js";
import { ascending, highestOf, lowestOf, place, placeLabel } from "./places.js";
import { checkInteger, checkNumber } from "./receiving.js";
import { Session } from "./session.js";
import { checkUnit, labelOf } from "./table.js";
import {
  buildUssBroadcast,
  buildUssRequest,
  checkUssLink,
  checkUssRequest,
  parseUssReply,
  sentPkw,
  USS_NO_TASK,
  USS_READ,
  ussChangeTask,
  ussReplyShape,
} from "./uss-frames.js";

/** @typedef {import("./places.js").Place} Place */
/** @typedef {import("./table.js").AnyPoint} AnyPoint */
/** @typedef {import("./uss-frames.js").UssRequest} UssRequest */
/** Process data that is sent, by the place of the word. @typedef {Map<number, number>} SentWords */

/**
 * A device on a USS line, with how its link is set, and the process data that its next telegrams carry.
 *
 * Each telegram carries process data, those that read a parameter too. A word is 0 until it is written, all bits of it;
 * the bits that are always written as a constant come with the first point of their word, so that reading, or writing a
 * setpoint alone, commands nothing.
 *
 * When a telegram that changes words fails, nobody knows which words the device has now, and neither the new nor the
 * old ones may be repeated: all words are 0 then until some are written again; write the setpoint again, too.
 */
export class UssDevice extends Session {
  /** @param {import("./receiving.js").Line} line
   * @param {import("./session.js").DeviceOptions & { link: import("./uss-frames.js").UssLink }} options */
  constructor(line, options) {
    super(line, options);
    if (line.framing !== undefined && line.framing !== "uss") {
      throw new RequestError("bad_framing", `the device speaks uss, and the line ${shown(line.framing)}`);
    }
    checkUnit(this.unit, this._profile.units);
    checkUssLink(this._profile, options.link, this.variants);
    this.link = options.link;
    /** A task that the device has not answered yet is sent again up to so many times. */
    this.repeats = 20;
    /** @type {SentWords} */
    this._sent = new Map();
  }

  /** Let all words of process data be 0 until they are written again, because others have commanded the device. */
  dropProcessData() {
    this._sent = new Map();
  }

  /**
   * Read a parameter by number, without any meaning: one word, or two with the high one first. With the name of a
   * telegram for the space it is a word of process data, counted from 0.
   * @param {string} space @param {number} address @param {{ index?: number }} [how] @returns {Promise<number[]>}
   */
  readAt(space, address, { index } = {}) {
    return this._run(async () => {
      const at = this._placeOf(space, address, 1, index);
      return this._about(placeLabel(at), () => this._get(at));
    });
  }

  /**
   * Write a parameter by number to RAM, or with the name of a telegram words of process data. Nothing is checked: this
   * can set what no point allows.
   * @param {string} space @param {number} address @param {number | readonly number[]} words
   * @param {{ index?: number }} [how] @returns {Promise<void>}
   */
  writeAt(space, address, words, { index } = {}) {
    return this._run(async () => {
      const values = typeof words === "number" ? [words] : words;
      const at = this._placeOf(space, address, values.length, index);
      for (const word of values) checkNumber("bad_value", "a word", word, [0, 0xffff]);
      await this._about(placeLabel(at), () => this._put(at, values));
    });
  }

  /**
   * Send process data to all units of the line, which nobody answers: `words`, or those written to this device.
   *
   * The mask says what counts: the first word which words (bit 1 the first one), the second which bits of the first
   * word. Afterwards the process data of this device falls back to 0: call `dropProcessData` on the objects of all
   * other units too, or their next telegram takes the broadcast back.
   * @param {readonly number[]} mask @param {readonly number[]} [words] @returns {Promise<void>}
   */
  broadcast(mask, words) {
    return this._run(async () => {
      const chosen = words ?? this._allWords(this._sent);
      const request = buildUssBroadcast(mask, chosen, this._profile, this.link);
      for (const [at, [fixed, bits]] of this._constants()) {
        if ((mask[0] >> (at + 1)) & 1 && (chosen[at] & fixed) !== bits) {
          throw new RequestError("bad_value", `word ${at + 1} is ${chosen[at]} and has not ${bits} in ${fixed}`);
        }
        if (at === 0 && bits & ~mask[1]) {
          throw new RequestError(
            "bad_value",
            `the mask leaves out ${bits & ~mask[1]} of the first word, which has to count`,
          );
        }
      }
      this._sent = new Map();
      await this._exchange(request, ussReplyShape(request, true), "").catch((error) => {
        if (error.status !== "timeout") throw error;
      });
    });
  }

  /** @param {string} space @param {number} address @param {number} count @param {number} [index] @returns {Place} */
  _placeOf(space, address, count, index) {
    checkNumber("bad_address", "address", address, [0, 0xffff]);
    checkNumber("bad_count", "the number of words", count, [1, 0x10000]);
    if (index !== undefined) checkInteger("bad_index", "index", index);
    if (!this._telegram(space)) return place(space, [address], { index });
    return place(
      "telegram",
      Array.from({ length: count }, (_, at) => address + at),
      { telegram: space },
    );
  }

  /** @param {string | undefined} name @returns {import("./uss-frames.js").Telegram | undefined} */
  _telegram(name) {
    const { telegrams } = /** @type {import("./uss-frames.js").UssProfile} */ (this._profile);
    return telegrams.find((one) => one.name === name);
  }

  /** Whether words of a telegram go to the device. @param {Place} at */
  _isSent(at) {
    return this._telegram(at.telegram)?.direction === "request";
  }

  /** Read a parameter (the high word first), or words of the process data that comes back.
   * @param {Place} at @returns {Promise<number[]>} */
  async _get(at) {
    if (at.telegram === undefined) {
      const request = { unit: this.unit, task: USS_READ, parameter: this._number(at), index: at.index ?? 0 };
      const reply = await this._task(request);
      return reply.width === 2 ? [Math.floor(reply.value / 0x10000), reply.value % 0x10000] : [reply.value];
    }
    if (this._isSent(at)) return this._chosen(this._allWords(this._sent), at);
    this._chosen(this._allWords(new Map()), at); // raises if the link does not carry them
    return this._chosen((await this._task({ unit: this.unit })).words, at);
  }

  /** Read several points; process data out of one telegram.
   * @param {readonly AnyPoint[]} points @param {string | undefined} group
   * @param {import("./session.js").Refusals} [refusals] @returns {Promise<import("./session.js").PointRaws>} */
  async _gather(points, group, refusals) {
    const heard = points.filter((point) => point.at.telegram !== undefined && !this._isSent(point.at));
    const rest = points.filter((point) => !heard.includes(point));
    /** @type {import("./session.js").PointRaws} */
    let raws = new Map();
    if (heard.length) {
      raws = await this._part(heard, refusals, async () => {
        const { words } = await this._task({ unit: this.unit });
        return new Map(heard.map((point) => [point, this._taken(point, this._chosen(words, point.at))]));
      });
    }
    return new Map([...raws, ...(await super._gather(rest, group, refusals))]);
  }

  /** @param {AnyPoint} point @returns {Promise<number>} */
  async _sharedWord(point) {
    if (point.at.telegram === undefined || !this._isSent(point.at)) return super._sharedWord(point);
    const address = lowestOf(point.at);
    return this._sent.get(address) ?? this._constants().get(address)?.[1] ?? 0;
  }

  /** Write a parameter by the task that the place names (RAM unless it does), or words of the process data.
   * @param {Place} at @param {readonly number[]} words */
  async _store(at, words) {
    if (at.telegram === undefined) return this._change(at, words);
    if (!this._isSent(at)) throw new RequestError("bad_space", `the words of ${at.telegram} come from the device`);
    if (words.length !== at.addresses.length) {
      throw new RequestError("bad_value", `${words.length} words do not fill ${at.addresses.length}`);
    }
    this._chosen(this._allWords(new Map()), at); // raises if the link does not carry them
    const sent = new Map(this._sent);
    ascending(at).forEach((address, each) => sent.set(address, words[each]));
    const request = { unit: this.unit, words: this._allWords(sent) };
    checkUssRequest(request, this._profile, this.link); // what raises here was not sent: the old words still hold
    this._sent = new Map(); // until the device has answered, whatever ends the wait
    await this._retried(0, () => this._telegramExchange(request));
    this._sent = sent;
  }

  /** Write a parameter; the answer confirms the change with the value that the device has now.
   * @param {Place} at @param {readonly number[]} words */
  async _change(at, words) {
    const task = at.function ?? ussChangeTask(words.length, at.index !== undefined, false);
    if (task === undefined) {
      throw new RequestError("bad_value", `a parameter has one word or two, not ${words.length}`);
    }
    const value = words.reduce((number, word) => number * 0x10000 + word, 0);
    const parameter = this._number(at);
    const width = words.length;
    const reply = await this._task({ unit: this.unit, task, parameter, index: at.index ?? 0, width, value });
    if (reply.value !== value) {
      const text = `${value} was written to ${parameter}, but the device answered ${reply.value}`;
      const high = Math.floor(reply.value / 0x10000);
      throw new EchoError(text, words, reply.width === 2 ? [high, reply.value % 0x10000] : [reply.value]);
    }
  }

  /** One task, again while it is lost: it changes no process data. @param {UssRequest} request */
  _task(request) {
    return this._retried(this.retries, () => this._telegramExchange({ ...request, words: this._allWords(this._sent) }));
  }

  /** One task with process data, and the reply; a task is repeated until the device answers it.
   * @param {UssRequest} request */
  async _telegramExchange(request) {
    const frame = buildUssRequest(request, this._profile, this.link);
    const isTask = (request.task ?? USS_NO_TASK) !== USS_NO_TASK;
    const about = isTask ? ` to task ${request.task} for ${request.parameter}` : "";
    for (let left = this.repeats; ; left--) {
      const reply = await this._exchange(frame, ussReplyShape(frame), `unit ${this.unit} did not reply${about}`);
      try {
        return parseUssReply(request, reply, this._profile, this.link);
      } catch (error) {
        if (!(error instanceof FrameError) || error.status !== "no_answer" || left <= 0) throw error;
      }
    }
  }

  /** @param {Place} at @returns {number} */
  _number(at) {
    if (at.space === "parameter") return lowestOf(at);
    const { telegrams } = /** @type {import("./uss-frames.js").UssProfile} */ (this._profile);
    const known = ["parameter", ...telegrams.map((one) => one.name)].join(", ");
    throw new RequestError("bad_space", `there is no space ${shown(at.space)}, only ${known}`);
  }

  /** Where a parameter is written, with the task that keeps its value if the caller says so.
   * @param {AnyPoint} point @param {boolean} keep @returns {Place | undefined} */
  _writePlace(point, keep) {
    if (!keep) return undefined;
    const { at, facts } = point;
    if (at.telegram !== undefined || (facts.keeps && facts.keeps !== "choice")) {
      throw new AccessError(`${labelOf(point)} has no choice of keeping its value`);
    }
    return { ...at, function: ussChangeTask(point.size, at.index !== undefined, true) };
  }

  /** Whether the link has room for the words of a point. @param {AnyPoint} point */
  _isCarried(point) {
    if (point.at.telegram !== undefined) return highestOf(point.at) < this.link.pzd;
    return sentPkw(this.link) >= (point.size > 1 ? 4 : 3);
  }

  /** All words of process data as they are sent. @param {SentWords} sent @returns {number[]} */
  _allWords(sent) {
    return Array.from({ length: this.link.pzd }, (_, at) => sent.get(at) ?? 0);
  }

  /** The words of a place out of the process data. @param {readonly number[]} words @param {Place} at
   * @returns {number[]} */
  _chosen(words, at) {
    if (lowestOf(at) < 0 || highestOf(at) >= words.length) {
      const text = `the link carries ${words.length} words of process data, and this is word ${highestOf(at) + 1}`;
      throw new RequestError("bad_link", text);
    }
    return ascending(at).map((address) => words[address]);
  }

  /** The bits that are always written as a constant, mask and bits, by the word of process data.
   * @returns {Map<number, [number, number]>} */
  _constants() {
    /** @type {Map<number, [number, number]>} */
    const found = new Map();
    for (const { at, facts } of this.table.points.values()) {
      if (!facts.fixed || at.telegram === undefined || !this._isSent(at)) continue;
      const [mask, bits] = found.get(lowestOf(at)) ?? [0, 0];
      found.set(lowestOf(at), [mask | facts.fixed[0], bits | facts.fixed[1]]);
    }
    return found;
  }
}
