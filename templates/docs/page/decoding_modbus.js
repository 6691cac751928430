/* Frames of Modbus in words: requests, replies, echoes and exceptions. The request before a reply tells what it holds. */

/** Return the name of a function, its space, and the most items of a request; an unknown function has none. @param {number} code */
function functionOf(code) {
  const [name = "", space = "", most = 0] = device.bus.protocol.functions[code] ?? [];
  return { name, space, most };
}

/** A frame without its wrapping; `pdu` begins with the function code. @typedef {{ framing: string, data: Uint8Array, unit: number, pdu: Uint8Array, transaction: number, fault: string, checks: string }} Unwrapped */

/** @param {string} framing @param {Uint8Array} data @returns {Unwrapped} */
function unwrapModbus(framing, data) {
  const least = framing === "tcp" ? 8 : 4;
  const bare = { framing, data, unit: data[0], pdu: new Uint8Array(0), transaction: 0, fault: "", checks: "none" };
  if (data.length < least) {
    return { ...bare, fault: `${framing === "tcp" ? "a TCP" : "an RTU"} frame has at least ${least} bytes, here ${data.length === 1 ? "is" : "are"} ${data.length}` };
  }
  if (framing === "rtu") {
    const right = generatedCode().modbusCrc(data.subarray(0, -2));
    const [due, here] = [[right & 255, right >> 8], data.subarray(-2)];
    const isSwapped = here[0] === due[1] && here[1] === due[0] && here[0] !== due[0];
    const isRight = here[0] === due[0] && here[1] === due[1];
    const fault = isRight ? "" : isSwapped ? "the bytes of the checksum are swapped" : "the checksum is wrong";
    const checks = isSwapped ? `its two bytes are swapped: ${hexBytes(here)}, the low byte ${hexBytes(due)} travels first` : checkText(here, due);
    return { ...bare, pdu: data.subarray(1, -2), fault, checks };
  }
  const [transaction, protocol, size] = generatedCode().wordsOfBytes(data.subarray(0, 6));
  const made = { ...bare, unit: data[6], pdu: data.subarray(7), transaction, checks: `ok (transaction ${transaction})` };
  if (protocol) return { ...made, fault: "the header does not say Modbus", checks: `wrong: protocol number ${hexBytes(data.subarray(2, 4))} in place of 00 00` };
  if (size === data.length - 6) return made;
  return { ...made, fault: "the length in the header is wrong", checks: `wrong: it says ${size} bytes follow, ${data.length - 6} do` };
}

/** Return the length of a request or of a reply from its function code on; 0 if it is neither. @param {Uint8Array} pdu */
function requestSize(pdu) {
  if (!functionOf(pdu[0]).most) return 0;
  return pdu[0] < 15 ? 5 : pdu.length > 5 ? 6 + pdu[5] : 0;
}

/** @param {Uint8Array} pdu */
function replySize(pdu) {
  if (pdu[0] & 0x80) return 2;
  if (!functionOf(pdu[0]).most) return 0;
  if (pdu[0] > 4) return 5;
  return pdu.length > 1 ? 2 + pdu[1] : 0;
}

/** @param {Uint8Array} pdu */
function isWhole(pdu) {
  return pdu.length > 0 && [requestSize(pdu), replySize(pdu)].includes(pdu.length);
}

/** Return bits or words of the data of a function. @param {number} code @param {Uint8Array} data @returns {number[]} */
function valuesIn(code, data) {
  if (code <= 2 || code === 15) return Array.from({ length: 8 * data.length }, (_, at) => (data[at >> 3] >> (at & 7)) & 1);
  return generatedCode().wordsOfBytes(data.subarray(0, data.length & ~1));
}

