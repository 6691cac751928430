/** A point that can only be read. @param {Form} form @param {FactsOfPoint} facts */
export function readOnly(form: Form, facts: FactsOfPoint): ReadOnlyCodec;
/** A point that can only be written. @param {Form} form @param {FactsOfPoint} facts */
export function writeOnly(form: Form, facts: FactsOfPoint): WriteOnlyCodec;
/** A point that can be read and written. @param {Form} form @param {FactsOfPoint} facts */
export function readWrite(form: Form, facts: FactsOfPoint): ReadWriteCodec;
/** A point that a write may keep in EEPROM. @param {Form} form @param {FactsOfPoint} facts */
export function stored(form: Form, facts: FactsOfPoint): ReadWriteCodec & {
    isStored: boolean;
};
/** The same that can only be written. @param {Form} form @param {FactsOfPoint} facts */
export function storedWriteOnly(form: Form, facts: FactsOfPoint): WriteOnlyCodec & {
    isStored: boolean;
};
/** Why a point has no codec, and the addresses of its words, if they can be reached. @param {string} reason
 * @param {{ at?: Place, writeAt?: Place, code?: string }} [facts] */
export function documented(reason: string, facts?: {
    at?: Place;
    writeAt?: Place;
    code?: string;
}): Readonly<{
    at?: Place;
    writeAt?: Place;
    code?: string;
    reason: string;
}>;
export type Raws = import("./rules.js").Raws;
export type Form = import("./forms.js").Form;
export type Place = import("./places.js").Place;
/**
 * The facts of a point. `name` is the description's, `item` differs from that of other variants;
 * `allowed` are the raw numbers that may be written, `fixed` a mask and the bits that are always written there.
 */
export type FactsOfPoint = {
    name: string;
    item?: string;
    at: Place;
    writeAt?: Place;
    bits?: readonly [number, number];
    group?: string;
    code?: string;
    references?: Readonly<Record<string, number | string>>;
    unit?: string;
    display?: number;
    allowed?: import("./rules.js").Allowed;
    default?: number;
    fixed?: readonly [number, number];
    changes?: string;
    changesWith?: readonly string[];
    variant?: readonly [string, string];
    onlyFor?: readonly [string, readonly string[]];
    uncertain?: boolean;
    when?: import("./commands.js").Step["when"];
    conditions?: readonly string[];
    takesEffect?: string;
    selects?: readonly (readonly [string, number])[];
    writeWith?: readonly string[];
    keeps?: string;
};
declare class ReadOnlyCodec extends Codec {
}
declare class WriteOnlyCodec extends Codec {
}
declare class ReadWriteCodec extends ReadOnlyCodec {
}
/** @typedef {import("./rules.js").Raws} Raws */
/** @typedef {import("./forms.js").Form} Form */
/** @typedef {import("./places.js").Place} Place */
/**
 * The facts of a point. `name` is the description's, `item` differs from that of other variants;
 * `allowed` are the raw numbers that may be written, `fixed` a mask and the bits that are always written there.
 * @typedef {{ name: string, item?: string, at: Place, writeAt?: Place, bits?: readonly [number, number], group?: string,
 *   code?: string, references?: Readonly<Record<string, number | string>>, unit?: string, display?: number,
 *   allowed?: import("./rules.js").Allowed, default?: number, fixed?: readonly [number, number], changes?: string,
 *   changesWith?: readonly string[], variant?: readonly [string, string],
 *   onlyFor?: readonly [string, readonly string[]], uncertain?: boolean,
 *   when?: import("./commands.js").Step["when"], conditions?: readonly string[], takesEffect?: string,
 *   selects?: readonly (readonly [string, number])[],
 *   writeWith?: readonly string[], keeps?: string }} FactsOfPoint
 */
