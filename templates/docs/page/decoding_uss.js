/* Telegrams of USS in words: tasks with their answers, process data, broadcasts. */

class UssDecoder extends FrameDecoder {
  /** @param {any} settings */
  constructor(settings) {
    super(settings);
    /** The units that were sent a request. @type {Set<number | null>} */
    this.asked = new Set();
  }

  /** Forget all earlier frames, as on another line. */
  forget() {
    super.forget();
    this.asked.clear();
  }

  /** @param {Pasted} pasted @returns {Pasted[]} */
  frames(pasted) {
    const sound = (/** @type {Uint8Array} */ rest) => (rest[0] === 2 && rest[1] + 2 <= rest.length && rest[1] > 1 && !rest.subarray(0, rest[1] + 2).reduce((check, byte) => check ^ byte, 0) ? rest[1] + 2 : 0);
    return cutApart(pasted.data, sound, 4).map((data) => ({ ...pasted, data }));
  }

  /** Return how the words of a telegram are divided: as the reader says, else by their number and the request before.
   * @param {number} words @param {any} open @returns {{ pkw: number, pzd: number, isSure: boolean }} */
  link(words, open) {
    const { pkw, pzd } = this.settings;
    const [, most] = this.profile.pzd;
    const left = pzd !== undefined ? pzd : open ? Math.min(open.pzd, words) : undefined;
    if (pkw !== undefined) return { pkw, pzd: left ?? Math.max(0, Math.min(most, words - (pkw === 127 ? 4 : pkw))), isSure: true };
    const lengths = this.profile.pkw.filter((/** @type {number} */ length) => length <= 4).sort((/** @type {number} */ one, /** @type {number} */ other) => other - one);
    const fits = lengths.find((/** @type {number} */ length) => length <= words && (left === undefined ? words - length <= most : words - length === left)) ?? 0;
    return { pkw: fits, pzd: left ?? words - fits, isSure: false };
  }

  /** @param {Pasted} pasted @returns {Decoded} */
  decode({ data, isReply = false }) {
    const framing = this.settings.framing ?? bareFraming(data);
    if (framing) return this.bare(framing === "pzd" && isReply ? "pzd response" : framing, data, isReply);
    if (data.length < 4) return decodedFrame({ summary: "USS: not readable", faults: [`a telegram has at least 4 bytes, here ${data.length === 1 ? "is" : "are"} ${data.length}`] });
    const lacksCheck = data[1] === data.length - 1 && data.length % 2 === 1;
    const body = lacksCheck ? data : data.subarray(0, -1);
    const check = body.reduce((sum, byte) => sum ^ byte, 0);
    const faults = [];
    if (data[0] !== 2) faults.push(`a telegram begins with 02h, this with ${hexText(data[0], 2)}`);
    if (lacksCheck) faults.push("the check byte is missing");
    else if (data[1] + 2 !== data.length) faults.push(`its length byte says ${data[1] + 2} bytes, here are ${data.length}`);
    if (!lacksCheck && check !== data[data.length - 1]) faults.push("the check byte is wrong");
    if (body.length % 2 === 0) faults.push("its data is no whole number of words");
    const unit = data[2];
    const words = wordsIn(body.subarray(3));
    const isForeign = data[0] !== 2 && faults.length > 1;
    const made = isForeign ? decodedFrame({}) : unit === this.profile.broadcast ? this.broadcast(words) : this.telegram(unit, words, isReply);
    return { ...made, unit, faults: [...faults, ...made.faults], checks: checkText(lacksCheck ? [] : data.subarray(-1), [check]), summary: `USS, unit ${unit}: ${made.summary}` };
  }

  /** Decode the words of a single part, as manuals print them. @param {string} framing @param {Uint8Array} data @param {boolean} isReply @returns {Decoded} */
  bare(framing, data, isReply) {
    const words = wordsIn(data);
    const faults = data.length % 2 ? [`the part is made of words of two bytes, here are ${data.length} bytes`] : [];
    const direction = framing === "pzd response" ? "response" : "request";
    let made = decodedFrame({ kind: direction === "response" ? "reply" : "request", summary: `${direction === "response" ? "reply" : "request"}, process data`, items: framing.startsWith("pzd") ? this.process(null, direction, words) : [] });
    if (framing === "broadcast") made = this.broadcast(words);
    if (framing === "pkw") made = this.telegram(null, words, isReply, { pkw: words.length, pzd: 0, isSure: false });
    return { ...made, faults: [...faults, ...made.faults], summary: `USS: ${made.summary}` };
  }

