/* The section that decodes pasted frames and logs: it reads line by line in slices, so that the page stays responsive. */

/** A decoded frame with the line that it stood in. @typedef {Decoded & { text: string, time: number | null }} DecodedLine */

const MOST_LINES = 100_000;
const SHOWN_AT_ONCE = 100;
/** The most characters that the field shows: with all of a long paste, browsers freeze for seconds. */
const MOST_IN_FIELD = { lines: 2000, signs: 200_000 };
const SLICE_TIME = 20; // milliseconds of work until the page reacts to the reader again

const USS_FRAMINGS = { pkw: "parameter part alone", pzd: "process data of the master", "pzd response": "process data of the device", broadcast: "broadcast alone" };

/** The decoder of each family; a page has only that of its own. @type {Record<string, () => any>} */
const DECODERS = { modbus: () => ModbusDecoder, uss: () => UssDecoder, can: () => CanDecoder };

/** @param {object} settings @returns {FrameDecoder} */
function newDecoder(settings) {
  return new (DECODERS[device.family]())(settings);
}

/** The pasted text and the settings, kept while the page is open. */
const pastedBefore = { text: "", known: "", framing: "", pkw: "", pzd: "", onlyWrong: false };

/** Yield the frames in pasted text, one after the other. @param {string} text @param {FrameDecoder} decoder @returns {Generator<DecodedLine>} */
function* decodedFrames(text, decoder) {
  /** @type {number | null} */
  let asked = null;
  for (const line of linesOf(text)) {
    const pasted = pastedLine(line, device.family === "can");
    if (!pasted) continue;
    if (pasted.problem) yield { ...decodedFrame({ kind: "no frame", summary: "no frame", notes: [pasted.problem] }), text: pasted.text, time: pasted.time };
    else {
      for (const frame of decoder.frames(pasted)) {
        const decoded = decoder.decode(frame);
        const isAnswer = decoded.kind === "reply" || decoded.kind === "exception";
        if (isAnswer && asked !== null && pasted.time !== null) decoded.notes.push(`answered after ${durationText(pasted.time - asked)}`);
        asked = decoded.kind === "request" ? pasted.time : null;
        yield { ...decoded, text: pastedText(frame), time: pasted.time };
      }
    }
  }
}

/** Yield the lines of a text, at most `MOST_LINES`. @param {string} text @returns {Generator<string>} */
function* linesOf(text) {
  let start = 0;
  for (let count = 0; start < text.length && count < MOST_LINES; count += 1) {
    const end = text.indexOf("\n", start);
    yield text.slice(start, end < 0 ? text.length : end);
    start = end < 0 ? text.length : end + 1;
  }
}

/** Return the beginning of a text, as much as the field holds. @param {string} text */
function inField(text) {
  const { lines, signs } = MOST_IN_FIELD;
  return text.slice(0, signs).split("\n", lines).join("\n");
}

/** @param {Pasted} pasted */
function pastedText({ id, data, remote }) {
  if (id === undefined) return hexBytes(data);
  return `${id.toString(16).toUpperCase().padStart(id > 0x7ff ? 8 : 3, "0")}#${remote ? "R" : hexBytes(data).replaceAll(" ", "")}`;
}

/** Return true if a frame is damaged or contradicts the manual. @param {DecodedLine} frame */
function isWrong({ faults, findings, items, kind }) {
  return kind === "exception" || faults.length + findings.length > 0 || items.some(({ finding }) => finding);
}

/** Return numbers by name out of `P2009=0, P2000=50.5, PGNEXPO=3h`. @param {string} text @returns {Record<string, number>} */
function knownNumbers(text) {
  /** @type {Record<string, number>} */
  const known = {};
  for (const [, name, number] of text.matchAll(/([\w.[\]]+)\s*=\s*([^\s,;]+)/g)) {
    try { known[name] = /^-?\d+\.\d+$/.test(number) ? Number(number) : Number(wholeText(number, false)); } catch { /* the entry is not complete yet */ }
  }
  return known;
}

