/**
 * The frame of a message with signals that have these values, by attribute; bits of signals without a value are 0.
 * Raises as encoding does, and RequestError for a point that is not in the message, or a message without signals.
 * @param {typeof Session} device @param {string} message @param {Readonly<Record<string, unknown>>} values
 * @param {{ unit?: number, raws?: Readonly<Record<string, number>> }} [how] @returns {CanFrame}
 */
export function packMessage(device: typeof Session, message: string, values: Readonly<Record<string, unknown>>, { unit, raws }?: {
    unit?: number;
    raws?: Readonly<Record<string, number>>;
}): CanFrame;
/** The last two frames of one multiplexer number; for signals, the words that come together.
 * @typedef {{ words: number[], number: number, wordsBefore: number[], numberBefore: number, moment: number }} Slot */
/** Takes the frames of a telegram from one unit, and returns its words once they have arrived. */
export class TelegramReceiver {
    /** @param {CanProfile} profile @param {string} telegram @param {number} unit */
    constructor(profile: CanProfile, telegram: string, unit: number);
    telegram: string;
    unit: number;
    message: import("./can-frames.js").CanMessage;
    packing: SignalPacking | undefined;
    places: (readonly [number, number])[];
    multiplexer: number;
    /** The part of each word of the telegram, and its place in the part. @type {[number, number][]} */
    partOf: [number, number][];
    /** @type {Slot[]} */
    slots: Slot[];
    count: number;
    /** Take a frame at the time `moment` (in seconds) if it belongs to the telegram; returns whether it does.
     * @param {CanFrame} frame @param {number} [moment] @returns {boolean} */
    take(frame: CanFrame, moment?: number): boolean;
    /** @private @param {Uint8Array} data @returns {Map<number, number[]>} */
    private taken;
    /** Whether all frames with these words arrived at `moment` or later. @param {readonly number[]} positions
     * @param {number} moment */
    isNewer(positions: readonly number[], moment: number): boolean;
    /** Whether any frame of the telegram arrived at `moment` or later. @param {number} moment */
    isSent(moment: number): boolean;
    /**
     * The words at these positions, the high one first; raises TelegramError, `missing` or `torn`.
     *
     * Two words of two frames are accepted only if the same high word arrived before and after the low one: a counter may
     * have changed in between. More words, such as texts, are returned as they arrived last.
     * @param {readonly number[]} positions @returns {number[]}
     */
    words(positions: readonly number[]): number[];
    /** @private @param {number} position @returns {Slot} */
    private slot;
    /** The words at these positions in ascending order of position. @param {Place} at @returns {number[]} */
    ascending(at: Place): number[];
}
/**
 * A device on a CAN bus.
 *
 * While other frames keep arriving, an answer may take `patience` seconds. Words of a telegram that arrived up to
 * `freshFor` seconds ago are read without waiting for new ones.
 */
export class CanDevice extends Session {
    /** @param {CanLine} line @param {import("./session.js").DeviceOptions} options */
    constructor(line: CanLine, options: import("./session.js").DeviceOptions);
    patience: number;
    freshFor: number;
    _receivers: Map<string, TelegramReceiver>;
    /** @type {number | undefined} */
    _since: number | undefined;
    _isWaitOver: boolean;
    _isUnanswered: boolean;
    /** Take a frame received elsewhere; returns whether it is of a telegram of this device. @param {CanFrame} frame */
    take(frame: CanFrame): boolean;
    /** Read parameters by address, or words of the telegram that `space` names, as plain numbers.
     * @param {string} space @param {number} address @param {number} [count] @returns {Promise<number[]>} */
    readAt(space: string, address: number, count?: number): Promise<number[]>;
    /** Write parameters by address. Nothing is checked: this can set what no point allows.
     * @param {string} space @param {number} address @param {...number} values @returns {Promise<void>} */
    writeAt(space: string, address: number, ...values: number[]): Promise<void>;
    /** @param {string} space @param {number} address @param {number} count @returns {Place} */
    _placeOf(space: string, address: number, count: number): Place;
    /** The message that answers a request, if any. @param {CanMessage} request @returns {CanMessage | undefined} */
    _answer(request: CanMessage): CanMessage | undefined;
    /** One request, and the raw number of its answer; the receivers take all other frames.
     * @param {CanMessage} request @param {number} address @param {number} raw @returns {Promise<number>} */
    _ask(request: CanMessage, address: number, raw: number): Promise<number>;
    /** Wait for a late answer, so that it is not taken for the next one. */
    _settle(): Promise<void>;
    /** @param {CanFrame | null} frame @param {(frame: CanFrame) => boolean} accepts @param {() => string} awaited */
    _wait(frame: CanFrame | null, accepts: (frame: CanFrame) => boolean, awaited: () => string): Promise<void>;
    /** Words of a telegram, as soon as all have arrived, are fresh, and belong together.
     * @param {Place} at @returns {Promise<number[]>} */
    _listen(at: Place): Promise<number[]>;
    /** Read some points; if refusals are collected, also words that are missing in a telegram that is sent.
     * @param {readonly AnyPoint[]} points @param {import("./session.js").Refusals | undefined} refusals
     * @param {() => Promise<import("./session.js").PointRaws>} ask
     * @returns {Promise<import("./session.js").PointRaws>} */
    _part(points: readonly AnyPoint[], refusals: import("./session.js").Refusals | undefined, ask: () => Promise<import("./session.js").PointRaws>): Promise<import("./session.js").PointRaws>;
}
export type Place = import("./places.js").Place;
export type AnyPoint = import("./table.js").AnyPoint;
export type CanFrame = import("./can-frames.js").CanFrame;
export type CanMessage = import("./can-frames.js").CanMessage;
export type CanProfile = import("./can-frames.js").CanProfile;
/**
 * What a line must know of the frames that a device waits for. The line passes every received frame to `accepts`, and
 * resolves with the first one accepted; if none is within `patience` seconds, it rejects with NoReplyError.
 * Nobody answers a `broadcast`: the line resolves at once.
 */
export type CanReplyShape = {
    framing: string;
    broadcast: boolean;
    patience: number;
    accepts: (frame: CanFrame) => boolean;
};
/**
 * Carries frames to the bus and from it: sends the request, if there is one, and waits for `reply`.
 */
export type CanLine = {
    exchange: (request: CanFrame | null, reply: CanReplyShape) => Promise<CanFrame | undefined>;
};
/**
 * The last two frames of one multiplexer number; for signals, the words that come together.
 */
export type Slot = {
    words: number[];
    number: number;
    wordsBefore: number[];
    numberBefore: number;
    moment: number;
};
import { Session } from "./session.js";
import { SignalPacking } from "./can-frames.js";
