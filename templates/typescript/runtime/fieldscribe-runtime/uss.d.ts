/** @typedef {import("./places.js").Place} Place */
/** @typedef {import("./table.js").AnyPoint} AnyPoint */
/** @typedef {import("./uss-frames.js").UssRequest} UssRequest */
/** Process data that is sent, by the place of the word. @typedef {Map<number, number>} SentWords */
/**
 * A device on a USS line, with how its link is set, and the process data that its next telegrams carry.
 *
 * Each telegram carries process data, those that read a parameter too. A word is 0 until it is written, all bits of it;
 * the bits that are always written as a constant come with the first point of their word, so that reading, or writing a
 * setpoint alone, commands nothing.
 *
 * When a telegram that changes words fails, nobody knows which words the device has now, and neither the new nor the
 * old ones may be repeated: all words are 0 then until some are written again; write the setpoint again, too.
 */
export class UssDevice extends Session {
    /** @param {import("./receiving.js").Line} line
     * @param {import("./session.js").DeviceOptions & { link: import("./uss-frames.js").UssLink }} options */
    constructor(line: import("./receiving.js").Line, options: import("./session.js").DeviceOptions & {
        link: import("./uss-frames.js").UssLink;
    });
    link: import("./uss-frames.js").UssLink;
    /** A task that the device has not answered yet is sent again up to so many times. */
    repeats: number;
    /** @type {SentWords} */
    _sent: SentWords;
    /** Let all words of process data be 0 until they are written again, because others have commanded the device. */
    dropProcessData(): void;
    /**
     * Read a parameter by number, without any meaning: one word, or two with the high one first. With the name of a
     * telegram for the space it is a word of process data, counted from 0.
     * @param {string} space @param {number} address @param {{ index?: number }} [how] @returns {Promise<number[]>}
     */
    readAt(space: string, address: number, { index }?: {
        index?: number;
    }): Promise<number[]>;
    /**
     * Write a parameter by number to RAM, or with the name of a telegram words of process data. Nothing is checked: this
     * can set what no point allows.
     * @param {string} space @param {number} address @param {number | readonly number[]} words
     * @param {{ index?: number }} [how] @returns {Promise<void>}
     */
    writeAt(space: string, address: number, words: number | readonly number[], { index }?: {
        index?: number;
    }): Promise<void>;
    /**
     * Send process data to all units of the line, which nobody answers: `words`, or those written to this device.
     *
     * The mask says what counts: the first word which words (bit 1 the first one), the second which bits of the first
     * word. Afterwards the process data of this device falls back to 0: call `dropProcessData` on the objects of all
     * other units too, or their next telegram takes the broadcast back.
     * @param {readonly number[]} mask @param {readonly number[]} [words] @returns {Promise<void>}
     */
    broadcast(mask: readonly number[], words?: readonly number[]): Promise<void>;
    /** @param {string} space @param {number} address @param {number} count @param {number} [index] @returns {Place} */
    _placeOf(space: string, address: number, count: number, index?: number): Place;
    /** @param {string | undefined} name @returns {import("./uss-frames.js").Telegram | undefined} */
    _telegram(name: string | undefined): import("./uss-frames.js").Telegram | undefined;
    /** Whether words of a telegram go to the device. @param {Place} at */
    _isSent(at: Place): boolean;
    /** Write a parameter; the answer confirms the change with the value that the device has now.
     * @param {Place} at @param {readonly number[]} words */
    _change(at: Place, words: readonly number[]): Promise<void>;
    /** One task, again while it is lost: it changes no process data. @param {UssRequest} request */
    _task(request: UssRequest): Promise<import("./uss-frames.js").UssReply>;
    /** One task with process data, and the reply; a task is repeated until the device answers it.
     * @param {UssRequest} request */
    _telegramExchange(request: UssRequest): Promise<import("./uss-frames.js").UssReply>;
    /** @param {Place} at @returns {number} */
    _number(at: Place): number;
    /** All words of process data as they are sent. @param {SentWords} sent @returns {number[]} */
    _allWords(sent: SentWords): number[];
    /** The words of a place out of the process data. @param {readonly number[]} words @param {Place} at
     * @returns {number[]} */
    _chosen(words: readonly number[], at: Place): number[];
    /** The bits that are always written as a constant, mask and bits, by the word of process data.
     * @returns {Map<number, [number, number]>} */
    _constants(): Map<number, [number, number]>;
}
export type Place = import("./places.js").Place;
export type AnyPoint = import("./table.js").AnyPoint;
export type UssRequest = import("./uss-frames.js").UssRequest;
/**
 * Process data that is sent, by the place of the word.
 */
export type SentWords = Map<number, number>;
import { Session } from "./session.js";
