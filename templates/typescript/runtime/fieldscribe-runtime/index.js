// SPDX-License-Identifier: 0BSD
/** The common part of generated packages: points with their codecs, places, commands and errors. */
export * from "./commands.js";
export * from "./dates.js";
export * from "./errors.js";
export * from "./forms.js";
export * from "./numbers.js";
export * from "./places.js";
export * from "./points.js";
export * from "./receiving.js";
export * from "./rules.js";
export * from "./session.js";
export * from "./special.js";
export * from "./table.js";
export * from "./texts.js";
export * from "./types.js";
export * from "./wire-types.js";
export * from "./words.js";
