/** A point of any kind, as far as devices need to know. @typedef {any} AnyPoint */
/**
 * The facts of a device in generated code. `points` and `commands` are by attribute; `oldNames` are former names of
 * attributes, `documented` the reasons why points have none.
 * @typedef {object} DeviceFacts
 * @property {any} profile
 * @property {Readonly<Record<string, AnyPoint>>} points
 * @property {Readonly<Record<string, import("./commands.js").AnyCommand>>} [commands]
 * @property {Readonly<Record<string, readonly string[]>>} [variants]
 * @property {Readonly<Record<string, readonly import("./modbus.js").ModbusBlock[]>>} [blocks]
 * @property {Readonly<Record<string, import("./bases.js").ModbusBase>>} [bases]
 * @property {Readonly<Record<string, readonly [number, number]>>} [given]
 * @property {import("./bases.js").ModbusChain} [chain]
 * @property {readonly Identification[]} [identifications]
 * @property {Readonly<Record<string, { reason: string }>>} [documented]
 * @property {Readonly<Record<string, string>>} [oldNames]
 */
/**
 * What a point holds in a device, or in one of its variants: one of `values`, raw numbers or texts.
 * @typedef {{ point: string, values: readonly (number | string)[], variant?: readonly [string,
 *   string] }} Identification
 */
/** @param {string} point @param {readonly (number | string)[]} values @param {readonly [string, string]} [variant]
 * @returns {Identification} */
export function identification(point: string, values: readonly (number | string)[], variant?: readonly [string, string]): Identification;
/** The values of variants that are known, by axis. @typedef {Record<string, string | undefined>} Variants */
/** Whether the known variants have a point; false if its variant is not known.
 * @param {AnyPoint} point @param {Variants} variants @returns {boolean} */
export function pointExists(point: AnyPoint, variants: Variants): boolean;
/** The label of a point for messages: code and name. @param {AnyPoint} point @returns {string} */
export function labelOf(point: AnyPoint): string;
/** The own property of an object with a name from a user, not an inherited one.
 * @template T @param {Readonly<Record<string, T>> | undefined} held @param {string} name @returns {T | undefined} */
export function ownOf<T>(held: Readonly<Record<string, T>> | undefined, name: string): T | undefined;
/** Raises RequestError for a unit number that the device cannot have. @param {number} unit
 * @param {readonly [number, number]} units */
export function checkUnit(unit: number, units: readonly [number, number]): void;
/** A device's points by name. */
export class PointTable {
    /** @param {DeviceFacts} facts */
    constructor(facts: DeviceFacts);
    facts: DeviceFacts;
    /** @type {Map<string, AnyPoint>} */
    points: Map<string, AnyPoint>;
    /** @type {Map<string, AnyPoint[]>} */
    byName: Map<string, AnyPoint[]>;
    /** @type {Map<AnyPoint, string>} */
    attributes: Map<AnyPoint, string>;
    /** The given variants by axis; raises RequestError (bad_variant). @param {Record<string, unknown>} options
     * @returns {Variants} */
    variants(options: Record<string, unknown>): Variants;
    /** The point of the known variant by name. @param {string} name @param {Variants} variants
     * @returns {AnyPoint | undefined} */
    found(name: string, variants: Variants): AnyPoint | undefined;
    /** A point by name, old name or code (`P0731[1]` is an element of an array); raises AccessError.
     * @param {unknown} what @param {Variants} variants @returns {AnyPoint} */
    resolved(what: unknown, variants: Variants): AnyPoint;
    /** The points with a code, in capitals or not. @param {string} what @returns {AnyPoint[]} */
    coded(what: string): AnyPoint[];
    /** Why there is no such point, or not yet. @param {string} name @param {Variants} variants @returns {string} */
    absence(name: string, variants: Variants): string;
    /** The names of the groups. @returns {string[]} */
    groups(): string[];
}
/**
 * A point of any kind, as far as devices need to know.
 */
export type AnyPoint = any;
/**
 * The facts of a device in generated code. `points` and `commands` are by attribute; `oldNames` are former names of
 * attributes, `documented` the reasons why points have none.
 */
export type DeviceFacts = {
    profile: any;
    points: Readonly<Record<string, AnyPoint>>;
    commands?: Readonly<Record<string, import("./commands.js").AnyCommand>> | undefined;
    variants?: Readonly<Record<string, readonly string[]>> | undefined;
    blocks?: Readonly<Record<string, readonly import("./modbus.js").ModbusBlock[]>> | undefined;
    bases?: Readonly<Record<string, import("./bases.js").ModbusBase>> | undefined;
    given?: Readonly<Record<string, readonly [number, number]>> | undefined;
    chain?: import("./bases.js").ModbusChain | undefined;
    identifications?: readonly Identification[] | undefined;
    documented?: Readonly<Record<string, {
        reason: string;
    }>> | undefined;
    oldNames?: Readonly<Record<string, string>> | undefined;
};
/**
 * What a point holds in a device, or in one of its variants: one of `values`, raw numbers or texts.
 */
export type Identification = {
    point: string;
    values: readonly (number | string)[];
    variant?: readonly [string, string];
};
/**
 * The values of variants that are known, by axis.
 */
export type Variants = Record<string, string | undefined>;
