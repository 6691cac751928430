/**
 * Connects on first use, and again after a failure. `framing: "rtu"` is for RTU frames over TCP, `"uss"` for
 * USS over a serial server.
 */
export class TcpLine extends StreamLine {
    /** @param {string} host @param {{ port?: number, framing?: "tcp" | "rtu" | "uss", timeout?: number }} [options] */
    constructor(host: string, { port, framing, timeout }?: {
        port?: number;
        framing?: "tcp" | "rtu" | "uss";
        timeout?: number;
    });
    host: string;
    port: number;
    /** @type {any} */
    _socket: any;
    /** Close the connection, so that a late answer is lost. */
    _failed(): void;
}
import { StreamLine } from "./stream-line.js";
