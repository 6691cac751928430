/** A data frame on the bus. @typedef {{ id: number, data: Uint8Array, extended?: boolean }} CanFrame */
/**
 * The content of one byte of a message: `constant` (number: the byte itself), `unit`, `address`, `raw` (number: the
 * position of its lowest bit), `multiplexer`, `word` (number: 2 * word of the frame, plus 1 for its low byte), `xor`
 * (number: a mask of the bytes of the message that are combined).
 * @typedef {{ kind: string, number: number }} CanRole
 */
/**
 * The place of a signal: `start` is its first bit as CAN databases count (bit 7 of byte 1 is 15): the bit of the lowest
 * value if the low byte comes first, else that of the highest. `when` has places of other signals with the raw numbers
 * that select this one: all must fit.
 * @typedef {{ start: number, width: number, lowFirst: boolean, when: readonly (readonly [number,
 *   readonly number[]])[] }} CanSignal
 */
/**
 * A layout of bytes with an identifier: `canId`, plus the unit number if `addsUnit`. It has `roles` for its 8 bytes, or
 * `length` bytes with signals, whose words are a telegram of the same name.
 * @typedef {object} CanMessage
 * @property {string} name
 * @property {string} direction
 * @property {number} canId
 * @property {readonly CanRole[]} roles
 * @property {boolean} addsUnit
 * @property {string | undefined} answers
 * @property {readonly CanSignal[]} signals
 * @property {number} length
 * @property {number | undefined} bits
 * @property {number | undefined} every
 */
/** @typedef {import("./uss-frames.js").Telegram} Telegram */
/**
 * The facts of a device: unit numbers, the bits of identifiers, messages and telegrams.
 * @typedef {object} CanProfile
 * @property {readonly [number, number]} units
 * @property {number} identifierBits
 * @property {readonly CanMessage[]} messages
 * @property {readonly Telegram[]} telegrams
 */
/** The profile of a device; facts that are left out have the usual value.
 * @param {Omit<CanProfile, "telegrams"> & Partial<CanProfile>} facts @returns {CanProfile} */
export function canProfile(facts: Omit<CanProfile, "telegrams"> & Partial<CanProfile>): CanProfile;
/** @param {string} name @param {string} direction @param {number} canId @param {Partial<CanMessage>} facts
 * @returns {CanMessage} */
export function canMessage(name: string, direction: string, canId: number, facts: Partial<CanMessage>): CanMessage;
/** @param {string} kind @param {number} [number] @returns {CanRole} */
export function canRole(kind: string, number?: number): CanRole;
/** @param {number} start @param {number} width @param {Partial<CanSignal>} [facts] @returns {CanSignal} */
export function canSignal(start: number, width: number, facts?: Partial<CanSignal>): CanSignal;
/** @param {string} name @param {string} direction @param {number} words @param {string} [message]
 * @returns {Telegram} */
export function telegramLayout(name: string, direction: string, words: number, message?: string): Telegram;
/** A message by name; raises AccessError. @param {CanProfile} profile @param {string | undefined} name
 * @returns {CanMessage} */
export function messageNamed(profile: CanProfile, name: string | undefined): CanMessage;
/** A telegram by name; raises AccessError. @param {{ telegrams: readonly Telegram[] }} profile
 * @param {string | undefined} name @returns {Telegram} */
export function telegramNamed(profile: {
    telegrams: readonly Telegram[];
}, name: string | undefined): Telegram;
/** @param {CanMessage} message @param {string} kind */
export function carriesRole(message: CanMessage, kind: string): boolean;
/** The request that reads or writes a parameter; raises AccessError. @param {CanProfile} profile
 * @param {boolean} writes
 * @returns {CanMessage} */
export function parameterRequest(profile: CanProfile, writes: boolean): CanMessage;
/** The identifier that carries a message to or from a unit. @param {CanMessage} message @param {number} unit */
export function identifierOf(message: CanMessage, unit: number): number;
/**
 * The frame of a message; raises RequestError (bad_unit, bad_address, bad_value).
 * @param {CanMessage} message @param {CanProfile} profile @param {number} unit @param {number} [address]
 * @param {number} [raw] @returns {CanFrame}
 */
