/* Frames of CAN in words: telegrams, signals, and parameters that are asked for by messages. */

class CanDecoder extends FrameDecoder {
  /** Return the messages with the identifier of a frame, each with its unit. @param {any} frame @returns {[any, number | null][]} */
  senders(frame) {
    const [low, high] = this.profile.units;
    return this.profile.messages.flatMap((/** @type {any} */ message) => {
      const offset = frame.id - message.canId;
      if (message.addsUnit ? offset < low || offset > high : offset !== 0) return [];
      const roles = message.roles.map((/** @type {any} */ role, /** @type {number} */ at) => ({ ...role, at })).filter((/** @type {any} */ role) => role.kind === "unit");
      const carried = roles.reduce((/** @type {number} */ unit, /** @type {any} */ role) => unit | ((frame.data[role.at] ?? 0) << role.number), 0);
      return [[message, message.addsUnit ? offset : roles.length ? carried : null]];
    });
  }

  /** @param {Pasted} pasted @returns {Decoded} */
  decode(pasted) {
    const frame = { id: pasted.id ?? 0, data: pasted.data };
    const senders = this.senders(frame);
    const head = `CAN ${hexText(frame.id, 3)}`;
    if (!senders.length) return decodedFrame({ kind: "other", summary: `${head}: not of this device`, notes: [`no message of ${device.id} has this identifier: ${this.identifiers()}`] });
    const first = (/** @type {[any, number | null]} */ [{ roles }]) => roles.findIndex((/** @type {any} */ role) => role.kind === "constant");
    const fitting = senders.filter((sender) => frame.data.length === sender[0].length && (first(sender) < 0 || frame.data[first(sender)] === sender[0].roles[first(sender)].number));
    if (pasted.remote || !fitting.length) return decodedFrame({ unit: senders[0][1], summary: `${head}: not readable`, faults: [this.unknownKind(pasted, senders.map((sender) => sender[0]))] });
    const rated = fitting.map(([message, unit]) => ({ message, unit, faults: this.faults(message, unit ?? 0, frame) })).sort((one, other) => one.faults.length - other.faults.length);
    const { message, unit, faults } = rated[0];
    const own = `${head}${unit === null ? "" : `, unit ${unit}`}, ${message.name}`;
    const telegram = this.profile.telegrams.find((/** @type {any} */ each) => each.message === message.name);
    const checks = this.checks(message, frame);
    const facts = { unit, faults, checks, kind: message.direction === "request" ? "request" : message.direction === "response" ? "reply" : "cyclic" };
    if (telegram) return this.cyclic(message, unit ?? 0, frame, telegram, own, facts);
    if (!generatedCode().carriesRole(message, "address")) return decodedFrame({ ...facts, summary: `${own}` });
    return this.parameter(message, unit, frame, own, facts);
  }

  identifiers() {
    const [low, high] = this.profile.units;
    return this.profile.messages.map((/** @type {any} */ message) => `${message.addsUnit ? `${hexText(message.canId + low, 3)} to ${hexText(message.canId + high, 3)}` : hexText(message.canId, 3)} ${message.name}`).join("; ");
  }

  /** @param {Pasted} pasted @param {any[]} messages */
  unknownKind({ remote, data }, messages) {
    if (remote) return "a remote request carries no data, and the manual knows none";
    const lengths = [...new Set(messages.map((message) => message.length))];
    if (!lengths.includes(data.length)) return `every message has ${lengths.join(" or ")} bytes, here are ${data.length}`;
    const known = messages.map((message) => ({ message, at: message.roles.findIndex((/** @type {any} */ role) => role.kind === "constant") })).filter(({ at }) => at >= 0);
    const place = known[0]?.at ?? 0;
    return `byte ${place} is ${hexText(data[place], 2)}; on this identifier it is ${known.map(({ message, at }) => `${hexText(message.roles[at].number, 2)} ${message.name}`).join(", ")}`;
  }

