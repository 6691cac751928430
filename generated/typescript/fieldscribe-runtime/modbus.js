// SPDX-License-Identifier: 0BSD
/** Modbus devices on a line: planned reads, and words read and written by point or by address. */
import { ModbusBases } from "./bases.js";
import { BlockError, RequestError, shown } from "./errors.js";
import {
  buildModbusRequest,
  checkFraming,
  modbusReplyShape,
  MODBUS_READS,
  MODBUS_WRITES,
  parseModbusReply,
  READ_COILS,
  READ_DISCRETE,
  READ_HOLDING,
  READ_INPUT,
  WRITE_COIL,
  WRITE_COILS,
  WRITE_REGISTER,
  WRITE_REGISTERS,
} from "./modbus-frames.js";
import { areaOf, ascending, highestOf, lowestOf, place, placeLabel, runsOf } from "./places.js";
import { checkNumber } from "./receiving.js";
import { Session } from "./session.js";
import { checkUnit, ownOf, pointExists } from "./table.js";

/** @typedef {import("./places.js").Place} Place */
/** @typedef {import("./table.js").AnyPoint} AnyPoint */
/** One read: `count` words or bits from `address` on.
 * @typedef {{ space: string, function: number, address: number, count: number, base?: string }} ModbusBlock */

/** @type {Readonly<Record<string, number>>} */
const SPACE_READS = { coil: READ_COILS, discrete: READ_DISCRETE, holding: READ_HOLDING, input: READ_INPUT };
/** @type {Readonly<Record<string, readonly [number, number]>>} */
const SPACE_WRITES = { coil: [WRITE_COIL, WRITE_COILS], holding: [WRITE_REGISTER, WRITE_REGISTERS] };

/** @param {string} space @param {number} code @param {number} address @param {number} count @param {string} [base]
 * @returns {ModbusBlock} */
export function modbusBlock(space, code, address, count, base) {
  return { space, function: code, address, count, base };
}

/** Whether a block brings all of a place. @param {ModbusBlock} block @param {Place} at */
function covers(block, at) {
  if (block.space !== at.space || block.base !== at.base) return false;
  return block.address <= lowestOf(at) && highestOf(at) < block.address + block.count;
}

/** Whether words of others lie between those of a place. @param {Place} at */
function isScattered(at) {
  return at.addresses.length > 1 && highestOf(at) - lowestOf(at) >= at.addresses.length;
}

/** A word or bit of an area, as text. @param {string} area @param {number} address */
function spot(area, address) {
  return `${area} ${address}`;
}

/** The words or bits of a block. @param {ModbusBlock} block @returns {string[]} */
function spotsOf(block) {
  const area = block.base === undefined ? block.space : `${block.space} from ${block.base}`;
  return Array.from({ length: block.count }, (_, at) => spot(area, block.address + at));
}

/** The function that reads a place; raises RequestError for an unknown space. @param {Place} at @returns {number} */
export function readFunction(at) {
  const usual = SPACE_READS[at.space];
  if (usual === undefined) {
    const known = Object.keys(SPACE_READS).join(", ");
    throw new RequestError("bad_space", `there is no space ${shown(at.space)}, only ${known}`);
  }
  return at.function !== undefined && MODBUS_READS.includes(at.function) ? at.function : usual;
}

/**
 * The fewest reads of all places, from the lowest address on.
 *
 * A read never splits a place, has no more items than the function allows (unless a text alone has more), and touches
 * no other addresses, except those that are known to be readable, by `isBridge`.
 * @param {readonly Place[]} places @param {import("./modbus-frames.js").ModbusProfile} profile
 * @param {(spot: string) => boolean} isBridge @returns {ModbusBlock[]}
 */
export function planReads(places, profile, isBridge) {
  const reads = places.map((at) => {
    const address = lowestOf(at);
    return { area: areaOf(at), code: readFunction(at), address, count: highestOf(at) - address + 1, at };
  });
  reads.sort(
    (one, other) =>
      (one.area < other.area ? -1 : Number(one.area > other.area)) ||
      one.code - other.code ||
      one.address - other.address ||
      one.count - other.count,
  );
  /** @type {ModbusBlock[]} */
  const blocks = [];
  let lastArea = "";
  for (const { area, code, address, count, at } of reads) {
    const last = blocks[blocks.length - 1];
    if (last && lastArea === area && last.function === code) {
      const end = last.address + last.count;
      const merged = Math.max(end, address + count) - last.address;
      const between = Array.from({ length: Math.max(0, address - end) }, (_, gap) => spot(area, end + gap));
      if (merged <= (profile.functions[code] ?? 1) && between.every(isBridge)) {
        last.count = merged;
        continue;
      }
    }
    blocks.push(modbusBlock(at.space, code, address, count, at.base));
    lastArea = area;
  }
  return blocks;
}