  /** @param {number | null} unit @param {number[]} words @param {boolean} isReply @param {any} [given] how the words are divided @returns {Decoded} */
  telegram(unit, words, isReply, given) {
    const open = this.open.get(String(unit));
    const link = given ?? this.link(words.length, open);
    const size = link.pkw === 127 ? Math.max(0, words.length - link.pzd) : link.pkw;
    const part = words.slice(0, size);
    const data = words.slice(size);
    const isMisfit = link.isSure && (link.pkw === 127 ? size < 3 : words.length !== link.pkw + link.pzd);
    const sizes = link.pkw === 127 ? `at least ${3 + link.pzd}` : link.pkw + link.pzd;
    const faults = isMisfit ? [`it has ${countedText(words.length, "word")}; a parameter part ${link.pkw === 127 ? "of variable length" : `of ${link.pkw}`} and ${countedText(link.pzd, "word")} of process data make ${sizes}`] : [];
    if (part.length < 2) {
      const answers = isReply || open !== undefined;
      if (answers) this.open.delete(String(unit));
      else this.open.set(String(unit), { task: 0, pzd: data.length });
      return decodedFrame({ kind: answers ? "reply" : "request", summary: `${answers ? "reply" : "request"}, process data`, faults, items: this.process(unit, answers ? "response" : "request", data) });
    }
    const page = [15, 12, 13, 14].reduce((bits, place, at) => bits | (((part[1] >> place) & 1) << at), 0);
    const named = { code: part[0] >> 12, parameter: (part[0] & 0x7ff) + 2000 * page, index: part[1] & 0xff, values: part.slice(2), data, link };
    const isAnswer = isReply || (open && this.answers(open, named));
    const made = isAnswer ? this.response(unit, named, open) : this.request(unit, named, part);
    if (!isAnswer && !this.asked.has(unit) && named.code && named.values.some(Boolean)) made.notes.push("read as a request, for there was none before it; RX before the frame says that it is a reply");
    this.asked.add(unit);
    return { ...made, faults: [...made.faults, ...faults] };
  }

  /** @param {any} open @param {any} part */
  answers(open, { code, parameter, index }) {
    if (!open.task) return code === 0;
    if (code === 0) return true;
    return open.parameter === parameter && open.index === index && (code === 7 || code === 8 || this.profile.tasks[open.task]?.includes(code));
  }

  /** A value of one or two words. @param {number} width @param {any} part @returns {number | null} */
  value(width, { values, link }) {
    if (width === 2) return values.length > 1 ? values[0] * 0x10000 + values[1] : null;
    const isLast = link.pkw === 4 && values.length > 1 && (link.isSure || values[1] !== 0 || values[0] === 0);
    return width ? values[isLast ? 1 : 0] ?? null : null;
  }

  /** @param {number | null} unit @param {any} part @param {number[]} words @returns {Decoded} */
  request(unit, part, words) {
    const { code, parameter, index, data, values } = part;
    this.open.set(String(unit), { task: code, parameter, index, pzd: data.length });
    const width = device.bus.protocol.tasks[code] ?? 0;
    const findings = unit === null ? [] : this.strangeUnit(unit);
    if (this.profile.tasks[code] === undefined) findings.push(`the device does not know task ${code}`);
    else if (code && !this.profile.tasks[code].length) findings.push("the device cannot do this task");
    if (words[0] & 0x800) findings.push("bit 11 of the first word (SP) is set, it is always 0");
    if (width === 2 && values.length < 2) findings.push("a double word does not fit into this parameter part");
    const notes = device.bus.protocol.eeprom.includes(code) ? ["it writes to the EEPROM too, which wears the memory"] : [];
    return decodedFrame({
      kind: "request", summary: `request, ${codeText("functions", code, `task ${code}`)}${this.element(code, parameter, index)}`, findings, notes,
      items: [...(code ? this.elementItems(unit, part, width, true) : []), ...this.process(unit, "request", data)],
    });
  }

  /** @param {number | null} unit @param {any} part @param {any} open @returns {Decoded} */
  response(unit, part, open) {
    const { code, parameter, index, data, values } = part;
    const made = decodedFrame({ kind: "reply", summary: `reply, ${codeText("responses", code, `response ${code}`)}${this.element(code, parameter, index)}` });
    if (code || !open?.task) this.open.delete(String(unit));
    if (code === 7 || code === 8) made.kind = "exception";
    if (code === 7 && values.length) {
      made.exception = values[0];
      made.summary += `: ${codeText("exceptions", values[0], `error ${values[0]}`)}`;
    }
    const width = device.bus.protocol.responses[code] ?? 0;
    if (width === 2 && values.length < 2) made.faults.push("it has too few words for its response");
    made.items = [...(code ? this.elementItems(unit, part, width, false) : []), ...this.process(unit, "response", data)];
    return made;
  }