/** Return the request in bytes that begin with a function code, or why they are none. @param {number} unit @param {Uint8Array} pdu @returns {any} */
function modbusRequestIn(unit, pdu) {
  const code = pdu[0];
  const name = hexText(code, 2);
  const { most } = functionOf(code);
  if (!most) return `function ${name} is not one of the Modbus functions known here`;
  if (pdu.length < 5) return `a request of function ${name} has at least 5 bytes from the function on, here are ${pdu.length}`;
  const [address, number] = generatedCode().wordsOfBytes(pdu.subarray(1, 5));
  if (code < 15 && pdu.length > 5) return `a request of function ${name} has 5 bytes from the function on, here are ${pdu.length}`;
  const isSingle = code === 5 || code === 6 || code === 8;
  if (code === 5 && number !== 0 && number !== 0xff00) return `a coil is written with FF00h or 0000h, here is ${shortAddress(number)}`;
  const count = isSingle ? 1 : number;
  if (count < 1 || count > most) return `a count of ${count} is outside 1 to ${most}`;
  if (code < 15) return { unit, function: code, address, count, values: isSingle ? [code === 5 ? number >> 15 : number] : [] };
  const data = pdu.subarray(6);
  const size = code === 15 ? (count + 7) >> 3 : 2 * count;
  if (pdu.length < 6) return "the byte count is missing, here are 0 bytes of data";
  if (pdu[5] !== data.length) return `the byte count says ${pdu[5]}, here are ${data.length} bytes of data`;
  if (data.length !== size && !(code === 15 && data.length === size + (size & 1))) return `${count} ${code === 15 ? "coils" : "words"} are ${size} bytes, here are ${data.length}`;
  return { unit, function: code, address, count, values: valuesIn(code, data).slice(0, count) };
}

class ModbusDecoder extends FrameDecoder {
  /** @param {Pasted} pasted @returns {Pasted[]} */
  frames(pasted) {
    const { data } = pasted;
    if (["rtu", "tcp"].some((framing) => !unwrapModbus(framing, data).fault)) return [pasted];
    const soundRtu = (/** @type {Uint8Array} */ rest) => {
      const pdu = rest.subarray(1);
      const sizes = pdu.length ? [requestSize(pdu), replySize(pdu)].sort((one, other) => one - other) : [];
      return 3 + (sizes.find((size) => size > 0 && size + 3 <= rest.length && !unwrapModbus("rtu", rest.subarray(0, size + 3)).fault) ?? -3);
    };
    const soundTcp = (/** @type {Uint8Array} */ rest) => {
      const size = 6 + rest[4] * 256 + rest[5];
      return size <= rest.length && !unwrapModbus("tcp", rest.subarray(0, size)).fault ? size : 0;
    };
    const found = cutApart(data, soundRtu, 4);
    return (found.length > 1 ? found : cutApart(data, soundTcp, 8)).map((each) => ({ ...pasted, data: each }));
  }

  /** @param {Uint8Array} data @returns {Unwrapped} */
  recognised(data) {
    const tried = [unwrapModbus("rtu", data), unwrapModbus("tcp", data)];
    const sound = tried.find((each) => !each.fault);
    const likely = sound ?? tried[device.framings[0] === "tcp" ? 1 : 0];
    if (sound || likely.framing === "tcp" || isWhole(likely.pdu) || !isWhole(data.subarray(1))) return likely;
    const right = generatedCode().modbusCrc(data);
    return { ...likely, pdu: data.subarray(1), fault: "the checksum is missing", checks: checkText([], [right & 255, right >> 8]) };
  }

  /** @param {Pasted} pasted @returns {Decoded} */
  decode({ data }) {
    const unwrapped = this.recognised(data);
    const decoded = this.read(unwrapped);
    const misprint = device.frames.find(([, bytes, note]) => note && bytes === hexBytes(data));
    if (misprint) decoded.notes.push(misprint[2]);
    if (unwrapped.fault) decoded.faults.unshift(unwrapped.fault);
    else if (data.length > (unwrapped.framing === "tcp" ? 260 : 256)) decoded.faults.unshift(`the frame has ${data.length} bytes, ${unwrapped.framing === "tcp" ? 260 : 256} are the most`);
    if (device.framings.length && !device.framings.includes(unwrapped.framing) && !unwrapped.fault && !this.isToldOfFraming) {
      this.isToldOfFraming = true;
      decoded.notes.push(`the manual knows only ${device.framings.join(" and ").toUpperCase()} frames; ${unwrapped.framing.toUpperCase()} takes a gateway`);
    }
    const code = unwrapped.pdu.length ? unwrapped.pdu[0] & (decoded.kind === "exception" ? 0x7f : 0xff) : undefined;
    const named = code === undefined ? "" : `, ${hexText(code, 2)} ${functionOf(code).name || "(not a function known here)"}`;
    const { unit } = unwrapped;
    return { ...decoded, unit: unit ?? null, checks: unwrapped.checks, summary: `${unwrapped.framing.toUpperCase()}, ${unit === undefined ? "no unit" : `unit ${unit}`}${named}: ${decoded.summary}` };
  }

