/** Characters. @param {number} characters @param {...(string | TextFacts)} more encoding, and how words hold it
 * @returns {Form} */
export function text(characters: number, ...more: (string | TextFacts)[]): Form;
/** Bytes in a notation. @param {number} count @param {...(string | TextFacts)} more notation, and how words hold it
 * @returns {Form} */
export function bytes(count: number, ...more: (string | TextFacts)[]): Form;
/** Decimal digits. @param {WireType} wire @param {Readonly<Record<string, number>>} names @param {{ count: number }} facts
 * @returns {Form} */
export function digits(wire: WireType, names: Readonly<Record<string, number>>, { count }: {
    count: number;
}): Form;
/** A time. @param {Form} form @param {string} epoch @returns {Form} */
export function time(form: Form, epoch: string): Form;
export type Raws = import("./rules.js").Raws;
export type TextFacts = {
    perWord?: number;
    padding?: number;
    lowFirst?: boolean;
};
import { Form } from "./forms.js";
import { WireType } from "./wire-types.js";
