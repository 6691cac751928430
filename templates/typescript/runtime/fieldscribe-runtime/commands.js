// SPDX-License-Identifier: 0BSD
/** Commands: named constant writes, and several requests in order, such as set-up sequences, keys and mailboxes. */
import { AccessError, FieldscribeError, OutOfRangeError, RequestError, shown, WaitError } from "./errors.js";
import { placeLabel } from "./places.js";

/** @typedef {import("./places.js").Place} Place */
/** A word of a step: constant + factor * argument, modulo 65536. Bits outside `mask` are preserved.
 * @typedef {{ constant: number, factor: number, argument: string, mask: number }} StepWord */
/** Compares a variant axis, or a point by its raw number: its name, the operator, and the constants.
 * @typedef {readonly [string, string, readonly (number | string)[]]} StepTest */
/** One request: it writes words, or waits at most `within` seconds until the device has them. `when` is a condition:
 * groups of tests, one of which must hold; without any, the step is always taken.
 * @typedef {{ says: string, at: Place, words: readonly (number | StepWord)[], within?: number,
 *   when?: readonly (readonly StepTest[])[] }} Step */
/** A write that makes the device do something; without a `value` any number does (1 if none is given).
 * @typedef {{ at: Place, value?: number }} Command */
/** Requests in order. `run` says when a device sends them: `first`, `before write`, or `by caller`.
 * @typedef {{ requests: readonly Step[], arguments: Readonly<Record<string, readonly [number, number]>>, run: string,
 *   every?: number }} SteppedCommand */
/** @typedef {Command | SteppedCommand} AnyCommand */

const WHOLE_WORD = 0xffff;
const LOOK_PAUSE = 0.1;

/** @param {Command} facts @returns {Command} */
export function command(facts) {
  return Object.freeze(facts);
}

/** @param {number} constant @param {...(number | string | { mask: number })} more factor and argument, and `mask`
 * @returns {StepWord} */
export function stepWord(constant, ...more) {
  const last = more[more.length - 1];
  const [factor, argument] = more;
  const mask = typeof last === "object" ? last.mask : WHOLE_WORD;
  if (typeof factor !== "number") return { constant, factor: 0, argument: "", mask };
  return { constant, factor, argument: String(argument), mask };
}

/** @param {string} says @param {Place} at @param {readonly (number | StepWord)[]} words
 * @param {{ within?: number, when?: Step["when"] }} [facts] @returns {Step} */
export function step(says, at, words, facts) {
  return Object.freeze({ says, at, words, ...facts });
}

/** @param {...(Step | Partial<SteppedCommand>)} parts the steps, and the facts behind them @returns {SteppedCommand} */
export function steppedCommand(...parts) {
  const requests = /** @type {Step[]} */ (parts.filter((part) => "at" in part));
  const facts = parts.find((part) => !("at" in part));
  return Object.freeze({ requests, arguments: {}, run: "by caller", ...facts });
}

/** The words to write, given those that the device holds; a step that waits is done if they are equal.
 * @param {Step} one @param {Readonly<Record<string, number>>} numbers @param {readonly number[]} held */
export function mergedWords(one, numbers, held) {
  return one.words.map((word, at) => {
    if (typeof word === "number") return word;
    const number = word.constant + (word.factor ? word.factor * numbers[word.argument] : 0);
    return (held[at] & ~word.mask & WHOLE_WORD) | (number & word.mask);
  });
}

/** Whether the words of a step must be read: to wait for them, or to preserve bits. @param {Step} one */
export function stepReads(one) {
  return one.within !== undefined || one.words.some((word) => typeof word === "object" && word.mask !== WHOLE_WORD);
}

/**
 * Send a command, with the number of a constant write, or the arguments of steps by name.
 * @param {import("./session.js").Session} session @param {string} name @param {AnyCommand} given
 * @param {number | Readonly<Record<string, number>>} [value]
 */
