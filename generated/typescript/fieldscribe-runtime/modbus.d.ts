/** @param {string} space @param {number} code @param {number} address @param {number} count @param {string} [base]
 * @returns {ModbusBlock} */
export function modbusBlock(space: string, code: number, address: number, count: number, base?: string): ModbusBlock;
/** The function that reads a place; raises RequestError for an unknown space. @param {Place} at @returns {number} */
export function readFunction(at: Place): number;
/**
 * The fewest reads of all places, from the lowest address on.
 *
 * A read never splits a place, has no more items than the function allows (unless a text alone has more), and touches
 * no other addresses, except those that are known to be readable, by `isBridge`.
 * @param {readonly Place[]} places @param {import("./modbus-frames.js").ModbusProfile} profile
 * @param {(spot: string) => boolean} isBridge @returns {ModbusBlock[]}
 */
export function planReads(places: readonly Place[], profile: import("./modbus-frames.js").ModbusProfile, isBridge: (spot: string) => boolean): ModbusBlock[];
/** A device on a Modbus line or network. */
export class ModbusDevice extends Session {
    /** @param {import("./receiving.js").Line} line @param {import("./session.js").DeviceOptions} options */
    constructor(line: import("./receiving.js").Line, options: import("./session.js").DeviceOptions);
    _framing: string;
    _transaction: number;
    _bases: ModbusBases | undefined;
    /** Addresses between points that no read may span. @type {Set<string>} */
    _gaps: Set<string>;
    /** @type {Set<string> | undefined} */
    _readableSpots: Set<string> | undefined;
    /** Set a base that is known from elsewhere, and the last address that counts from it.
     * @param {string} name @param {number} address @param {number} [last] */
    setBase(name: string, address: number, last?: number): void;
    /** The address of each block that the addresses of points may count from, and its last word, by id. They are found
     * when the first of them is needed, and anew after `forget()`. Raises BlockError.
     * @returns {Promise<Map<number, { address: number, last: number }>>} */
    findBlocks(): Promise<Map<number, {
        address: number;
        last: number;
    }>>;
    /** Read words or bits by address, as plain numbers.
     * @param {string} space @param {number} address @param {number} [count] @returns {Promise<number[]>} */
    readAt(space: string, address: number, count?: number): Promise<number[]>;
    /** Write words or bits by address. Nothing is checked: this can set what no point allows.
     * @param {string} space @param {number} address @param {...number} values @returns {Promise<void>} */
    writeAt(space: string, address: number, ...values: number[]): Promise<void>;
    /** One request and its reply. @param {number} code @param {number} address @param {number} count
     * @param {readonly number[]} [values] @returns {Promise<number[]>} */
    _ask(code: number, address: number, count: number, values?: readonly number[]): Promise<number[]>;
    /** The address of a base, if addresses up to `last` are within it. @param {string | undefined} base
     * @param {number} last @returns {Promise<number>} */
    _start(base: string | undefined, last: number): Promise<number>;
    /** Read words or bits; a text that is longer than a request needs several.
     * @param {number} code @param {number} address @param {number} count @returns {Promise<number[]>} */
    _words(code: number, address: number, count: number): Promise<number[]>;
    /** @param {Place} at @param {number} count @returns {number} */
    _writeFunction(at: Place, count: number): number;
    /** Read points by one request; a long text by several. @param {ModbusBlock} block @param {readonly AnyPoint[]} points
     * @returns {Promise<import("./session.js").PointRaws>} */
    _readBlock(block: ModbusBlock, points: readonly AnyPoint[]): Promise<import("./session.js").PointRaws>;
    /** @param {readonly AnyPoint[]} points @param {ModbusBlock} block */
    _noteGaps(points: readonly AnyPoint[], block: ModbusBlock): void;
    /** The addresses of points, and between them, that the device has refused. @returns {Set<string>} */
    _holes(): Set<string>;
    /** Returns a test for addresses of points that are known to exist and to be readable.
     * @returns {(spot: string) => boolean} */
    _bridges(): (spot: string) => boolean;
}
export type Place = import("./places.js").Place;
export type AnyPoint = import("./table.js").AnyPoint;
/**
 * One read: `count` words or bits from `address` on.
 */
export type ModbusBlock = {
    space: string;
    function: number;
    address: number;
    count: number;
    base?: string;
};
import { Session } from "./session.js";
import { ModbusBases } from "./bases.js";
