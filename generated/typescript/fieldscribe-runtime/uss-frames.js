// SPDX-License-Identifier: 0BSD
/** USS telegrams as bytes, without any I/O. Any bytes of any length are safe to parse. */
import { FrameError, RefusedError, RequestError, shown } from "./errors.js";
import { checkBytes, checkInteger, checkNumber, wordsOfBytes } from "./receiving.js";

const USS_START = 0x02;
/** The setting of the parameter part that lets its length follow from the request. */
export const USS_VARIABLE = 127;
export const USS_NO_TASK = 0;
export const USS_READ = 1;
/** The tasks that change a value of one word, of two, and of elements of arrays: in RAM, and to keep it in EEPROM. */
const USS_CHANGES = { ram: [2, 3, 7, 8], eeprom: [14, 13, 12, 11] };
const USS_PAGE_BITS = [15, 12, 13, 14];

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
export function ussProfile(facts) {
  return Object.freeze({ broadcast: null, errors: {}, telegrams: [], variantPzd: [], ...facts });
}

/** The task that writes a parameter of 1 or 2 words. @param {number} words @param {boolean} isElement
 * @param {boolean} keep
 * @returns {number | undefined} */
export function ussChangeTask(words, isElement, keep) {
  return words < 1 || words > 2 ? undefined : USS_CHANGES[keep ? "eeprom" : "ram"][words - 1 + (isElement ? 2 : 0)];
}

/** How many words of the parameter part are sent. @param {UssLink} link @returns {number} */
export function sentPkw(link) {
  return link.pkw === USS_VARIABLE ? 4 : link.pkw;
}

/** Whether a single value stands in the second value word. @param {UssLink} link */
function isSingleLast(link) {
  return link.pkw === 4 && !link.singleFirst;
}

/** @param {Uint8Array} data @returns {number} */
function blockCheck(data) {
  return data.reduce((check, byte) => check ^ byte, 0);
}

/** @param {number} address @param {readonly number[]} words @returns {Uint8Array} */
function ussTelegram(address, words) {
  const data = words.flatMap((word) => [word >> 8, word & 0xff]);
  const body = Uint8Array.of(USS_START, data.length + 2, address, ...data, 0);
  body[body.length - 1] = blockCheck(body);
  return body;
}

/** The words that name a task and an element of a parameter.
 * @param {number} task @param {number} parameter @param {number} index @returns {[number, number]} */
function ussNamed(task, parameter, index) {
  const page = Math.floor(parameter / 2000);
  const pages = USS_PAGE_BITS.reduce((bits, place, at) => bits | (((page >> at) & 1) << place), 0);
  return [(task << 12) | (parameter % 2000), pages | index];
}

/**
 * Raises RequestError (bad_link) if a device, of these variants as far as they are known, has no such link.
 * @param {UssProfile} profile @param {UssLink} link @param {Readonly<Record<string, string | undefined>>} variants
 */
export function checkUssLink(profile, link, variants) {
  checkUssPart(profile, link);
  checkUssLength(profile.pzd, link, "the device");
  for (const [[axis, value], ends] of profile.variantPzd) {
    if (variants[axis] === value) checkUssLength(ends, link, `${axis} ${value}`);
  }
}

/** @param {UssProfile} profile @param {UssLink} link */
function checkUssPart(profile, link) {
  if (typeof link !== "object" || link === null) {
    throw new RequestError("bad_link", `the link is an object as { pkw: 4, pzd: 2 }, not ${shown(link)}`);
  }
  checkInteger("bad_link", "the length of the parameter part", link.pkw);
  if (!profile.pkw.includes(link.pkw)) {
    throw new RequestError("bad_link", `the parameter part is ${profile.pkw.join(", ")} words long, not ${link.pkw}`);
  }
}

/** @param {readonly [number, number]} ends @param {UssLink} link @param {string} whose */
function checkUssLength([low, high], link, whose) {
  checkInteger("bad_link", "the length of the process data", link.pzd);
  if (link.pzd < low || link.pzd > high) {
    throw new RequestError("bad_link", `${whose} takes ${low}..${high} words of process data, not ${link.pzd}`);
  }
}

