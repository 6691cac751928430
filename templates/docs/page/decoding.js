/* Frames of each family in words: what a frame is, what it carries, and what is wrong with it by the manual. */

/** A decoded frame; `faults` say what is damaged, `findings` what contradicts the manual.
 * @typedef {{ kind: string, unit: number | null, summary: string, items: DecodedItem[], checks: string, faults: string[], findings: string[],
 *   notes: string[], exception?: number }} Decoded */

const NO_ANSWER = {
  wrong_unit: "it comes from another unit than was asked", wrong_transaction: "its transaction number is not that of the request",
  wrong_function: "its function is not that of the request", bad_byte_count: "it brings another number of bytes than was asked for",
  echo_mismatch: "it does not repeat the request", short_frame: "it is shorter than it says", long_frame: "it is longer than it says",
  wrong_parameter: "it is about another parameter or element", wrong_response: "its response does not belong to the task",
  wrong_length: "it has too few words for its response",
};

/** Decodes the frames of a device in order; each family has a class with its own `decode`. */
class FrameDecoder {
  /** @param {{ known?: Record<string, number>, framing?: string, pkw?: number, pzd?: number }} settings */
  constructor(settings) {
    this.settings = settings;
    this.places = new Places(settings.known ?? {});
    const { profile } = generatedCode().Device.table.facts;
    this.profile = profile;
    /** @type {Map<string, UnitState>} */
    this.states = new Map();
    /** The requests without an answer. @type {Map<string, any>} */
    this.open = new Map();
    /** The collectors of the words of telegrams. @type {Map<string, any>} */
    this.receivers = new Map();
  }

  /** Forget all earlier frames, as on another line. */
  forget() {
    for (const kept of [this.states, this.open, this.receivers]) kept.clear();
  }

  /** @param {number | string | null} unit @returns {UnitState} */
  state(unit) {
    const key = String(unit);
    const state = this.states.get(key) ?? { raws: { ...this.places.given }, words: new Map() };
    this.states.set(key, state);
    return state;
  }

  /** @param {number} unit @returns {string[]} */
  strangeUnit(unit) {
    const [low, high] = this.profile.units;
    return unit >= low && unit <= high ? [] : [`the device cannot have unit ${unit}: units are ${low} to ${high}`];
  }

  /** The frames in pasted bytes. @param {Pasted} pasted @returns {Pasted[]} */
  frames(pasted) {
    return [pasted];
  }

  /** The next frame in words; any bytes are safe. @param {Pasted} pasted @returns {Decoded} */
  decode({ data }) {
    return decodedFrame({ notes: [hexBytes(data)] });
  }
}

/** @param {Partial<Decoded>} facts @returns {Decoded} */
function decodedFrame(facts) {
  return { kind: "unreadable", unit: null, summary: "not readable", items: [], checks: "", faults: [], findings: [], notes: [], ...facts };
}

/** Return `017h`, `08h`. @param {number} number @param {number} digits */
function hexText(number, digits) {
  return `${number.toString(16).toUpperCase().padStart(digits, "0")}h`;
}

/** @param {Iterable<number>} there @param {Iterable<number>} right */
function checkText(there, right) {
  const [here, due] = [hexBytes(there), hexBytes(right)];
  return here === due ? `ok (${here})` : here ? `wrong: ${here}; these bytes give ${due}` : `missing; it would be ${due}`;
}

/** Return a numbered code of the manual: `02h address_not_found: The inverter has nothing there`. @param {string} kind @param {number} number @param {string} text */
function codeText(kind, number, text) {
  const known = device.bus[kind][number];
  return known ? `${text} ${known[0]}${kind === "exceptions" ? `: ${known[1]}` : ""}` : `${text}, which the manual does not list`;
}
