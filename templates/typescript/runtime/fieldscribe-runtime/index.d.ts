// SPDX-License-Identifier: 0BSD
/** The common part of generated packages: points with their codecs, places, commands and errors. */
export * from "./errors.js";
export * from "./types.js";
export type { Raws } from "./rules.js";
export type { Place } from "./places.js";
export type { Line, ReplyShape } from "./receiving.js";
export { SpecialCode } from "./special.js";
export { Word } from "./words.js";
export { Session } from "./session.js";
