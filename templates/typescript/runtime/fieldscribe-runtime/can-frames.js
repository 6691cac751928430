// SPDX-License-Identifier: 0BSD
/** CAN messages with a layout of bytes, and their signals, without any I/O. Any bytes are safe to parse. */
import { AccessError, FrameError } from "./errors.js";
import { checkNumber, hex2 } from "./receiving.js";

/** The number of bytes of every message without signals. */
const CAN_LENGTH = 8;

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
export function canProfile(facts) {
  return Object.freeze({ telegrams: [], ...facts });
}

/** @param {string} name @param {string} direction @param {number} canId @param {Partial<CanMessage>} facts
 * @returns {CanMessage} */
export function canMessage(name, direction, canId, facts) {
  const usual = { roles: [], addsUnit: false, answers: undefined, signals: [], bits: undefined, every: undefined };
  return Object.freeze({ name, direction, canId, length: CAN_LENGTH, ...usual, ...facts });
}

/** @param {string} kind @param {number} [number] @returns {CanRole} */
export function canRole(kind, number = 0) {
  return { kind, number };
}

/** @param {number} start @param {number} width @param {Partial<CanSignal>} [facts] @returns {CanSignal} */
export function canSignal(start, width, facts) {
  return { start, width, lowFirst: false, when: [], ...facts };
}

/** @param {string} name @param {string} direction @param {number} words @param {string} [message]
 * @returns {Telegram} */
export function telegramLayout(name, direction, words, message) {
  return { name, direction, words, message };
}

/** A message by name; raises AccessError. @param {CanProfile} profile @param {string | undefined} name
 * @returns {CanMessage} */
export function messageNamed(profile, name) {
  const found = profile.messages.find((message) => message.name === name);
  if (!found) throw new AccessError(`the device has no message ${name}`);
  return found;
}

/** A telegram by name; raises AccessError. @param {{ telegrams: readonly Telegram[] }} profile
 * @param {string | undefined} name @returns {Telegram} */
export function telegramNamed(profile, name) {
  const found = profile.telegrams.find((telegram) => telegram.name === name);
  const known = profile.telegrams.map((telegram) => telegram.name).join(", ");
  if (!found) throw new AccessError(`the device has no telegram ${name}${known && `, only ${known}`}`);
  return found;
}

/** @param {CanMessage} message @param {string} kind */
export function carriesRole(message, kind) {
  return message.roles.some((role) => role.kind === kind);
}

/** The request that reads or writes a parameter; raises AccessError. @param {CanProfile} profile
 * @param {boolean} writes
 * @returns {CanMessage} */
export function parameterRequest(profile, writes) {
  const found = profile.messages.find(
    (one) => one.direction === "request" && carriesRole(one, "address") && carriesRole(one, "raw") === writes,
  );
  if (!found) throw new AccessError(`the device has no message that ${writes ? "writes" : "reads"} a parameter`);
  return found;
}

/** The identifier that carries a message to or from a unit. @param {CanMessage} message @param {number} unit */
export function identifierOf(message, unit) {
  return message.addsUnit ? message.canId + unit : message.canId;
}

/** The bytes of a mask, combined by exclusive or. @param {Uint8Array} data @param {number} mask */
function combinedBytes(data, mask) {
  return data.reduce((result, byte, place) => ((mask >> place) & 1 ? result ^ byte : result), 0);
}

/**
 * The frame of a message; raises RequestError (bad_unit, bad_address, bad_value).
 * @param {CanMessage} message @param {CanProfile} profile @param {number} unit @param {number} [address]
 * @param {number} [raw] @returns {CanFrame}
 */
export function buildCanFrame(message, profile, unit, address = 0, raw = 0) {
  checkNumber("bad_unit", "unit", unit, profile.units);
  checkNumber("bad_address", "address", address, [0, 0xffff]);
  checkNumber("bad_value", "raw number", raw, [0, 0xffff]);
  /** @type {Record<string, number>} */
  const carried = { unit, address, raw };
  const bytes = message.roles.map(({ kind, number }) =>
    kind === "constant" ? number : (carried[kind] ?? 0) >> number,
  );
  const data = Uint8Array.from(bytes);
  message.roles.forEach(({ kind, number }, place) => {
    if (kind === "xor") data[place] = combinedBytes(data, number);
  });
  return canFrameOf(message, profile, unit, data);
}

/** @param {CanMessage} message @param {CanProfile} profile @param {number} unit @param {Uint8Array} data
 * @returns {CanFrame} */
export function canFrameOf(message, profile, unit, data) {
  return { id: identifierOf(message, unit), extended: (message.bits ?? profile.identifierBits) > 11, data };
}

/** The kinds of bytes with a known value, in the order of the checks. */
const FIXED_ROLES = [
  ["constant", "constant"],
  ["unit", "unit"],
  ["xor", "check"],
];

/** The first fault of a frame as this message of this unit: wrong_id, wrong_length, wrong_constant, wrong_unit,
 * wrong_check.
 * @param {CanMessage} message @param {number} unit @param {CanFrame} frame @returns {string | undefined} */
