// SPDX-License-Identifier: 0BSD
/** The types of points stand in types.d.ts; there is nothing of them at run time. */
export {};
