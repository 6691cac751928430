// SPDX-License-Identifier: 0BSD
/** Replies from bytes as they come, without any I/O, and what requests of all families are checked for. */
import { FrameError, NoReplyError, RequestError, shown } from "./errors.js";

/**
 * What a line must know of the reply to a request. After a `broadcast`, a line resolves at once with no bytes.
 *
 * `size` returns the length of the frame that starts with these bytes, null while they are too few; `isOwn` whether a
 * frame belongs to the request: it has its unit, or transaction.
 * @typedef {object} ReplyShape
 * @property {string} framing
 * @property {boolean} broadcast
 * @property {number} shortest
 * @property {number} longest
 * @property {(received: Uint8Array) => number | null} size
 * @property {(frame: Uint8Array) => boolean} isOwn
 */

/**
 * Sends one request and receives one reply; rejects with NoReplyError if none comes in time, and with
 * LineError if the line itself failed. Lines do one exchange at a time.
 * @typedef {object} Line
 * @property {string} [framing] what the frames look like: `rtu`, `tcp`, `pdu` or `uss`
 * @property {(request: Uint8Array, reply: ReplyShape) => Promise<Uint8Array>} exchange
 */

/** Collects the reply to one request from received bytes. Frames of other units are dropped. */
export class ReplyReader {
  /** @param {ReplyShape} shape */
  constructor(shape) {
    this.shape = shape;
    /** @type {Uint8Array} */
    this.received = new Uint8Array(0);
    /** @type {Uint8Array | undefined} */
    this.foreign = undefined;
  }

  /**
   * Add received bytes; returns the reply once it is complete. Raises FrameError (long_frame) if there are more bytes
   * than any frame has, but no frame.
   * @param {Uint8Array} data @returns {Uint8Array | undefined}
   */
  take(data) {
    const { size, longest, isOwn } = this.shape;
    this.received = joinedBytes(this.received, data);
    for (;;) {
      const length = this.received.length;
      const expected = size(this.received);
      if (expected !== null && expected > longest) {
        const text = `the reply would have ${expected} bytes, and a frame has at most ${longest}`;
        throw new FrameError("long_frame", `${quotedBytes(this.received)}: ${text}`);
      }
      if (expected === null || length < expected) {
        if (length < longest) return undefined;
        throw new FrameError(
          "long_frame",
          `${quotedBytes(this.received)}, more than any frame has${hintOf(this.shape)}`,
        );
      }
      const frame = this.received.subarray(0, expected);
      if (isOwn(frame)) return frame;
      this.foreign = frame;
      this.received = this.received.subarray(expected);
    }
  }

  /** The last frame with another address, for the error message; raises NoReplyError if there is none. */
  giveUp() {
    if (this.foreign && !(this.received.length && this.shape.isOwn(this.received))) return this.foreign;
    if (!this.received.length) throw new NoReplyError("no byte came");
    throw new NoReplyError(`${quotedBytes(this.received)}, which are no reply${hintOf(this.shape)}`, this.received);
  }
}

/** What may help where bytes are no reply. @param {ReplyShape} shape @returns {string} */
function hintOf(shape) {
  return shape.framing === "tcp" ? "" : "; is the baud rate right?";
}

/** @param {Uint8Array} received @returns {string} */
function quotedBytes(received) {
  const first = [...received.subarray(0, 16)].map(hex2).join(" ");
  return `${received.length} bytes came (${first}${received.length > 16 ? " ..." : ""})`;
}

/** @param {Uint8Array} first @param {Uint8Array} second @returns {Uint8Array} */
export function joinedBytes(first, second) {
  if (!first.length) return second;
  const joined = new Uint8Array(first.length + second.length);
  joined.set(first);
  joined.set(second, first.length);
  return joined;
}

/** A byte as two hexadecimal digits. @param {number} byte @returns {string} */
export function hex2(byte) {
  return byte.toString(16).toUpperCase().padStart(2, "0");
}

/** The words of bytes, the high byte first. @param {Uint8Array} data @returns {number[]} */
export function wordsOfBytes(data) {
  return Array.from({ length: data.length >> 1 }, (_, at) => (data[2 * at] << 8) | data[2 * at + 1]);
}

/** Raises FrameError (wrong_type) for what is no reply at all. @param {unknown} reply */
export function checkBytes(reply) {
  if (!(reply instanceof Uint8Array))
    throw new FrameError("wrong_type", `a reply is a Uint8Array, not ${shown(reply)}`);
}

/** Raises RequestError for what is no integer. @param {string} status @param {string} what @param {unknown} number */
export function checkInteger(status, what, number) {
  if (!Number.isSafeInteger(number)) throw new RequestError(status, `${what} is an integer, not ${shown(number)}`);
}

/** The same, also for one that lies outside of the ends.
 * @param {string} status @param {string} what @param {number} number @param {readonly [number, number]} ends */
export function checkNumber(status, what, number, [low, high]) {
  checkInteger(status, what, number);
  if (number < low || number > high) throw new RequestError(status, `${what} ${number} is outside ${low}..${high}`);
}
