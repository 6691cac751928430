/** Special codes. @param {ConstructorParameters<typeof Codes>[0]} raws @param {ConstructorParameters<typeof Codes>[1]} [facts] */
export function codes(raws: ConstructorParameters<typeof Codes>[0], facts?: ConstructorParameters<typeof Codes>[1]): Codes;
/** A special code, which a point holds instead of a quantity. @template {string} [Name=string] */
export class SpecialCode<Name extends string = string> {
    /** @param {Name} name @param {number | bigint} raw @param {boolean} noValue @param {boolean} writable */
    constructor(name: Name, raw: number | bigint, noValue: boolean, writable: boolean);
    name: Name;
    raw: number | bigint;
    /** Whether it means that there is no value. */
    noValue: boolean;
    writable: boolean;
    toString(): Name;
}
/** The special codes of a point. A code is a raw number, or the first and the last one of a band. */
export class Codes {
    /** @param {Readonly<Record<string, number | bigint | readonly [number | bigint, number | bigint]>>} raws
     * @param {{ noValue?: readonly string[], writable?: readonly string[] }} facts */
    constructor(raws: Readonly<Record<string, number | bigint | readonly [number | bigint, number | bigint]>>, { noValue, writable }: {
        noValue?: readonly string[];
        writable?: readonly string[];
    });
    /** @type {Map<string, readonly [number | bigint, number | bigint]>} */
    spans: Map<string, readonly [number | bigint, number | bigint]>;
    noValue: readonly string[];
    writable: readonly string[];
    /** @type {Map<number | bigint, SpecialCode>} */
    single: Map<number | bigint, SpecialCode>;
    /** The codes of one raw number by name. @type {Readonly<Record<string, SpecialCode>>} */
    byName: Readonly<Record<string, SpecialCode>>;
    /** @type {string[]} */
    bands: string[];
    /** The code that a raw number is; undefined for a quantity. @param {number | bigint} raw @returns {SpecialCode | undefined} */
    of(raw: number | bigint): SpecialCode | undefined;
    /** First and last raw number of a code. @param {string} name */
    span(name: string): readonly [number | bigint, number | bigint];
    /** Whether a code is one of these. @param {SpecialCode} code */
    has(code: SpecialCode): boolean;
    /** How a program names a code. @param {SpecialCode} code */
    said(code: SpecialCode): string;
    /** Why a text is not taken for a value, and the code that is meant by it. @param {string} given */
    notAText(given: string): string;
    /** @param {string} name @param {number | bigint} raw */
    made(name: string, raw: number | bigint): SpecialCode<string>;
}
export const NO_CODES: Codes;
