// SPDX-License-Identifier: 0BSD
/**
 * A serial line for Modbus RTU and USS, by the package `serialport`, which is installed beside this one.
 *
 * What came before a request is dropped, and so are frames of other units. A reply that comes late is not taken for the
 * next one: after a failure the same unit is asked again only when `timeout` has passed once more, others at once.
 */
import { SerialPort } from "serialport";
import { paused } from "./commands.js";
import { NoReplyError, RequestError, shown } from "./errors.js";
import { StreamLine } from "./stream-line.js";

/** @typedef {import("./receiving.js").ReplyShape} ReplyShape */

/** The bits of a character with start, parity and stop bit. */
const CHARACTER_BITS = 11;
/** @type {Readonly<Record<string, "none" | "even" | "odd">>} */
const PARITIES = { N: "none", E: "even", O: "odd" };

/**
 * A serial line: opened on first use, and again after a failure of the port.
 *
 * `mode` is data bits, parity (N, E, O) and stop bits; the default of USS is 8E1. A reply has `timeout` seconds to
 * begin, and then the time that the longest frame takes. With `echo` what is sent comes back first, as on many RS-485
 * adapters with two wires. For `turnaround` seconds the line rests after a broadcast, so that the units can work.
 */
export class SerialLine extends StreamLine {
  /**
   * @param {string} path @param {{ baudRate?: number, mode?: string, framing?: "rtu" | "uss", timeout?: number,
   *   echo?: boolean, turnaround?: number }} [options]
   */
  constructor(path, options = {}) {
    const { baudRate = 9600, framing = "rtu", timeout = 0.5, echo = false, turnaround = 0.1 } = options;
    super(framing, timeout);
    const mode = options.mode ?? (framing === "uss" ? "8E1" : "8N1");
    if (!/^[78][NEO][12]$/.test(mode)) {
      throw new RequestError("bad_mode", `a mode is data bits, parity and stop bits, as in 8E1, not ${shown(mode)}`);
    }
    this.path = path;
    this.baudRate = baudRate;
    this.mode = mode;
    this.echo = echo;
    this.turnaround = turnaround;
    /** @type {any} */
    this._port = undefined;
    this._restsUntil = 0;
    /** The unit whose reply may still come, and until when. @type {{ reply: ReplyShape, until: number } | undefined} */
    this._late = undefined;
  }

  toString() {
    return `${this.path} at ${this.baudRate} baud, ${this.mode}`;
  }

  /** @returns {Promise<void>} */
  async _open() {
    if (this._port) return;
    const port = new SerialPort({
      path: this.path,
      baudRate: this.baudRate,
      dataBits: this.mode[0] === "7" ? 7 : 8,
      parity: PARITIES[this.mode[1]],
      stopBits: this.mode[2] === "2" ? 2 : 1,
      autoOpen: false,
    });
    await new Promise((resolve, reject) => port.open((error) => (error ? reject(error) : resolve(undefined))));
    this._port = port;
    const end = (/** @type {Error | null | undefined} */ error) => {
      if (this._port === port) this._port = undefined;
      this._onEnd?.(error ?? new Error("the port was closed"));
    };
    port.on("data", (/** @type {Uint8Array} */ data) => this._onData?.(new Uint8Array(data)));
    port.on("error", end);
    port.on("close", end);
  }

  /** Wait until the line is silent, and no late reply of this unit can come. @param {Uint8Array} request */
  async _rest(request) {
    const silence = Math.max((3.5 * CHARACTER_BITS) / this.baudRate, 0.00175);
    let free = Math.max(this._restsUntil, clock() + silence);
    if (this._late?.reply.isOwn(request)) {
      free = Math.max(free, this._late.until);
      this._late = undefined;
    }
    await paused(free - clock());
  }

  /** @param {Uint8Array} request @returns {Promise<void>} */
  async _send(request) {
    const onData = this._onData;
    const echoed = this.echo ? this._echoed(request, onData) : undefined;
    await new Promise((resolve, reject) => {
      this._port.write(request, (/** @type {Error | undefined} */ error) =>
        error ? reject(error) : resolve(undefined),
      );
    });
    await new Promise((resolve) => this._port.drain(resolve));
    await echoed;
  }

  /** Remove the echo of a request from received bytes. @param {Uint8Array} request
   * @param {((data: Uint8Array) => void) | undefined} onData @returns {Promise<void>} */
  _echoed(request, onData) {
    return new Promise((resolve, reject) => {
      const wrong = () => reject(new NoReplyError("what was sent was not heard: another speaks, or there is no echo"));
      const timer = setTimeout(wrong, this.timeout * 1000);
      let heard = 0;
      this._onData = (/** @type {Uint8Array} */ data) => {
        const own = data.subarray(0, request.length - heard);
        if (own.some((byte, at) => byte !== request[heard + at])) return wrong();
        heard += own.length;
        if (heard < request.length) return undefined;
        clearTimeout(timer);
        this._onData = onData;
        resolve();
        return own.length < data.length ? onData?.(data.subarray(own.length)) : undefined;
      };
    });
  }

  /** @returns {Promise<void>} */
  async _afterBroadcast() {
    this._restsUntil = clock() + this.turnaround;
  }

  /** @param {number} bytes */
  _frameSeconds(bytes) {
    return (bytes * CHARACTER_BITS) / this.baudRate;
  }

  /** @param {ReplyShape} reply */
  _failed(reply) {
    if (!reply.broadcast) this._late = { reply, until: clock() + this.timeout };
  }

  /** Close the port; the next exchange opens it again. */
  close() {
    const port = this._port;
    this._port = undefined;
    if (port?.isOpen) port.close(() => undefined);
  }
}

/** @returns {number} seconds of a clock that only goes forward */
function clock() {
  return performance.now() / 1000;
}
