/** A date in parts. @param {number} words @param {readonly DatePart[]} parts @param {DateFacts} [facts] @returns {Form} */
export function dateParts(words: number, parts: readonly DatePart[], facts?: DateFacts): Form;
/** A time in parts. @param {number} words @param {readonly DatePart[]} parts @param {DateFacts} [facts] @returns {Form} */
export function timeParts(words: number, parts: readonly DatePart[], facts?: DateFacts): Form;
/** A date and time in parts. @param {number} words @param {readonly DatePart[]} parts @param {DateFacts} [facts] @returns {Form} */
export function dateTimeParts(words: number, parts: readonly DatePart[], facts?: DateFacts): Form;
export type DatePart = [name: string, word: number, high: number, low: number, base?: number];
export type DateFacts = {
    bcd?: boolean;
    lowFirst?: boolean;
};
import { Form } from "./forms.js";
