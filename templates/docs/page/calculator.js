/* The calculator of a point: value, raw number, words, bits and frames, each from any other, by the generated code. */

/** Fill the calculator of a point; it stays hidden for points without generated code. @param {HTMLElement | null} place @param {Point} point */
function fillCalculator(place, point) {
  const codec = codecOf(point);
  if (!place || !codec || !codec.access) return;
  place.hidden = false;
  const calculator = new Calculator(point, codec);
  place.replaceChildren(...calculator.parts());
  calculator.listenToBits();
}

/** The last entries, kept while the page is open: unit, framing, other points, and the numbers that addresses depend on. */
/** @type {{ unit: number | null, framing: string, pkw?: number, others: Record<string, string>, numbers: Record<string, number | undefined> }} */
const entered = { unit: null, framing: "", others: {}, numbers: {} };

class Calculator {
  /** @param {Point} point @param {Codec} codec */
  constructor(point, codec) {
    this.point = point;
    this.codec = codec;
    this.isCyclic = codec.at.telegram !== undefined || codec.at.space === "signal"; // no request reads it alone
    this.isBig = codec.form.wire.isBig;
    this.entries = codec.names && !codec.facts.bits && point.shared.enum !== undefined && !point.shared.digits ? device.enums[point.shared.enum].entries : null;
    this.needs = [...new Set([...codec.scaleNeeds, ...(codec.limitNeeds ?? [])])];
    this.status = element("p", { className: "calculated", role: "status" });
    this.settle();
    this.raw = this.start();
  }

  /** The default, else an allowed number near 0. */
  start() {
    const { codec } = this;
    const starts = [...startsOf(codec)];
    return firstGood(starts, (raw) => this.test(raw)) ?? starts[0];
  }

  /** Set the line to its usual settings, and other points to raw numbers for which the scale gives a value. */
  settle() {
    const { profile } = generatedCode().Device.table.facts;
    const [low, high] = profile.units;
    entered.unit ??= low <= 1 && high >= 1 ? 1 : low;
    entered.framing ||= device.framings[0] ?? device.family;
    const open = this.needs.filter((name) => entered.others[name] === undefined);
    let choices = [{}];
    for (const name of open) {
      const other = this.other(name);
      const starts = [...startsOf(other, 1)].map((raw) => (isFloat(other) ? shownValue(other, raw, {}) : String(raw)));
      choices = choices.flatMap((made) => starts.map((text) => ({ ...made, [name]: text }))).slice(0, MOST_CHOICES);
    }
    const tried = (/** @type {(raw: any) => any} */ test) => firstGood(choices, (made) => {
      Object.assign(entered.others, made);
      if (firstGood(startsOf(this.codec), test) === undefined) throw new SyntaxError();
    });
    Object.assign(entered.others, tried((raw) => this.test(raw)) ?? tried((raw) => this.codec.form.decode(raw, this.raws())) ?? choices[0]);
  }

  /** Raise what is wrong with a raw number. @param {any} raw */
  test(raw) {
    this.codec.check?.(raw, this.raws());
    shownValue(this.codec, raw, this.raws());
  }

  /** @param {string} name */
  other(name) {
    const { table } = generatedCode().Device;
    return table.found(name, this.variants()) ?? table.byName.get(name)[0];
  }

  parts() {
    const { codec, point } = this;
    /** @type {any} */
    this.value = this.field("Value", (text) => this.rawOfValue(text), point.shared.unit);
    this.rawField = this.field("Raw", (text) => this.rawOfNumber(text));
    this.words = this.field(codec.size > 1 ? "Words" : "Word", (text) => this.rawOfWords(text));
    const fields = [this.value, this.rawField, this.words];
    if (this.entries) fields.unshift(this.chooser());
    this.frames = element("div", { className: "exchanges" });
    this.bits = codec.width <= 32 && codec.width > 1 && point.shared.form !== "float" && point.shared.form !== "text" ? this.bitButtons() : null;
    const others = this.needs.map((name) => this.need(name));
    this.show();
    return [element("h3", {}, "Calculator"),
      element("div", { className: "fields" }, ...fields.map((each) => each.box ?? each)),
      others.length ? element("div", { className: "fields", role: "group", ariaLabel: "Other points" }, element("span", { className: "soft" }, "with"), ...others) : "",
      this.bits?.box, this.status, this.line(), this.frames].filter(Boolean);
  }