  /** @param {any} message @param {number} unit @param {any} frame @returns {string[]} */
  faults(message, unit, frame) {
    const faults = message.direction === "request" ? [] : this.strangeUnit(unit);
    for (const [at, { kind, number }] of message.roles.entries()) {
      const due = kind === "constant" ? number : kind === "unit" ? (unit >> number) & 255 : frame.data[at];
      if (due !== frame.data[at]) faults.push(`byte ${at} is ${hexText(frame.data[at], 2)}, in this message it is ${hexText(due, 2)}`);
    }
    return this.checks(message, frame).startsWith("wrong") ? [...faults, "the checksum is wrong"] : faults;
  }

  /** @param {any} message @param {any} frame */
  checks(message, frame) {
    const sums = message.roles.map((/** @type {any} */ role, /** @type {number} */ at) => ({ ...role, at })).filter((/** @type {any} */ role) => role.kind === "xor");
    const due = sums.map((/** @type {any} */ { number }) => frame.data.reduce((/** @type {number} */ sum, /** @type {number} */ byte, /** @type {number} */ at) => ((number >> at) & 1 ? sum ^ byte : sum), 0));
    return sums.length ? checkText(sums.map((/** @type {any} */ { at }) => frame.data[at]), due) : "";
  }

  /** Decode words of a telegram, which may take several frames.
   * @param {any} message @param {number} unit @param {any} frame @param {any} telegram @param {string} own @param {Partial<Decoded>} facts @returns {Decoded} */
  cyclic(message, unit, frame, telegram, own, facts) {
    const { TelegramReceiver } = generatedCode();
    const key = `${telegram.name} ${unit}`;
    if (!this.receivers.has(key) && facts.faults?.length === 0) this.receivers.set(key, new TelegramReceiver(this.profile, telegram.name, unit));
    const receiver = this.receivers.get(key);
    if (facts.faults?.length) return decodedFrame({ ...facts, summary: own, notes: ["its words are not read, for the frame is damaged"] });
    const isTaken = receiver.take(frame);
    const positions = isTaken ? receiver.partOf.flatMap((/** @type {any} */ [part], /** @type {number} */ at) => (receiver.slots[part].number === receiver.count ? [at] : [])) : [];
    const slot = receiver.multiplexer < 0 ? "" : `multiplexer ${frame.data[receiver.multiplexer]}, `;
    if (!isTaken) return decodedFrame({ ...facts, summary: own, findings: slot ? [`the manual knows multiplexers 0 to ${receiver.slots.length - 1} only`] : [] });
    const summary = message.signals.length ? own : `${own}: ${slot}words ${positions[0]} to ${positions[positions.length - 1]} of ${telegram.name}`;
    return decodedFrame({ ...facts, summary, items: this.pieces(unit, telegram.name, receiver, positions) });
  }

  /** @param {number} unit @param {string} name @param {any} receiver @param {number[]} positions @returns {DecodedItem[]} */
  pieces(unit, name, receiver, positions) {
    const state = this.state(unit);
    const there = new Set(positions);
    const rawOf = (/** @type {Spot} */ { codec }) => {
      try { return codec?.fromWords(receiver.ascending(codec.at)); } catch (error) {
        if (error instanceof generatedCode().TelegramError) return error;
        throw error;
      }
    };
    /** @type {{ at: number, spot: Spot | null, raw: any }[]} */
    const starting = positions.flatMap((/** @type {number} */ at) => {
      const spots = this.places.at(name, at);
      const here = spots.filter((spot) => Math.min(...spot.addresses.filter((each) => there.has(each))) === at);
      /** @type {(Spot | null)[]} */
      const owners = spots.length ? here : [null];
      return owners.map((spot) => ({ at, spot, raw: spot === null ? undefined : rawOf(spot) }));
    });
    const isRaw = (/** @type {any} */ raw) => raw !== undefined && !(raw instanceof Error);
    for (const { spot, raw } of starting) if (spot && isRaw(raw)) this.places.learn(state, spot.codec, raw);
    return withoutRepeats(starting.map(({ at, spot, raw }) => {
      if (!spot) return { text: `word ${at}: no point is described here (${hexNumbers(receiver.words([at]))})` };
      if (isRaw(raw)) return { ...pointValue(spot.point, spot.codec, raw, state), doubt: "" };
      return namedPoint(spot.point, raw ? raw.text : "documented only");
    }));
  }

