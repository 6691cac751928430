// SPDX-License-Identifier: 0BSD
/** What vectors say of frames and whole exchanges, held against the generated class of a device. */
import { buildCanFrame, messageNamed, parseCanFrame, SignalPacking } from "../fieldscribe-runtime/can-frames.js";
import { TelegramReceiver } from "../fieldscribe-runtime/can.js";
import { mergedWords, stepReads } from "../fieldscribe-runtime/commands.js";
import { FieldscribeError, NoReplyError } from "../fieldscribe-runtime/errors.js";
import { buildModbusRequest, parseModbusReply } from "../fieldscribe-runtime/modbus-frames.js";
import { lowestOf } from "../fieldscribe-runtime/places.js";
import { camelName } from "../fieldscribe-runtime/words.js";
import { buildUssBroadcast, buildUssRequest, parseUssReply } from "../fieldscribe-runtime/uss-frames.js";

/** The fields of a vector by name. @typedef {Record<string, any>} Vector */
/** The generated class of a device. @typedef {any} DeviceClass */
/** @typedef {(device: DeviceClass, vector: Vector) => boolean | Promise<boolean>} Check */

/** The status of a call, and its result or error. @param {() => unknown} work @returns {Promise<[string, any]>} */
async function outcomeOf(work) {
  try {
    return ["ok", await work()];
  } catch (error) {
    if (error instanceof FieldscribeError) return [error.status, error];
    throw error;
  }
}

/** Whether two values are the same, all through; a raw number of a vector may be a number or a bigint. @param {any} one
 * @param {any} other @returns {boolean} */
function isSame(one, other) {
  if (Object.is(one, other) || (typeof one === "bigint" && String(one) === String(other))) return true;
  if (typeof one !== "object" || typeof other !== "object" || !one || !other) return false;
  const names = Object.keys(one);
  return names.length === Object.keys(other).length && names.every((name) => isSame(one[name], other[name]));
}

/** The point of a vector. @param {DeviceClass} device @param {Vector} vector @returns {any} */
function pointOfVector(device, vector) {
  const { points } = device.table;
  const name = camelName(vector.point);
  const found = points.get(name) ?? points.get(`${name}_`);
  if (!found) throw new Error(`there is no point ${vector.point}`);
  return found;
}

/** A line of every family that follows a script; requests in `needs` may come in any order. */
class ScriptedLine {
  /** @param {Vector} vector */
  constructor(vector) {
    this.framing = vector.framing ?? undefined;
    /** The bytes of the transaction, which is the same in all steps of a script. */
    this.head = this.framing === "tcp" ? 2 : 0;
    /** @type {[Uint8Array, Uint8Array][]} */
    this.steps = [...vector.script];
    /** @type {Map<string, [Uint8Array, Uint8Array]>} */
    this.needs = new Map(
      (vector.needs ?? []).map((/** @type {[Uint8Array, Uint8Array]} */ step) => [String(this.body(step[0])), step]),
    );
  }

  /** @param {any} request @param {any} reply @returns {Promise<any>} */
  async exchange(request, reply) {
    if (reply.framing !== "can") return this.answer(request);
    const { id, data } = request;
    const came = this.answer(Uint8Array.of(id >>> 24, (id >> 16) & 0xff, (id >> 8) & 0xff, id & 0xff, ...data));
    if (reply.broadcast) return undefined;
    const frame = { id: ((came[0] << 24) | (came[1] << 16) | (came[2] << 8) | came[3]) >>> 0, data: came.slice(4) };
    if (came.length && reply.accepts(frame)) return frame;
    throw new NoReplyError("no frame came");
  }

  /** @param {Uint8Array} frame */
  body(frame) {
    return frame.slice(this.head);
  }

  /** @param {Uint8Array} request @returns {Uint8Array} */
  answer(request) {
    const none = new Uint8Array(0);
    const [sent, came] = this.needs.get(String(this.body(request))) ?? this.steps.shift() ?? [none, none];
    if (String(this.body(sent)) !== String(this.body(request))) throw new Error(`sent ${request}, not ${sent}`);
    return came.map((byte, at) => (at < this.head ? byte ^ sent[at] ^ request[at] : byte));
  }
}

/** How the link of a vector is set. @param {any} vector */
function linkOfVector({ pkw, pzd, single_first: singleFirst }) {
  return { pkw, pzd, singleFirst: Boolean(singleFirst) };
}

