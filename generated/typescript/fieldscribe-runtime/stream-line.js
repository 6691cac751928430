// SPDX-License-Identifier: 0BSD
/** What lines of bytes have in common: one exchange at a time, and no byte of an old reply in a new one. */
import { FieldscribeError, LineError, RequestError, shown } from "./errors.js";
import { ReplyReader } from "./receiving.js";

/** @typedef {import("./receiving.js").ReplyShape} ReplyShape */

/** A line of bytes. A reply has `timeout` seconds to begin. */
export class StreamLine {
  /** @param {string} framing @param {number} timeout */
  constructor(framing, timeout) {
    if (!(typeof timeout === "number" && timeout > 0)) {
      throw new RequestError("bad_timeout", `the timeout is a number of seconds, not ${shown(timeout)}`);
    }
    /** What the frames look like: `rtu`, `tcp`, `pdu` or `uss`. */
    this.framing = framing;
    /** Seconds that a reply has to begin. */
    this.timeout = timeout;
    /** @type {Promise<unknown>} */
    this._turn = Promise.resolve();
    /** Takes received bytes while a reply is awaited. @type {((data: Uint8Array) => void) | undefined} */
    this._onData = undefined;
    /** Takes the error that ends the line. @type {((error: Error) => void) | undefined} */
    this._onEnd = undefined;
  }

  /** Open the line if it is closed; rejects with the error of the system. @returns {Promise<void>} */
  async _open() {}

  /** Wait until a request may be sent. @param {Uint8Array} request @returns {Promise<void>} */
  async _rest(request) {
    void request;
  }

  /** @param {Uint8Array} request @returns {Promise<void>} */
  async _send(request) {
    void request;
  }

  /** Make sure that a reply which comes too late is not taken for the next one. @param {ReplyShape} reply */
  _failed(reply) {
    void reply;
  }

  /** Wait after a broadcast. @returns {Promise<void>} */
  async _afterBroadcast() {}

  /** So many seconds longer a reply of these many bytes may take once its first byte is there. @param {number} bytes */
  _frameSeconds(bytes) {
    return bytes * 0;
  }

  /** Close the line; the next exchange opens it again. */
  close() {}

  /**
   * Send a frame and return the whole reply, or no bytes after a broadcast. Rejects with NoReplyError, FrameError and
   * LineError.
   * @param {Uint8Array} request @param {ReplyShape} reply @returns {Promise<Uint8Array>}
   */
  exchange(request, reply) {
    const turn = this._turn.then(() => this._exchanged(request, reply));
    this._turn = turn.catch(() => undefined);
    return turn;
  }

  /** @param {Uint8Array} request @param {ReplyShape} reply @returns {Promise<Uint8Array>} */
  async _exchanged(request, reply) {
    let isSent = false;
    try {
      await this._open();
      await this._rest(request);
      await new Promise((resolve) => setImmediate(resolve)); // what has come already is dropped
      const received = reply.broadcast ? this._afterBroadcast() : this._received(reply);
      received.catch(() => undefined); // sending may fail first
      await this._send(request);
      isSent = true;
      return (await received) ?? new Uint8Array(0);
    } catch (error) {
      this._onEnd?.(/** @type {Error} */ (error)); // ends the wait for a reply
      if (error instanceof FieldscribeError) {
        this._failed(reply);
        throw error;
      }
      this.close();
      throw new LineError(`${this}: ${error instanceof Error ? error.message : error}`, !isSent);
    }
  }

  /** @param {ReplyShape} reply @returns {Promise<Uint8Array>} */
  _received(reply) {
    const reader = new ReplyReader(reply);
    return new Promise((resolve, reject) => {
      /** @type {ReturnType<typeof setTimeout>} */
      let timer;
      const done = (/** @type {() => void} */ end) => {
        clearTimeout(timer);
        this._onData = this._onEnd = undefined;
        end();
      };
      const giveUp = () =>
        done(() => {
          try {
            resolve(reader.giveUp());
            this._failed(reply);
          } catch (error) {
            reject(error);
          }
        });
      timer = setTimeout(giveUp, this.timeout * 1000);
      const longer = this._frameSeconds(reply.longest);
      let isFirst = longer > 0;
      this._onEnd = (error) => done(() => reject(error));
      this._onData = (data) => {
        if (isFirst) {
          isFirst = false;
          clearTimeout(timer);
          timer = setTimeout(giveUp, (this.timeout + longer) * 1000);
        }
        try {
          const frame = reader.take(data);
          if (frame) done(() => resolve(frame));
        } catch (error) {
          done(() => reject(error));
        }
      };
    });
  }
}

/** Rejects with NoReplyError or what the work rejects with. @template T @param {Promise<T>} work
 * @param {number} seconds @param {string} text @returns {Promise<T>} */
export function withinSeconds(work, seconds, text) {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => reject(new Error(text)), seconds * 1000);
    work.then(resolve, reject).finally(() => clearTimeout(timer));
  });
}
