// SPDX-License-Identifier: 0BSD
/** Bases of addresses: from numbers that are given when a device is opened, or blocks that are found in it. */
import { BlockError, ExceptionReplyError, FieldscribeError, RequestError, shown } from "./errors.js";
import { checkNumber } from "./receiving.js";

const LAST_ADDRESS = 0xffff;
/** The most blocks that a search reads, so that a broken device cannot keep the line busy. */
const MOST_BLOCKS = 256;

/**
 * A base of addresses: `offset` plus multiples of given numbers, or a place in the found block with this id: `offset`
 * words after the start of the block, plus multiples of the words at the addresses of `counts`.
 * @typedef {{ offset: number, factors: Readonly<Record<string, number>>, block?: number,
 *   counts: Readonly<Record<number, number>> }} ModbusBase
 */

/**
 * Blocks after a `marker` at one of `places`: each starts with its id and the number of words that follow these two.
 * @typedef {{ name: string, function: number, marker: readonly number[], places: readonly number[],
 *   end: number }} ModbusChain
 */

/** The address that others count from, and the last address relative to it.
 * @typedef {{ address: number, last: number }} BlockStart */

/** @typedef {(address: number, count: number) => Promise<number[]>} ReadWords */

/** @param {...(number | Readonly<Record<string, number>> | Partial<ModbusBase>)} where offset and factors, or facts
 * @returns {ModbusBase} */
export function modbusBase(...where) {
  const [offset, factors] = where;
  if (typeof offset === "number") {
    return { offset, factors: /** @type {Record<string, number>} */ (factors ?? {}), counts: {} };
  }
  return { offset: 0, factors: {}, counts: {}, .../** @type {Partial<ModbusBase>} */ (offset) };
}

/** @param {string} name @param {number} code @param {readonly number[]} marker @param {readonly number[]} places
 * @param {number} end @returns {ModbusChain} */
export function modbusChain(name, code, marker, places, end) {
  return { name, function: code, marker, places, end };
}

/** The bases of one device, as far as they are known. */
export class ModbusBases {
  /** @param {import("./table.js").DeviceFacts} facts @param {ReadWords} read
   * @param {Record<string, unknown>} options */
  constructor({ bases = {}, given = {}, chain }, read, options) {
    this.bases = bases;
    this.chain = chain;
    this.read = read;
    /** @type {Map<string, BlockStart>} */
    this.starts = new Map();
    /** @type {Map<string, BlockStart>} */
    this.behind = new Map();
    /** @type {Record<string, number>} */
    this.numbers = {};
    /** @type {Map<number, BlockStart> | BlockError | undefined} */
    this.found = undefined;
    for (const [name, [low, high]] of Object.entries(given)) {
      const number = options[name.replace(/(?!^)_([a-z0-9])/g, (_, letter) => letter.toUpperCase())] ?? options[name];
      if (number === undefined) continue;
      checkNumber("bad_base", name, /** @type {number} */ (number), [low, high]);
      this.numbers[name] = /** @type {number} */ (number);
    }
  }

  /** Set a base that is known from elsewhere; raises RequestError if it is invalid.
   * @param {string} name @param {number} address @param {number} [last] */
  put(name, address, last = LAST_ADDRESS - address) {
    if (!(name in this.bases)) {
      throw new RequestError("bad_base", `there is no base ${shown(name)}, only ${Object.keys(this.bases).join(", ")}`);
    }
    checkNumber("bad_base", "the base", address, [0, LAST_ADDRESS]);
    checkNumber("bad_base", "the last address", last, [0, LAST_ADDRESS - address]);
    this.starts.set(name, { address, last });
  }

  /** Forget the blocks; they are searched again when needed. */
  forget() {
    this.found = undefined;
    this.behind.clear();
  }

  /** The blocks of the device by their ids, found once. @returns {Promise<Map<number, BlockStart>>} */
  async blocks() {
    if (!this.chain) throw new BlockError("no_marker", "the addresses of this device count from no found block");
    if (!this.found) {
      try {
        this.found = await walkChain(this.chain, this.read);
      } catch (error) {
        if (error instanceof BlockError) this.found = error;
        throw error;
      }
    }
    if (this.found instanceof FieldscribeError) throw this.found.copied();
    return this.found;
  }

  /** The address of a base. Raises BlockError, or RequestError if a number was not given. @param {string} name
   * @returns {Promise<BlockStart>} */
  async start(name) {
    const known = this.starts.get(name) ?? this.behind.get(name);
    if (known) return known;
    const base = this.bases[name];
    if (base.block !== undefined) return this.inBlock(name, base, base.block);
    const missing = Object.keys(base.factors).find((each) => !(each in this.numbers));
    if (missing !== undefined) {
      throw new RequestError("bad_base", `where this is depends on ${missing}: open the device with ${missing}`);
    }
    let address = base.offset;
    for (const [each, factor] of Object.entries(base.factors)) address += this.numbers[each] * factor;
    return { address, last: LAST_ADDRESS - address };
  }

  /** @private @param {string} name @param {ModbusBase} base @param {number} id @returns {Promise<BlockStart>} */
  async inBlock(name, base, id) {
    const blocks = await this.blocks();
    const start = blocks.get(id);
    if (!start) {
      throw new BlockError(
        "no_block",
        `the device has no block ${id}, only ${[...blocks.keys()].join(", ") || "none"}`,
      );
    }
    const counts = Object.entries(base.counts);
    if (!base.offset && !counts.length) return start;
    let words = base.offset;
    for (const [address, factor] of counts) words += factor * (await this.read(start.address + Number(address), 1))[0];
    if (words > start.last) throw new BlockError("behind_end", `${name} lies behind the end of the block ${id}`);
    const behind = { address: start.address + words, last: start.last - words };
    this.behind.set(name, behind);
    return behind;
  }
}

/** The start of each block by its id; the first one of two with the same id. Raises BlockError.
 * @param {ModbusChain} chain @param {ReadWords} read @returns {Promise<Map<number, BlockStart>>} */
async function walkChain(chain, read) {
  let place = await chainStart(chain, read);
  /** @type {Map<number, BlockStart>} */
  const found = new Map();
  for (let walked = 0; walked < MOST_BLOCKS; walked++) {
    if (place > LAST_ADDRESS) {
      throw new BlockError("bad_chain", `the blocks of ${chain.name} do not end before the address 65536`);
    }
    const [block, length = 0] = await read(place, place === LAST_ADDRESS ? 1 : 2);
    if (block === chain.end) return found;
    const last = 1 + length;
    if (place + last > LAST_ADDRESS) {
      const text = `the block ${block} of ${chain.name} at ${place} has ${length} words, and ends beyond 65535`;
      throw new BlockError("bad_chain", text);
    }
    if (!found.has(block)) found.set(block, { address: place, last });
    place += last + 1;
  }
  throw new BlockError("bad_chain", `${chain.name} has more than ${MOST_BLOCKS} blocks`);
}

/** The address after the marker; a place that the device refuses has none.
 * @param {ModbusChain} chain @param {ReadWords} read @returns {Promise<number>} */
async function chainStart({ name, marker, places }, read) {
  for (const place of places) {
    try {
      const words = await read(place, marker.length);
      if (words.every((word, at) => word === marker[at])) return place + marker.length;
    } catch (error) {
      if (!(error instanceof ExceptionReplyError) || error.lost) throw error;
    }
  }
  throw new BlockError("no_marker", `nothing at ${places.join(", ")} says where the blocks of ${name} start`);
}