/** A device over the script of a vector. @param {DeviceClass} device @param {Vector} vector @param {any} [point] */
function scripted(device, vector, point) {
  const line = new ScriptedLine(vector);
  /** @type {Record<string, unknown>} */
  const options = { unit: vector.unit };
  if ("pkw" in vector) options.link = linkOfVector(vector);
  const { variant, onlyFor } = point?.facts ?? {};
  for (const [axis, value] of [variant, onlyFor && [onlyFor[0], onlyFor[1][0]]].filter(Boolean)) {
    options[camelName(axis)] = value;
  }
  const made = new device(line, options);
  for (const [base, start] of Object.entries(vector.starts ?? {})) {
    made.setBase(base, Number(start), Number(vector.lasts[base]));
  }
  return { line, made, handle: point && made.point(device.table.attributes.get(point)) };
}

/** Whether an operation has the status and the result of the vector, and sent all that it should.
 * @param {Vector} vector @param {ScriptedLine} line @param {() => unknown} work @param {unknown} [expected] */
async function follows(vector, line, work, expected) {
  const [status, result] = await outcomeOf(work);
  if (status !== vector.status || line.steps.length) return false;
  return status !== "ok" || isSame(result, expected);
}

/** @param {any} point @param {Vector} vector */
function rawOfVector(point, vector) {
  return vector.words?.length ? point.fromWords(vector.words) : vector.raw;
}

/** The raw numbers of other points that a vector needs. @param {Vector} vector */
function rawsOfVector(vector) {
  const pairs = Object.entries(vector.with ?? {});
  return Object.fromEntries(pairs.map(([name, raw]) => [camelName(name), Number(raw)]));
}

/** @param {DeviceClass} device @param {any} vector */
async function readFollows(device, vector) {
  const point = pointOfVector(device, vector);
  const raw = vector.status === "ok" ? rawOfVector(point, vector) : undefined;
  const value = vector.status === "ok" ? point.decode(raw, rawsOfVector(vector)) : undefined;
  for (const [name, expected] of [
    ["readRaw", raw],
    ["read", value],
  ]) {
    const { line, handle } = scripted(device, vector, point);
    if (!(await follows(vector, line, () => handle[name](), expected))) return false;
  }
  return true;
}

/** @param {DeviceClass} device @param {Vector} vector @param {{ keep?: boolean }} [how] */
async function writeFollows(device, vector, how) {
  const point = pointOfVector(device, vector);
  const raw = rawOfVector(point, vector);
  const raws = rawsOfVector(vector);
  const { line, handle } = scripted(device, vector, point);
  if (!(await follows(vector, line, () => handle.writeRaw(raw, how)))) return false;
  if (!point.decode) return true;
  const value = point.decode(raw, raws);
  const [encoded] = await outcomeOf(() => point.encode(value, raws));
  if (encoded === "wrong_type") return true; // a number of too many bits for a value is written raw alone
  const again = scripted(device, vector, point);
  return follows(vector, again.line, () => again.handle.write(value, how));
}

/** @param {DeviceClass} device @param {any} vector */
async function commandFollows(device, vector) {
  const { line, made } = scripted(device, vector);
  return follows(vector, line, () => made[commandAttribute(device, vector.command)].send());
}

/** What a command is called: its name may be a point's, or a method. @param {DeviceClass} device
 * @param {string} name */
function commandAttribute(device, name) {
  const { commands = {} } = device.table.facts;
  const plain = camelName(name);
  return [`${plain}Command`, plain, `${plain}_`].find((one) => one in commands) ?? plain;
}

/** @param {any} vector */
function modbusRequestOf({ unit, function: code, address, count, values }) {
  return { unit, function: code, address, count, values: values ?? [] };
}

/** The frame of a vector with its framing, and the PDU in it unless checksum or framing are wrong. @param {any} vector
 * @returns {[Uint8Array, import("../fieldscribe-runtime/modbus-frames.js").ModbusFraming][]} */
function modbusFramesOf({ framing, status, bytes: given }) {
  const bytes = given ?? new Uint8Array(0);
  if (framing !== "rtu" || status === "bad_crc" || status === "bad_framing") return [[bytes, framing]];
  return [[bytes, framing], [bytes.subarray(0, -2), "pdu"]];
}

/** @param {DeviceClass} device @param {any} vector */
async function modbusBuilds(device, vector) {
  const { profile } = device.table.facts;
  for (const [bytes, framing] of modbusFramesOf(vector)) {
    const build = () => buildModbusRequest(modbusRequestOf(vector), profile, framing, vector.transaction);
    const [status, frame] = await outcomeOf(build);
    if (status !== vector.status || (status === "ok" && !isSame(frame, bytes))) return false;
  }
  return true;
}

