// SPDX-License-Identifier: 0BSD
/** The types of points: their methods, and the types of these, follow from the description. */
import type { Place } from "./places.js";
import type { Raws } from "./rules.js";
import type { SpecialCode } from "./special.js";

declare const unknownNumber: unique symbol;
/** A number that the manual does not name; `number as UnknownNumber` makes one. */
export type UnknownNumber = number & { readonly [unknownNumber]: true };




/** A date as a device keeps it, with the names of `Temporal.PlainDate`. */
export interface DateParts {
  readonly year: number;
  readonly month: number;
  readonly day: number;
}

/** A time as a device keeps it, with the names of `Temporal.PlainTime`. */
export interface TimeParts {
  readonly hour: number;
  readonly minute: number;
  readonly second: number;
  readonly millisecond: number;
}

/** What is written as a time: what is left out is 0. */
export type GivenTime = Pick<TimeParts, "hour"> & Partial<TimeParts>;

/** What a type says of a point beside its values; facts that are left out have the usual value. */
export interface PointFacts {
  /** Raw numbers, where they are no `number`. */
  raw?: number | bigint;
  /** What `encode` takes, where that is not what `decode` gives. */
  takes?: unknown;
  /** The names of points whose raw numbers the scale needs. */
  scale?: string;
  /** The names of further points whose raw numbers the limits need. */
  limits?: string;
  /** The special codes of one raw number: how they are named here, and in the description. */
  special?: object;
  /** What names numbers or flags. */
  names?: object;
}

type Fact<Facts, Key extends string, Usual> = Facts extends { [K in Key]: infer Found } ? Found : Usual;
type Raw<Facts> = Fact<Facts, "raw", number>;
type Names<Facts, Key extends string> = Extract<Fact<Facts, Key, never>, string>;
type CodesOf<Codes> = { readonly [Name in keyof Codes]: SpecialCode<Extract<Codes[Name], string>> };
/** The last argument of a conversion: needed where other points decide. */
type Needs<Name extends string> = [Name] extends [never]
  ? [raws?: Raws]
  : [raws: { readonly [Key in Name]: number | bigint }];
type ScaleNeeds<Facts> = Needs<Names<Facts, "scale">>;
type AllNeeds<Facts> = Needs<Names<Facts, "scale"> | Names<Facts, "limits">>;

/** One addressable datum. */
export interface Point<Facts extends PointFacts = any, Device extends string = string> {
  /** The device that has it. */
  readonly device?: Device;
  /** The description's name. */
  readonly name: string;
  /** The name, with the variant if only one has the point. */
  readonly item: string;
  /** The manual's code. */
  readonly code: string | undefined;
  /** Code and name, for messages. */
  readonly label: string;
  readonly group: string;
  /** The unit of its values; empty where they have none. */
  readonly unit: string;
  readonly access: string;
  /** Where it is on the wire. */
  readonly at: Place;
  /** The manual's other numberings. */
  readonly references: Readonly<Record<string, number | string>>;
  /** The number of its words (or single bits). */
  readonly size: number;
  /** The number of bits of the raw number. */
  readonly width: number;
  /** Counts are in units of 10^-decimals; undefined if there are none. */
  readonly decimals: number | undefined;
  /** The least value that is ever allowed; undefined if there is none, or other points decide. */
  readonly minimum: number | undefined;
  readonly maximum: number | undefined;
  /** The least and the greatest raw number that is ever allowed, whatever other points hold. */
  readonly rawLimits: readonly [Raw<Facts>, Raw<Facts>];
  readonly names: Fact<Facts, "names", undefined>;
  /** The special codes of one raw number, by name. */
  readonly special: CodesOf<Fact<Facts, "special", {}>>;
  readonly scaleNeeds: readonly string[];
  readonly limitNeeds: readonly string[];
  /** What else the description says. */
  readonly facts: Readonly<Record<string, any>>;
  /** The special code that a raw number is; undefined for a quantity. */
  specialOf(raw: Raw<Facts>): SpecialCode | undefined;
  /** The description's name for a raw number. */
  nameOf(raw: Raw<Facts>): string | undefined;
  /** The raw number in unsigned words (or bits) in ascending order of address. */
  fromWords(words: readonly number[]): Raw<Facts>;
  /** The unsigned words of a raw number in ascending order of address. */
  toWords(raw: Raw<Facts>): number[];
  /** The raw number of a bit group, from its whole word. */
  extract(word: number): Raw<Facts>;
  /** The whole word with this bit group replaced, and with the constant bits set. */
  insert(word: number, raw: Raw<Facts>): number;
  /** A raw number as people read it, with the unit. */
  told(raw: Raw<Facts>, raws?: Raws): string;
}

