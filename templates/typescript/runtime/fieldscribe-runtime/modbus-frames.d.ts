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
export function modbusProfile(facts: Partial<ModbusProfile> & Pick<ModbusProfile, "functions">): ModbusProfile;
/** The CRC-16 of RTU frames; its low byte is sent first. @param {Uint8Array} data @returns {number} */
export function modbusCrc(data: Uint8Array): number;
/** Raises RequestError (bad_framing) if the device does not support the framing.
 * @param {string} framing @param {ModbusProfile} profile */
export function checkFraming(framing: string, profile: ModbusProfile): void;
/** Raises RequestError if the device does not take such a request.
 * @param {ModbusRequest} request @param {ModbusProfile} profile */
export function checkModbusRequest(request: ModbusRequest, profile: ModbusProfile): void;
/**
 * The bytes of a request; raises RequestError if the device does not take it.
 * @param {ModbusRequest} request @param {ModbusProfile} profile @param {string} [framing] @param {number} [transaction]
 * @returns {Uint8Array}
 */
export function buildModbusRequest(request: ModbusRequest, profile: ModbusProfile, framing?: string, transaction?: number): Uint8Array;
/** The length of the RTU reply that begins with these bytes; null while they are too few, or if it cannot be told.
 * @param {Uint8Array} received @returns {number | null} */
export function rtuReplySize(received: Uint8Array): number | null;
/** The length of the TCP reply that begins with these bytes; null while they are too few.
 * @param {Uint8Array} received @returns {number | null} */
export function tcpReplySize(received: Uint8Array): number | null;
/**
 * What a line must know of the reply to a request.
 * @param {Uint8Array} request @param {string} framing @param {boolean} broadcast
 * @returns {import("./receiving.js").ReplyShape}
 */
export function modbusReplyShape(request: Uint8Array, framing: string, broadcast: boolean): import("./receiving.js").ReplyShape;
/**
 * The content of a reply to `request`: words, bits as 0 or 1, the echoed value, or nothing for a block write.
 *
 * Raises FrameError unless this is a valid answer; its subclass ExceptionReplyError has the device's code.
 * @param {ModbusRequest} request @param {Uint8Array} reply @param {ModbusProfile} profile
 * @param {string} [framing] @param {number} [transaction]
 * @returns {number[]}
 */
export function parseModbusReply(request: ModbusRequest, reply: Uint8Array, profile: ModbusProfile, framing?: string, transaction?: number): number[];
export const READ_COILS: 1;
export const READ_DISCRETE: 2;
export const READ_HOLDING: 3;
export const READ_INPUT: 4;
export const WRITE_COIL: 5;
export const WRITE_REGISTER: 6;
export const DIAGNOSTICS: 8;
export const WRITE_COILS: 15;
export const WRITE_REGISTERS: 16;
/** @type {readonly number[]} */
export const MODBUS_READS: readonly number[];
/** @type {readonly number[]} */
export const MODBUS_WRITES: readonly number[];
/**
 * What a device supports: functions with the most items of one request, unit numbers, and its peculiarities.
 *
 * `broadcast` is the unit number of all units, `broadcasts` the functions that may be sent to it.
 */
export type ModbusProfile = {
    functions: Readonly<Record<number, number>>;
    units: readonly [number, number];
    broadcast: number | null;
    padCoilBytesEven: boolean;
    exceptions: Readonly<Record<number, string>>;
    broadcasts: readonly number[];
    framings: readonly string[];
};
/**
 * One request. Reads name `count`, writes `values`; a loop-back test (08h) sends values[0] to `address` 0.
 */
export type ModbusRequest = {
    unit: number;
    function: number;
    address: number;
    count?: number;
    values?: readonly number[];
};
/**
 * `pdu` is the unit and the request, without the rest of the frame.
 */
export type ModbusFraming = "rtu" | "tcp" | "pdu";
