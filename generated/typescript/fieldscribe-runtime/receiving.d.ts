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
 * What a line must know of the reply to a request. Nobody answers a `broadcast`: a line resolves at once with no bytes.
 *
 * `size` tells the length of the frame that begins with these bytes, null while they are too few; `isOwn` whether a
 * whole frame belongs to the request: it has its unit, or transaction.
 * @typedef {object} ReplyShape
 * @property {string} framing
 * @property {boolean} broadcast
 * @property {number} shortest
 * @property {number} longest
 * @property {(received: Uint8Array) => number | null} size
 * @property {(frame: Uint8Array) => boolean} isOwn
 */
/**
 * Carries one request to the bus and one reply back; rejects with NoReplyError when none comes in time, and with
 * LineError where the line itself failed. Lines take one exchange after the other.
 * @typedef {object} Line
 * @property {string} [framing] what the frames look like: `rtu`, `tcp`, `pdu` or `uss`
 * @property {(request: Uint8Array, reply: ReplyShape) => Promise<Uint8Array>} exchange
 */
/** Collects the reply to one request out of bytes as they come. Whole frames of others are dropped. */
export class ReplyReader {
    /** @param {ReplyShape} shape */
    constructor(shape: ReplyShape);
    shape: ReplyShape;
    /** @type {Uint8Array} */
    received: Uint8Array;
    /** @type {Uint8Array | undefined} */
    foreign: Uint8Array | undefined;
    /**
     * Add bytes that came; returns the reply once it is whole. Raises FrameError (long_frame) when there are more bytes
     * than any frame has, and no frame among them.
     * @param {Uint8Array} data @returns {Uint8Array | undefined}
     */
    take(data: Uint8Array): Uint8Array | undefined;
    /** The last frame of another address, for the error that names it; raises NoReplyError without one. */
    giveUp(): Uint8Array<ArrayBufferLike>;
}
/**
 * What a line must know of the reply to a request. Nobody answers a `broadcast`: a line resolves at once with no bytes.
 *
 * `size` tells the length of the frame that begins with these bytes, null while they are too few; `isOwn` whether a
 * whole frame belongs to the request: it has its unit, or transaction.
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
 * Carries one request to the bus and one reply back; rejects with NoReplyError when none comes in time, and with
 * LineError where the line itself failed. Lines take one exchange after the other.
 */
export type Line = {
    /**
     * what the frames look like: `rtu`, `tcp`, `pdu` or `uss`
     */
    framing?: string | undefined;
    exchange: (request: Uint8Array, reply: ReplyShape) => Promise<Uint8Array>;
};