/** A device on a Modbus line or network. */
export class ModbusDevice extends Session {
  /** @param {import("./receiving.js").Line} line @param {import("./session.js").DeviceOptions} options */
  constructor(line, options) {
    super(line, options);
    this._framing = line.framing ?? "rtu";
    checkFraming(this._framing, this._profile);
    if (this.unit !== this._profile.broadcast) checkUnit(this.unit, this._profile.units);
    this._transaction = 0;
    const { facts } = this.table;
    /** @param {number} address @param {number} count */
    const readChain = async (address, count) => {
      if (!facts.chain || this.unit === this._profile.broadcast) {
        throw new BlockError("no_marker", "blocks are found in a single unit: setBase says where they are");
      }
      return this._ask(facts.chain.function, address, count);
    };
    this._bases = facts.bases ? new ModbusBases(facts, readChain, options) : undefined;
    /** Addresses between points that no read may span. @type {Set<string>} */
    this._gaps = new Set();
    /** @type {Set<string> | undefined} */
    this._readableSpots = undefined;
  }

  /** Set a base that is known from elsewhere, and the last address that counts from it.
   * @param {string} name @param {number} address @param {number} [last] */
  setBase(name, address, last) {
    if (!this._bases) throw new RequestError("bad_base", "the addresses of this device count from 0");
    this._bases.put(name, address, last);
  }

  /** Read everything anew, and search blocks anew. */
  forget() {
    super.forget();
    this._gaps.clear();
    this._bases?.forget();
  }

  /** The address of each block that the addresses of points may count from, and its last word, by id. They are found
   * when the first of them is needed, and anew after `forget()`. Raises BlockError.
   * @returns {Promise<Map<number, { address: number, last: number }>>} */
  findBlocks() {
    return this._run(async () => {
      if (!this._bases) throw new BlockError("no_marker", "the addresses of this device count from no found block");
      return this._bases.blocks();
    });
  }

  /** Read words or bits by address, as plain numbers.
   * @param {string} space @param {number} address @param {number} [count] @returns {Promise<number[]>} */
  readAt(space, address, count = 1) {
    return this._run(async () => {
      const at = place(space, [address]);
      checkNumber("bad_address", "address", address, [0, 0xffff]);
      checkNumber("bad_count", "the number of words or bits", count, [1, 0x10000]);
      return this._about(placeLabel(at), () => this._ask(readFunction(at), address, count));
    });
  }

  /** Write words or bits by address. Nothing is checked: this can set what no point allows.
   * @param {string} space @param {number} address @param {...number} values @returns {Promise<void>} */
  writeAt(space, address, ...values) {
    return this._run(async () => {
      checkNumber("bad_address", "address", address, [0, 0xffff]);
      checkNumber("bad_count", "the number of words or bits", values.length, [1, 0x10000]);
      const at = place(
        space,
        values.map((_, each) => address + each),
      );
      const code = this._writeFunction(at, values.length);
      if (values.length > (this._profile.functions[code] ?? 0)) {
        buildModbusRequest({ unit: this.unit, function: code, address, values }, this._profile, this._framing);
      }
      await this._about(placeLabel(at), () => this._put(at, values));
    });
  }

  /** One request and its reply. @param {number} code @param {number} address @param {number} count
   * @param {readonly number[]} [values] @returns {Promise<number[]>} */
  async _ask(code, address, count, values = []) {
    const request = { unit: this.unit, function: code, address, count, values };
    const isToAll = this.unit === this._profile.broadcast;
    return this._retried(isToAll ? 0 : this.retries, async () => {
      const transaction = this._framing === "tcp" ? (this._transaction = (this._transaction + 1) & 0xffff) : 0;
      const frame = buildModbusRequest(request, this._profile, this._framing, transaction);
      const name = code.toString(16).toUpperCase().padStart(2, "0");
      const awaited = `unit ${this.unit} did not reply to function ${name}h`;
      const shape = modbusReplyShape(frame, this._framing, isToAll);
      const sent = this._exchange(frame, shape, awaited);
      if (!isToAll) return parseModbusReply(request, await sent, this._profile, this._framing, transaction);
      await sent.catch((error) => {
        if (error.status !== "timeout") throw error;
      });
      return [];
    });
  }

  /** The address of a base, if addresses up to `last` are within it. @param {string | undefined} base
   * @param {number} last @returns {Promise<number>} */
  async _start(base, last) {
    if (base === undefined || !this._bases) return 0;
    const start = await this._bases.start(base);
    if (last > start.last) {
      throw new BlockError(
        "behind_end",
        `the block of ${base} ends at its word ${start.last}, before the word ${last}`,
      );
    }
    return start.address;
  }

  /** @param {AnyPoint[]} points @returns {Promise<AnyPoint[]>} */
  async _there(points) {
    const base = points[0]?.at.base;
    if (base === undefined || this.table.facts.bases?.[base].block === undefined || !this._bases) return points;
    try {
      const { last } = await this._bases.start(base);
      return points.filter((point) => highestOf(point.at) <= last);
    } catch (error) {
      if (error instanceof BlockError) return points; // each of them says so when it is read
      throw error;
    }
  }