  /** @param {number} code @param {number} parameter @param {number} index */
  element(code, parameter, index) {
    if (!code) return "";
    const isAlone = index === 0 && !device.points.some((point) => point.addresses[0] === parameter && point.index !== "");
    return `, parameter ${parameter}${isAlone ? "" : index === 255 ? ", all elements (index 255)" : `, index ${index}`}`;
  }

  /** @param {number | null} unit @param {any} part @param {number} width @param {boolean} isRequest @returns {DecodedItem[]} */
  elementItems(unit, part, width, isRequest) {
    const { code, parameter, index, values } = part;
    const spots = this.places.at("parameter", parameter, ` ${index}`);
    const carried = `carries ${hexNumbers(values)}`;
    const value = this.value(width, part);
    if (!spots.length) return [{ text: `${this.element(code, parameter, index).slice(2)}: no point is described here${width || !isRequest ? ` (${carried})` : ""}` }];
    return withoutRepeats(spots.map(({ point, codec }) => {
      if (!isRequest && code === 6) return namedPoint(point, `${value} elements`);
      if (value === null || (!isRequest && code > 6)) return namedPoint(point, !isRequest && width === 0 && code < 7 ? carried : "");
      if (!codec) return namedPoint(point, `${carried}; documented only`);
      if (codec.size !== width) {
        const due = codec.size === 2 ? "a double word" : countedText(codec.size, "word");
        return namedPoint(point, carried, `the parameter is ${due}, the ${isRequest ? "task" : "response"} carries ${width}${isRequest ? "; a device answers with a wrong data type" : ""}`);
      }
      const words = width === 2 ? [Math.floor(value / 0x10000), value % 0x10000] : [value];
      const raw = codec.fromWords(words);
      if (!isRequest) this.places.learn(this.state(unit), codec, raw);
      return pointValue(point, codec, raw, this.state(unit), isRequest);
    }));
  }

  /** The points in process data. @param {number | null} unit @param {string} direction @param {number[]} words @returns {DecodedItem[]} */
  process(unit, direction, words) {
    const names = device.telegrams.filter((telegram) => telegram[2] === direction).map((telegram) => telegram[0]);
    return words.flatMap((word, at) => {
      const spots = names.flatMap((name) => this.places.at(name, at));
      if (!spots.length) return [{ text: `word ${at + 1} of process data = ${shortAddress(word)}: no point is described here` }];
      const starting = spots.filter(({ addresses, codec }) => Math.min(...addresses) === at && (!codec || at + codec.size <= words.length));
      return starting.map(({ point, codec }) => {
        if (!codec) return namedPoint(point, `carries ${shortAddress(word)}; documented only`);
        const item = pointValue(point, codec, codec.fromWords(words.slice(at, at + codec.size)), this.state(unit), direction === "request" && Boolean(codec.encode) && word !== 0);
        return { ...item, doubt: "" };
      });
    });
  }

  /** @param {number[]} words @returns {Decoded} */
  broadcast(words) {
    const made = decodedFrame({ kind: "broadcast", summary: "broadcast, no unit answers" });
    if (words.length < 4) return { ...made, faults: [`a broadcast starts with 4 words of masks, here are ${words.length}`] };
    const valid = Array.from({ length: 15 }, (_, at) => at + 1).filter((at) => (words[0] >> at) & 1);
    const listed = [valid.slice(0, -1).join(", "), valid[valid.length - 1]].filter(Boolean).join(" and ");
    const counting = valid.length ? `words ${listed} of process data count` : "no word of process data counts";
    return { ...made, items: [{ text: `mask ${shortAddress(words[0])}: ${counting}` }, { text: `masks of bits ${hexNumbers(words.slice(1, 4))}` }, ...this.process(this.profile.broadcast, "request", words.slice(4))] };
  }
}

/** Return which part bytes are that are no telegram: process data of up to 2 words, a parameter part of 3 or 4.
 * @param {Uint8Array} data */
function bareFraming(data) {
  if (data.length % 2 || data.length > 8 || data[0] === 2 || data[1] + 2 === data.length) return undefined;
  return data.length > 4 ? "pkw" : "pzd";
}

/** Return the whole words of bytes. @param {Uint8Array} data @returns {number[]} */
function wordsIn(data) {
  return generatedCode().wordsOfBytes(data.subarray(0, data.length & ~1));
}
