/* The meaning of numbers in frames: points at their addresses, values, bits, special codes, and faults. */

/** One item of a frame: a point or something else, its text, a contradiction to the manual, and bits by label.
 * @typedef {{ point?: string, name?: string, label?: string, raw?: any, value?: string, text: string, finding?: string, doubt?: string, bits?: [string, string][] }} DecodedItem */

/** The addresses at which frames read or write a point.
 * @typedef {{ point: any, codec: any, addresses: number[], reads: boolean, writes: boolean }} Spot */

/** What is known of a unit from its frames: raw numbers that scales and limits need, and words of parameters.
 * @typedef {{ raws: Record<string, any>, words: Map<number, number>, blocks?: any, places?: Places }} UnitState */

/** Finds points by their addresses; `known` is what the reader gives: raw numbers of points, values of floats, and numbers
 * that addresses depend on. */
class Places {
  /** @param {Record<string, number>} known @param {Record<string, number>} [lasts] the last addresses of bases */
  constructor(known, lasts = {}) {
    /** @type {Map<string, Spot[]>} */
    this.spots = new Map();
    /** The points that scales and limits need. @type {Set<string>} */
    this.needed = new Set();
    /** The numbers that are missing to know where points are. @type {Set<string>} */
    this.unplaced = new Set();
    /** @type {Record<string, any>} */
    this.given = {};
    for (const point of device.points.filter(hasVariant)) this.add(point, known, lasts);
  }

  /** @param {any} point @param {Record<string, number>} known @param {Record<string, number>} lasts */
  add(point, known, lasts) {
    const codec = codecOf(point);
    const selecting = selectionOf(codec).map(([name]) => name);
    for (const name of codec ? [...codec.scaleNeeds, ...(codec.limitNeeds ?? []), ...selecting] : []) this.needed.add(name);
    const given = known[point.name] ?? known[point.code];
    if (codec && given !== undefined && (isFloat(codec) || Number.isInteger(given))) this.given[generatedCode().camelName(codec.name)] = codec.form.wire.raw(isFloat(codec) ? codec.form.converted(given, {}) : given);
    const { base } = point.shared;
    const start = baseAddress(base, known);
    if (start === undefined) {
      for (const name of Object.keys(baseNumbers(base))) if (known[name] === undefined) this.unplaced.add(name);
      return;
    }
    if (base && start + Math.max(...point.addresses) > lasts[base]) return; // the block is shorter
    const read = codec?.at ?? { space: point.shared.space, telegram: point.shared.telegram, addresses: point.addresses };
    const write = codec?.facts.writeAt ?? read;
    const can = { reads: !codec || Boolean(codec.decode), writes: !codec || Boolean(codec.encode) };
    if (write === read) this.put(read, start, { point, codec, ...can, addresses: [] });
    else {
      this.put(read, start, { point, codec, reads: can.reads, writes: false, addresses: [] });
      this.put(write, start, { point, codec, reads: false, writes: can.writes, addresses: [] });
    }
  }

  /** @param {any} at @param {number} start @param {Spot} spot */
  put(at, start, spot) {
    spot.addresses = at.addresses.map((/** @type {number} */ address) => address + start);
    const index = device.family === "uss" && !at.telegram ? ` ${at.index ?? 0}` : "";
    const space = at.telegram ?? MODBUS_SPACES[at.function] ?? at.space;
    for (const address of spot.addresses) {
      const key = `${space} ${address}${index}`;
      this.spots.set(key, [...(this.spots.get(key) ?? []), spot]);
    }
  }

  /** @param {string} space @param {number} address @param {string} [index] @returns {Spot[]} */
  at(space, address, index = "") {
    return this.spots.get(`${space} ${address}${index}`) ?? [];
  }

  /** Return the points that an address means with the present selection of the unit. @param {UnitState} state @param {string} space
   * @param {number} address @returns {Spot[]} */
  meant(state, space, address) {
    const isHeld = (/** @type {[string, number]} */ [name, raw]) => Number(state.raws[name] ?? raw) === raw;
    return this.at(space, address).filter(({ codec }) => selectionOf(codec).every(isHeld));
  }

  /** Keep a number that the device reported, if a scale, a limit or a selection needs it. @param {UnitState} state @param {any} codec @param {any} raw */
  learn(state, codec, raw) {
    const name = codec && generatedCode().camelName(codec.name);
    if (this.needed.has(name) && !(name in this.given)) state.raws[name] = raw;
  }
}