/** The decoder on the page. */
class DecoderView {
  constructor() {
    /** @type {DecodedLine[]} */
    this.decoded = [];
    this.shown = 0;
    this.run = 0;
    this.isCut = false;
    this.wrong = 0;
    this.unread = 0;
    this.area = element("textarea", { rows: 8, spellcheck: false, placeholder: device.family === "can" ? "321#DD00051513880064" : "one frame a line, in hexadecimal" });
    this.status = element("p", { className: "status", role: "status" });
    this.results = element("div", { className: "decoded" });
    this.more = element("button", { type: "button", hidden: true }, "Show more");
    this.more.addEventListener("click", () => this.extend());
    this.area.addEventListener("input", () => { pastedBefore.text = this.area.value; void this.decode(); });
    this.area.addEventListener("paste", (/** @type {any} */ event) => {
      const text = event.clipboardData?.getData("text/plain") ?? "";
      if (!this.area.readOnly && inField(text).length === text.length) return;
      event.preventDefault();
      this.put(text);
    });
  }

  /** Decode a text instead of what is there; the field shows its beginning. @param {string} text */
  put(text) {
    pastedBefore.text = text;
    this.area.value = inField(text);
    this.area.readOnly = inField(text).length < text.length;
    void this.decode();
  }

  parts() {
    const example = element("button", { type: "button" }, "Frames of the manual");
    example.addEventListener("click", () => this.put(device.frames.map(([way, bytes]) => `${way} ${bytes}`).join("\n")));
    const clear = element("button", { type: "button" }, "Clear");
    clear.addEventListener("click", () => { this.put(""); this.area.focus(); });
    const onlyWrong = element("input", { type: "checkbox", checked: pastedBefore.onlyWrong });
    onlyWrong.addEventListener("input", () => { pastedBefore.onlyWrong = onlyWrong.checked; this.show(); });
    this.put(pastedBefore.text);
    return [
      element("p", {}, device.family === "can" ? "Paste frames as candump prints or logs them, or identifier and data; one a line, with times or without." : "Paste frames in hexadecimal, one a line, with times or without. A reply is read with the request before it."),
      element("label", { className: "paste" }, element("span", {}, "Frames or a log"), this.area),
      element("div", { className: "fields" }, device.frames.length ? example : null, clear, element("label", {}, onlyWrong, element("span", {}, "only what is wrong")), ...this.settings()),
      this.status, this.results, this.more,
    ];
  }

  settings() {
    const fields = [];
    const { facts } = generatedCode().Device.table;
    if (device.family === "uss") {
      const lengths = facts.profile.pkw.map((/** @type {number} */ length) => [String(length), pkwText(length)]);
      const [low, high] = facts.profile.pzd;
      const words = Array.from({ length: high - low + 1 }, (_, at) => [String(low + at), countedText(low + at, "word")]);
      fields.push(this.choice("Framing", "framing", Object.entries(USS_FRAMINGS), "by its bytes"), this.choice("Parameter part", "pkw", lengths), this.choice("Process data", "pzd", words));
    }
    const places = new Places({});
    const needed = [...places.needed].map((name) => (isFloat(neededCodec(name)) ? `${neededCode(name)}=50.0` : `${neededCode(name)}=1`));
    const examples = [...[...places.unplaced].map((name) => `${name}=1`), ...needed];
    if (examples.length) {
      const input = element("input", { type: "text", value: pastedBefore.known, spellcheck: false, placeholder: examples.slice(0, 2).join(" ") });
      input.addEventListener("input", () => { pastedBefore.known = input.value; void this.decode(); });
      fields.push(element("label", {}, element("span", {}, places.unplaced.size ? "Known addresses and raw numbers" : "Known raw numbers"), input));
    }
    return fields;
  }

  /** @param {string} text @param {"framing" | "pkw" | "pzd"} key @param {string[][]} options @param {string} [usual] */
  choice(text, key, options, usual = "by its length") {
    return choiceField(text, options, pastedBefore[key], (/** @type {string} */ value) => { pastedBefore[key] = value; void this.decode(); }, usual);
  }

