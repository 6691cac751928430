// SPDX-License-Identifier: 0BSD
/** Modbus requests and replies as bytes, RTU and TCP, without any I/O. Any bytes of any length are safe to parse. */
import { EchoError, ExceptionReplyError, FrameError, RequestError, shown } from "./errors.js";
import { checkBytes, checkInteger, checkNumber, hex2, wordsOfBytes } from "./receiving.js";

export const READ_COILS = 0x01;
export const READ_DISCRETE = 0x02;
export const READ_HOLDING = 0x03;
export const READ_INPUT = 0x04;
export const WRITE_COIL = 0x05;
export const WRITE_REGISTER = 0x06;
export const DIAGNOSTICS = 0x08;
export const WRITE_COILS = 0x0f;
export const WRITE_REGISTERS = 0x10;

/** @type {readonly number[]} */
export const MODBUS_READS = [READ_COILS, READ_DISCRETE, READ_HOLDING, READ_INPUT];
/** @type {readonly number[]} */
export const MODBUS_WRITES = [WRITE_COIL, WRITE_REGISTER, WRITE_COILS, WRITE_REGISTERS];
/** @type {readonly number[]} */
const MODBUS_ECHOES = [WRITE_COIL, WRITE_REGISTER, DIAGNOSTICS];

/**
 * What a device supports: functions with the most items of one request, unit numbers, and its peculiarities.
 *
 * `broadcast` is the unit number of all units, `broadcasts` the functions that may be sent to it.
 * @typedef {object} ModbusProfile
 * @property {Readonly<Record<number, number>>} functions
 * @property {readonly [number, number]} units
 * @property {number | null} broadcast
 * @property {boolean} padCoilBytesEven
 * @property {Readonly<Record<number, string>>} exceptions
 * @property {readonly number[]} broadcasts
 * @property {readonly string[]} framings
 */

/**
 * One request. Reads name `count`, writes `values`; a loop-back test (08h) sends values[0] to `address` 0.
 * @typedef {{ unit: number, function: number, address: number, count?: number,
 *   values?: readonly number[] }} ModbusRequest
 */

/** @typedef {"rtu" | "tcp" | "pdu"} ModbusFraming  `pdu` is the unit and the request, without the rest of the frame. */

/**
 * The profile of a device; facts that are left out have the usual value.
 * @param {Partial<ModbusProfile> & Pick<ModbusProfile, "functions">} facts
 * @returns {ModbusProfile}
 */
export function modbusProfile(facts) {
  const usual = { broadcast: 0, padCoilBytesEven: false, exceptions: {}, broadcasts: MODBUS_WRITES };
  return Object.freeze({ units: /** @type {const} */ ([1, 247]), framings: ["rtu", "tcp"], ...usual, ...facts });
}

/** @type {number[]} */
const CRC_TABLE = [];
for (let byte = 0; byte < 256; byte++) {
  let value = byte;
  for (let bit = 0; bit < 8; bit++) value = (value >> 1) ^ (value & 1 ? 0xa001 : 0);
  CRC_TABLE.push(value);
}

/** The CRC-16 of RTU frames; its low byte is sent first. @param {Uint8Array} data @returns {number} */
export function modbusCrc(data) {
  let value = 0xffff;
  for (const byte of data) value = (value >> 8) ^ CRC_TABLE[(value ^ byte) & 0xff];
  return value;
}

/** @param {ModbusRequest} request @returns {number} */
function itemsOf(request) {
  return MODBUS_READS.includes(request.function) ? (request.count ?? 0) : (request.values?.length ?? 0);
}

/** Raises RequestError (bad_framing) if the device does not support the framing.
 * @param {string} framing @param {ModbusProfile} profile */
export function checkFraming(framing, profile) {
  if (framing !== "pdu" && !profile.framings.includes(framing)) {
    const told = `the device speaks ${profile.framings.join(" and ")}, not ${shown(framing)}`;
    throw new RequestError("bad_framing", `${told}: give the line { framing: "${profile.framings[0]}" }`);
  }
}

/** Raises RequestError if the device does not take such a request.
 * @param {ModbusRequest} request @param {ModbusProfile} profile */