  /** @param {string} label @param {(text: string) => any} read @param {string} [unit] */
  field(label, read, unit = "") {
    const input = element("input", { type: "text", spellcheck: false, autocomplete: "off" });
    input.addEventListener("input", () => this.take(() => read(input.value.trim()), input));
    return { input, box: element("label", {}, element("span", {}, label), input, unit ? element("span", { className: "unit" }, unit) : "") };
  }

  chooser() {
    const list = element("select", {}, element("option", { value: "" }, "…"), ...(this.entries ?? []).map(([raw, name]) => element("option", { value: raw }, `${raw} ${name}`)));
    list.addEventListener("input", () => list.value && this.take(() => this.rawOfNumber(list.value.replace(/.*\(([0-9A-F]+h)\)$/, "$1")), list));
    this.list = list;
    return element("label", {}, element("span", {}, "Name"), list);
  }

  /** Return a field for another point and the meaning of its content: a raw number, or the value of a float. @param {string} name */
  need(name) {
    const other = this.other(name);
    const input = element("input", { type: "text", value: entered.others[name], spellcheck: false, autocomplete: "off" });
    const told = element("span", { className: "unit" });
    const say = () => { try { told.textContent = other.told(this.rawOf(name)); } catch { told.textContent = ""; } };
    input.addEventListener("input", () => {
      entered.others[name] = input.value.trim();
      say();
      if (this.again) this.take(this.again, this.value.input); else this.show();
    });
    say();
    return element("label", {}, pointLink(other.item), element("span", { className: "soft" }, isFloat(other) ? "value" : "raw number", element("span", { className: "unseen" }, ` of ${other.name}`)), input, told);
  }

  /** @param {string} name */
  rawOf(name) {
    const other = this.other(name);
    const text = entered.others[name];
    return isFloat(other) ? other.form.wire.raw(other.form.converted(numberText(text), {})) : wholeText(text, other.form.wire.isBig);
  }

  raws() {
    return Object.fromEntries(this.needs.map((name) => [name, this.rawOf(name)]));
  }

  /** Return a value for each axis of variants: the point's own, else the reader's choice, else the first in which the point exists. */
  variants() {
    const [axis, value] = this.point.variant.split("=");
    const [only, kept] = this.codec.facts.onlyFor ?? [];
    const chosen = Object.entries(device.variants).map(([name, all]) => {
      const values = name === axis ? [value] : name === only ? kept : all;
      return [name, values.includes(state.variants[name]) ? state.variants[name] : values[0]];
    });
    return Object.fromEntries(chosen);
  }

  /** @param {() => any} read @param {HTMLElement} source */
  take(read, source) {
    this.typed = undefined;
    /** Reads the entered value again when other points change. */
    this.again = source === this.value?.input ? read : undefined;
    try {
      this.raw = read();
      this.show(source);
    } catch (error) {
      this.fail(error, source);
    }
  }

  /** @param {any} error @param {HTMLElement} source */
  fail(error, source) {
    this.raw = null;
    this.status.textContent = knownError(error).message;
    this.status.classList.add("wrong");
    for (const field of [this.value, this.rawField, this.words]) if (field && field.input !== source) field.input.value = "";
    if (this.list && this.list !== source) this.list.value = "";
    this.frames.replaceChildren();
    this.bits?.show();
    this.drawBits();
  }

  /** @param {string} text */
  rawOfValue(text) {
    const { codec } = this;
    const { form } = this.point.shared;
    const special = codec.special[Object.keys(codec.special).find((name) => folded(name) === folded(text).replaceAll(" ", "_")) ?? ""];
    if (special) return codec.form.wire.raw(special.raw);
    const named = this.entries?.find(([raw, name]) => folded(name) === folded(text) || raw === text);
    if (named) return this.rawOfNumber(named[0].replace(/.*\(([0-9A-F]+h)\)$/, "$1"));
    const typed = form === "text" ? text : numberText(text, this.point.shared.unit);
    if (form !== "float") this.typed = typed;
    if (codec.encode && codec.form.encodes) return codec.encode(typed, this.raws());
    return codec.form.wire.raw(codec.form.converted(typed, this.raws()));
  }

  /** @param {string} text */
  rawOfNumber(text) {
    const number = wholeText(text, this.isBig);
    const [low, high] = this.codec.form.wire.limits(this.codec.width);
    if (number >= low && number <= high) return number;
    throw new SyntaxError(`${text} is outside ${low}..${high}`);
  }

