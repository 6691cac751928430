/** Rejects with NoReplyError or what the work rejects with. @template T @param {Promise<T>} work
 * @param {number} seconds @param {string} text @returns {Promise<T>} */
export function withinSeconds<T>(work: Promise<T>, seconds: number, text: string): Promise<T>;
/** @typedef {import("./receiving.js").ReplyShape} ReplyShape */
/** A line of bytes. A reply has `timeout` seconds to begin. */
export class StreamLine {
    /** @param {string} framing @param {number} timeout */
    constructor(framing: string, timeout: number);
    /** What the frames look like: `rtu`, `tcp`, `pdu` or `uss`. */
    framing: string;
    /** Seconds that a reply has to begin. */
    timeout: number;
    /** @type {Promise<unknown>} */
    _turn: Promise<unknown>;
    /** Takes received bytes while a reply is awaited. @type {((data: Uint8Array) => void) | undefined} */
    _onData: ((data: Uint8Array) => void) | undefined;
    /** Takes the error that ends the line. @type {((error: Error) => void) | undefined} */
    _onEnd: ((error: Error) => void) | undefined;
    /** Open the line if it is closed; rejects with the error of the system. @returns {Promise<void>} */
    _open(): Promise<void>;
    /** Wait until a request may be sent. @param {Uint8Array} request @returns {Promise<void>} */
    _rest(request: Uint8Array): Promise<void>;
    /** @param {Uint8Array} request @returns {Promise<void>} */
    _send(request: Uint8Array): Promise<void>;
    /** Make sure that a reply which comes too late is not taken for the next one. @param {ReplyShape} reply */
    _failed(reply: ReplyShape): void;
    /** Wait after a broadcast. @returns {Promise<void>} */
    _afterBroadcast(): Promise<void>;
    /** So many seconds longer a reply of these many bytes may take once its first byte is there. @param {number} bytes */
    _frameSeconds(bytes: number): number;
    /** Close the line; the next exchange opens it again. */
    close(): void;
    /**
     * Send a frame and return the whole reply, or no bytes after a broadcast. Rejects with NoReplyError, FrameError and
     * LineError.
     * @param {Uint8Array} request @param {ReplyShape} reply @returns {Promise<Uint8Array>}
     */
    exchange(request: Uint8Array, reply: ReplyShape): Promise<Uint8Array>;
    /** @param {Uint8Array} request @param {ReplyShape} reply @returns {Promise<Uint8Array>} */
    _exchanged(request: Uint8Array, reply: ReplyShape): Promise<Uint8Array>;
    /** @param {ReplyShape} reply @returns {Promise<Uint8Array>} */
    _received(reply: ReplyShape): Promise<Uint8Array>;
}
export type ReplyShape = import("./receiving.js").ReplyShape;
