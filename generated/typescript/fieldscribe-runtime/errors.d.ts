/** A value as text for messages. @param {unknown} value @returns {string} */
export function shown(value: unknown): string;
/** Everything that can go wrong, as errors: one base class, and `status` names the case. */
/**
 * Base of all errors of generated devices; `status` is a stable name for programs.
 *
 * `point` says which point was asked for; of several that one request reads, which they are; else the command or the
 * place. `group` is the group that was read, `needs` another point that had to be read first. `existsWhen` says when a
 * refused point exists, where other points decide that.
 */
export class FieldscribeError extends Error {
    /** @param {string} message @param {string} [status] */
    constructor(message: string, status?: string);
    text: string;
    status: string;
    /** @type {string | undefined} */
    point: string | undefined;
    /** @type {string | undefined} */
    group: string | undefined;
    /** @type {string | undefined} */
    needs: string | undefined;
    /** @type {string | undefined} */
    existsWhen: string | undefined;
    /** @type {unknown} */
    value: unknown;
    /** @type {readonly unknown[] | undefined} */
    limits: readonly unknown[] | undefined;
    /** Whether the line lost a frame or spoiled it, so that trying again may help: no refusal, and no mistake. */
    get lost(): boolean;
    /**
     * Say what the error is about; what is known already stays. Returns the error.
     * @param {{ point?: string, group?: string, needs?: string, existsWhen?: string, value?: unknown, limits?: readonly unknown[] }} about
     */
    about(about: {
        point?: string;
        group?: string;
        needs?: string;
        existsWhen?: string;
        value?: unknown;
        limits?: readonly unknown[];
    }): this;
    /**
     * Say that the error came while another point was read which that one needs. Returns the error.
     * @param {string} point
     */
    needing(point: string): this;
    /** The same error, to be raised once more. @returns {FieldscribeError} */
    copied(): FieldscribeError;
    /** @private */
    private reworded;
}
/** A value or raw number cannot be converted. */
export class CodecError extends FieldscribeError {
}
/** The number may not be written. */
export class OutOfRangeError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** The value is NaN. */
export class NotANumberError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** The value is of a type that the point does not take. */
export class WrongTypeError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** The number is none of the named ones, and only those may be written. */
export class UnknownValueError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** Another point that the scale or a limit needs is zero. */
export class ZeroFactorError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** No scale fits the numbers of the points that choose it. */
export class NoCaseError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** The result is too large to be represented. */
export class ResultOverflowError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** A special code stands where a quantity belongs, or is to be written and only read; `special` is its name. */
export class SpecialCodeError extends CodecError {
    /** @param {string} special @param {string} message */
    constructor(special: string, message: string);
    special: string;
}
/** The words do not hold what they should: a text that is no UTF-8 or UTF-16. */
export class MalformedError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** Too few or too many words for this point. */
export class WrongLengthError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** The conversion needs the raw number of another point, and `raws` does not hold it. */
export class MissingRawError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** The device has the point or the group, but not this: it is only written, belongs to another device, ... */
export class AccessError extends FieldscribeError {
    /** @param {string} message */
    constructor(message: string);
}
/** The device has no such point: the name is unknown, the point is documented only, or another variant has it. */
export class AbsentError extends AccessError {
}
/** What answers is another device: a point holds something else than the description says. */
export class OtherDeviceError extends FieldscribeError {
    /** @param {string} message */
    constructor(message: string);
}
/** The device did not come to what a step of a command waits for; `held` are the words that it had last. */
export class WaitError extends FieldscribeError {
    /** @param {string} message @param {readonly number[]} held */
    constructor(message: string, held: readonly number[]);
    held: readonly number[];
}
/** A block of addresses cannot be found: `no_marker`, `bad_chain`, `no_block` or `behind_end`. */
export class BlockError extends FieldscribeError {
    /** @param {string} status @param {string} message */
    constructor(status: string, message: string);
}
/** The request cannot be sent to this device; `status` says why (bad_unit, bad_count, ...). */
export class RequestError extends FieldscribeError {
    /** @param {string} status @param {string} message */
    constructor(status: string, message: string);
}
/** The reply is no good answer to the request; `status` says why (bad_crc, short_frame, echo_mismatch, ...). */
export class FrameError extends FieldscribeError {
    /** @param {string} status @param {string} message */
    constructor(status: string, message: string);
    /** Process data that came in the same telegram, where the rest of it was good. @type {readonly number[]} */
    words: readonly number[];
}
/** The device took a write and confirmed another value than the one `written`: `answered` is what it has now. */
export class EchoError extends FrameError {
    /** @param {string} message @param {readonly number[]} written @param {readonly number[]} answered */
    constructor(message: string, written: readonly number[], answered: readonly number[]);
    written: readonly number[];
    answered: readonly number[];
}
/**
 * The device refused the request with an exception `code`; `codeName` is the manual's name for it, where known. Where
 * the manual has none, the message has that of the standard.
 */
export class ExceptionReplyError extends FrameError {
    /** @param {number} code @param {string} [codeName] */
    constructor(code: number, codeName?: string);
    code: number;
    codeName: string | undefined;
}
/** The device refused the task with an error number `code`; `codeName` is the manual's name for it, where known. */
export class RefusedError extends FrameError {
    /** @param {number} code @param {string} [codeName] */
    constructor(code: number, codeName?: string);
    code: number;
    codeName: string | undefined;
}
/** Words of a telegram cannot be told; `status` is `missing` (not all came yet) or `torn` (they do not agree). */
export class TelegramError extends FieldscribeError {
    /** @param {string} status @param {string} message */
    constructor(status: string, message: string);
}
/** Nothing came that answers, in time; `received` is what came in its place. */
export class NoReplyError extends FieldscribeError {
    /** @param {string} message @param {Uint8Array} [received] */
    constructor(message: string, received?: Uint8Array);
    received: Uint8Array<ArrayBufferLike> | undefined;
}
/** The line itself failed: it cannot be opened, or the other side is gone. `unsent`: the request was not sent. */
export class LineError extends FieldscribeError {
    /** @param {string} message @param {boolean} [unsent] */
    constructor(message: string, unsent?: boolean);
    unsent: boolean;
}
