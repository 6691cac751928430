/**
 * How the link is set: `pkw` words of the parameter part (127: variable), `pzd` words of process data. `singleFirst`:
 * the firmware that keeps single words in the first value word although the part has 4 words.
 * @typedef {{ pkw: number, pzd: number, singleFirst?: boolean }} UssLink
 */
/**
 * A layout of words that travel together: `request` to the device, `response` or `cyclic` from it.
 * @typedef {{ name: string, direction: string, words: number, message?: string }} Telegram
 */
/**
 * What a device takes: unit numbers, the address byte for all of them, lengths, tasks with their answers. `variantPzd`
 * has axis, value and ends of those variants that take less process data.
 * @typedef {object} UssProfile
 * @property {readonly [number, number]} units
 * @property {readonly number[]} pkw
 * @property {readonly [number, number]} pzd
 * @property {Readonly<Record<number, readonly number[]>>} tasks
 * @property {number | null} broadcast
 * @property {Readonly<Record<number, string>>} errors
 * @property {readonly Telegram[]} telegrams
 * @property {readonly (readonly [readonly [string, string], readonly [number, number]])[]} variantPzd
 */
/**
 * What is asked: a task for a parameter (or an element of one) with a value of `width` words, and process data.
 * @typedef {object} UssRequest
 * @property {number} unit
 * @property {number} [task]
 * @property {number} [parameter]
 * @property {number} [index]
 * @property {number} [width]
 * @property {number} [value]
 * @property {readonly number[]} [words]
 */
/**
 * A good answer: its response id, a value of `width` words (0 without a task), and process data.
 * @typedef {{ response: number, width: number, value: number, words: number[] }} UssReply
 */
/**
 * The profile of a device; facts that are left out have the usual value.
 * @param {Partial<UssProfile> & Pick<UssProfile, "units" | "pkw" | "pzd" | "tasks">} facts
 * @returns {UssProfile}
 */
export function ussProfile(facts: Partial<UssProfile> & Pick<UssProfile, "units" | "pkw" | "pzd" | "tasks">): UssProfile;
/** The task that writes a parameter of 1 or 2 words. @param {number} words @param {boolean} isElement
 * @param {boolean} keep
 * @returns {number | undefined} */
export function ussChangeTask(words: number, isElement: boolean, keep: boolean): number | undefined;
/** How many words of the parameter part are sent. @param {UssLink} link @returns {number} */
export function sentPkw(link: UssLink): number;
/**
 * Raises RequestError (bad_link) if a device, of these variants as far as they are known, has no such link.
 * @param {UssProfile} profile @param {UssLink} link @param {Readonly<Record<string, string | undefined>>} variants
 */
export function checkUssLink(profile: UssProfile, link: UssLink, variants: Readonly<Record<string, string | undefined>>): void;
/**
 * Raises RequestError if a request must not be sent; the first failure decides: bad_link, bad_unit, bad_task,
 * bad_parameter, bad_index, bad_value.
 * @param {UssRequest} request @param {UssProfile} profile @param {UssLink} link
 */
export function checkUssRequest(request: UssRequest, profile: UssProfile, link: UssLink): void;
/** The bytes of a request; raises RequestError if it must not be sent.
 * @param {UssRequest} request @param {UssProfile} profile @param {UssLink} link @returns {Uint8Array} */
export function buildUssRequest(request: UssRequest, profile: UssProfile, link: UssLink): Uint8Array;
/**
 * Process data for all units, which nobody answers; four words of `mask` say which words and bits count. Raises
 * RequestError (bad_link, bad_value).
 * @param {readonly number[]} mask @param {readonly number[]} words @param {UssProfile} profile @param {UssLink} link
 * @returns {Uint8Array}
 */
export function buildUssBroadcast(mask: readonly number[], words: readonly number[], profile: UssProfile, link: UssLink): Uint8Array;
/** The length of the telegram that begins with these bytes; null while they are too few.
 * @param {Uint8Array} received @returns {number | null} */
export function ussReplySize(received: Uint8Array): number | null;
/** What a line must know of the reply to a request. @param {Uint8Array} request @param {boolean} [broadcast]
 * @returns {import("./receiving.js").ReplyShape} */
export function ussReplyShape(request: Uint8Array, broadcast?: boolean): import("./receiving.js").ReplyShape;
/**
 * What a reply to `request` brings.
 *
 * Raises FrameError, the first failure deciding: wrong_start, wrong_length, wrong_check, wrong_unit, no_answer,
 * wrong_parameter, refused (RefusedError, with the device's number), no_rights, wrong_response. From no_answer on the
 * error holds the process data, which came all the same.
 * @param {UssRequest} request @param {Uint8Array} reply @param {UssProfile} profile @param {UssLink} link
 * @returns {UssReply}
 */
export function parseUssReply(request: UssRequest, reply: Uint8Array, profile: UssProfile, link: UssLink): UssReply;
/** The setting of the parameter part that lets its length follow from the request. */
export const USS_VARIABLE: 127;
export const USS_NO_TASK: 0;
export const USS_READ: 1;
/**
 * How the link is set: `pkw` words of the parameter part (127: variable), `pzd` words of process data. `singleFirst`:
 * the firmware that keeps single words in the first value word although the part has 4 words.
 */
export type UssLink = {
    pkw: number;
    pzd: number;
    singleFirst?: boolean;
};
/**
 * A layout of words that travel together: `request` to the device, `response` or `cyclic` from it.
 */
export type Telegram = {
    name: string;
    direction: string;
    words: number;
    message?: string;
};
/**
 * What a device takes: unit numbers, the address byte for all of them, lengths, tasks with their answers. `variantPzd`
 * has axis, value and ends of those variants that take less process data.
 */
export type UssProfile = {
    units: readonly [number, number];
    pkw: readonly number[];
    pzd: readonly [number, number];
    tasks: Readonly<Record<number, readonly number[]>>;
    broadcast: number | null;
    errors: Readonly<Record<number, string>>;
    telegrams: readonly Telegram[];
    variantPzd: readonly (readonly [readonly [string, string], readonly [number, number]])[];
};
/**
 * What is asked: a task for a parameter (or an element of one) with a value of `width` words, and process data.
 */
export type UssRequest = {
    unit: number;
    task?: number | undefined;
    parameter?: number | undefined;
    index?: number | undefined;
    width?: number | undefined;
    value?: number | undefined;
    words?: readonly number[] | undefined;
};
/**
 * A good answer: its response id, a value of `width` words (0 without a task), and process data.
 */
export type UssReply = {
    response: number;
    width: number;
    value: number;
    words: number[];
};