  /** Decode the pasted text; an edit meanwhile starts again. */
  async decode() {
    const run = (this.run += 1);
    const number = (/** @type {string} */ text) => (text === "" ? undefined : Number(text));
    const { text, known, framing, pkw, pzd } = pastedBefore;
    this.decoded = [];
    [this.wrong, this.unread] = [0, 0];
    this.isCut = text.trimEnd().split("\n", MOST_LINES + 1).length > MOST_LINES;
    this.show();
    let sliced = performance.now();
    const decoder = newDecoder({ known: knownNumbers(known), framing: framing || undefined, pkw: number(pkw), pzd: number(pzd) });
    for (const frame of decodedFrames(text, decoder)) {
      this.decoded.push(frame);
      if (frame.kind === "no frame") this.unread += 1;
      if (isWrong(frame)) this.wrong += 1;
      if (performance.now() - sliced < SLICE_TIME) continue;
      this.tell(true);
      if (this.shown < SHOWN_AT_ONCE) this.extend();
      await new Promise((done) => { setTimeout(done); });
      if (this.run !== run) return;
      sliced = performance.now();
    }
    this.tell(false);
    this.extend();
  }

  /** Say how many frames there are. @param {boolean} isGoing */
  tell(isGoing) {
    const { wrong, unread } = this;
    const count = countedText(this.decoded.length - unread, "frame");
    this.status.textContent = this.decoded.length ? [`${count}${isGoing ? " so far" : ""}`, wrong ? `${wrong} with something wrong or refused` : "nothing wrong", unread ? `${countedText(unread, "line")} without a frame` : "", this.isCut ? `only the first ${MOST_LINES} lines are read` : "", this.area.readOnly ? "the field shows the beginning alone" : ""].filter(Boolean).join(", ") : "";
  }

  show() {
    this.shown = 0;
    this.results.replaceChildren();
    this.tell(false);
    this.extend();
  }

  /** Show the next frames. */
  extend() {
    const rows = pastedBefore.onlyWrong ? this.decoded.filter(isWrong) : this.decoded;
    const next = rows.slice(this.shown, this.shown + SHOWN_AT_ONCE);
    this.results.append(...next.map(frameBox));
    this.shown += next.length;
    this.more.hidden = this.shown >= rows.length;
  }
}

/** @param {string} name @returns {Codec} */
function neededCodec(name) {
  return generatedCode().Device.table.byName.get(name)[0];
}

/** @param {string} name */
function neededCode(name) {
  const { code, name: own } = neededCodec(name);
  return code ?? own;
}

/** Return a decoded frame as a box. @param {DecodedLine} frame */
function frameBox(frame) {
  const { faults, findings, notes, checks, items, summary, time, text } = frame;
  /** @type {any[]} */
  const rows = [["Frame", summary]];
  for (const each of items) {
    const point = each.point === undefined ? undefined : device.byName.get(each.point);
    rows.push(["Says", ...(point ? [element("a", { href: `#point=${encodeURIComponent(point.name)}` }, each.label ?? pointLabel(point))] : []), each.finding ? element("span", { className: "wrong" }, each.text) : each.text]);
    rows.push(...(each.bits ?? []));
    if (each.doubt) rows.push(["Doubt", element("span", { className: "wrong" }, each.doubt)]);
  }
  if (checks) rows.push([summary.startsWith("TCP") ? "Header" : "Checksum", checks]);
  for (const each of [...faults, ...findings]) rows.push(["Wrong", element("strong", { className: "wrong" }, each)]);
  for (const each of notes) rows.push(["Note", each]);
  const head = element("p", { className: "frame-text" }, time === null ? "" : element("span", { className: "soft" }, `${timeText(time)} `), element("code", {}, text));
  return element("section", { className: isWrong(frame) ? "one wrong-one" : "one" }, head, factList(rows));
}

/** Return `4.2 ms`, `1.25 s`. @param {number} seconds */
function durationText(seconds) {
  return seconds < 1 ? `${(1000 * seconds).toFixed(1)} ms` : `${seconds.toFixed(2)} s`;
}

/** @param {number} time seconds of a day, or since 1970 */
function timeText(time) {
  if (time >= 86400) return new Date(time * 1000).toISOString().replace("T", " ").replace("Z", "");
  return new Date(time * 1000).toISOString().slice(11, 23);
}

/** Return what the section of the decoder shows. */
function decoderParts() {
  return new DecoderView().parts();
}