  /** @param {any} message @param {number | null} unit @param {any} frame @param {string} own @param {Partial<Decoded>} facts @returns {Decoded} */
  parameter(message, unit, frame, own, facts) {
    const { carriesRole } = generatedCode();
    /** @type {Record<string, number>} */
    const carried = { address: 0, raw: 0 };
    for (const [at, { kind, number }] of message.roles.entries()) if (kind === "address" || kind === "raw") carried[kind] += frame.data[at] << number;
    const { address } = carried;
    const raw = carriesRole(message, "raw") ? carried.raw : null;
    const isRequest = message.direction === "request";
    const asked = this.profile.messages.find((/** @type {any} */ each) => each.name === message.answers);
    const isWrite = isRequest ? raw !== null : Boolean(asked && carriesRole(asked, "raw"));
    const key = `${unit} ${isRequest ? message.name : message.answers}`;
    const findings = isRequest && unit !== null ? this.strangeUnit(unit) : [];
    const open = isRequest ? undefined : this.open.get(key);
    if (isRequest) this.open.set(key, { address, raw });
    else if (open && open.address !== address) findings.push(`the request before asked for parameter ${open.address}, this answers ${address}`);
    else if (open) {
      if (open.raw !== null && open.raw !== raw) findings.push(`it does not repeat what was written: ${shortAddress(open.raw)} was, ${shortAddress(raw ?? 0)} came back`);
      this.open.delete(key);
    }
    const state = this.state(unit);
    if (!isRequest && raw !== null && !facts.faults?.length) state.words.set(address, raw);
    const spots = this.places.at("parameter", address);
    const items = spots.length ? withoutRepeats(spots.map((spot) => this.word(spot, address, raw, state, isWrite && isRequest)))
      : [{ text: `${spanText(address, address)}: no point is described here${raw === null ? "" : ` (${shortAddress(raw)})`}` }];
    return decodedFrame({ ...facts, findings, items, summary: `${own}: parameter ${spanText(address, address)}` });
  }

  /** Decode one word of a parameter. @param {Spot} spot @param {number} address @param {number | null} word @param {UnitState} state @param {boolean} written @returns {DecodedItem} */
  word({ point, codec, addresses }, address, word, state, written) {
    if (word === null) return namedPoint(point, "", codec && !codec.decode ? "it is write only" : "");
    if (!codec) return namedPoint(point, `carries ${shortAddress(word)}; documented only`);
    const sorted = [...addresses].sort((one, other) => one - other);
    const words = sorted.map((at) => (at === address ? word : state.words.get(at)));
    const here = addresses.length > 1 ? `word ${addresses.indexOf(address) + 1} of ${addresses.length} = ${shortAddress(word)}` : "";
    const missing = words.filter((each) => each === undefined).length;
    if (missing) return namedPoint(point, `${here}; ${missing} more words to come`);
    const raw = codec.fromWords(words);
    if (!written) this.places.learn(state, codec, raw);
    const item = pointValue(point, codec, raw, state, written);
    const [mask, bits] = codec.facts.fixed ?? [0, 0];
    if (written && codec.facts.bits && (word & mask) !== bits) item.finding = [item.finding, "the word breaks what is always written beside it"].filter(Boolean).join("; ");
    return here ? { ...item, text: `${item.text}; here ${here}` } : item;
  }
}
