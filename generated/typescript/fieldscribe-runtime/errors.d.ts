/** A value as text for messages. @param {unknown} value @returns {string} */
export function shown(value: unknown): string;
/** The errors of generated devices: one base class; `status` names the case. */
/**
 * Base of all errors of generated devices; `status` is a stable name for programs.
 *
 * `point` names the point, the points of one request, the command, or the
 * place. `group` is the group that was read, `needs` another point that had to be read first. `existsWhen` says when a
 * refused point exists, if other points decide it.
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
    /** True if a frame was lost or damaged on the line, so that trying again may help. */
    get lost(): boolean;
    /**
     * Add the subject of the error, unless it has one. Returns the error.
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
     * Add that the error came from reading another point that the requested one needs. Returns the error.
     * @param {string} point
     */
    needing(point: string): this;
    /** A copy of the error, to be raised again. @returns {FieldscribeError} */
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
/** The point does not take a value of this type. */
export class WrongTypeError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** The number has no name, and only named ones may be written. */
export class UnknownValueError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** Another point that the scale or a limit needs is zero. */
export class ZeroFactorError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** The scale has no case for the numbers of the points that choose it. */
export class NoCaseError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** The result is too large. */
export class ResultOverflowError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** A special code instead of a quantity, or a write of a read-only one; `special` is its name. */
export class SpecialCodeError extends CodecError {
    /** @param {string} special @param {string} message */
    constructor(special: string, message: string);
    special: string;
}
/** The words are no valid text (UTF-8 or UTF-16), or no date. */
export class MalformedError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** Too few or too many words for this point. */
export class WrongLengthError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** The conversion needs the raw number of another point, but `raws` does not hold it. */
export class MissingRawError extends CodecError {
    /** @param {string} message */
    constructor(message: string);
}
/** The device has the point or the group but not this access: it is write-only, of another device, ... */
export class AccessError extends FieldscribeError {
    /** @param {string} message */
    constructor(message: string);
}
/** The device has no such point: the name is unknown, the point is only documented, or another variant has it. */
export class AbsentError extends AccessError {
}
/** Another device answers: a point holds something else than the description says. */
export class OtherDeviceError extends FieldscribeError {
    /** @param {string} message */
    constructor(message: string);
}
/** The device did not reach what a step of a command waits for; `held` are the last words read. */
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
/** The reply is not a valid answer to the request; `status` says why (bad_crc, short_frame, echo_mismatch, ...). */
export class FrameError extends FieldscribeError {
    /** @param {string} status @param {string} message */
    constructor(status: string, message: string);
    /** Process data of the same telegram, if that part was valid. @type {readonly number[]} */
    words: readonly number[];
}
/** The device confirmed a write with another value than the one `written`: `answered` is what it has now. */
export class EchoError extends FrameError {
    /** @param {string} message @param {readonly number[]} written @param {readonly number[]} answered */
    constructor(message: string, written: readonly number[], answered: readonly number[]);
    written: readonly number[];
    answered: readonly number[];
}
/**
 * The device refused the request with an exception `code`; `codeName` is the manual's name for it, if known. If not,
 * the message has the standard's name.
 */
export class ExceptionReplyError extends FrameError {
    /** @param {number} code @param {string} [codeName] */
    constructor(code: number, codeName?: string);
    code: number;
    codeName: string | undefined;
}
/** The device refused the task with an error number `code`; `codeName` is the manual's name for it, if known. */
export class RefusedError extends FrameError {
    /** @param {number} code @param {string} [codeName] */
    constructor(code: number, codeName?: string);
    code: number;
    codeName: string | undefined;
}
/** Words of a telegram are not available: `status` is `missing` (not all arrived yet) or `torn` (inconsistent). */
export class TelegramError extends FieldscribeError {
    /** @param {string} status @param {string} message */
    constructor(status: string, message: string);
}
/** No answer arrived in time; `received` is what arrived instead. */
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