export function buildCanFrame(message: CanMessage, profile: CanProfile, unit: number, address?: number, raw?: number): CanFrame;
/** @param {CanMessage} message @param {CanProfile} profile @param {number} unit @param {Uint8Array} data
 * @returns {CanFrame} */
export function canFrameOf(message: CanMessage, profile: CanProfile, unit: number, data: Uint8Array): CanFrame;
/** The first fault of a frame as this message of this unit: wrong_id, wrong_length, wrong_constant, wrong_unit,
 * wrong_check.
 * @param {CanMessage} message @param {number} unit @param {CanFrame} frame @returns {string | undefined} */
export function canFrameFault(message: CanMessage, unit: number, frame: CanFrame): string | undefined;
/**
 * Address and raw number in a message, 0 if it has none. Raises FrameError with the fault of `canFrameFault`.
 * @param {CanMessage} message @param {number} unit @param {CanFrame} frame @returns {{ address: number, raw: number }}
 */
export function parseCanFrame(message: CanMessage, unit: number, frame: CanFrame): {
    address: number;
    raw: number;
};
/** The positions of the high and the low byte of each word of a frame. @param {CanMessage} message
 * @returns {(readonly [number, number])[]} */
export function wordPlaces(message: CanMessage): (readonly [number, number])[];
/** The number of words of a signal in the telegram of its message. @param {CanSignal} signal */
export function signalWords(signal: CanSignal): number;
/** Takes the signals of a message out of its bytes, and puts them in. */
export class SignalPacking {
    /** @param {readonly CanSignal[]} signals @param {number} length */
    constructor(signals: readonly CanSignal[], length: number);
    signals: readonly CanSignal[];
    length: number;
    /** @type {{ signals: number[], when: CanSignal["when"], first: number,
     *   words: number }[]} words that come together */
    parts: {
        signals: number[];
        when: CanSignal["when"];
        first: number;
        words: number;
    }[];
    /** The first word of each signal in the telegram of the message. @returns {number[]} */
    firsts(): number[];
    /** The raw number of a signal without its sign. @param {Uint8Array} data @param {number} number @returns {bigint} */
    raw(data: Uint8Array, number: number): bigint;
    /** The numbers of the parts that these bytes have, with their words. @param {Uint8Array} data
     * @returns {Map<number, number[]>} */
    coming(data: Uint8Array): Map<number, number[]>;
    /** The bytes with these raw numbers, by the place of the signal; all other bits are 0.
     * @param {Iterable<readonly [number, number | bigint]>} raws @returns {Uint8Array} */
    pack(raws: Iterable<readonly [number, number | bigint]>): Uint8Array;
}
/**
 * A data frame on the bus.
 */
export type CanFrame = {
    id: number;
    data: Uint8Array;
    extended?: boolean;
};
/**
 * The content of one byte of a message: `constant` (number: the byte itself), `unit`, `address`, `raw` (number: the
 * position of its lowest bit), `multiplexer`, `word` (number: 2 * word of the frame, plus 1 for its low byte), `xor`
 * (number: a mask of the bytes of the message that are combined).
 */
export type CanRole = {
    kind: string;
    number: number;
};
/**
 * The place of a signal: `start` is its first bit as CAN databases count (bit 7 of byte 1 is 15): the bit of the lowest
 * value if the low byte comes first, else that of the highest. `when` has places of other signals with the raw numbers
 * that select this one: all must fit.
 */
export type CanSignal = {
    start: number;
    width: number;
    lowFirst: boolean;
    when: readonly (readonly [number, readonly number[]])[];
};
/**
 * A layout of bytes with an identifier: `canId`, plus the unit number if `addsUnit`. It has `roles` for its 8 bytes, or
 * `length` bytes with signals, whose words are a telegram of the same name.
 */
export type CanMessage = {
    name: string;
    direction: string;
    canId: number;
    roles: readonly CanRole[];
    addsUnit: boolean;
    answers: string | undefined;
    signals: readonly CanSignal[];
    length: number;
    bits: number | undefined;
    every: number | undefined;
};
export type Telegram = import("./uss-frames.js").Telegram;
/**
 * The facts of a device: unit numbers, the bits of identifiers, messages and telegrams.
 */
export type CanProfile = {
    units: readonly [number, number];
    identifierBits: number;
    messages: readonly CanMessage[];
    telegrams: readonly Telegram[];
};
