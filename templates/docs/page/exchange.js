/* A line that answers by itself: it shows what generated code sends, and what a device would reply. */

/** The generated code of the device, once it is loaded. @type {{ code?: any, points?: Map<string, Codec> }} */
const opened = {};

/** Return the code of the device, which is loaded at its first use; null for a family without code. */
function generatedCode() {
  if (opened.code === undefined) opened.code = globalThis.openCode?.() ?? null;
  return opened.code;
}

/** Return the generated point of a point of the page. @param {Point} point */
function codecOf(point) {
  const code = generatedCode();
  if (!code || !point.shared.generated) return null;
  opened.points ??= new Map([...code.Device.table.points.values()].map((codec) => [codec.item, codec]));
  return opened.points.get(point.name) ?? null;
}

/** Return the numbers on which a base depends, with their ranges: those that are given, else the address of a block
 * that is found. @param {string | undefined} name @returns {Record<string, [number, number]>} */
function baseNumbers(name) {
  const { bases = {}, given } = generatedCode().Device.table.facts;
  if (name === undefined || !bases[name]) return {};
  const { block, factors } = bases[name];
  return block === undefined ? Object.fromEntries(Object.keys(factors).map((each) => [each, given[each]])) : { [name]: [0, 0xffff] };
}

/** Return what addresses count from; undefined where a number is missing. @param {string | undefined} name
 * @param {Record<string, any>} numbers @returns {number | undefined} */
function baseAddress(name, numbers) {
  if (name === undefined) return 0;
  const { block, offset, factors } = generatedCode().Device.table.facts.bases?.[name] ?? { block: 0 };
  if (block !== undefined) return numbers[name];
  const sum = Object.entries(factors).reduce((address, [each, factor]) => address + numbers[each] * factor, offset);
  return Number.isNaN(sum) ? undefined : sum;
}

/** A line whose device holds the words in `memory`; `exchanges` are the frames that went over it. */
class AnsweringLine {
  /** @param {string} framing */
  constructor(framing) {
    this.framing = framing;
    this.memory = new Map();
    /** @type {{ request: any, reply: any }[]} */
    this.exchanges = [];
    /** What is answered instead, to the last request. @type {any} */
    this.answer = null;
    this.unit = 0;
    this.pkw = 0;
    this.isSingleLast = false;
  }

  /** @param {any} at @param {number[]} words @param {number} start what its addresses count from */
  hold(at, words, start) {
    const index = this.framing === "uss" ? at.index : 0; // elsewhere the address alone is the place
    const ascending = [...at.addresses].sort((one, other) => one - other);
    ascending.forEach((address, each) => this.memory.set(this.key(at.space, start + address, index), words[each] ?? 0));
  }

  /** @param {string} space @param {number} address @param {number} [index] */
  key(space, address, index = 0) {
    return `${space} ${address} ${index}`;
  }

  /** The words of a parameter of USS; undefined for one that is not held. @param {number} parameter @param {number} index */
  wordsOf(parameter, index) {
    const words = this.memory.get(this.key("parameter", parameter, index));
    return words === undefined ? undefined : [words].flat();
  }

  /** @param {any} request @param {any} shape */
  async exchange(request, shape) {
    const reply = request && (this.answer ?? ANSWERS[this.framing === "can" || this.framing === "uss" ? this.framing : "modbus"](this, request, shape));
    if (request) this.exchanges.push({ request, reply: shape.broadcast ? null : reply });
    if (this.framing === "can" && !(reply && shape.accepts(reply)) && !shape.broadcast) throw new (generatedCode().NoReplyError)("this frame answers nothing");
    return reply;
  }
}

/** The spaces by function. @type {Record<number, string>} */
const MODBUS_SPACES = { 1: "coil", 2: "discrete", 3: "holding", 4: "input", 5: "coil", 6: "holding", 15: "coil", 16: "holding" };

