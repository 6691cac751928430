/**
 * A serial line: opened when it is used first, and anew after a failure of the port.
 *
 * `mode` is data bits, parity (N, E, O) and stop bits; USS has 8E1 if it is not said. A reply has `timeout` seconds to
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
    /** Whose reply may still come, and until when. @type {{ reply: ReplyShape, until: number } | undefined} */
    _late: {
        reply: ReplyShape;
        until: number;
    } | undefined;
    /** Take what was sent off what comes. @param {Uint8Array} request
     * @param {((data: Uint8Array) => void) | undefined} onData @returns {Promise<void>} */
    _echoed(request: Uint8Array, onData: ((data: Uint8Array) => void) | undefined): Promise<void>;
}
export type ReplyShape = import("./receiving.js").ReplyShape;
import { StreamLine } from "./stream-line.js";