  /** @param {Unwrapped} unwrapped @returns {Decoded} */
  read(unwrapped) {
    const { unit, pdu } = unwrapped;
    if (!pdu.length) return decodedFrame({});
    const open = this.open.get("");
    const { values, status } = this.answer(unwrapped, open);
    if (pdu[0] & 0x80) return this.exception(unwrapped, open, status);
    if (values) {
      this.open.delete("");
      const isRead = open.function <= 4;
      return decodedFrame({ kind: "reply", summary: `reply${isRead ? "" : ", the device has taken the request"}, ${this.spanOf(open)}`, items: this.items(open, isRead ? values : open.values, true) });
    }
    const parsed = modbusRequestIn(unit, pdu);
    return typeof parsed === "string" ? this.unmatched(unwrapped, parsed, open, status) : this.request({ ...parsed, transaction: unwrapped.transaction });
  }

  /** Return the values of a frame that answers the open request, or why it does not. @param {Unwrapped} unwrapped @param {any} open
   * @returns {{ values?: number[], status: string }} */
  answer({ framing, unit, pdu, transaction }, open) {
    const { FrameError, parseModbusReply } = generatedCode();
    if (!open) return { status: "" };
    if (framing === "tcp" && transaction !== open.transaction) return { status: "wrong_transaction" };
    try {
      return { values: parseModbusReply(open, Uint8Array.of(unit, ...pdu), this.profile, "pdu"), status: "ok" };
    } catch (error) {
      if (!(error instanceof FrameError)) throw error;
      return { status: /** @type {any} */ (error).status };
    }
  }

  /** @param {any} request @returns {Decoded} */
  request(request) {
    const { unit, function: code, count, address } = request;
    const { functions, broadcast, broadcasts } = this.profile;
    const findings = [];
    if (functions[code] === undefined) findings.push(`the device does not know function ${hexText(code, 2)}`);
    else if (count > functions[code]) findings.push(`the device takes at most ${functions[code]} of them in one request`);
    if (unit !== broadcast) findings.push(...this.strangeUnit(unit));
    else if (code <= 4 || code === 8) findings.push("broadcast: only writes may be sent to all units");
    else if (!broadcasts.includes(code)) findings.push(`broadcast: the device does not accept function ${hexText(code, 2)} as a broadcast`);
    if (address + count > 0x10000) findings.push("it reaches beyond the last address");
    if (unit === broadcast) this.open.delete("");
    else this.open.set("", request);
    const isEcho = (code === 5 || code === 6 || code === 8) && unit !== broadcast;
    return decodedFrame({
      kind: "request", summary: `${isEcho ? "request, or the reply that repeats it" : "request"}, ${this.spanOf(request)}`, findings,
      items: this.items(request, request.values.length ? request.values : undefined, false),
      notes: [...(unit === broadcast && !findings.length ? ["broadcast: no unit answers"] : []), ...this.offByOne(request)],
    });
  }

  /** @param {Unwrapped} unwrapped @param {any} open @param {string} status @returns {Decoded} */
  exception({ pdu }, open, status) {
    if (pdu.length !== 2) return decodedFrame({ faults: [`an exception has 2 bytes from the function on, here are ${pdu.length}`] });
    const code = pdu[1];
    const common = device.bus.protocol.exceptions[code];
    const meaning = common ? `: ${common} (the protocol's meaning; the manual does not list it)` : ": the manual does not list it";
    const summary = `exception ${device.bus.exceptions[code] ? codeText("exceptions", code, hexText(code, 2)) : hexText(code, 2) + meaning}`;
    const made = decodedFrame({ kind: "exception", exception: code, summary });
    if (!open) return { ...made, notes: ["which request it refuses is not in the frame"] };
    if (status !== "exception") return { ...made, faults: [`it does not answer the request before: ${noAnswer(status)}`] };
    this.open.delete("");
    return { ...made, summary: `${summary}; refused was ${this.spanOf(open)}`, items: this.items(open, open.values.length ? open.values : undefined) };
  }