/** @type {Record<string, (line: AnsweringLine, request: any, shape: any) => any>} */
const ANSWERS = {
  /** @param {AnsweringLine} line @param {any} request */
  modbus(line, request) {
    const tcp = line.framing === "tcp";
    const body = tcp ? request.subarray(6) : request.subarray(0, -2);
    const [, code] = body;
    const [address, count] = [body[2] * 256 + body[3], body[4] * 256 + body[5]];
    const space = MODBUS_SPACES[code];
    const held = (/** @type {number} */ at) => line.memory.get(line.key(space, at)) ?? line.memory.get(line.key(code === 4 ? "holding" : "input", at)) ?? 0;
    let reply = [...body.subarray(0, 6)];
    if (code <= 2) {
      const bits = new Array(Math.ceil(count / 8)).fill(0);
      for (let at = 0; at < count; at += 1) if (held(address + at)) bits[at >> 3] |= 1 << (at & 7);
      reply = [body[0], code, bits.length, ...bits];
    } else if (code <= 4) {
      const words = Array.from({ length: count }, (_, at) => held(address + at));
      reply = [body[0], code, 2 * count, ...words.flatMap((word) => [word >> 8, word & 255])];
    }
    if (tcp) return Uint8Array.of(...request.subarray(0, 4), reply.length >> 8, reply.length & 255, ...reply);
    const check = generatedCode().modbusCrc(Uint8Array.from(reply));
    return Uint8Array.of(...reply, check & 255, check >> 8);
  },
  /** @param {AnsweringLine} line @param {any} frame */
  can(line, frame) {
    const { Device, carriesRole, canFrameFault, parseCanFrame, buildCanFrame } = generatedCode();
    const { profile } = Device.table.facts;
    const request = profile.messages.find((/** @type {any} */ each) => each.direction === "request" && each.roles.length && !canFrameFault(each, line.unit, frame));
    const answer = request && profile.messages.find((/** @type {any} */ each) => each.answers === request.name);
    if (!answer) return null;
    const { address, raw } = parseCanFrame(request, line.unit, frame);
    const writes = carriesRole(request, "raw");
    return buildCanFrame(answer, profile, line.unit, address, writes ? raw : line.memory.get(line.key("parameter", address)) ?? 0);
  },
  /** @param {AnsweringLine} line @param {any} request */
  uss(line, request) {
    const { profile } = generatedCode().Device.table.facts;
    const reply = Uint8Array.from(request);
    const task = request[3] >> 4;
    const page = [15, 12, 13, 14].reduce((bits, place, at) => bits | (((request[5] << 8 >> place) & 1) << at), 0);
    const parameter = ((request[3] & 7) << 8 | request[4]) + 2000 * page;
    const words = line.wordsOf(parameter, request[6]);
    const wide = (words?.length ?? 1) > 1;
    const responses = profile.tasks[task] ?? [0];
    const response = responses.find((/** @type {number} */ each) => [2, 5].includes(each) === wide) ?? responses[0] ?? 0;
    reply[3] = response << 4 | request[3] & 15;
    if (task && responses.length && words && !writesValue(task)) {
      const [high, low] = wide ? words : line.isSingleLast ? [0, words[0]] : [words[0], 0];
      reply.set([high >> 8, high & 255, low >> 8, low & 255].slice(0, 2 * (line.pkw - 2)), 7);
    }
    reply[reply.length - 1] = reply.subarray(0, -1).reduce((check, byte) => check ^ byte, 0);
    return reply;
  },
};

/** Return true for a task of USS that brings a value. @param {number} task */
function writesValue(task) {
  return [2, 3, 7, 8, 11, 12, 13, 14].includes(task);
}

/** Return the device on a line that answers by itself; `facts` may have unit, framing, words of the parameter part,
 * variants, and numbers that say where bases are. @param {any} facts */
function answeringDevice({ unit, framing, pkw, variants, numbers = {} }) {
  const { Device } = generatedCode();
  const line = new AnsweringLine(framing);
  line.unit = unit;
  const link = framing === "uss" ? { pkw: pkw ?? Math.max(...Device.table.facts.profile.pkw), pzd: 2 } : undefined;
  line.pkw = link?.pkw ?? 0;
  line.isSingleLast = line.pkw === 4;
  const made = new Device(line, { unit, ...(link && { link }), ...variants, ...numbers });
  for (const [name, { block }] of Object.entries(Device.table.facts.bases ?? {})) {
    if (block !== undefined && numbers[name] !== undefined) made.setBase(name, numbers[name]);
  }
  return { made, line };
}