/** @param {DeviceClass} device @param {any} vector */
async function modbusParses(device, vector) {
  const { profile } = device.table.facts;
  for (const [bytes, framing] of modbusFramesOf(vector)) {
    const parse = () => parseModbusReply(modbusRequestOf(vector), bytes, profile, framing, vector.transaction);
    const [status, result] = await outcomeOf(parse);
    if (status !== vector.status) return false;
    if (status === "exception" && result.code !== vector.exception) return false;
    if (status === "ok" && !isSame(result, vector.values_out ?? [])) return false;
  }
  return true;
}

/** @param {DeviceClass} device @param {any} vector */
function stepMerges(device, vector) {
  const given = device.table.facts.commands[commandAttribute(device, vector.command)];
  const one = given.requests[vector.index];
  const pairs = Object.entries(vector.with ?? {});
  const numbers = Object.fromEntries(pairs.map(([name, number]) => [name, Number(number)]));
  const words = mergedWords(one, numbers, vector.held ?? []);
  const within = one.within === undefined ? null : Math.round(one.within * 1000);
  const found = [lowestOf(one.at), one.words.length, one.at.function ?? null, one.at.base ?? null];
  const expected = [vector.address, words.length, vector.write ?? null, vector.base ?? null];
  const reads = [Boolean(one.when?.length), stepReads(one), within];
  const due = [Boolean(vector.conditional), (vector.read ?? null) !== null, vector.within ?? null];
  const ends = Object.entries(given.arguments).every(([name, pair]) => pair.includes(numbers[name]));
  return ends && isSame(words, vector.words) && isSame(found, expected) && isSame(reads, due);
}

/** Where a device that is given numbers, or finds blocks, reads the point. @param {DeviceClass} device
 * @param {any} vector */
async function baseIsFound(device, vector) {
  const line = new ScriptedLine({ ...vector, script: vector.script ?? [] });
  const given = Object.entries(vector.given ?? {}).map(([name, number]) => [camelName(name), Number(number)]);
  const options = { unit: vector.unit, ...Object.fromEntries(given) };
  const name = device.table.attributes.get(pointOfVector(device, vector));
  const [status, made] = await outcomeOf(async () => {
    const opened = new device(line, options);
    await opened.point(name).readRaw();
    return opened;
  });
  if (status !== vector.status || line.steps.length) return false;
  if (vector.kind !== "base" || given.length || status !== "ok") return true;
  const found = [...(await made.findBlocks()).values()];
  return found.some(({ address, last }) => isSame([address, last], [vector.start, vector.last]));
}

/** @param {DeviceClass} device @param {any} vector */
function blockIsPlanned(device, { group, space, function: code, address, count }) {
  const blocks = device.table.facts.blocks?.[group] ?? device.table.facts.blocks?.[camelName(group)] ?? [];
  return blocks.some((/** @type {any} */ one) =>
    isSame([one.space, one.function, one.address, one.count], [space, code, address, count]),
  );
}

/** The words that bring a group. @param {DeviceClass} device @param {any} vector */
function groupIsRead(device, { group, addresses }) {
  const read = [...device.table.points.values()].filter(
    (point) => point.group === group && point.decode && point.at.space === "parameter",
  );
  return isSame([...new Set(read.flatMap((point) => point.at.addresses))], addresses);
}

/** A number of the protocol with a name. @param {DeviceClass} device @param {any} vector */
function codeIsNamed(device, { what, number, name }) {
  const { profile } = device.table.facts;
  return profile[what === "exception" ? "exceptions" : "errors"][number] === name;
}

/** @param {any} vector */
function ussRequestOf({ unit, task, parameter, index, width, value, words }) {
  return { unit, task, parameter, index, width, value, words: words ?? [] };
}

/** @param {DeviceClass} device @param {any} vector */
async function ussBuilds(device, vector) {
  const build = () => buildUssRequest(ussRequestOf(vector), device.table.facts.profile, linkOfVector(vector));
  const [status, bytes] = await outcomeOf(build);
  return status === vector.status && (status !== "ok" || isSame(bytes, vector.bytes));
}

/** @param {DeviceClass} device @param {any} vector */
async function ussBroadcasts(device, vector) {
  const link = linkOfVector(vector);
  const build = () => buildUssBroadcast(vector.mask ?? [], vector.words ?? [], device.table.facts.profile, link);
  const [status, bytes] = await outcomeOf(build);
  return status === vector.status && (status !== "ok" || isSame(bytes, vector.bytes));
}