export function canFrameFault(message, unit, frame) {
  if (frame.id !== identifierOf(message, unit)) return "wrong_id";
  if (frame.data.length !== message.length) return "wrong_length";
  for (const [kind, name] of FIXED_ROLES) {
    for (let place = 0; place < message.roles.length; place++) {
      const role = message.roles[place];
      if (role.kind === kind && frame.data[place] !== expectedByte(role, unit, frame.data)) return `wrong_${name}`;
    }
  }
  return undefined;
}

/** @param {CanRole} role @param {number} unit @param {Uint8Array} data */
function expectedByte({ kind, number }, unit, data) {
  if (kind === "constant") return number;
  return kind === "unit" ? (unit >> number) & 0xff : combinedBytes(data, number);
}

/**
 * Address and raw number in a message, 0 if it has none. Raises FrameError with the fault of `canFrameFault`.
 * @param {CanMessage} message @param {number} unit @param {CanFrame} frame @returns {{ address: number, raw: number }}
 */
export function parseCanFrame(message, unit, frame) {
  const fault = canFrameFault(message, unit, frame);
  if (fault) {
    const bytes = [...frame.data].map(hex2).join(" ");
    throw new FrameError(fault, `${frame.id.toString(16).toUpperCase()}h: ${bytes} is not ${message.name}: ${fault}`);
  }
  const carried = { address: 0, raw: 0 };
  message.roles.forEach(({ kind, number }, place) => {
    if (kind === "address" || kind === "raw") carried[kind] += frame.data[place] << number;
  });
  return carried;
}

/** The positions of the high and the low byte of each word of a frame. @param {CanMessage} message
 * @returns {(readonly [number, number])[]} */
export function wordPlaces(message) {
  const places = new Map(message.roles.map((role, place) => [role.kind === "word" ? role.number : -1, place]));
  places.delete(-1);
  return Array.from({ length: places.size >> 1 }, (_, word) => [
    places.get(2 * word) ?? 0,
    places.get(2 * word + 1) ?? 0,
  ]);
}

/** Takes the signals of a message out of its bytes, and puts them in. */
export class SignalPacking {
  /** @param {readonly CanSignal[]} signals @param {number} length */
  constructor(signals, length) {
    this.signals = signals;
    this.length = length;
    /** @type {{ signals: number[], when: CanSignal["when"], first: number,
     *   words: number }[]} words that come together */
    this.parts = [];
    let at = 0;
    signals.forEach((signal, number) => {
      const last = this.parts[this.parts.length - 1];
      if (last && JSON.stringify(last.when) === JSON.stringify(signal.when)) {
        last.signals.push(number);
        last.words += signalWords(signal);
      } else this.parts.push({ signals: [number], when: signal.when, first: at, words: signalWords(signal) });
      at += signalWords(signal);
    });
  }

  /** The first word of each signal in the telegram of the message. @returns {number[]} */
  firsts() {
    let at = 0;
    return this.signals.map((signal) => (at += signalWords(signal)) - signalWords(signal));
  }

  /** The raw number of a signal without its sign. @param {Uint8Array} data @param {number} number @returns {bigint} */
  raw(data, number) {
    const { start, width, lowFirst } = this.signals[number];
    const shift = lowFirst ? start : 8 * this.length - (start ^ 7) - width;
    return (bigOf(data, lowFirst) >> BigInt(shift)) & ((1n << BigInt(width)) - 1n);
  }

  /** The numbers of the parts that these bytes have, with their words. @param {Uint8Array} data
   * @returns {Map<number, number[]>} */
  coming(data) {
    /** @type {Map<number, number[]>} */
    const found = new Map();
    this.parts.forEach(({ signals, when }, place) => {
      if (!when.every(([selector, known]) => known.includes(Number(this.raw(data, selector))))) return;
      found.set(
        place,
        signals.flatMap((number) => wordsOfRaw(this.raw(data, number), signalWords(this.signals[number]))),
      );
    });
    return found;
  }

  /** The bytes with these raw numbers, by the place of the signal; all other bits are 0.
   * @param {Iterable<readonly [number, number | bigint]>} raws @returns {Uint8Array} */
  pack(raws) {
    const data = new Uint8Array(this.length);
    for (const [number, raw] of raws) {
      const { start, width, lowFirst } = this.signals[number];
      const shift = lowFirst ? start : 8 * this.length - (start ^ 7) - width;
      let bits = BigInt.asUintN(width, BigInt(raw)) << BigInt(shift);
      for (let at = 0; bits > 0n; at++, bits >>= 8n) data[lowFirst ? at : this.length - 1 - at] |= Number(bits & 0xffn);
    }
    return data;
  }
}

/** The number of words of a signal in the telegram of its message. @param {CanSignal} signal */
export function signalWords(signal) {
  return (signal.width + 15) >> 4;
}

/** @param {Uint8Array} data @param {boolean} lowFirst */
function bigOf(data, lowFirst) {
  const bytes = lowFirst ? [...data].reverse() : [...data];
  return bytes.reduce((number, byte) => (number << 8n) | BigInt(byte), 0n);
}

/** @param {bigint} raw @param {number} words @returns {number[]} */
function wordsOfRaw(raw, words) {
  return Array.from({ length: words }, (_, at) => Number((raw >> BigInt(16 * (words - 1 - at))) & 0xffffn));
}