  /** @param {Place} at @returns {Promise<number[]>} */
  async _get(at) {
    const start = await this._start(at.base, highestOf(at));
    if (isScattered(at)) {
      /** @type {Map<number, number>} */
      const found = new Map();
      for (const block of planReads(runsOf(at), this._profile, this._bridges())) {
        const items = await this._words(block.function, start + block.address, block.count);
        items.forEach((item, each) => found.set(block.address + each, item));
      }
      return ascending(at).map((address) => found.get(address) ?? 0);
    }
    return this._words(readFunction(at), start + lowestOf(at), highestOf(at) - lowestOf(at) + 1);
  }

  /** Read words or bits; a text that is longer than a request needs several.
   * @param {number} code @param {number} address @param {number} count @returns {Promise<number[]>} */
  async _words(code, address, count) {
    const most = this._profile.functions[code] ?? count;
    /** @type {number[]} */
    const words = [];
    while (words.length < count) {
      words.push(...(await this._ask(code, address + words.length, Math.min(most, count - words.length))));
    }
    return words;
  }

  /** @param {Place} at @param {number} count @returns {number} */
  _writeFunction(at, count) {
    const codes = SPACE_WRITES[at.space];
    if (!codes) {
      throw new RequestError("bad_space", `the space ${shown(at.space)} cannot be written, only coil and holding`);
    }
    if (at.function !== undefined && MODBUS_WRITES.includes(at.function)) return at.function;
    return count === 1 && codes[0] in this._profile.functions ? codes[0] : codes[1];
  }

  /** Write words or bits; a text that is longer than a request by several, its first words first.
   * @param {Place} at @param {readonly number[]} words */
  async _store(at, words) {
    const code = this._writeFunction(at, words.length);
    const most = this._profile.functions[code] ?? words.length;
    const start = (await this._start(at.base, highestOf(at))) + lowestOf(at);
    for (let each = 0; each < words.length; each += most) {
      await this._ask(code, start + each, 0, words.slice(each, each + most));
    }
  }

  /** Read several points with few requests, in the blocks that the group was planned in.
   * @param {readonly AnyPoint[]} points @param {string | undefined} group
   * @param {import("./session.js").Refusals} [refusals] @returns {Promise<import("./session.js").PointRaws>} */
  async _gather(points, group, refusals) {
    const holes = this._holes();
    const planned = (group !== undefined && ownOf(this.table.facts.blocks, group)) || [];
    const blocks = planned.filter(
      (block) => points.some((point) => covers(block, point.at)) && !spotsOf(block).some((one) => holes.has(one)),
    );
    const rest = points.filter((point) => !blocks.some((block) => covers(block, point.at)));
    const raws = await super._gather(
      rest.filter((point) => isScattered(point.at)),
      undefined,
      refusals,
    );
    const places = rest.filter((point) => !isScattered(point.at)).map((point) => point.at);
    for (const block of [...blocks, ...planReads(places, this._profile, this._bridges())]) {
      const inside = points.filter((point) => covers(block, point.at) && !raws.has(point));
      const ask = () => this._readBlock(block, inside);
      for (const [point, raw] of await this._part(inside, refusals, ask, block)) raws.set(point, raw);
    }
    return raws;
  }

  /** Read points by one request; a long text by several. @param {ModbusBlock} block @param {readonly AnyPoint[]} points
   * @returns {Promise<import("./session.js").PointRaws>} */
  async _readBlock(block, points) {
    const start = await this._start(block.base, block.address + block.count - 1);
    const words = await this._words(block.function, start + block.address, block.count);
    const own = (/** @type {AnyPoint} */ point) => ascending(point.at).map((address) => words[address - block.address]);
    return new Map(points.map((point) => [point, this._taken(point, own(point))]));
  }

  /** @param {readonly AnyPoint[]} points @param {ModbusBlock} block */
  _noteGaps(points, block) {
    const taken = new Set(
      points.flatMap(({ at }) => at.addresses.map((/** @type {number} */ one) => spot(areaOf(at), one))),
    );
    for (const one of spotsOf(block)) if (!taken.has(one)) this._gaps.add(one);
  }

  /** The addresses of points, and between them, that the device has refused. @returns {Set<string>} */
  _holes() {
    const refused = [...this._refused.keys()].flatMap(({ at }) =>
      at.addresses.map((/** @type {number} */ address) => spot(areaOf(at), address)),
    );
    return new Set([...this._gaps, ...refused]);
  }

  /** Returns a test for addresses of points that are known to exist and to be readable.
   * @returns {(spot: string) => boolean} */
  _bridges() {
    if (!this._readableSpots) {
      this._readableSpots = new Set();
      for (const point of this.table.points.values()) {
        const { onlyFor, uncertain } = point.facts;
        if (!point.decode || uncertain || (onlyFor && this.variants[onlyFor[0]] === undefined)) continue;
        if (!pointExists(point, this.variants)) continue;
        for (const address of point.at.addresses) this._readableSpots.add(spot(areaOf(point.at), address));
      }
    }
    const readable = this._readableSpots;
    const holes = this._holes();
    return (one) => readable.has(one) && !holes.has(one);
  }
}
