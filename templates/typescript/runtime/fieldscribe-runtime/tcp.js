// SPDX-License-Identifier: 0BSD
/**
 * A Modbus device, or a gateway to several, in a network, by the sockets of Node.
 *
 * What came before a request is dropped, and after a failure the line connects anew: a reply that comes late or twice
 * is not taken for the next one.
 */
import { connect } from "node:net";
import { StreamLine, withinSeconds } from "./stream-line.js";

/**
 * Connects on first use, and again after a failure. `framing: "rtu"` is for RTU frames over TCP, `"uss"` for
 * USS over a serial server.
 */
export class TcpLine extends StreamLine {
  /** @param {string} host @param {{ port?: number, framing?: "tcp" | "rtu" | "uss", timeout?: number }} [options] */
  constructor(host, { port = 502, framing = "tcp", timeout = 1 } = {}) {
    super(framing, timeout);
    this.host = host;
    this.port = port;
    /** @type {any} */
    this._socket = undefined;
  }

  toString() {
    return `${this.host}:${this.port}`;
  }

  /** @returns {Promise<void>} */
  async _open() {
    if (this._socket) return;
    const socket = connect({ host: this.host, port: this.port, noDelay: true });
    this._socket = socket;
    const opened = new Promise((resolve, reject) => {
      socket.once("connect", resolve);
      socket.once("error", reject);
    });
    await withinSeconds(opened, this.timeout, `no connection within ${this.timeout} s`);
    const end = (/** @type {Error} */ error) => {
      if (this._socket === socket) this.close();
      this._onEnd?.(error);
    };
    socket.on("data", (data) => {
      if (this._socket === socket) this._onData?.(new Uint8Array(data));
    });
    socket.on("error", end);
    socket.on("end", () => end(new Error("the other side closed the connection")));
  }

  /** @param {Uint8Array} request @returns {Promise<void>} */
  async _send(request) {
    if (!this._socket) await this._open(); // the other side closed it meanwhile
    await new Promise((resolve, reject) => {
      this._socket.write(request, (/** @type {Error | undefined} */ error) =>
        error ? reject(error) : resolve(undefined),
      );
    });
  }

  /** Close the connection, so that a late answer is lost. */
  _failed() {
    this.close();
  }

  /** Close the connection; the next exchange opens it again. */
  close() {
    this._socket?.destroy();
    this._socket = undefined;
  }
}
