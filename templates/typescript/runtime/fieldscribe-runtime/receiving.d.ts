/** @param {Uint8Array} first @param {Uint8Array} second @returns {Uint8Array} */
export function joinedBytes(first: Uint8Array, second: Uint8Array): Uint8Array;
/** A byte as two hexadecimal digits. @param {number} byte @returns {string} */
export function hex2(byte: number): string;
/** The words of bytes, the high byte first. @param {Uint8Array} data @returns {number[]} */
export function wordsOfBytes(data: Uint8Array): number[];
/** Raises FrameError (wrong_type) for what is no reply at all. @param {unknown} reply */
export function checkBytes(reply: unknown): void;
/** Raises RequestError for what is no integer. @param {string} status @param {string} what @param {unknown} number */
export function checkInteger(status: string, what: string, number: unknown): void;
/** The same, also for one that lies outside of the ends.
 * @param {string} status @param {string} what @param {number} number @param {readonly [number, number]} ends */
export function checkNumber(status: string, what: string, number: number, [low, high]: readonly [number, number]): void;
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
    constructor(shape: ReplyShape);
    shape: ReplyShape;
    /** @type {Uint8Array} */
    received: Uint8Array;
    /** @type {Uint8Array | undefined} */
    foreign: Uint8Array | undefined;
    /**
     * Add received bytes; returns the reply once it is complete. Raises FrameError (long_frame) if there are more bytes
     * than any frame has, but no frame.
     * @param {Uint8Array} data @returns {Uint8Array | undefined}
     */
    take(data: Uint8Array): Uint8Array | undefined;
    /** The last frame with another address, for the error message; raises NoReplyError if there is none. */
    giveUp(): Uint8Array<ArrayBufferLike>;
}
/**
 * What a line must know of the reply to a request. After a `broadcast`, a line resolves at once with no bytes.
 *
 * `size` returns the length of the frame that starts with these bytes, null while they are too few; `isOwn` whether a
 * frame belongs to the request: it has its unit, or transaction.
 */
export type ReplyShape = {
    framing: string;
    broadcast: boolean;
    shortest: number;
    longest: number;
    size: (received: Uint8Array) => number | null;
    isOwn: (frame: Uint8Array) => boolean;
};
/**
 * Sends one request and receives one reply; rejects with NoReplyError if none comes in time, and with
 * LineError if the line itself failed. Lines do one exchange at a time.
 */
export type Line = {
    /**
     * what the frames look like: `rtu`, `tcp`, `pdu` or `uss`
     */
    framing?: string | undefined;
    exchange: (request: Uint8Array, reply: ReplyShape) => Promise<Uint8Array>;
};
