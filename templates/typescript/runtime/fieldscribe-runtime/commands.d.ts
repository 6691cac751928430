/** @param {Command} facts @returns {Command} */
export function command(facts: Command): Command;
/** @param {number} constant @param {...(number | string | { mask: number })} more factor and argument, and `mask`
 * @returns {StepWord} */
export function stepWord(constant: number, ...more: (number | string | {
    mask: number;
})[]): StepWord;
/** @param {string} says @param {Place} at @param {readonly (number | StepWord)[]} words
 * @param {{ within?: number, when?: Step["when"] }} [facts] @returns {Step} */
export function step(says: string, at: Place, words: readonly (number | StepWord)[], facts?: {
    within?: number;
    when?: Step["when"];
}): Step;
/** @param {...(Step | Partial<SteppedCommand>)} parts the steps, and the facts behind them @returns {SteppedCommand} */
export function steppedCommand(...parts: (Step | Partial<SteppedCommand>)[]): SteppedCommand;
/** The words to write, given those that the device holds; a step that waits is done if they are equal.
 * @param {Step} one @param {Readonly<Record<string, number>>} numbers @param {readonly number[]} held */
export function mergedWords(one: Step, numbers: Readonly<Record<string, number>>, held: readonly number[]): number[];
/** Whether the words of a step must be read: to wait for them, or to preserve bits. @param {Step} one */
export function stepReads(one: Step): boolean;
/**
 * Send a command, with the number of a constant write, or the arguments of steps by name.
 * @param {import("./session.js").Session} session @param {string} name @param {AnyCommand} given
 * @param {number | Readonly<Record<string, number>>} [value]
 */
export function giveCommand(session: import("./session.js").Session, name: string, given: AnyCommand, value?: number | Readonly<Record<string, number>>): Promise<void>;
/** @param {number | string} value @param {string} test @param {readonly (number | string)[]} than */
export function stepTestHolds(value: number | string, test: string, than: readonly (number | string)[]): boolean;
/** Wait. @param {number} seconds @returns {Promise<void>} */
export function paused(seconds: number): Promise<void>;
export type Place = import("./places.js").Place;
/**
 * A word of a step: constant + factor * argument, modulo 65536. Bits outside `mask` are preserved.
 */
export type StepWord = {
    constant: number;
    factor: number;
    argument: string;
    mask: number;
};
/**
 * Compares a variant axis, or a point by its raw number: its name, the operator, and the constants.
 */
export type StepTest = readonly [string, string, readonly (number | string)[]];
/**
 * One request: it writes words, or waits at most `within` seconds until the device has them. `when` is a condition:
 * groups of tests, one of which must hold; without any, the step is always taken.
 */
export type Step = {
    says: string;
    at: Place;
    words: readonly (number | StepWord)[];
    within?: number;
    when?: readonly (readonly StepTest[])[];
};
/**
 * A write that makes the device do something; without a `value` any number does (1 if none is given).
 */
export type Command = {
    at: Place;
    value?: number;
};
/**
 * Requests in order. `run` says when a device sends them: `first`, `before write`, or `by caller`.
 */
export type SteppedCommand = {
    requests: readonly Step[];
    arguments: Readonly<Record<string, readonly [number, number]>>;
    run: string;
    every?: number;
};
export type AnyCommand = Command | SteppedCommand;