/** @param {UssProfile} profile @param {UssLink} link @param {readonly number[]} words */
function checkProcessData(profile, link, words) {
  checkUssLength(profile.pzd, link, "the device");
  if (words.length !== link.pzd) {
    throw new RequestError("bad_link", `${words.length} words of process data do not fill the ${link.pzd} of the link`);
  }
}

/** @param {unknown} word */
function isUssWord(word) {
  return typeof word === "number" && Number.isInteger(word) && word >= 0 && word <= 0xffff;
}

/**
 * Raises RequestError if a request must not be sent; the first failure decides: bad_link, bad_unit, bad_task,
 * bad_parameter, bad_index, bad_value.
 * @param {UssRequest} request @param {UssProfile} profile @param {UssLink} link
 */
export function checkUssRequest(request, profile, link) {
  const { unit, task = USS_NO_TASK, parameter = 0, index = 0, width = 0, value = 0, words = [] } = request;
  checkUssPart(profile, link);
  checkProcessData(profile, link, words);
  checkNumber("bad_unit", "unit", unit, profile.units);
  if (profile.tasks[task] === undefined) throw new RequestError("bad_task", `the device has no task ${shown(task)}`);
  if (link.pkw === 0 && task !== USS_NO_TASK) throw new RequestError("bad_task", "the link carries no parameters");
  checkNumber("bad_parameter", "parameter", parameter, [0, 31999]);
  checkNumber("bad_index", "index", index, [0, 255]);
  for (const number of [width, value, ...words]) checkInteger("bad_value", "a value", number);
  if (width === 2 && sentPkw(link) < 4) throw new RequestError("bad_value", "the link has no room for double words");
  const largest = [0, 0xffff, 0xffffffff][width] ?? -1;
  if (value < 0 || value > largest || !words.every(isUssWord)) {
    throw new RequestError("bad_value", `a value does not fit: ${value} into ${width} words, or a word`);
  }
}

/** The bytes of a request; raises RequestError if it must not be sent.
 * @param {UssRequest} request @param {UssProfile} profile @param {UssLink} link @returns {Uint8Array} */
export function buildUssRequest(request, profile, link) {
  checkUssRequest(request, profile, link);
  const { unit, task = USS_NO_TASK, parameter = 0, index = 0, width = 0, value = 0, words = [] } = request;
  let values = [value >>> 16, value & 0xffff];
  if (width === 1) values = isSingleLast(link) ? [0, value] : [value, 0];
  const part = [...ussNamed(task, parameter, index), ...values].slice(0, sentPkw(link));
  return ussTelegram(unit, [...part, ...words]);
}

/**
 * Process data for all units, which nobody answers; four words of `mask` say which words and bits count. Raises
 * RequestError (bad_link, bad_value).
 * @param {readonly number[]} mask @param {readonly number[]} words @param {UssProfile} profile @param {UssLink} link
 * @returns {Uint8Array}
 */
export function buildUssBroadcast(mask, words, profile, link) {
  checkProcessData(profile, link, words);
  if (profile.broadcast === null || !Array.isArray(mask) || mask.length !== 4) {
    throw new RequestError("bad_link", "a broadcast takes 4 words of mask, and a device that knows it");
  }
  for (const word of [...mask, ...words]) checkNumber("bad_value", "a word", word, [0, 0xffff]);
  return ussTelegram(profile.broadcast, [...mask, ...words]);
}

/** The length of the telegram that begins with these bytes; null while they are too few.
 * @param {Uint8Array} received @returns {number | null} */
export function ussReplySize(received) {
  return received.length < 2 ? null : received[1] + 2;
}

/** What a line must know of the reply to a request. @param {Uint8Array} request @param {boolean} [broadcast]
 * @returns {import("./receiving.js").ReplyShape} */
export function ussReplyShape(request, broadcast = false) {
  const isOwn = (/** @type {Uint8Array} */ frame) => frame[2] === request[2];
  return { framing: "uss", broadcast, shortest: 4, longest: 257, size: ussReplySize, isOwn };
}

