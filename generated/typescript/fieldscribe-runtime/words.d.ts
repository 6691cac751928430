/** A name of a description as programs write it: base_frequency is baseFrequency. @param {string} name @returns {string} */
export function camelName(name: string): string;
/** Some bits of a word; `active` is the state of a single bit in which its name is true, `names` names several.
 * @typedef {{ low: number, width: number, active?: 0 | 1, names?: Readonly<Record<string, number>> }} BitRange */
/** One bit of a word. @param {number} low @param {{ active?: 0 | 1 }} [facts] @returns {BitRange} */
export function bitFlag(low: number, { active }?: {
    active?: 0 | 1;
}): BitRange;
/** Several bits of a word. @param {number} low @param {number} width @param {Readonly<Record<string, number>>} [names]
 * @returns {BitRange} */
export function bitField(low: number, width: number, names?: Readonly<Record<string, number>>): BitRange;
/** The bits of a word, right-aligned. @param {BitRange} bits @param {number | bigint} raw @returns {number} */
export function bitsOf(bits: BitRange, raw: number | bigint): number;
/** The name that a number has, in lower case. @param {Readonly<Record<string, number>> | undefined} names
 * @param {number | bigint} number @returns {string | undefined} */
export function numberName(names: Readonly<Record<string, number>> | undefined, number: number | bigint): string | undefined;
/** The kind of a word of flags. @param {string} name @param {Readonly<Record<string, BitRange>>} flags
 * @param {{ constant?: number, closed?: readonly string[] }} [facts] */
export function wordOf(name: string, flags: Readonly<Record<string, BitRange>>, facts?: {
    constant?: number;
    closed?: readonly string[];
}): WordLayout;
/** A word of flags: what it means is in its properties, and `raw` is its number. */
export class Word {
    /** @param {number | bigint} raw */
    constructor(raw: number | bigint);
    /** @type {number | bigint} */
    raw: number | bigint;
    valueOf(): number | bigint;
    /** The number, and the names that are true. */
    toString(): string;
}
/** What the bits of a word mean, and what makes words of it. */
export class WordLayout {
    /** @param {string} name @param {Readonly<Record<string, BitRange>>} flags
     * @param {{ constant?: number, closed?: readonly string[] }} facts */
    constructor(name: string, flags: Readonly<Record<string, BitRange>>, { constant, closed }: {
        constant?: number;
        closed?: readonly string[];
    });
    name: string;
    flags: Readonly<Record<string, BitRange>>;
    constant: number;
    /** Flags whose bits are always written as a constant. */
    closed: readonly string[];
    prototype: any;
    /** The word that a raw number is. @param {number | bigint} raw @returns {Word} */
    from(raw: number | bigint): Word;
    /** The word in which exactly these flags are true, active-low bits included. @param {Readonly<Record<string, unknown>>} [given] */
    of(given?: Readonly<Record<string, unknown>>): Word;
}
/**
 * Some bits of a word; `active` is the state of a single bit in which its name is true, `names` names several.
 */
export type BitRange = {
    low: number;
    width: number;
    active?: 0 | 1;
    names?: Readonly<Record<string, number>>;
};
