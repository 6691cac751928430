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
export function modbusBase(...where: (number | Readonly<Record<string, number>> | Partial<ModbusBase>)[]): ModbusBase;
/** @param {string} name @param {number} code @param {readonly number[]} marker @param {readonly number[]} places
 * @param {number} end @returns {ModbusChain} */
export function modbusChain(name: string, code: number, marker: readonly number[], places: readonly number[], end: number): ModbusChain;
/** The bases of one device, as far as they are known. */
export class ModbusBases {
    /** @param {import("./table.js").DeviceFacts} facts @param {ReadWords} read
     * @param {Record<string, unknown>} options */
    constructor({ bases, given, chain }: import("./table.js").DeviceFacts, read: ReadWords, options: Record<string, unknown>);
    bases: Readonly<Record<string, ModbusBase>>;
    chain: ModbusChain | undefined;
    read: ReadWords;
    /** @type {Map<string, BlockStart>} */
    starts: Map<string, BlockStart>;
    /** @type {Map<string, BlockStart>} */
    behind: Map<string, BlockStart>;
    /** @type {Record<string, number>} */
    numbers: Record<string, number>;
    /** @type {Map<number, BlockStart> | BlockError | undefined} */
    found: Map<number, BlockStart> | BlockError | undefined;
    /** Set a base that is known from elsewhere; raises RequestError if it is invalid.
     * @param {string} name @param {number} address @param {number} [last] */
    put(name: string, address: number, last?: number): void;
    /** Forget the blocks; they are searched again when needed. */
    forget(): void;
    /** The blocks of the device by their ids, found once. @returns {Promise<Map<number, BlockStart>>} */
    blocks(): Promise<Map<number, BlockStart>>;
    /** The address of a base. Raises BlockError, or RequestError if a number was not given. @param {string} name
     * @returns {Promise<BlockStart>} */
    start(name: string): Promise<BlockStart>;
    /** @private @param {string} name @param {ModbusBase} base @param {number} id @returns {Promise<BlockStart>} */
    private inBlock;
}
/**
 * A base of addresses: `offset` plus multiples of given numbers, or a place in the found block with this id: `offset`
 * words after the start of the block, plus multiples of the words at the addresses of `counts`.
 */
export type ModbusBase = {
    offset: number;
    factors: Readonly<Record<string, number>>;
    block?: number;
    counts: Readonly<Record<number, number>>;
};
/**
 * Blocks after a `marker` at one of `places`: each starts with its id and the number of words that follow these two.
 */
export type ModbusChain = {
    name: string;
    function: number;
    marker: readonly number[];
    places: readonly number[];
    end: number;
};
/**
 * The address that others count from, and the last address relative to it.
 */
export type BlockStart = {
    address: number;
    last: number;
};
export type ReadWords = (address: number, count: number) => Promise<number[]>;
import { BlockError } from "./errors.js";