/**
 * What a reply to `request` brings.
 *
 * Raises FrameError, the first failure deciding: wrong_start, wrong_length, wrong_check, wrong_unit, no_answer,
 * wrong_parameter, refused (RefusedError, with the device's number), no_rights, wrong_response. From no_answer on the
 * error holds the process data, which came all the same.
 * @param {UssRequest} request @param {Uint8Array} reply @param {UssProfile} profile @param {UssLink} link
 * @returns {UssReply}
 */
export function parseUssReply(request, reply, profile, link) {
  checkBytes(reply);
  const all = openUss(request, reply, link);
  const part = all.slice(0, all.length - link.pzd);
  const words = all.slice(all.length - link.pzd);
  if (!part.length) return { response: 0, width: 0, value: 0, words };
  if (part.length < 3) throw new FrameError("wrong_length", `a parameter part of ${part.length} words is of no link`);
  const response = part[0] >> 12;
  if ((request.task ?? USS_NO_TASK) === USS_NO_TASK) return { response, width: 0, value: 0, words };
  const error = ussAnswerError(request, part, profile);
  if (error) {
    error.words = words;
    throw error;
  }
  if (isDoubleResponse(response)) return { response, width: 2, value: part[2] * 0x10000 + part[3], words };
  return { response, width: 1, value: part[isSingleLast(link) ? 3 : 2], words };
}

/** @param {number} response */
function isDoubleResponse(response) {
  return response === 2 || response === 5;
}

/** The words of a reply whose bytes are a good telegram of the right unit and length.
 * @param {UssRequest} request @param {Uint8Array} reply @param {UssLink} link @returns {number[]} */
function openUss(request, reply, link) {
  if (reply[0] !== USS_START) throw new FrameError("wrong_start", "the reply does not begin with 02h");
  const size = reply.length;
  const isWhole = size >= 4 && reply[1] + 2 === size && size % 2 === 0;
  const part = (size - 4) / 2 - link.pzd;
  if (!isWhole) throw new FrameError("wrong_length", `${size} bytes are no whole reply`);
  if (link.pkw === USS_VARIABLE ? part < 3 : part !== link.pkw) {
    const least = link.pkw === USS_VARIABLE ? "at least " : "";
    const belong = `${least}${4 + 2 * ((least ? 3 : link.pkw) + link.pzd)}`;
    throw new FrameError(
      "wrong_length",
      `the reply has ${size} bytes where ${belong} belong: is the link of the device set so?`,
    );
  }
  if (blockCheck(reply) !== 0) throw new FrameError("wrong_check", "the check of the reply is wrong");
  if (reply[2] !== request.unit) {
    throw new FrameError("wrong_unit", `unit ${reply[2]} answered instead of ${request.unit}`);
  }
  return wordsOfBytes(reply.subarray(3, size - 1));
}

/** What is wrong with a parameter part as an answer to the task.
 * @param {UssRequest} request @param {number[]} part @param {UssProfile} profile @returns {FrameError | undefined} */
function ussAnswerError(request, part, profile) {
  const { task = USS_NO_TASK, parameter = 0, index = 0 } = request;
  const response = part[0] >> 12;
  if (response === 0) return new FrameError("no_answer", "the device has not answered the task yet");
  const [number, element] = ussNamed(0, parameter, index);
  if ((part[0] & 0x0fff) !== number || part[1] !== element) {
    return new FrameError("wrong_parameter", "the reply is for another parameter");
  }
  if (response === 7) return new RefusedError(part[2], profile.errors[part[2]]);
  if (response === 8) return new FrameError("no_rights", "the device does not let this master change parameters");
  if (!profile.tasks[task]?.includes(response)) {
    return new FrameError("wrong_response", `response ${response} does not belong to task ${task}`);
  }
  if (isDoubleResponse(response) && part.length < 4) {
    return new FrameError("wrong_length", "the reply has no room for the double word that it announces");
  }
  return undefined;
}