/** Return what other points must hold before an address means the point. @param {any} codec @returns {[string, number][]} */
function selectionOf(codec) {
  return (codec?.facts.selects ?? []).map((/** @type {[string, number]} */ [name, raw]) => [generatedCode().camelName(name), raw]);
}

/** Return the label of a point: `A020 base_frequency`. @param {any} point */
function pointLabel(point) {
  return point.code ? `${point.code} ${point.name}` : point.name;
}

/** Return a title in all its languages, English first. @param {string | string[]} title */
function allTitles(title) {
  return typeof title === "string" ? title : [...new Set(title)].filter(Boolean).join(" / ");
}

/** Return the English title. @param {string | string[]} title */
function englishTitle(title) {
  return typeof title === "string" ? title : title[0];
}

/** Return a named point without a number. @param {any} point @param {string} [text] @param {string} [finding] @returns {DecodedItem} */
function namedPoint(point, text = "", finding = "") {
  return { point: point.name, name: codecOf(point)?.name, finding, text: `: ${[text || englishTitle(point.title), finding].filter(Boolean).join("; ")}` };
}

/** Return a point with its raw number and, if it is written, why the device refuses it.
 * @param {any} point @param {any} codec @param {any} raw @param {UnitState} state @param {boolean} [written] @returns {DecodedItem} */
function pointValue(point, codec, raw, state, written = false) {
  const value = meaningOf(point, codec, raw, state.raws);
  const bits = point.shared.word === undefined ? [] : bitRows(point, codec, raw);
  const refused = outside(codec, raw, state.raws);
  const finding = written ? (codec.encode ? refused : "it is read only") : "";
  const number = rawText(point, codec, raw);
  const text = bits.length ? ` = ${number}` : ` = ${value} (${number})`;
  return { point: point.name, name: codec.name, raw, value, bits, finding, doubt: written ? "" : refused, text: `${text}: ${[englishTitle(point.title), finding].filter(Boolean).join("; ")}` };
}

/** Return the value of a raw number with its unit, or its name. @param {any} point @param {any} codec @param {any} raw @param {any} raws @returns {string} */
function meaningOf(point, codec, raw, raws) {
  const { shared } = point;
  const special = codec.specialOf(raw);
  if (special) {
    const title = device.codes[shared.codes]?.find((/** @type {any} */ code) => code[1] === special.name)?.[2] ?? "";
    return `${special.name} (${allTitles(title)})${special.noValue ? ", no value" : ""}`;
  }
  if (shared.enum !== undefined && !shared.digits) {
    const entry = device.enums[shared.enum].entries.find(([number]) => isNumber(number, raw));
    return entry ? `${entry[1]} (${allTitles(entry[2] ?? "")}${entry[3] && !allTitles(entry[2] ?? "").includes(entry[3]) ? `, ${entry[3]}` : ""})` : `${raw}, a number without a name in the manual`;
  }
  if (codec.width === 1 && shared.form !== "scaled") return raw ? "on" : "off";
  try {
    codec.form.decode(raw, raws);
    return shared.form === "text" ? JSON.stringify(codec.told(raw, raws)) : codec.told(raw, raws);
  } catch (error) {
    const { text } = generatedError(error);
    const missing = codec.scaleNeeds.filter((/** @type {string} */ name) => raws[name] === undefined);
    return missing.length ? `not known: its scale depends on ${missing.map(neededLabel).join(" and ")}` : `not known: ${text}`;
  }
}

