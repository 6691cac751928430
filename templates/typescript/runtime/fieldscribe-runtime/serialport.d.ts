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
    constructor(path: string, options?: {
        baudRate?: number;
        mode?: string;
        framing?: "rtu" | "uss";
        timeout?: number;
        echo?: boolean;
        turnaround?: number;
    });
    path: string;
    baudRate: number;
    mode: string;
    echo: boolean;
    turnaround: number;
    /** @type {any} */
    _port: any;
    _restsUntil: number;
    /** The unit whose reply may still come, and until when. @type {{ reply: ReplyShape, until: number } | undefined} */
    _late: {
        reply: ReplyShape;
        until: number;
    } | undefined;
    /** Remove the echo of a request from received bytes. @param {Uint8Array} request
     * @param {((data: Uint8Array) => void) | undefined} onData @returns {Promise<void>} */
    _echoed(request: Uint8Array, onData: ((data: Uint8Array) => void) | undefined): Promise<void>;
}
export type ReplyShape = import("./receiving.js").ReplyShape;
import { StreamLine } from "./stream-line.js";
