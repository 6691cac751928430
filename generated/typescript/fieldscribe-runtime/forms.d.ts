/** @param {Names} names @returns {string} */
export function namedList(names: Names): string;
/** The form with constant bits; special codes stay outermost.
 * @param {Form} form @param {readonly [number, number]} fixed @returns {Form} */
export function withFixed(form: Form, [mask, bits]: readonly [number, number]): Form;
/** The raw number is the value. @param {WireType} wire @returns {Form} */
export function integer(wire: WireType): Form;
/** A coil or a single bit. @param {WireType} [wire] @returns {Form} */
export function bit(wire?: WireType): Form;
/** Numbers with names. @param {WireType} wire @param {Names} names @param {{ closed?: boolean }} [facts] @returns {Form} */
export function named(wire: WireType, names: Names, { closed }?: {
    closed?: boolean;
}): Form;
/** A word of flags. @param {WireType} wire @param {import("./words.js").WordLayout} layout @returns {Form} */
export function flags(wire: WireType, layout: import("./words.js").WordLayout): Form;
/** A quantity. @param {WireType} wire @param {LinearRule | readonly import("./rules.js").ScaleCase[]} scale
 * @param {{ decimals: number | null, encodes?: boolean, most?: number | bigint }} facts @returns {Form} */
export function scaled(wire: WireType, scale: LinearRule | readonly import("./rules.js").ScaleCase[], facts: {
    decimals: number | null;
    encodes?: boolean;
    most?: number | bigint;
}): Form;
/** An IEEE 754 number. @param {WireType} wire @param {{ units?: readonly (readonly [number, number])[] }} [facts]
 * @returns {Form} */
export function floating(wire: WireType, { units }?: {
    units?: readonly (readonly [number, number])[];
}): Form;
/** A form with special codes, to which no value is encoded. @param {Form} form
 * @param {import("./special.js").Codes} codes @returns {Form} */
export function withCodes(form: Form, codes: import("./special.js").Codes): Form;
/** The same with special codes that may be written. @param {Form} form
 * @param {import("./special.js").Codes} codes @returns {Form} */
export function withWritableCodes(form: Form, codes: import("./special.js").Codes): Form;
/** @typedef {import("./rules.js").Raws} Raws */
/** @typedef {import("./rules.js").Allowed} Allowed */
/** @typedef {Readonly<Record<string, number>>} Names */
/** Converts the usual cases, and others by a slower function. @typedef {(number: any, raws?: Raws) => any} Way */
/** The meaning of raw numbers. They are bigint if the type has more than 32 bits. */
export class Form {
    /** @param {WireType} wire */
    constructor(wire: WireType);
    wire: WireType;
    /** The points whose raw numbers the scale needs. @type {readonly string[]} */
    needs: readonly string[];
    /** Counts are in units of 10^-decimals; undefined if there are none. @type {number | undefined} */
    decimals: number | undefined;
    codes: import("./special.js").Codes;
    /** @type {Names | import("./words.js").WordLayout | undefined} */
    names: Names | import("./words.js").WordLayout | undefined;
    /** The error for what may not be written. @type {new (message: string) => Error} */
    refused: new (message: string) => Error;
    /** Whether values can be encoded; numbers with too many bits can only be decoded. */
    encodes: boolean;
    /** The value of a raw number. @param {any} raw @param {Raws} raws @returns {any} */
    decode(raw: any, raws: Raws): any;
    /** The raw number for a value, even if it may not be written; undefined if there is none.
     * @param {any} value @param {Raws} raws @returns {any} */
    converted(value: any, raws: Raws): any;
    /** A function that decodes raw numbers from `low` to `high` quickly. @param {any} low @param {any} high @param {Way} slow
     * @returns {Way} */
    quickDecode(low: any, high: any, slow: Way): Way;
    /** A function that computes the value of an unsigned word, or undefined if there is none. @returns {((word: number) => any) | undefined} */
    quickWord(): ((word: number) => any) | undefined;
    /** The value as a count of 10^-decimals units. @param {any} raw @param {Raws} raws @returns {bigint} */
    decodeCount(raw: any, raws: Raws): bigint;
    /** The raw number for a count, even if it may not be written. @param {unknown} count @param {Raws} raws @returns {any} */
    convertedCount(count: unknown, raws: Raws): any;
    /** The number; undefined if it may not be written. @param {any} raw @param {Allowed} allowed @param {Raws} raws
     * @returns {any} */
    checked(raw: any, allowed: Allowed, raws: Raws): any;
    /** The least and greatest number of the form in `width` bits.
     * @param {number} width @returns {[any, any]} */
    limits(width: number): [any, any];
    /** The least and greatest quantity for raw numbers of a range; undefined if there are none.
     * @param {any} low @param {any} high @returns {[number, number] | undefined} */
    bounds(low: any, high: any): [number, number] | undefined;
    /** The value of a raw number as text without the unit; a quantity with `display` decimals, if given.
     * @param {any} raw @param {Raws} raws @param {number} [display] @returns {string} */
    shown(raw: any, raws: Raws, display?: number): string;
    /** Whether two raw numbers mean the same. @param {any} raw @param {any} other */
    same(raw: any, other: any): boolean;
    /** Why a value is refused, if not for the range of raw numbers. @param {string} unit @returns {string | undefined} */
    choices(unit: string): string | undefined;
    /** The name of a raw number. @param {any} raw @returns {string | undefined} */
    nameOf(raw: any): string | undefined;
}
/** A form that delegates to another one, except for what a subclass overrides. */
export class AroundForm extends Form {
    /** @param {Form} form */
    constructor(form: Form);
    form: Form;
}
export type Raws = import("./rules.js").Raws;
export type Allowed = import("./rules.js").Allowed;
export type Names = Readonly<Record<string, number>>;
/**
 * Converts the usual cases, and others by a slower function.
 */
export type Way = (number: any, raws?: Raws) => any;
import { WireType } from "./wire-types.js";
import { LinearRule } from "./rules.js";