export function checkModbusRequest(request, profile) {
  const { unit, address } = request;
  const name = `function ${hex2(request.function)}h`;
  const most = profile.functions[request.function];
  if (most === undefined) throw new RequestError("bad_function", `the device has no ${name}`);
  checkInteger("bad_unit", "unit", unit);
  const [low, high] = profile.units;
  if (unit === profile.broadcast) {
    if (!profile.broadcasts.includes(request.function)) {
      throw new RequestError("bad_unit", `${name} cannot be sent to all units`);
    }
  } else checkNumber("bad_unit", "unit", unit, [low, high]);
  const items = itemsOf(request);
  if (!(Number.isInteger(items) && items >= 1 && items <= most)) {
    throw new RequestError("bad_count", `${name} takes 1..${most} items, not ${shown(items)}`);
  }
  checkInteger("bad_address", "address", address);
  if (address < 0 || address > (request.function === DIAGNOSTICS ? 0 : 0x10000 - items)) {
    throw new RequestError("bad_address", `${items} items from ${address} on are outside 0..65535`);
  }
  const largest = request.function === WRITE_COIL || request.function === WRITE_COILS ? 1 : 0xffff;
  for (const value of request.values ?? []) checkNumber("bad_value", "value", value, [0, largest]);
}

/** Function, address, and count or value: what a device repeats of a write. @param {ModbusRequest} request */
function headOf(request) {
  let value = itemsOf(request);
  if (MODBUS_ECHOES.includes(request.function)) {
    value = request.values?.[0] ?? 0;
    if (request.function === WRITE_COIL) value = value ? 0xff00 : 0;
  }
  return [request.function, request.address >> 8, request.address & 0xff, value >> 8, value & 0xff];
}

/** @param {ModbusRequest} request @param {ModbusProfile} profile @returns {number[]} */
function pduOf(request, profile) {
  const values = request.values ?? [];
  /** @type {number[]} */
  let data = [];
  if (request.function === WRITE_REGISTERS) for (const word of values) data.push(word >> 8, word & 0xff);
  else if (request.function === WRITE_COILS) {
    const size = (values.length + 7) >> 3;
    data = Array(profile.padCoilBytesEven ? size + (size % 2) : size).fill(0);
    values.forEach((bit, at) => (data[at >> 3] |= bit << (at & 7)));
  } else return headOf(request);
  return [...headOf(request), data.length, ...data];
}

/**
 * The bytes of a request; raises RequestError if the device does not take it.
 * @param {ModbusRequest} request @param {ModbusProfile} profile @param {string} [framing] @param {number} [transaction]
 * @returns {Uint8Array}
 */
export function buildModbusRequest(request, profile, framing = "rtu", transaction = 0) {
  checkFraming(framing, profile);
  checkModbusRequest(request, profile);
  const frame = [request.unit, ...pduOf(request, profile)];
  if (framing === "tcp") {
    return Uint8Array.of(
      (transaction >> 8) & 0xff,
      transaction & 0xff,
      0,
      0,
      frame.length >> 8,
      frame.length,
      ...frame,
    );
  }
  if (framing === "pdu") return Uint8Array.from(frame);
  const check = modbusCrc(Uint8Array.from(frame));
  return Uint8Array.of(...frame, check & 0xff, check >> 8);
}

/** The length of the RTU reply that begins with these bytes; null while they are too few, or if it cannot be told.
 * @param {Uint8Array} received @returns {number | null} */
export function rtuReplySize(received) {
  if (received.length < 3) return null;
  const code = received[1] & 0x7f;
  if (!MODBUS_READS.includes(code) && !MODBUS_WRITES.includes(code) && code !== DIAGNOSTICS) return null;
  if (received[1] & 0x80) return 5;
  return MODBUS_READS.includes(code) ? 5 + received[2] : 8;
}

/** The length of the TCP reply that begins with these bytes; null while they are too few.
 * @param {Uint8Array} received @returns {number | null} */
export function tcpReplySize(received) {
  return received.length < 6 ? null : 6 + ((received[4] << 8) | received[5]);
}

/**
 * What a line must know of the reply to a request.
 * @param {Uint8Array} request @param {string} framing @param {boolean} broadcast
 * @returns {import("./receiving.js").ReplyShape}
 */
export function modbusReplyShape(request, framing, broadcast) {
  if (framing === "tcp") {
    const isOwn = (/** @type {Uint8Array} */ frame) => frame[0] === request[0] && frame[1] === request[1];
    return { framing, broadcast, shortest: 9, longest: 260, size: tcpReplySize, isOwn };
  }
  const isOwn = (/** @type {Uint8Array} */ frame) => frame[0] === request[0];
  return { framing, broadcast, shortest: 5, longest: 256, size: rtuReplySize, isOwn };
}

/**
 * The content of a reply to `request`: words, bits as 0 or 1, the echoed value, or nothing for a block write.
 *
 * Raises FrameError unless this is a valid answer; its subclass ExceptionReplyError has the device's code.
 * @param {ModbusRequest} request @param {Uint8Array} reply @param {ModbusProfile} profile
 * @param {string} [framing] @param {number} [transaction]
 * @returns {number[]}
 */