  /** @param {string} text */
  rawOfWords(text) {
    const words = text.replace(/0x/gi, " ").split(/[\s,;:]+/).filter(Boolean);
    const odd = words.find((word) => !/^[0-9a-f]{1,4}h?$/i.test(word));
    const { size } = this.codec;
    if (odd !== undefined) throw new SyntaxError(`${odd} is no word of up to four hexadecimal digits`);
    if (words.length !== size) throw new SyntaxError(`${words.length || "no"} word${words.length === 1 ? "" : "s"} here, ${size === 1 ? "one is" : `${size} are`} needed`);
    return this.codec.fromWords(words.map((word) => parseInt(word, 16)));
  }

  /** Show what follows from the raw number in all fields but the one that is edited. @param {HTMLElement} [source] */
  show(source) {
    const { codec, raw } = this;
    if (raw === null) return;
    const set = (/** @type {any} */ field, /** @type {string} */ text) => { if (field.input !== source) field.input.value = text; };
    /** @type {string[]} */
    const problems = [];
    const attempt = (/** @type {() => any} */ work, /** @type {any} */ other) => {
      try { return work(); } catch (error) {
        const { message } = knownError(error);
        if (!problems.includes(message)) problems.push(message);
        return other;
      }
    };
    const raws = attempt(() => this.raws(), null);
    set(this.value, raws ? attempt(() => shownValue(codec, raw, raws), "") : "");
    set(this.rawField, String(raw));
    set(this.words, attempt(() => hexWords(this.wordsOf(raw)), ""));
    if (this.list && this.list !== source) this.list.value = this.entries?.find(([number]) => number.replace(/ \(.*/, "") === String(raw))?.[0] ?? "";
    if (codec.check && raws) attempt(() => { codec.requireRaw(raw); codec.check(raw, raws); }, undefined);
    const told = raws ? attempt(() => codec.told(raw, raws), "") : "";
    const name = codec.nameOf(raw);
    const isRounded = typeof this.typed === "number" && !problems.length && String(this.typed) !== shownValue(codec, raw, raws);
    this.status.textContent = [told, isRounded ? `rounded, ${this.typed} is between two raw numbers` : "", typeof name === "string" && !told.includes(name) ? name : "", this.flagNames(), ...problems].filter(Boolean).join(" · ");
    this.status.classList.toggle("wrong", problems.length > 0);
    this.bits?.show();
    this.drawBits();
    void this.exchange(raws ?? {}, problems.length === 0);
  }

  /** Return the names of the set flags, and the numbers of flags of several bits. */
  flagNames() {
    if (this.point.shared.word === undefined) return "";
    const now = this.bitsNow();
    const told = device.words[this.point.shared.word].map(([low, width, name, , active, values]) => {
      const number = Number((now >> BigInt(low)) & ((1n << BigInt(width)) - 1n));
      if (width === 1) return number === active ? name : "";
      return `${name} ${values.find(([raw]) => raw === number)?.[1] ?? number}`;
    });
    return told.filter(Boolean).join(", ");
  }

  /** @param {any} raw */
  wordsOf(raw) {
    return this.codec.facts.bits ? [this.codec.insert(0, raw)] : this.codec.toWords(raw);
  }

  bitButtons() {
    const { codec, point } = this;
    const low = point.shared.low ?? 0;
    const flags = point.shared.word === undefined ? [] : device.words[point.shared.word];
    const buttons = Array.from({ length: codec.width }, (_, at) => codec.width - 1 - at).map((bit) => {
      const flag = flags.find(([from, size]) => bit >= from && bit < from + size);
      const button = element("button", { type: "button", title: flag ? flag[2] : "" }, element("span", { className: "unseen" }, "Bit "), element("small", {}, String(bit + low)), flag ? element("span", { className: "unseen" }, ` ${flag[2]} `) : null, element("b", {}));
      button.dataset.bit = bit;
      button.addEventListener("click", () => this.flip(bit, button));
      return button;
    });
    const show = () => {
      const now = this.bitsNow();
      for (const button of buttons) {
        const on = (now >> BigInt(button.dataset.bit)) & 1n;
        button.setAttribute("aria-pressed", String(on === 1n));
        button.lastChild.textContent = String(on);
      }
    };
    const bytes = [];
    for (let end = buttons.length; end > 0; end -= 8) bytes.unshift(element("span", {}, ...buttons.slice(Math.max(0, end - 8), end)));
    return { box: element("div", { className: "bit-row", role: "group", ariaLabel: "Bits of the raw number" }, ...bytes), show };
  }

  /** Mark the bits that are set in the drawings of the point. */
  drawBits() {
    const { shared } = this.point;
    if (this.codec.form.wire.bits > 64 || shared.form === "text") return;
    const [now, low] = [this.bitsNow(), shared.low ?? 0];
    for (const box of document.querySelectorAll("#detail [data-bit].bit")) {
      const bit = Number(/** @type {SVGElement} */ (box).dataset.bit) - low;
      box.classList.toggle("set", bit >= 0 && bit < this.codec.width && ((now >> BigInt(bit)) & 1n) === 1n);
    }
  }

  /** @param {number} bit @param {HTMLElement} source */
  flip(bit, source) {
    this.take(() => this.pattern(this.bitsNow() ^ (1n << BigInt(bit))), source);
  }

  /** Make the bits in the drawings clickable. */
  listenToBits() {
    for (const box of document.querySelectorAll("#detail [data-bit].bit")) {
      const bit = Number(/** @type {SVGElement} */ (box).dataset.bit) - (this.point.shared.low ?? 0);
      if (!this.bits || bit < 0 || bit >= this.codec.width) continue;
      box.classList.add("clickable");
      box.addEventListener("click", () => this.flip(bit, /** @type {HTMLElement} */ (box)));
    }
  }

  bitsNow() {
    const { codec, raw } = this;
    const pattern = BigInt(codec.form.wire.pattern(raw ?? codec.form.wire.raw(0), codec.width, Math.ceil(codec.form.wire.bits / 16)));
    return BigInt.asUintN(codec.width, pattern);
  }

  /** @param {bigint} bits */
  pattern(bits) {
    const { wire } = this.codec.form;
    return wire.number(wire.raw(bits), this.codec.width);
  }

  /** The settings of the line: unit, framing, and what addresses count from. */
  line() {
    const { profile, given } = generatedCode().Device.table.facts;
    const [low, high] = profile.units;
    const unit = element("input", { type: "number", min: low, max: high, value: String(entered.unit) });
    unit.addEventListener("input", () => { entered.unit = Number(unit.value); this.show(unit); });
    const fields = [element("label", {}, element("span", {}, "Unit"), unit)];
    if (device.framings.length > 1 && !this.isCyclic) {
      const list = element("select", {}, ...device.framings.map((name) => element("option", { value: name, selected: name === entered.framing }, name)));
      list.addEventListener("input", () => { entered.framing = list.value; this.show(list); });
      fields.push(element("label", {}, element("span", {}, "Framing"), list));
    }
    if (device.family === "uss" && !this.isCyclic) {
      entered.pkw ??= Math.max(...profile.pkw); // the variable length, 127, where the device has it
      const lengths = profile.pkw.filter(Boolean).map((/** @type {number} */ words) => element("option", { value: String(words), selected: words === entered.pkw }, pkwText(words)));
      const list = element("select", {}, ...lengths);
      list.addEventListener("input", () => { entered.pkw = Number(list.value); this.show(list); });
      fields.push(element("label", {}, element("span", {}, "Parameter part"), list));
    }
    for (const [name, [least, most]] of Object.entries(this.numbers())) {
      const input = element("input", { type: "number", min: least, max: most, value: String(entered.numbers[name] ?? "") });
      input.addEventListener("input", () => { entered.numbers[name] = input.value === "" ? undefined : Number(input.value); this.show(input); });
      fields.push(element("label", {}, element("span", {}, given?.[name] ? capital(name) : `Address of ${name}`), input));
    }
    return element("div", { className: "fields" }, ...fields);
  }

  /** Return the numbers on which the addresses of this point and of those that it needs depend, with their ranges. */
  numbers() {
    return Object.assign({}, ...[this.codec, ...this.needs.map((name) => this.other(name))].map(({ at }) => baseNumbers(at.base)));
  }

  /** Show the requests and replies that read and write this number. @param {any} raws @param {boolean} isAllowed */
  async exchange(raws, isAllowed) {
    const turn = (this.turn = {});
    const { codec, raw } = this;
    if (this.isCyclic) { this.showCyclic(); return; }
    if (!codec.at.addresses.length) return;
    const { given } = generatedCode().Device.table.facts;
    const missing = Object.keys(this.numbers()).filter((name) => entered.numbers[name] === undefined);
    if (missing.length) {
      this.frames.replaceChildren(element("p", { className: "soft" }, `Enter ${missing.map((name) => (given?.[name] ? name : `the address of ${name}`)).join(" and ")} to see its frames.`));
      return;
    }
    const boxes = [];
    const read = codec.decode ? await this.sent(raw, raws, (/** @type {any} */ point) => point.readRaw()) : null;
    if (read) boxes.push(this.readBox(read));
    if (codec.encode && isAllowed && !read?.error) boxes.push(exchangeBox("Write", await this.sent(raw, raws, (/** @type {any} */ point) => point.writeRaw(raw))));
    if (this.turn === turn && !this.frames.contains(document.activeElement)) this.frames.replaceChildren(...boxes);
  }

  /** Show the frames that carry this number in a telegram. */
  showCyclic() {
    const { codec, raw } = this;
    const isAsked = device.telegrams.some(([name, , direction]) => name === codec.at.telegram && direction === "request");
    try {
      answeringDevice({ unit: entered.unit, framing: device.family, variants: this.variants() }); // refuses impossible units
      const frames = cyclicFrames(codec, this.wordsOf(raw), raw, entered.unit ?? 0);
      const rows = frames.map((frame) => frameRow(isAsked ? "To the device" : "From the device", frameText(frame)));
      this.frames.replaceChildren(...rows, rows.length ? element("p", { className: "soft" }, "All other words are 0 here.") : "");
    } catch (error) {
      this.frames.replaceChildren(element("p", { className: "wrong" }, knownError(error).message));
    }
  }

  /** Return the exchanges of an operation with a device that holds this number; `reply` replaces the answer of the device.
   * @param {any} raw @param {any} raws @param {any} work @param {any} [reply] */
  async sent(raw, raws, work, reply = null) {
    const { codec } = this;
    const { FieldscribeError, Device } = generatedCode();
    /** @type {any} */
    let line = { exchanges: [] };
    const start = (/** @type {Codec} */ { at }) => baseAddress(at.base, entered.numbers) ?? 0;
    try {
      const opened = answeringDevice({ unit: entered.unit, framing: device.family === "modbus" ? entered.framing : device.family, pkw: entered.pkw, variants: this.variants(), numbers: entered.numbers });
      line = opened.line;
      for (const [name, number] of Object.entries(raws)) {
        const other = this.other(name);
        hold(line, other, other.facts.bits ? [other.insert(0, number)] : other.toWords(number), start(other));
      }
      hold(line, codec, this.wordsOf(raw), start(codec));
      line.answer = reply;
      const result = await work(opened.made[Device.table.attributes.get(codec)]);
      return { exchanges: line.exchanges, result };
    } catch (error) {
      if (!(error instanceof FieldscribeError)) throw error;
      return { exchanges: line.exchanges, error };
    }
  }

  /** Return the exchange that reads, with an editable reply, to see the meaning of what a device sent. @param {any} done */
  readBox(done) {
    const box = exchangeBox("Read", done);
    const reply = box.querySelector(".reply input");
    reply?.addEventListener("input", async () => {
      const frame = frameOf(reply.value, device.family === "can");
      if (!frame) { this.fail(new SyntaxError("this is no frame in hexadecimal"), reply); return; }
      const { result, error } = await this.sent(this.codec.form.wire.raw(0), this.raws(), (/** @type {any} */ point) => point.readRaw(), frame);
      if (error) this.failReply(error); else this.take(() => result, reply);
    });
    return box;
  }

  /** @param {any} error */
  failReply(error) {
    this.status.textContent = error.message;
    this.status.classList.add("wrong");
  }
}

/** @param {number} words the length of the parameter part of USS */
function pkwText(words) {
  return words === 127 ? "127, variable" : `${words} words`;
}

/** @param {AnsweringLine} line @param {Codec} codec @param {any[]} words @param {number} start what its addresses count from */
function hold(line, codec, words, start) {
  line.hold(codec.at, line.framing === "uss" && words.length > 1 ? [words] : words, start);
}

/** @param {string} what @param {any} facts */
function exchangeBox(what, { exchanges, error }) {
  const rows = exchanges.flatMap((/** @type {any} */ { request, reply }, /** @type {number} */ at) => {
    const isLast = at === exchanges.length - 1;
    const name = exchanges.length > 1 ? `${what} ${at + 1}` : what;
    return [frameRow(`${name}: request`, frameText(request)), reply ? frameRow(`${name}: reply`, frameText(reply), what === "Read" && isLast) : ""];
  });
  return element("div", {}, ...rows, error ? element("p", { className: "wrong" }, error.message) : "");
}

/** @param {string} name @param {string} text @param {boolean} [isEdited] */
function frameRow(name, text, isEdited = false) {
  if (!isEdited) return element("p", { className: "frame" }, element("span", {}, name), element("code", {}, text), copyButton("Copy", () => text));
  const input = element("input", { type: "text", value: text, spellcheck: false, autocomplete: "off" });
  return element("label", { className: "frame reply" }, element("span", {}, name), input);
}

/** Return the value of a raw number as a field has it: without its unit. @param {Codec} codec @param {any} raw @param {any} raws */
function shownValue(codec, raw, raws) {
  const special = codec.specialOf(raw);
  if (special) return special.name;
  const value = codec.form.decode(raw, raws);
  return typeof value === "object" && value !== null && !(value instanceof Date) ? codec.told(raw, raws) : value instanceof Date ? value.toISOString() : String(value);
}

/** Return true if people know a point by its value, as with floats, whose raw numbers tell them nothing. @param {Codec} codec */
function isFloat(codec) {
  return device.byName.get(codec.item)?.shared.form === "float";
}

const MOST_CHOICES = 400;

/** Yield raw numbers to start with: the default, `first` (for floats 100 times that), 0, and the ends of the allowed
 * and the named numbers.
 * @param {Codec} codec @param {number} [first] */
function* startsOf(codec, first = 0) {
  const { form, facts, rawLimits: [low, high], names } = codec;
  const begin = isFloat(codec) ? () => form.converted(100 * first, {}) : first;
  const raws = [facts.default, () => codec.encode(facts.default), facts.fixed && !facts.bits ? facts.fixed[1] : begin, 0, () => codec.encode(""), () => form.converted(codec.minimum, {}), () => form.converted(100, {}), () => form.converted(50, {}), low, high];
  for (const bounds of facts.allowed ?? []) raws.push(...bounds);
  if (names && !facts.bits) raws.push(...Object.values(names));
  for (const each of raws) {
    try {
      const raw = form.wire.raw(typeof each === "function" ? each() : each);
      if (raw >= codec.least && raw <= codec.greatest) yield raw;
    } catch { /* it has no such number */ }
  }
}

/** Return the first of these for which a test raises nothing; undefined if there is none.
 * @param {Iterable<any>} candidates @param {(candidate: any) => any} test */
function firstGood(candidates, test) {
  for (const each of candidates) {
    try {
      test(each);
      return each;
    } catch (error) {
      knownError(error);
    }
  }
  return undefined;
}

/** @param {number[]} words */
function hexWords(words) {
  return words.map((word) => word.toString(16).toUpperCase().padStart(4, "0")).join(" ");
}

/** Return a whole number, decimal, or hexadecimal as `1F4h` and `0x1F4`. @param {string} text @param {boolean} isBig */
function wholeText(text, isBig) {
  const hexadecimal = /^(?:0x|\$)([0-9a-f]+)$|^([0-9a-f]+)h$/i.exec(text);
  const plain = hexadecimal ? `0x${hexadecimal[1] ?? hexadecimal[2]}` : text;
  if (!hexadecimal && !/^[+-]?\d+$/.test(text)) throw new SyntaxError(`${text || "nothing"} is no whole number`);
  return isBig ? BigInt(plain) : Number(plain);
}

/** Return a number, with a point or a comma; its unit may follow. @param {string} text @param {string} [unit] */
function numberText(text, unit = "") {
  if (/^[+-]?[1-9]\d{0,2},\d{3}$/.test(text)) throw new SyntaxError(`${text} can be read in two ways: write a point for a decimal comma, and thousands without a separator`);
  const number = unit && text.endsWith(unit) ? text.slice(0, -unit.length) : text;
  const plain = number.replace(",", ".").replace(/\s+/g, "");
  if (/^[+-]?\d{16,}$/.test(plain)) return BigInt(plain);
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain)) throw new SyntaxError(`${text || "nothing"} is no number`);
  return Number(plain);
}

/** Return an error of the generated code or of parsing a number; throw any other error. @param {any} error @returns {Error} */
function knownError(error) {
  if (error instanceof generatedCode().FieldscribeError || error instanceof SyntaxError) return error;
  throw error;
}