  /** Decode as much as possible of a reply that does not fit the open request.
   * @param {Unwrapped} unwrapped @param {string} why @param {any} open @param {string} status @returns {Decoded} */
  unmatched({ unit, pdu }, why, open, status) {
    const faults = open ? [`it does not answer the request: ${noAnswer(status)}`] : [];
    const [code] = pdu;
    if (code <= 4 && pdu.length === replySize(pdu)) {
      const data = pdu.subarray(2);
      if (open?.function !== code) {
        return decodedFrame({ kind: "reply", summary: `reply with ${countedText(data.length, "byte")} of data: ${hexBytes(data)}`, faults, notes: ["which addresses these are, only the request says: give it before this frame"] });
      }
      this.open.delete("");
      const values = valuesIn(code, data);
      const came = { ...open, count: Math.min(open.count, values.length) };
      const due = code <= 2 ? (open.count + 7) >> 3 : 2 * open.count;
      if (data.length !== due) faults.splice(0, 1, `it brings ${countedText(data.length, "byte")}, the request asks for ${due} (${countedText(open.count, "item")})`);
      return decodedFrame({ kind: "reply", summary: `reply, ${this.spanOf(came)}`, faults, items: this.items(came, values.slice(0, came.count), true) });
    }
    const { most } = functionOf(code);
    if (code >= 15 && pdu.length === 5 && most) {
      const [address, count] = generatedCode().wordsOfBytes(pdu.subarray(1));
      const confirmed = { unit, function: code, address, count, values: [] };
      const isPossible = count > 0 && count <= most;
      return decodedFrame({ kind: "reply", summary: `reply, the device has taken the request, ${this.spanOf(confirmed)}`, faults, items: isPossible ? this.items(confirmed) : [] });
    }
    const follow = `${countedText(pdu[1], "byte")} of data ${pdu[1] === 1 ? "follows" : "follow"}`;
    const isRead = code > 0 && code <= 4 && pdu.length > 1;
    return decodedFrame({ faults: [isRead ? `as a request: ${why}; as a reply: it says that ${follow}, here ${pdu.length === 3 ? "is" : "are"} ${pdu.length - 2}` : why] });
  }

  /** @param {any} request */
  spanOf({ function: code, address, count }) {
    if (code === 8) return `sub-function ${shortAddress(address)}`;
    const { space } = functionOf(code);
    const last = address + Math.max(count, 1) - 1;
    return `${space} ${spanText(address, last)}, ${countedText(count, space === "coil" || space === "discrete" ? "bit" : "word")}`;
  }

  /** Return the items that a request asks for or writes, or that its reply holds. @param {any} request @param {number[]} [words] @param {boolean} [isReply] @returns {DecodedItem[]} */
  items({ unit, function: code, address, count }, words, isReply = false) {
    if (code === 8) return [{ text: `test data ${hexNumbers(words ?? [])}; the device sends it back unchanged` }];
    const written = code > 4;
    const { space } = functionOf(code);
    const span = { space, address, count: Math.min(count, 0x10000 - address), words, written, learned: isReply };
    const state = this.state(unit);
    if (isReply && words) this.find(state, space, address, words);
    const places = this.placesOf(unit);
    const step = written && words && !words.some((_, at) => places.at(space, address + at).length) ? stepItem(space, address, words) : undefined;
    return step ? [step] : [...spanItems(places, state, span), ...commandsAt(span)];
  }

  /** Return the places of points, at the blocks that the unit has shown so far. @param {number} unit @returns {Places} */
  placesOf(unit) {
    return this.state(unit).places ?? this.places;
  }

  /** Look in what a unit reported for the blocks from which its addresses count.
   * @param {UnitState} state @param {string} space @param {number} address @param {number[]} words */
  find(state, space, address, words) {
    const { chain } = generatedCode().Device.table.facts;
    if (!chain || MODBUS_SPACES[chain.function] !== space) return;
    state.blocks ??= new FoundBlocks();
    if (state.blocks.take(address, words)) state.places = new Places({ ...state.blocks.starts, ...this.settings.known }, state.blocks.lasts);
  }

  /** Return a remark if an address may be a Modicon number, which counts from 1. @param {any} request @returns {string[]} */
  offByOne({ unit, function: code, address, count }) {
    const { space } = functionOf(code);
    const starting = (/** @type {number} */ at) => this.placesOf(unit).at(space, at).filter((spot) => Math.min(...spot.addresses) === at);
    if (!address || starting(address).length) return [];
    const below = starting(address - 1).find((spot) => spot.addresses.length <= count);
    if (!below) return [];
    const at = device.numberings.findIndex((_, place) => below.point.numbers[place] === address);
    const named = at >= 0 ? `${address} is its ${capital(device.numberings[at])} number; ` : "";
    return [`no point starts at ${shortAddress(address)}, but one less, ${shortAddress(address - 1)}, is ${pointLabel(below.point)}: ${named}on the wire addresses count from 0, so this frame may be one too high`];
  }
}

const MOST_WALKED = 256; // no device has as many blocks

