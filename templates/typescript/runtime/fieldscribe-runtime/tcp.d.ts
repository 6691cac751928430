/**
 * Connects when it is used first, and anew after a failure. `framing: "rtu"` is for RTU frames over TCP, `"uss"` for
 * USS behind a serial server.
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
    /** An answer that comes too late comes to nobody. */
    _failed(): void;
}
import { StreamLine } from "./stream-line.js";