export async function giveCommand(session, name, given, value) {
  if ("requests" in given) return giveSteps(session, name, given, typeof value === "object" ? value : {});
  const number = typeof value === "object" ? undefined : value;
  if (number !== undefined && !Number.isSafeInteger(number)) {
    throw new RequestError("bad_value", `the number of ${name} is an integer, not ${shown(number)}`);
  }
  if (given.value !== undefined && number !== undefined && number !== given.value) {
    throw new AccessError(`${name} is the number ${given.value}, not ${number}`);
  }
  await session._about(name, () => session._once(() => session._put(given.at, [given.value ?? number ?? 1])));
}

/** @param {import("./session.js").Session} session @param {string} name @param {SteppedCommand} given
 * @param {Readonly<Record<string, number>>} values */
async function giveSteps(session, name, given, values) {
  const numbers = checkedArguments(name, given, values);
  for (let place = 0; place < given.requests.length; place++) {
    const one = given.requests[place];
    const label = `${name}, step ${place + 1} (${one.says})`;
    try {
      if (await isTaken(session, one)) await request(session, one, numbers);
    } catch (error) {
      throw error instanceof FieldscribeError ? error.needing(label) : error;
    }
  }
}

/** @param {string} name @param {SteppedCommand} given @param {Readonly<Record<string, number>>} values */
function checkedArguments(name, given, values) {
  const takes = Object.keys(given.arguments);
  const names = Object.keys(values);
  if (takes.length !== names.length || takes.some((one) => !names.includes(one))) {
    const text = `${name} takes ${takes.join(", ") || "no arguments"}, not ${names.join(", ") || "none"}`;
    throw new RequestError("bad_arguments", text);
  }
  for (const [argument, [low, high]] of Object.entries(given.arguments)) {
    const number = values[argument];
    if (!Number.isSafeInteger(number) || number < low || number > high) {
      throw new OutOfRangeError(`${argument} of ${name} is ${low}..${high}, not ${shown(number)}`);
    }
  }
  return values;
}

/** Whether the condition of a step is true; reads the points that it compares.
 * @param {import("./session.js").Session} session @param {Step} one @returns {Promise<boolean>} */
async function isTaken(session, one) {
  /** @type {Record<string, number | string>} */
  const held = {};
  for (const clause of one.when ?? []) {
    let holds = true;
    for (const [of, test, than] of clause) {
      held[of] = held[of] ?? (await session._compared(of));
      holds = stepTestHolds(held[of], test, than);
      if (!holds) break;
    }
    if (holds) return true;
  }
  return !one.when?.length;
}

/** @param {number | string} value @param {string} test @param {readonly (number | string)[]} than */
export function stepTestHolds(value, test, than) {
  const [bound] = than;
  if (test === "<") return value < bound;
  if (test === "<=") return value <= bound;
  if (test === ">") return value > bound;
  if (test === ">=") return value >= bound;
  return than.includes(value) === (test !== "!=");
}

/** Write the words of a step, or wait for them; raises WaitError if they do not appear in time.
 * @param {import("./session.js").Session} session @param {Step} one
 * @param {Readonly<Record<string, number>>} numbers */
async function request(session, one, numbers) {
  for (let left = one.within; ; left -= LOOK_PAUSE) {
    const at = { ...one.at, function: undefined };
    const held = stepReads(one) ? await session._get(at) : one.words.map(() => 0);
    const words = mergedWords(one, numbers, held);
    if (left === undefined) return session._once(() => session._put(one.at, words));
    if (words.every((word, place) => word === held[place])) return undefined;
    if (left <= 0) throw new WaitError(`${placeLabel(one.at)}: not so within ${one.within} s`, held);
    await paused(Math.min(left, LOOK_PAUSE));
  }
}

/** Wait. @param {number} seconds @returns {Promise<void>} */
export function paused(seconds) {
  return new Promise((resolve) => setTimeout(resolve, seconds * 1000));
}
