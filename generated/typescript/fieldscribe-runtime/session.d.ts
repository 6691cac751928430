/**
 * Set the facts of a class, and make points and commands attributes of its objects.
 * @template {typeof Session} T @param {T} kind @param {import("./table.js").DeviceFacts} facts @returns {T}
 */
export function defineDevice<T extends typeof Session>(kind: T, facts: import("./table.js").DeviceFacts): T;
/** A device on a bus: its unit number, its variants, and what was read before. One operation at a time. */
export class Session {
    /** @param {any} line @param {DeviceOptions} options */
    constructor(line: any, options: DeviceOptions);
    /** The points of the device; `defineDevice` sets it. @type {PointTable} */
    get table(): PointTable;
    line: any;
    unit: number;
    variants: Record<string, string | undefined>;
    /** How often a request is repeated after it or its reply was lost; a command is never repeated. */
    retries: number;
    /** Seconds between a failure and the repetition. */
    retryPause: number;
    /** Requests, valid replies, and failures by status. */
    traffic: {
        requests: number;
        replies: number;
        errors: Record<string, number>;
    };
    _profile: any;
    /** @type {PointRaws} */
    _kept: PointRaws;
    /** The current selection, by point; forgotten when an exchange fails or something else is written.
     * @type {Map<string, number>} */
    _selected: Map<string, number>;
    /** Refusals that last: `readMany` does not request these points again. @type {Refusals} */
    _refused: Refusals;
    _isFirstDue: boolean;
    _isOnce: boolean;
    /** @type {Promise<unknown>} */
    _turn: Promise<unknown>;
    /** @type {Map<AnyPoint, any>} */
    _handles: Map<AnyPoint, any>;
    /** Read the words or bits of a place, in ascending order of address. @param {Place} at
     * @returns {Promise<number[]>} */
    _get(at: Place): Promise<number[]>;
    /** Write words or bits at a place, in ascending order of address. @param {Place} at
     * @param {readonly number[]} words */
    _store(at: Place, words: readonly number[]): Promise<void>;
    /** After earlier operations, send the commands that must come first, then carry out this one.
     * @template T @param {() => Promise<T>} work @param {boolean} [prepares] @returns {Promise<T>} */
    _run<T>(work: () => Promise<T>, prepares?: boolean): Promise<T>;
    /** Give the commands that a device gives by itself. @param {string} run */
    _automatic(run: string): Promise<void>;
    /** Turn off repetitions inside, so that no command is carried out twice.
     * @template T @param {() => Promise<T>} work @returns {Promise<T>} */
    _once<T>(work: () => Promise<T>): Promise<T>;
    /** Add to errors raised inside what was requested. @template T
     * @param {AnyPoint | readonly AnyPoint[] | string} what @param {() => Promise<T>} work @returns {Promise<T>} */
    _about<T>(what: AnyPoint | readonly AnyPoint[] | string, work: () => Promise<T>): Promise<T>;
    /** Carry out one request; repeat it while it or its reply is lost, and count failures. What was selected
     * is selected again first: the device may have restarted meanwhile.
     * @template T @param {number} left @param {() => Promise<T>} ask @returns {Promise<T>} */
    _retried<T>(left: number, ask: () => Promise<T>): Promise<T>;
    /** One exchange over the line; `awaited` is the text for a missing reply. @param {any} request @param {any} reply
     * @param {string} awaited @returns {Promise<any>} */
    _exchange(request: any, reply: any, awaited: string): Promise<any>;
    /** The operand of a test: the value of an axis, or the raw number of a point. @param {string} of
     * @returns {Promise<number | string>} */
    _compared(of: string): Promise<number | string>;
    /** @param {AnyPoint} point @returns {Promise<number | bigint>} */
    _readRaw(point: AnyPoint): Promise<number | bigint>;
    /** The raw number in received words; remembered if the description says how often it changes.
     * @param {AnyPoint} point @param {readonly number[]} words @returns {number | bigint} */
    _taken(point: AnyPoint, words: readonly number[]): number | bigint;
    /** The raw numbers of others that a point needs, by name: known ones, remembered ones, or read now.
     *
     * Before a write, only numbers that never change are taken from memory: another master, or a person, may have
     * changed the others since.
     * @param {AnyPoint} point @param {Iterable<string>} names
     * @param {{ known?: PointRaws, refusals?: Refusals, writes?: boolean }} [how]
     * @returns {Promise<Record<string, number | bigint>>}
     */
    _raws(point: AnyPoint, names: Iterable<string>, { known, refusals, writes }?: {
        known?: PointRaws;
        refusals?: Refusals;
        writes?: boolean;
    }): Promise<Record<string, number | bigint>>;
    /** A point that another one needs; the AccessError names both. @param {AnyPoint} point @param {string} name
     * @returns {AnyPoint} */
    _needed(point: AnyPoint, name: string): AnyPoint;
    /** Read a point's value. @param {AnyPoint} point @returns {Promise<any>} */
    _read(point: AnyPoint): Promise<any>;
    /** Write a value, to the point's own place or a given one.
     * @param {AnyPoint} point @param {unknown} value @param {Place} [at] */
    _write(point: AnyPoint, value: unknown, at?: Place): Promise<void>;
    /** Write a raw number that the range allows. @param {AnyPoint} point @param {number | bigint} raw
     * @param {Place} [at] */
    _writeRaw(point: AnyPoint, raw: number | bigint, at?: Place): Promise<void>;
    /** Write a checked raw number; raises EchoError if the device confirms another one.
     * @param {AnyPoint} point @param {number | bigint} raw @param {Record<string, number | bigint>} raws
     * @param {Place} [at] */
    _putRaw(point: AnyPoint, raw: number | bigint, raws: Record<string, number | bigint>, at?: Place): Promise<void>;
    /** Raises RequestError (not_together) if a point is missing that one request has to write with these.
     * @param {readonly AnyPoint[]} points */
    _requirePartners(points: readonly AnyPoint[]): void;
    /** The place of points that one request writes; raises RequestError (not_together).
     * @param {readonly AnyPoint[]} points @returns {Place} */
    _jointPlace(points: readonly AnyPoint[]): Place;
    /** Write several points in one request; each is checked with the new numbers of those before it.
     * @param {Map<AnyPoint, unknown>} values */
    _writeTogether(values: Map<AnyPoint, unknown>): Promise<void>;
    /** The word that a bit group shares with other points, read before the group is written. @param {AnyPoint} point
     * @returns {Promise<number>} */
    _sharedWord(point: AnyPoint): Promise<number>;
    /** Write words or bits at a place, and forget what they change. @param {Place} at @param {readonly number[]} words */
    _put(at: Place, words: readonly number[]): Promise<void>;
    /** Write what points must hold before the address of another one means it, unless they hold it.
     * @param {readonly (readonly [string, number])[]} [selects] */
    _select(selects?: readonly (readonly [string, number])[]): Promise<void>;
    /** Read the raw numbers of several points, together where they need the same selection.
     * @param {readonly AnyPoint[]} points @param {string | undefined} group @param {Refusals} [refusals]
     * @returns {Promise<PointRaws>} */
    _gatherSelected(points: readonly AnyPoint[], group: string | undefined, refusals?: Refusals): Promise<PointRaws>;
    /** Read the raw numbers of several points (or of a whole group), place by place.
     * @param {readonly AnyPoint[]} points @param {string | undefined} group @param {Refusals} [refusals]
     * @returns {Promise<PointRaws>} */
    _gather(points: readonly AnyPoint[], group: string | undefined, refusals?: Refusals): Promise<PointRaws>;
    /** Read some points in one request; if the device refuses it and `refusals` are collected, one request each.
     * @param {readonly AnyPoint[]} points @param {Refusals | undefined} refusals @param {() => Promise<PointRaws>} ask
     * @param {any} [block] @returns {Promise<PointRaws>} */
    _part(points: readonly AnyPoint[], refusals: Refusals | undefined, ask: () => Promise<PointRaws>, block?: any): Promise<PointRaws>;
    /** Record that the device refuses addresses between points; each point is read by itself from then on.
     * @param {readonly AnyPoint[]} points @param {any} block */
    _noteGaps(points: readonly AnyPoint[], block: any): void;
    /** The points of a group that this device has; families with blocks look there. @param {AnyPoint[]} points
     * @returns {Promise<AnyPoint[]>} */
    _there(points: AnyPoint[]): Promise<AnyPoint[]>;
    /** Whether the link, as it is set, carries the words of a point; families override it.
     * @param {AnyPoint} point @returns {boolean} */
    _isCarried(point: AnyPoint): boolean;
    /** The points whose conditions may be true now; reads the points that conditions compare.
     * @param {AnyPoint[]} points @returns {Promise<AnyPoint[]>} */
    _existingOf(points: AnyPoint[]): Promise<AnyPoint[]>;
    /** Read a point, and add to a refusal the condition under which it exists.
     * @template T @param {AnyPoint} point @param {() => Promise<T>} ask @returns {Promise<T>} */
    _existing<T>(point: AnyPoint, ask: () => Promise<T>): Promise<T>;
    /** @param {AnyPoint} point @param {unknown} error */
    _addCondition(point: AnyPoint, error: unknown): void;
    /** Read what the scales of points need, then return the values by name.
     * @param {readonly AnyPoint[]} points @param {string | undefined} group @param {Refusals} [refusals]
     * @returns {Promise<Record<string, any>>} */
    _values(points: readonly AnyPoint[], group: string | undefined, refusals?: Refusals): Promise<Record<string, any>>;
    /** @param {string} group @returns {AnyPoint[]} */
    _group(group: string): AnyPoint[];
    /** Raises AccessError if the point belongs to another variant than this device, or is no point.
     * @param {AnyPoint} point @returns {AnyPoint} */
    _required(point: AnyPoint): AnyPoint;
    /** @param {unknown} what @returns {AnyPoint} */
    _readable(what: unknown): AnyPoint;
    /** @param {string} name @returns {AnyPoint} */
    _writable(name: string): AnyPoint;
    /** The attribute of a point, or of one that is bound to this device. @param {any} one @returns {unknown} */
    _attributeOf(one: any): unknown;
    /** The point bound to this device. @param {AnyPoint} point @returns {any} */
    _bound(point: AnyPoint): any;
    /** The place to write a point; families with several memories choose. @param {AnyPoint} point @param {boolean} keep
     * @returns {Place | undefined} */
    _writePlace(point: AnyPoint, keep: boolean): Place | undefined;
    /**
     * A point by its name, old name or code (`P0731[1]` is one element of an array), bound to this device. Raises
     * AccessError.
     * @param {string} what @returns {any}
     */
    point(what: string): any;
    /**
     * Read a group by its name, or several points, with few requests; values by attribute.
     *
     * With `errors: "return"`, a point that is absent, refused or without a value has its error as its value; only a lost
     * line raises. A point that the device refused with exception 01h to 03h is not requested again but has the same
     * error, until it is read in another way or `forget()` is called.
     * @param {string | Iterable<string | object>} what @param {{ errors?: "raise" | "return" }} [how]
     * @returns {Promise<Record<string, any>>}
     */
    readMany(what: string | Iterable<string | object>, { errors }?: {
        errors?: "raise" | "return";
    }): Promise<Record<string, any>>;
    /**
     * Write several points by one request, as `writeWith` asks for: values by the name of the point. Raises RequestError
     * (not_together) where a point is missing, or one request cannot write them.
     * @param {Readonly<Record<string, unknown>>} values @returns {Promise<void>}
     */
    writeTogether(values: Readonly<Record<string, unknown>>): Promise<void>;
    /**
     * Read the points that identify this device; returns the matching value of each variant axis. Raises
     * OtherDeviceError for another device.
     * @returns {Promise<Record<string, string>>}
     */
    identify(): Promise<Record<string, string>>;
    /** The first difference from what the points should hold. @param {import("./table.js").Identification[]} rows
     * @param {Map<string, unknown>} held @returns {Promise<string | undefined>} */
    _misfit(rows: import("./table.js").Identification[], held: Map<string, unknown>): Promise<string | undefined>;
    /** Forget what was read and what the device has refused; first commands are sent again. */
    forget(): void;
}
export type Place = import("./places.js").Place;
export type AnyPoint = import("./table.js").AnyPoint;
export type Refusals = Map<AnyPoint, FieldscribeError>;
export type PointRaws = Map<AnyPoint, number | bigint>;
/**
 * What is common to the options of all devices: the unit, and variants and given numbers by name.
 */
export type DeviceOptions = {
    unit: number;
    [name: string]: unknown;
};
import { PointTable } from "./table.js";
import { FieldscribeError } from "./errors.js";