interface Decoding<Value, Facts> {
  /** The value (or special code) of a raw number. */
  decode(raw: Raw<Facts>, ...raws: ScaleNeeds<Facts>): Value;
  /** The value in bytes, the high byte of each word first, from `offset` on. */
  decodeBytes(bytes: Uint8Array, offset?: number, ...raws: ScaleNeeds<Facts>): Value;
  /** The value as an exact count of 10^-decimals units. */
  decodeCount(raw: Raw<Facts>, ...raws: ScaleNeeds<Facts>): bigint;
  /** A value as people read it, with the unit. */
  text(value: Value, ...raws: ScaleNeeds<Facts>): string;
}

interface Encoding<Value, Facts> {
  /** The raw number for a value; raises an error for one that may not be written. */
  encode(value: Fact<Facts, "takes", Value>, ...raws: AllNeeds<Facts>): Raw<Facts>;
  /** The raw number for an exact count of 10^-decimals units. */
  encodeCount(count: number | bigint, ...raws: AllNeeds<Facts>): Raw<Facts>;
  /** Raises an error if this raw number may not be written. */
  check(raw: Raw<Facts>, ...raws: AllNeeds<Facts>): void;
}

/** A point that can only be read. */
export interface ReadOnly<Value, Facts extends PointFacts = {}, Device extends string = string>
  extends Point<Facts, Device>,
    Decoding<Value, Facts> {}

/** A point that can only be written. */
export interface WriteOnly<Value, Facts extends PointFacts = {}, Device extends string = string>
  extends Point<Facts, Device>,
    Encoding<Value, Facts> {}

/** A point that can be read and written. */
export interface ReadWrite<Value, Facts extends PointFacts = {}, Device extends string = string>
  extends Point<Facts, Device>,
    Decoding<Value, Facts>,
    Encoding<Value, Facts> {}

/** A point that a write may keep in EEPROM. */
export interface Stored<Value, Facts extends PointFacts = {}, Device extends string = string>
  extends ReadWrite<Value, Facts, Device> {
  readonly isStored: true;
}

/** The same that can only be written. */
export interface StoredWriteOnly<Value, Facts extends PointFacts = {}, Device extends string = string>
  extends WriteOnly<Value, Facts, Device> {
  readonly isStored: true;
}

/** A word of flags as a constant of the module: it makes words from raw numbers, and from what is true. */
export interface WordKind<Kind, Flags> {
  readonly name: string;
  from(raw: number | bigint): Kind;
  /** The word in which exactly these flags are true, active-low bits included. */
  of(flags?: Flags): Kind;
}

/** How a write is kept. */
interface Keeping {
  /** Whether it outlives power-off, which wears the EEPROM. */
  keep?: boolean;
}

type How<P> = P extends { readonly isStored: true } ? [how?: Keeping] : [];
type Reading<Value, Facts> = { read(): Promise<Value>; readRaw(): Promise<Raw<Facts>> };
type Writing<Taken, Facts, P> = {
  write(value: Taken, ...how: How<P>): Promise<void>;
  writeRaw(raw: Raw<Facts>, ...how: How<P>): Promise<void>;
};
type TakenBy<P> = P extends { encode(value: infer Taken, ...raws: any[]): any } ? Taken : never;
type FactsOf<P> = P extends Point<infer Facts, any> ? Facts : never;

/** A point of a device on a line: what it is as a codec, and what the line can do with it. */
export type Handle<P> = P &
  (P extends { decode(...given: any[]): infer Value } ? Reading<Value, FactsOf<P>> : unknown) &
  (P extends { encode(...given: any[]): any } ? Writing<TakenBy<P>, FactsOf<P>, P> : unknown);

/** A command of a device as a constant of its module; `Given` is what it takes. */
export interface DeviceCommand<Given = number | undefined> {
  readonly given?: Given;
}

/** A command of a device on a line. */
export interface CommandHandle<Given> {
  send(...given: undefined extends Given ? [value?: Given] : {} extends Given ? [] : [values: Given]): Promise<void>;
}

/** The points and commands of a module as attributes of a device. */
export type Handles<Module> = {
  readonly [Name in keyof Module as Name extends "allPoints" | "allCommands" | "oldNames"
    ? never
    : Name]: Module[Name] extends Point<any, any>
    ? Handle<Module[Name]>
    : Module[Name] extends DeviceCommand<infer Given>
      ? CommandHandle<Given>
      : never;
};

/** The values of the points of a module that can be read, by attribute; with `Failure` where that may stand instead. */
export type Values<Module, Failure = never> = {
  [Name in keyof Handles<Module> as Handles<Module>[Name] extends { read(): any } ? Name : never]:
    | (Handles<Module>[Name] extends { read(): Promise<infer Value> } ? Value : never)
    | Failure;
};