/** Return true if a named number, printed as `3`, `3 (0003h)` or `1 (3F800000h)`, is a raw number. @param {string} printed @param {any} raw */
function isNumber(printed, raw) {
  const pattern = /\(([0-9A-F]+)h\)$/.exec(printed)?.[1];
  return printed.replace(/ \(.*/, "") === String(raw) || (pattern !== undefined && BigInt(`0x${pattern}`) === BigInt(raw));
}

/** @param {string} name */
function neededLabel(name) {
  const codec = generatedCode().Device.table.byName.get(name)?.[0];
  return codec ? codec.label : name;
}

/** Return why a raw number may not be written; empty if it may, or if nothing says so.
 * @param {any} codec @param {any} raw @param {any} raws @returns {string} */
function outside(codec, raw, raws) {
  if (!codec.check) return "";
  try {
    codec.requireRaw(raw);
    codec.check(raw, raws);
    return "";
  } catch (error) {
    const refusal = generatedError(error);
    if (refusal.status === "missing" || (codec.limitNeeds ?? []).some((/** @type {string} */ name) => raws[name] === undefined)) return "";
    try {
      codec.encode(codec.form.decode(raw, raws), raws);
    } catch (other) { // the same in units
      const inUnits = generatedError(other);
      if (inUnits.status === refusal.status) return inUnits.text;
    }
    return refusal.text;
  }
}

/** Return what generated code raised; raise any other error. @param {any} error @returns {{ status: string, text: string }} */
function generatedError(error) {
  if (error instanceof generatedCode().FieldscribeError) return error;
  throw error;
}

/** Return the raw number in both notations: `raw 500 = 01F4h`. @param {any} point @param {any} codec @param {any} raw */
function rawText(point, codec, raw) {
  if (codec.form.wire.bits === 1 || codec.width === 1) return `raw ${raw}`;
  if (point.shared.form === "text") return `words ${hexNumbers(codec.toWords(raw))}`;
  const pattern = BigInt.asUintN(codec.width, BigInt(codec.form.wire.pattern(raw, codec.width, codec.size)));
  return `raw ${raw} = ${pattern.toString(16).toUpperCase().padStart(Math.ceil(codec.width / 4), "0")}h`;
}

/** Return the bits of a word with what each means. @param {any} point @param {any} codec @param {any} raw @returns {[string, string][]} */
function bitRows(point, codec, raw) {
  const pattern = BigInt.asUintN(codec.width, BigInt(codec.form.wire.pattern(raw, codec.width, codec.size)));
  const lowest = point.shared.low ?? 0;
  let named = 0n;
  /** @type {[string, string][]} */
  const rows = device.words[point.shared.word].map((/** @type {any} */ [low, width, name, , active, values]) => {
    const mask = (1n << BigInt(width)) - 1n;
    named |= mask << BigInt(low);
    const number = Number((pattern >> BigInt(low)) & mask);
    const entry = values.find((/** @type {any} */ [of]) => of === number);
    const title = entry ? englishTitle(entry[2] ?? "") : "";
    const means = entry && !["zero", "one"].includes(entry[1]) ? `${entry[1]} (${title})` : title;
    const repeats = ["", name].includes(means.toLowerCase().replaceAll(" ", "_"));
    return [bitsLabel(low + width - 1 + lowest, low + lowest), `${number}  ${name}${width === 1 && !active ? " (true when 0)" : ""}${repeats ? "" : `: ${means}`}`];
  });
  for (let bit = 0; bit < codec.width; bit += 1) {
    if ((pattern & ~named) >> BigInt(bit) & 1n) rows.push([bitsLabel(bit + lowest, bit + lowest), "1  not named by the manual"]);
  }
  return rows;
}

/** @param {number} high @param {number} low */
function bitsLabel(high, low) {
  return high === low ? `Bit ${low}` : `Bits ${high}..${low}`;
}

/** Return words as manuals print them: `0001h FFFFh`. @param {Iterable<number>} words */
function hexNumbers(words) {
  return [...words].map(shortAddress).join(" ");
}

/** Return addresses in both notations: `1028h (4136)`. @param {number} low @param {number} high */
function spanText(low, high) {
  return low === high ? `${shortAddress(low)} (${low})` : `${shortAddress(low)} to ${shortAddress(high)} (${low} to ${high})`;
}

/** Return what consecutive addresses hold; neighbours without a point are one.
 * @param {Places} places @param {UnitState} state
 * @param {{ space: string, address: number, count: number, words?: number[], written?: boolean, learned?: boolean }} span @returns {DecodedItem[]} */
function spanItems(places, state, { space, address, count, words, written = false, learned = false }) {
  /** @type {DecodedItem[]} */
  const items = [];
  /** @type {number[]} */
  let unknown = [];
  const isInside = (/** @type {number} */ at) => at >= address && at < address + count;
  const own = { raws: learned ? state.raws : { ...state.raws }, words: state.words };
  const rawOf = (/** @type {Spot} */ spot) => {
    const sorted = [...spot.addresses].sort((one, other) => one - other);
    return words && spot.codec && (written ? spot.writes || !spot.codec.encode : spot.reads) && sorted.every((at) => isInside(at) && at - address < words.length)
      ? spot.codec.fromWords(sorted.map((at) => words[at - address])) : undefined;
  };
  for (let at = address; at < address + count; at += 1) {
    for (const spot of places.meant(own, space, at)) {
      const raw = Math.min(...spot.addresses) === at ? rawOf(spot) : undefined;
      if (raw !== undefined) places.learn(own, spot.codec, raw);
    }
  }
  const flush = () => {
    if (unknown.length) items.push(unknownItem(places, space, unknown, words?.slice(unknown[0] - address, unknown[unknown.length - 1] + 1 - address)));
    unknown = [];
  };
  for (let at = address; at < address + count; at += 1) {
    const spots = places.meant(own, space, at);
    if (!spots.length) { unknown.push(at); continue; }
    flush();
    const here = spots.filter((spot) => Math.min(...spot.addresses.filter(isInside)) === at);
    items.push(...withoutRepeats(here.map((spot) => spotItem(spot, rawOf(spot), own, { written, words, address, isInside }))));
  }
  flush();
  return items;
}

/** @param {Spot} spot @param {any} raw @param {UnitState} state @param {any} span @returns {DecodedItem} */
function spotItem({ point, codec, addresses, reads, writes }, raw, state, { written, words, address, isInside }) {
  const inside = addresses.filter(isInside).sort((one, other) => one - other);
  if (raw !== undefined) return pointValue(point, codec, raw, state, written);
  if (codec && !(written ? writes : reads) && codec.encode && codec.decode) {
    const right = written ? codec.facts.writeAt : codec.at;
    return namedPoint(point, "", `it is ${written ? "written" : "read"} at ${spanText(Math.min(...right.addresses), Math.min(...right.addresses))}`);
  }
  if (codec && inside.length < addresses.length) {
    const parts = inside.map((at) => `${partText(addresses.indexOf(at), addresses.length)}${words ? ` = ${shortAddress(words[at - address])}` : ""}`);
    return namedPoint(point, `only the ${parts.join(", ")}`);
  }
  if (codec) return namedPoint(point, "", !written && !codec.decode ? "it is write only" : written && !codec.encode ? "it is read only" : "");
  const carried = words ? `carries ${hexNumbers(inside.map((at) => words[at - address]))}; ` : "";
  return namedPoint(point, `${carried}${englishTitle(point.title)}, documented only`);
}

/** Return which word of a point has this place: `low word (2 of 2, the high part first)`. @param {number} place @param {number} count */
function partText(place, count) {
  const name = place === 0 ? "high word" : place === count - 1 ? "low word" : "word";
  return `${name} (${place + 1} of ${count}, the high part first)`;
}

/** Merge items that are the same for several variants; a doubt stays only if all variants have it. @param {DecodedItem[]} items @returns {DecodedItem[]} */
function withoutRepeats(items) {
  /** @type {Map<string, DecodedItem>} */
  const kept = new Map();
  for (const each of items) {
    const key = `${each.name ?? kept.size} ${each.text}`;
    const same = kept.get(key);
    kept.set(key, same ? { ...same, label: codeAndName(each), doubt: same.doubt && each.doubt } : each);
  }
  return [...kept.values()];
}

/** Return the label of an item that holds for all variants of a point. @param {DecodedItem} item */
function codeAndName({ point = "", name = "" }) {
  const code = device.byName.get(point)?.code;
  return code ? `${code} ${name}` : name;
}

/** @param {Places} places @param {string} space @param {number[]} addresses @param {number[]} [words] @returns {DecodedItem} */
function unknownItem(places, space, addresses, words) {
  const [low, high] = [addresses[0], addresses[addresses.length - 1]];
  const gap = (device.bus.gaps[space] ?? []).find((/** @type {number[]} */ [first, last]) => first <= high && low <= last);
  const finding = gap ? `the manual closes ${shortAddress(gap[0])} to ${shortAddress(gap[1])}` : "";
  const bases = places.unplaced.size ? `; other points count from a base: ${[...places.unplaced].map((name) => `${name}=NUMBER`).join(" ")}` : "";
  const isBits = space === "coil" || space === "discrete";
  const carried = words?.length ? ` (carries ${words.slice(0, 16).map((word) => (isBits ? String(word) : shortAddress(word))).join(" ")}${words.length > 16 ? " ..." : ""})` : "";
  return { finding, text: `${spanText(low, high)}: no point is described here${bases}${finding && `; ${finding}`}${carried}` };
}