/** @param {DeviceClass} device @param {any} vector */
async function ussParses(device, vector) {
  const { unit, task, parameter, index, bytes } = vector;
  const link = linkOfVector(vector);
  const parse = () =>
    parseUssReply({ unit, task, parameter, index }, bytes ?? new Uint8Array(0), device.table.facts.profile, link);
  const [status, found] = await outcomeOf(parse);
  if (status !== vector.status) return false;
  if (status === "refused") return vector.response === 7 && found.code === vector.error;
  const expected = [vector.response, vector.width, vector.value, vector.error ?? 0, vector.words ?? []];
  return status !== "ok" || isSame([found.response, found.width, found.value, 0, found.words], expected);
}

/** @param {DeviceClass} device @param {any} vector */
async function canBuilds(device, vector) {
  const { profile } = device.table.facts;
  const message = messageNamed(profile, vector.message);
  const [status, frame] = await outcomeOf(() =>
    buildCanFrame(message, profile, vector.unit, vector.address, vector.raw),
  );
  return status === vector.status && (status !== "ok" || isSame([frame.id, frame.data], [vector.id, vector.bytes]));
}

/** @param {DeviceClass} device @param {any} vector */
async function canParses(device, vector) {
  const message = messageNamed(device.table.facts.profile, vector.message);
  const frame = { id: vector.id, data: vector.bytes ?? new Uint8Array(0) };
  const [status, found] = await outcomeOf(() => parseCanFrame(message, vector.unit, frame));
  return status === vector.status && (status !== "ok" || isSame(found, { address: vector.address, raw: vector.raw }));
}

/** @param {DeviceClass} device @param {any} vector */
function receiverOf(device, vector) {
  const receiver = new TelegramReceiver(device.table.facts.profile, vector.telegram, vector.unit);
  const taken = (vector.frames ?? []).map((/** @type {[number, Uint8Array]} */ [id, data]) =>
    Number(receiver.take({ id, data })),
  );
  return { receiver, taken };
}

/** Which frames belong to a telegram. @param {DeviceClass} device @param {any} vector */
function canTakes(device, vector) {
  return isSame(receiverOf(device, vector).taken, vector.taken);
}

/** A point of a telegram. @param {DeviceClass} device @param {any} vector */
async function canTelegram(device, vector) {
  const { receiver, taken } = receiverOf(device, vector);
  const point = pointOfVector(device, vector);
  const [status, words] = await outcomeOf(() => receiver.ascending(point.at));
  if (status !== vector.status || !isSame(taken, vector.taken ?? []) || point.at.telegram !== vector.telegram)
    return false;
  return status !== "ok" || isSame(point.fromWords(words), vector.raw);
}

/** A signal of a message, out of a frame and into one. @param {DeviceClass} device @param {any} vector */
async function canSignalFollows(device, vector) {
  const point = pointOfVector(device, vector);
  const message = messageNamed(device.table.facts.profile, vector.telegram);
  const frame = { id: vector.id, data: vector.bytes ?? new Uint8Array(0) };
  let [status] = await outcomeOf(() => parseCanFrame(message, vector.unit, frame));
  const receiver = new TelegramReceiver(device.table.facts.profile, vector.telegram, vector.unit);
  if (receiver.take(frame) !== (status === "ok")) return false;
  let words;
  if (status === "ok") [status, words] = await outcomeOf(() => receiver.words(point.at.addresses));
  if (status !== vector.status || status !== "ok") return status === vector.status;
  const packing = new SignalPacking(message.signals, message.length);
  const number = packing.firsts().indexOf(point.at.addresses[0]);
  const selecting = message.signals[number].when.map(
    ([at, raws]) => /** @type {const} */ ([at, raws[raws.length - 1]]),
  );
  const packed = packing.pack([...selecting, [number, vector.raw]]);
  return isSame(point.fromWords(words), vector.raw) && isSame(packed, vector.packed);
}

/** The checks by the kind of vector. @type {Readonly<Record<string, Check>>} */
export const EXCHANGE_CHECKS = {
  read: readFollows,
  write: writeFollows,
  store: (device, vector) => writeFollows(device, vector, { keep: true }),
  alone: (device, vector) => writeFollows(device, { ...vector, script: [] }),
  command: commandFollows,
  build: modbusBuilds,
  reply: modbusParses,
  step: stepMerges,
  base: baseIsFound,
  base_behind: baseIsFound,
  block: blockIsPlanned,
  group: groupIsRead,
  code: codeIsNamed,
  uss_build: ussBuilds,
  uss_broadcast: ussBroadcasts,
  uss_reply: ussParses,
  can_build: canBuilds,
  can_reply: canParses,
  can_taken: canTakes,
  can_telegram: canTelegram,
  can_signal: canSignalFollows,
};