/** One data point. Its methods need no device; they depend on its access. */
declare class Codec {
    /** @param {Form} form @param {FactsOfPoint} facts */
    constructor(form: Form, facts: FactsOfPoint);
    facts: FactsOfPoint;
    form: import("./forms.js").Form;
    name: string;
    /** The name, with the variant if only one has the point. */
    item: string;
    at: import("./places.js").Place;
    code: string | undefined;
    group: string;
    unit: string;
    references: Readonly<Record<string, string | number>>;
    lowestBit: number;
    /** The number of bits of the raw number. */
    width: number;
    /** The number of its words (or single bits). */
    size: number;
    least: any;
    greatest: any;
    get access(): string;
    /** Code and name, for messages. */
    get label(): string;
    /** Counts are in units of 10^-decimals; undefined if there are none. */
    get decimals(): number | undefined;
    /** The names of its numbers or flags, if they have names. */
    get names(): import("./words.js").WordLayout | Readonly<Record<string, number>> | undefined;
    /** The special codes by name. */
    get special(): Readonly<Record<string, SpecialCode<string>>>;
    /** The special code that a raw number is; undefined for a quantity. @param {any} raw */
    specialOf(raw: any): SpecialCode<string> | undefined;
    /** The points whose raw numbers decoding needs. */
    get scaleNeeds(): readonly string[];
    /** The points whose raw numbers checking needs. @returns {readonly string[]} */
    get limitNeeds(): readonly string[];
    /** The raw numbers that may be written. @returns {import("./rules.js").Allowed} */
    get allowed(): import("./rules.js").Allowed;
    /** The least and the greatest raw number that is ever allowed, whatever other points hold. @returns {[any, any]} */
    get rawLimits(): [any, any];
    /** The least value that is ever allowed; undefined if there is none, or other points decide. */
    get minimum(): number | undefined;
    /** The greatest value that is ever allowed. */
    get maximum(): number | undefined;
    _bounds(): [number, number] | undefined;
    /** The description's name for a raw number; undefined if it has none. @param {any} raw */
    nameOf(raw: any): string | undefined;
    /** The raw number in unsigned words (or bits) in ascending order of address. @param {readonly number[]} words @returns {any} */
    fromWords(words: readonly number[]): any;
    /** The unsigned words of a raw number in ascending order of address. @param {any} raw @returns {number[]} */
    toWords(raw: any): number[];
    /** Where the words of the number stand among those in ascending order of address, the high one first. @param {Place} at */
    _order(at: Place): number[];
    /** The raw number of a bit group, from its whole word. @param {number} word @returns {any} */
    extract(word: number): any;
    /** The whole word with this bit group replaced, and with the constant bits set. @param {number} word @param {any} raw
     * @returns {number} */
    insert(word: number, raw: any): number;
    /** Whether two raw numbers mean the same. @param {any} raw @param {any} other */
    same(raw: any, other: any): boolean;
    /**
     * A value as text with its unit: `50 Hz`. It has the decimals of the description, or else as many as
     * needed. Raises as `encode` does, but also takes values that may not be written.
     * @param {any} value @param {Raws} [raws] @returns {string}
     */
    text(value: any, raws?: Raws): string;
    /** The value of a raw number as `text` does, or `raw ...` if `raws` lacks what the scale needs.
     * @param {any} raw @param {Raws} [raws] @returns {string} */
    told(raw: any, raws?: Raws): string;
    get _unit(): string;
    /** The same as a raw number of the type; a boolean is one of a bit. @param {any} number @param {any} low @param {any} high
     * @returns {any} */
    _within(number: any, low: any, high: any): any;
    /** @param {any} raw @returns {any} */
    _number(raw: any): any;
    /** Add to errors raised meanwhile what was asked for. @template T @param {any} value @param {() => T} work @returns {T} */
    _about<T>(value: any, work: () => T): T;
    /** @param {CodecError} error @param {any} [value] */
    _named(error: CodecError, value?: any): CodecError;
}
import { SpecialCode } from "./special.js";
import { CodecError } from "./errors.js";
export {};
