// SPDX-License-Identifier: 0BSD
/**
 * Modbus devices over a client of the package `modbus-serial`, which frames and checks requests itself:
 *
 *     const client = new ModbusRTU();
 *     await client.connectTCP("192.168.0.20");
 *     const drive = new HitachiL200(new ModbusSerialLine(client), { unit: 1 });
 */
import { FrameError, LineError, NoReplyError, RequestError } from "./errors.js";
import {
  READ_COILS,
  READ_DISCRETE,
  READ_HOLDING,
  READ_INPUT,
  WRITE_COIL,
  WRITE_COILS,
  WRITE_REGISTER,
  WRITE_REGISTERS,
} from "./modbus-frames.js";
import { hex2, wordsOfBytes } from "./receiving.js";

/** @typedef {(error: any, result: any) => void} NodeCallback */

/**
 * What a line needs of a client of `modbus-serial`.
 * @typedef {object} ModbusSerialClient
 * @property {boolean} isOpen
 * @property {(unit: number, address: number, count: number, next: NodeCallback) => void} writeFC1
 * @property {(unit: number, address: number, count: number, next: NodeCallback) => void} writeFC2
 * @property {(unit: number, address: number, count: number, next: NodeCallback) => void} writeFC3
 * @property {(unit: number, address: number, count: number, next: NodeCallback) => void} writeFC4
 * @property {(unit: number, address: number, state: boolean, next: NodeCallback) => void} writeFC5
 * @property {(unit: number, address: number, value: number, next: NodeCallback) => void} writeFC6
 * @property {(unit: number, address: number, states: boolean[], next: NodeCallback) => void} writeFC15
 * @property {(unit: number, address: number, values: number[], next: NodeCallback) => void} writeFC16
 */

/** What the client says of wrong replies. @type {readonly (readonly [string, RegExp])[]} */
const CLIENT_FAULTS = [
  ["bad_crc", /CRC/],
  ["wrong_unit", /address/i],
  ["wrong_function", /code/i],
];

/** A line over a client that is connected; it keeps the client's timeout. It has no loop-back test and no padding. */
export class ModbusSerialLine {
  /** @param {ModbusSerialClient} client */
  constructor(client) {
    this.client = client;
    this.framing = "pdu";
    /** @type {Promise<unknown>} */
    this._turn = Promise.resolve();
  }

  /** @param {Uint8Array} request @param {import("./receiving.js").ReplyShape} reply @returns {Promise<Uint8Array>} */
  exchange(request, reply) {
    const turn = this._turn.then(() => this._exchanged(request, reply.broadcast));
    this._turn = turn.catch(() => undefined);
    return turn;
  }

  /** @param {Uint8Array} request @param {boolean} isToAll @returns {Promise<Uint8Array>} */
  async _exchanged(request, isToAll) {
    try {
      if (!this.client.isOpen) throw new LineError("the client is not connected", true);
      const result = await new Promise((resolve, reject) => {
        callClient(this.client, request, (error, found) => (error ? reject(error) : resolve(found)));
      });
      return replyOfClient(request, result);
    } catch (error) {
      const { modbusCode, errno, name, message } = /** @type {any} */ (error);
      if (modbusCode !== undefined) return Uint8Array.of(request[0], request[1] | 0x80, modbusCode);
      if (errno === "ETIMEDOUT" || name === "TransactionTimedOutError") {
        if (isToAll) return new Uint8Array(0);
        throw new NoReplyError("no reply came in time");
      }
      if (error instanceof LineError || error instanceof RequestError) throw error;
      if (errno) throw new LineError(String(message ?? errno));
      const [status] = CLIENT_FAULTS.find(([, words]) => words.test(message)) ?? ["short_frame"];
      throw new FrameError(status, String(message));
    }
  }
}

/** @param {ModbusSerialClient} client @param {Uint8Array} request @param {NodeCallback} next */
function callClient(client, request, next) {
  const [unit, code] = request;
  const [address, value] = wordsOfBytes(request.subarray(2, 6));
  const data = request.subarray(7);
  if (code === READ_COILS) client.writeFC1(unit, address, value, next);
  else if (code === READ_DISCRETE) client.writeFC2(unit, address, value, next);
  else if (code === READ_HOLDING) client.writeFC3(unit, address, value, next);
  else if (code === READ_INPUT) client.writeFC4(unit, address, value, next);
  else if (code === WRITE_COIL) client.writeFC5(unit, address, value !== 0, next);
  else if (code === WRITE_REGISTER) client.writeFC6(unit, address, value, next);
  else if (code === WRITE_REGISTERS) client.writeFC16(unit, address, wordsOfBytes(data), next);
  else if (code === WRITE_COILS && data.length === (value + 7) >> 3) {
    client.writeFC15(
      unit,
      address,
      Array.from({ length: value }, (_, at) => ((data[at >> 3] >> (at & 7)) & 1) === 1),
      next,
    );
  } else throw new RequestError("bad_function", `modbus-serial cannot send ${[...request].map(hex2).join(" ")}`);
}

/** @param {Uint8Array} request @param {{ buffer?: Uint8Array, address?: number, state?: boolean, value?: number,
 *   length?: number }} result @returns {Uint8Array} */
function replyOfClient(request, { buffer, address = 0, state, value, length }) {
  const [unit, code] = request;
  if (buffer) return Uint8Array.of(unit, code, buffer.length, ...buffer);
  const word = value ?? length ?? (state ? 0xff00 : 0);
  return Uint8Array.of(unit, code, address >> 8, address & 0xff, word >> 8, word & 0xff);
}