/** Finds blocks in the replies of one unit, as its master finds them: the marker, then the head of each block in turn. */
class FoundBlocks {
  constructor() {
    /** Where the first block is, once the marker was seen. @type {number | undefined} */
    this.first = undefined;
    /** The words of heads, and those that say how much is before a base. @type {Map<number, number>} */
    this.words = new Map();
    /** @type {Record<string, number>} */
    this.starts = {};
    /** The last addresses of the blocks, by the bases in them. @type {Record<string, number>} */
    this.lasts = {};
  }

  /** Take words that the unit reported; return true if they move a base. @param {number} address @param {number[]} words */
  take(address, words) {
    const { chain, bases } = generatedCode().Device.table.facts;
    const kept = (/** @type {number} */ at) => {
      if (words[at - address] !== undefined) this.words.set(at, words[at - address]);
      return this.words.get(at);
    };
    const place = chain.places.find((/** @type {number} */ start) => chain.marker.every((/** @type {number} */ word, /** @type {number} */ at) => words[start + at - address] === word));
    if (place !== undefined) this.first ??= place + chain.marker.length;
    const before = JSON.stringify(this.starts);
    /** @type {Map<number, [number, number]>} */
    const blocks = new Map();
    for (let head = this.first, walked = 0; head !== undefined && walked < MOST_WALKED; walked += 1) {
      const [block, length] = [kept(head), kept(head + 1)];
      if (block === undefined || length === undefined || block === chain.end) break;
      if (!blocks.has(block)) blocks.set(block, [head, head + 1 + length]);
      head += 2 + length;
    }
    for (const [name, { block, offset, counts }] of Object.entries(bases)) {
      const [start, last] = blocks.get(block) ?? [NaN, NaN];
      const behind = Object.entries(counts).map(([at, factor]) => (kept(start + Number(at)) ?? NaN) * /** @type {number} */ (factor));
      const sum = behind.reduce((one, other) => one + other, start + offset);
      if (Number.isNaN(sum)) continue;
      this.starts[name] = sum;
      this.lasts[name] = last;
    }
    return JSON.stringify(this.starts) !== before;
  }
}

/** @param {string} status @returns {string} */
function noAnswer(status) {
  return NO_ANSWER[/** @type {keyof NO_ANSWER} */ (status)] ?? status;
}

/** Return the command at this address; of several, the one with this value.
 * @param {{ space: string, address: number, words?: number[], written: boolean, learned: boolean }} span @returns {DecodedItem[]} */
function commandsAt({ space, address, words, written }) {
  const here = written ? device.commands.filter((command) => command[1] === space && command[2] === address) : [];
  if (!here.length) return [];
  const [name, , , value, title] = here.find((command) => command[3] === words?.[0]) ?? here[0];
  const finding = words && value !== null && words[0] !== value ? `it takes ${value}, here is ${words[0]}` : "";
  return [{ text: `command ${name}: ${[allTitles(title), finding].filter(Boolean).join("; ")}`, finding }];
}

/** Return the step of a command that writes these words, if there is one. @param {string} space @param {number} address
 * @param {number[]} words @returns {DecodedItem | undefined} */
function stepItem(space, address, words) {
  for (const [place, given] of Object.values(generatedCode().Device.table.facts.commands ?? {}).entries()) {
    const { requests = [], arguments: ends } = /** @type {any} */ (given);
    for (const [number, step] of requests.entries()) {
      const isHere = step.within === undefined && step.at.base === undefined && step.at.space === space && Math.min(...step.at.addresses) === address;
      const numbers = isHere && step.words.length === words.length ? stepNumbers(step.words, words, ends) : undefined;
      if (!numbers) continue;
      const [name, , , , title] = device.commands[place];
      const text = Object.entries(numbers).map(([argument, value]) => `; ${argument} = ${value}`).join("");
      return { text: `command ${name}, step ${number + 1}: ${allTitles(title)}${text}` };
    }
  }
  return undefined;
}

/** Return the arguments, within their limits, with which a step writes these words. @param {any[]} due
 * @param {number[]} words @param {Record<string, [number, number]>} ends */
function stepNumbers(due, words, ends) {
  /** @type {Record<string, number>} */
  const numbers = {};
  for (const [at, one] of due.entries()) {
    const { constant, factor, argument, mask } = typeof one === "number" ? { constant: one, factor: 0, argument: "", mask: 0xffff } : one;
    const fits = () => (((constant + factor * (numbers[argument] ?? 0)) ^ words[at]) & mask) === 0;
    if (argument && numbers[argument] === undefined) {
      const [low, high] = ends[argument];
      for (numbers[argument] = low; numbers[argument] < high && !fits(); numbers[argument] += 1);
    }
    if (!fits()) return undefined;
  }
  return numbers;
}
