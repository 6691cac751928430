/* Frames as people paste them: bytes in any usual notation, one frame a line, and the lines of logs and of candump. */

/** A pasted line: the bytes of a frame, for CAN with its identifier; `isReply` if the log says that the device sent it; `problem`
 * says why the line has no frame.
 * @typedef {{ text: string, time: number | null, data: Uint8Array, id?: number, isReply?: boolean, remote?: boolean, problem?: string }} Pasted */

const LONGEST_LINE = 8192;
const TIME = /^[[(]?(?:(\d{4}-\d\d-\d\d)[T ])?(\d{1,2}):(\d\d):(\d\d(?:[.,]\d{1,9})?)(?:Z|[+-]\d\d:?\d\d)?[\])]?(?:[\s;,]+|:\s+)|^[[(]?(\d{1,12}\.\d{1,9})[\])]?[\s:;,]+/;
const WAYS = /^(?:(?:TX|RX|REQ|RES|SENT|RECV|SEND|REQUEST|RESPONSE|REPLY|<-|->|<<|>>|<|>)[\s:]*){1,4}/i;
/** A line that the packages of Python, Rust and TypeScript log. */
const LOGGED = /\bunit \d+(?: (->|<-) (?:([0-9A-F]{1,8})[:h] )?\[?([0-9A-F]{2}(?:,? [0-9A-F]{2})*)\]?|: )/;
const CANDUMP = /^(?:[A-Za-z][\w.-]{0,31}\s+)?(?:0x)?([0-9a-f]{1,8})#([^\s#]*)/i;
const CAN_TABLE = /^(?:[A-Za-z][\w.-]{0,31}\s+)?(?:[RT]X\s+\S\s+\S\s+)?(?:0x)?([0-9a-f]{3,8})h?\s*(?:\[\d{1,2}\]|:|\s)\s*(remote request|(?:[0-9a-f]{2}[\s,:-]{0,3}){0,64})(?:'.*)?$/i;

/** Return the seconds at the beginning of a line, and the rest of the line. @param {string} text
 * @returns {[number | null, string]} */
function timed(text) {
  const match = TIME.exec(text);
  if (!match) return [null, text];
  const rest = text.slice(match[0].length);
  if (match[5]) return [Number(match[5]), rest];
  const seconds = Number(match[2]) * 3600 + Number(match[3]) * 60 + Number(match[4].replace(",", "."));
  const day = match[1] ? Date.parse(match[1]) / 1000 : 0;
  return [(Number.isNaN(day) ? 0 : day) + seconds, rest];
}

/** Return the bytes that a text stands for, with blanks, commas, colons, dashes, `0x`, or none of these; else why not.
 * @param {string} text @returns {Uint8Array | string} */
function bytesOf(text) {
  const pieces = text.replace(/0x|\\x|h'/gi, " 0x").split(/[\s,;:|-]+/).filter(Boolean);
  if (!pieces.length) return "there are no bytes";
  /** @type {number[]} */
  const bytes = [];
  for (const [at, piece] of pieces.entries()) {
    let digits = piece.startsWith("0x") ? piece.slice(2).padStart(2, "0") : piece;
    if (/^..h$/i.test(digits)) digits = digits.slice(0, 2);
    if (!/^[0-9a-f]+$/i.test(digits)) return `\`${piece.slice(0, 24)}\` (piece ${at + 1}) is not hexadecimal: only 0 to 9 and A to F count`;
    if (digits.length % 2) return `\`${piece.slice(0, 24)}\` (piece ${at + 1}) has ${countedText(digits.length, "digit")}; two make a byte`;
    for (let place = 0; place < digits.length; place += 2) bytes.push(parseInt(digits.slice(place, place + 2), 16));
  }
  return Uint8Array.from(bytes);
}

/** Return what a line of pasted text holds; null for an empty line. @param {string} line @param {boolean} isCan
 * @returns {Pasted | null} */
function pastedLine(line, isCan) {
  const text = line.trim();
  if (!text) return null;
  const nothing = { text: text.slice(0, 200), time: null, data: new Uint8Array(0) };
  if (text.length > LONGEST_LINE) return { ...nothing, problem: `the line has ${text.length} characters; no frame is as long` };
  const logged = text.includes("unit ") ? LOGGED.exec(text) : null;
  if (logged) return logged[3] ? pastedFrame({ ...nothing, time: timed(text)[0], isReply: logged[1] === "<-" }, logged[2], logged[3]) : null;
  const [time, rest] = timed(text);
  const match = isCan ? CANDUMP.exec(rest) ?? CAN_TABLE.exec(rest) : null;
  if (match) return pastedFrame({ ...nothing, time }, match[1], match[2]);
  if (isCan) return { ...nothing, problem: "it has no identifier: write identifier and data in hexadecimal, as in 321#DD00051513880064" };
  const way = WAYS.exec(rest)?.[0] ?? "";
  return pastedFrame({ ...nothing, time, isReply: /^(?:RX|RE[CSP]|<)/i.test(way) }, undefined, rest.slice(way.length));
}

/** @param {Pasted} pasted @param {string | undefined} identifier @param {string} digits @returns {Pasted} */
function pastedFrame(pasted, identifier, digits) {
  const id = identifier === undefined ? undefined : parseInt(identifier, 16);
  if (id !== undefined && id > 0x1fffffff) return { ...pasted, problem: `the identifier ${identifier} is longer than 29 bits` };
  if (id !== undefined && /^r/i.test(digits)) return { ...pasted, id, remote: true };
  const data = id !== undefined && !digits.trim() ? new Uint8Array(0) : bytesOf(digits.replaceAll(".", " "));
  return typeof data === "string" ? { ...pasted, problem: data } : { ...pasted, id, data };
}

/** Return `1 word`, `2 words`. @param {number} count @param {string} what */
function countedText(count, what) {
  return `${count} ${what}${count === 1 ? "" : "s"}`;
}

/** Split bytes into consecutive valid frames; return them whole if they hold at most one.
 * @param {Uint8Array} data @param {(rest: Uint8Array) => number} soundSize @param {number} least @returns {Uint8Array[]} */
function cutApart(data, soundSize, least) {
  const pieces = [];
  let rest = data;
  for (let size = soundSize(rest); size > 0 && rest.length; size = soundSize(rest)) {
    pieces.push(rest.subarray(0, size));
    rest = rest.subarray(size);
  }
  if (!pieces.length || (rest.length > 0 && rest.length < least)) return [data];
  return rest.length ? [...pieces, rest] : pieces;
}