export function parseModbusReply(request, reply, profile, framing = "rtu", transaction = 0) {
  checkFraming(framing, profile);
  checkBytes(reply);
  const pdu = framing === "tcp" ? openTcp(request, reply, transaction & 0xffff) : openRtu(request, reply, framing);
  if (pdu[0] !== request.function) throw new ExceptionReplyError(pdu[1], profile.exceptions[pdu[1]]);
  return answerOf(request, pdu);
}

/** @param {ModbusRequest} request @param {Uint8Array} reply @param {string} framing */
function openRtu(request, reply, framing) {
  const around = framing === "pdu" ? 0 : 2;
  const end = reply.length - around;
  if (end < 3) throw new FrameError("short_frame", `${reply.length} bytes are too few for a reply`);
  const size = rtuReplySize(reply);
  if (size !== null && (reply[1] & 0x7f) === request.function) checkReplySize(end + 2, size);
  if (around && modbusCrc(reply.subarray(0, end)) !== (reply[end] | (reply[end + 1] << 8))) {
    throw new FrameError("bad_crc", "the CRC of the reply is wrong");
  }
  checkReplyHead(request, reply[0], reply[1]);
  return reply.subarray(1, end);
}

/** @param {ModbusRequest} request @param {Uint8Array} reply @param {number} transaction */
function openTcp(request, reply, transaction) {
  if (reply.length < 9) throw new FrameError("short_frame", `${reply.length} bytes are too few for a reply`);
  const [number, protocol, size] = wordsOfBytes(reply.subarray(0, 6));
  if (protocol !== 0) throw new FrameError("bad_protocol", "the protocol number is not 0");
  checkReplySize(reply.length, 6 + size);
  if (number !== transaction) {
    throw new FrameError("wrong_transaction", `the reply is to transaction ${number} instead of ${transaction}`);
  }
  checkReplyHead(request, reply[6], reply[7]);
  if (reply[7] & 0x80) checkReplySize(size - 1, 2);
  else if (!MODBUS_READS.includes(request.function)) checkReplySize(size - 1, 5);
  return reply.subarray(7);
}

/** @param {number} size @param {number} expected */
function checkReplySize(size, expected) {
  if (size === expected) return;
  const status = size < expected ? "short_frame" : "long_frame";
  throw new FrameError(status, `the reply has ${size} bytes where ${expected} belong`);
}

/** @param {ModbusRequest} request @param {number} unit @param {number} code */
function checkReplyHead(request, unit, code) {
  if (unit !== request.unit) {
    throw new FrameError("wrong_unit", `unit ${unit} answered instead of ${request.unit}`);
  }
  if ((code & 0x7f) !== request.function) {
    const text = `the reply is to function ${hex2(code & 0x7f)}h instead of ${hex2(request.function)}h`;
    throw new FrameError("wrong_function", text);
  }
}

/** @param {ModbusRequest} request @param {Uint8Array} pdu @returns {number[]} */
function answerOf(request, pdu) {
  const { count = 0, values = [] } = request;
  if (MODBUS_READS.includes(request.function)) {
    const areBits = request.function === READ_COILS || request.function === READ_DISCRETE;
    const size = areBits ? (count + 7) >> 3 : count * 2;
    const data = pdu.subarray(2);
    if (pdu[1] !== size || data.length !== size) {
      const has = pdu[1] === size ? data.length : pdu[1];
      throw new FrameError("bad_byte_count", `the reply has ${has} data bytes where ${size} belong`);
    }
    if (!areBits) return wordsOfBytes(data);
    return Array.from({ length: count }, (_, at) => (data[at >> 3] >> (at & 7)) & 1);
  }
  if (!values.length) throw new FrameError("echo_mismatch", "the reply repeats a request without values");
  const head = headOf(request);
  if (pdu.length !== head.length || head.some((byte, at) => byte !== pdu[at])) throw otherEcho(request, head, pdu);
  return MODBUS_ECHOES.includes(request.function) ? [...values] : [];
}

/** The error for a reply that does not repeat a write; of one register it has what the device took.
 * @param {ModbusRequest} request @param {readonly number[]} head @param {Uint8Array} pdu @returns {FrameError} */
function otherEcho(request, head, pdu) {
  const [to, written] = wordsOfBytes(Uint8Array.from(head.slice(1)));
  const [at, answered] = wordsOfBytes(pdu.subarray(1));
  if (request.function === WRITE_REGISTER && at === to) {
    const text = `${written} was written to ${hex4(to)}h, but the device answered ${answered}`;
    return new EchoError(text, [written], [answered]);
  }
  const repeats = `but the reply repeats ${hex4(answered)}h at ${hex4(at)}h`;
  return new FrameError("echo_mismatch", `${hex4(written)}h was written to ${hex4(to)}h, ${repeats}`);
}

/** A word as four hexadecimal digits. @param {number} word */
function hex4(word) {
  return hex2(word >> 8) + hex2(word & 0xff);
}