/** Return the frames of a cyclic telegram with these words of a point, and its raw number; all other words are 0.
 * @param {Codec} codec @param {number[]} words @param {any} raw @param {number} unit @returns {any[]} */
function cyclicFrames(codec, words, raw, unit) {
  const { Device, buildUssRequest, canFrameOf, messageNamed, SignalPacking, wordPlaces } = generatedCode();
  const { profile } = Device.table.facts;
  const telegram = profile.telegrams.find((/** @type {any} */ each) => each.name === codec.at.telegram);
  if (!telegram) return [];
  const ascending = [...codec.at.addresses].sort((one, other) => one - other);
  const last = ascending[ascending.length - 1];
  const held = Array.from({ length: Math.max(telegram.words, last + 1) }, (_, at) => words[ascending.indexOf(at)] ?? 0);
  if (device.family === "uss") {
    const pzd = Math.min(profile.pzd[1], Math.max(2, last + 1));
    return [buildUssRequest({ unit, words: held.slice(0, pzd) }, profile, { pkw: Math.min(...profile.pkw), pzd })];
  }
  const message = messageNamed(profile, telegram.message);
  if (message.signals.length) {
    const packing = new SignalPacking(message.signals, message.length);
    const number = packing.firsts().indexOf(ascending[0]);
    const selecting = message.signals[number].when.map((/** @type {any} */ [at, raws]) => [at, raws[0]]);
    return [canFrameOf(message, profile, unit, packing.pack([...selecting, [number, raw]]))];
  }
  const each = wordPlaces(message).length;
  const slots = [...new Set(ascending.map((at) => Math.floor(at / each)))];
  return slots.map((slot) => canFrameOf(message, profile, unit, telegramBytes(message, unit, slot, held.slice(slot * each, (slot + 1) * each))));
}

/** The bytes of a message that carries words. @param {any} message @param {number} unit @param {number} slot @param {number[]} words */
function telegramBytes(message, unit, slot, words) {
  /** @type {Record<string, (number: number) => number>} */
  const carried = { constant: (number) => number, unit: (number) => unit >> number, multiplexer: () => slot, word: (number) => (words[number >> 1] ?? 0) >> (number & 1 ? 0 : 8) };
  const data = Uint8Array.from(message.roles, ({ kind, number }) => (carried[kind]?.(number) ?? 0) & 255);
  message.roles.forEach((/** @type {any} */ { kind, number }, /** @type {number} */ place) => {
    if (kind === "xor") data[place] = data.reduce((sum, byte, at) => ((number >> at) & 1 ? sum ^ byte : sum), 0);
  });
  return data;
}

/** Return bytes as people print them. @param {Iterable<number>} bytes */
function hexBytes(bytes) {
  return [...bytes].map((byte) => byte.toString(16).toUpperCase().padStart(2, "0")).join(" ");
}

/** Return the frame as text: bytes, for CAN after the identifier. @param {any} frame */
function frameText(frame) {
  if (frame instanceof Uint8Array) return hexBytes(frame);
  return frame ? `${frame.id.toString(16).toUpperCase().padStart(frame.extended ? 8 : 3, "0")}#${hexBytes(frame.data).replaceAll(" ", "")}` : "";
}

/** Return the frame in a text, as `frameText` writes it or with other separators; null if it has none.
 * @param {string} text @param {boolean} isCan */
function frameOf(text, isCan) {
  const can = /^\s*([0-9a-f]{3,8})\s*#\s*([0-9a-f\s]*)$/i.exec(text);
  const digits = (can ? can[2] : text).replaceAll(/0x|[\s,;:-]/gi, "");
  if (!/^([0-9a-f]{2})*$/i.test(digits) || isCan !== Boolean(can)) return null;
  const data = Uint8Array.from(digits.match(/../g) ?? [], (pair) => parseInt(pair, 16));
  return can ? { id: parseInt(can[1], 16), extended: can[1].length > 3, data } : data;
}
