// SPDX-License-Identifier: 0BSD
/** The errors of generated devices: one base class; `status` names the case. */

/**
 * Base of all errors of generated devices; `status` is a stable name for programs.
 *
 * `point` names the point, the points of one request, the command, or the
 * place. `group` is the group that was read, `needs` another point that had to be read first. `existsWhen` says when a
 * refused point exists, if other points decide it.
 */
export class FieldscribeError extends Error {
  /** @param {string} message @param {string} [status] */
  constructor(message, status = "error") {
    super(message);
    this.name = new.target.name;
    this.text = message;
    this.status = status;
    /** @type {string | undefined} */
    this.point = undefined;
    /** @type {string | undefined} */
    this.group = undefined;
    /** @type {string | undefined} */
    this.needs = undefined;
    /** @type {string | undefined} */
    this.existsWhen = undefined;
    /** @type {unknown} */
    this.value = undefined;
    /** @type {readonly unknown[] | undefined} */
    this.limits = undefined;
  }

  /** True if a frame was lost or damaged on the line, so that trying again may help. */
  get lost() {
    return false;
  }

  /**
   * Add the subject of the error, unless it has one. Returns the error.
   * @param {{ point?: string, group?: string, needs?: string, existsWhen?: string, value?: unknown, limits?: readonly unknown[] }} about
   */
  about(about) {
    this.point = this.point ?? about.point;
    this.group = this.group ?? about.group;
    this.needs = this.needs ?? about.needs;
    this.existsWhen = this.existsWhen ?? about.existsWhen;
    this.value = this.value ?? about.value;
    this.limits = this.limits ?? about.limits;
    return this.reworded();
  }

  /**
   * Add that the error came from reading another point that the requested one needs. Returns the error.
   * @param {string} point
   */
  needing(point) {
    if (this.point !== point) this.needs = this.needs ?? this.point;
    this.point = point;
    return this.reworded();
  }

  /** A copy of the error, to be raised again. @returns {FieldscribeError} */
  copied() {
    return Object.create(Object.getPrototypeOf(this), Object.getOwnPropertyDescriptors(this));
  }

  /** @private */
  reworded() {
    const exists = this.existsWhen ? `; it exists only when ${this.existsWhen}` : "";
    const what = this.text + exists;
    const parts = [this.group && `group ${this.group}`, this.point, this.needs && `needs ${this.needs}`, what];
    this.message = parts.filter((part) => part !== undefined && part !== "").join(": ");
    return this;
  }
}

/** A value or raw number cannot be converted. */
export class CodecError extends FieldscribeError {}

/** The number may not be written. */
export class OutOfRangeError extends CodecError {
  /** @param {string} message */
  constructor(message) {
    super(message, "out_of_range");
  }
}

/** The value is NaN. */
export class NotANumberError extends CodecError {
  /** @param {string} message */
  constructor(message) {
    super(message, "not_a_number");
  }
}

/** The point does not take a value of this type. */
export class WrongTypeError extends CodecError {
  /** @param {string} message */
  constructor(message) {
    super(message, "wrong_type");
  }
}

/** The number has no name, and only named ones may be written. */
export class UnknownValueError extends CodecError {
  /** @param {string} message */
  constructor(message) {
    super(message, "unknown_value");
  }
}

/** Another point that the scale or a limit needs is zero. */
export class ZeroFactorError extends CodecError {
  /** @param {string} message */
  constructor(message) {
    super(message, "zero_factor");
  }
}

/** The scale has no case for the numbers of the points that choose it. */
export class NoCaseError extends CodecError {
  /** @param {string} message */
  constructor(message) {
    super(message, "no_case");
  }
}

/** The result is too large. */
export class ResultOverflowError extends CodecError {
  /** @param {string} message */
  constructor(message) {
    super(message, "overflow");
  }
}

/** A special code instead of a quantity, or a write of a read-only one; `special` is its name. */
export class SpecialCodeError extends CodecError {
  /** @param {string} special @param {string} message */
  constructor(special, message) {
    super(message, "special");
    this.special = special;
  }
}

/** The words are no valid text (UTF-8 or UTF-16), or no date. */
export class MalformedError extends CodecError {
  /** @param {string} message */
  constructor(message) {
    super(message, "malformed");
  }
}

/** Too few or too many words for this point. */
export class WrongLengthError extends CodecError {
  /** @param {string} message */
  constructor(message) {
    super(message, "wrong_length");
  }
}

/** The conversion needs the raw number of another point, but `raws` does not hold it. */
export class MissingRawError extends CodecError {
  /** @param {string} message */
  constructor(message) {
    super(message, "missing_raw");
  }
}

/** The device has the point or the group but not this access: it is write-only, of another device, ... */
export class AccessError extends FieldscribeError {
  /** @param {string} message */
  constructor(message) {
    super(message, "no_access");
  }
}

/** The device has no such point: the name is unknown, the point is only documented, or another variant has it. */
export class AbsentError extends AccessError {}

/** Another device answers: a point holds something else than the description says. */
export class OtherDeviceError extends FieldscribeError {
  /** @param {string} message */
  constructor(message) {
    super(message, "other_device");
  }
}

/** The device did not reach what a step of a command waits for; `held` are the last words read. */
export class WaitError extends FieldscribeError {
  /** @param {string} message @param {readonly number[]} held */
  constructor(message, held) {
    super(message, "not_reached");
    this.held = held;
  }
}

/** A block of addresses cannot be found: `no_marker`, `bad_chain`, `no_block` or `behind_end`. */
export class BlockError extends FieldscribeError {
  /** @param {string} status @param {string} message */
  constructor(status, message) {
    super(message, status);
  }
}

/** The request cannot be sent to this device; `status` says why (bad_unit, bad_count, ...). */
export class RequestError extends FieldscribeError {
  /** @param {string} status @param {string} message */
  constructor(status, message) {
    super(message, status);
  }
}

const FINAL_STATUS = ["exception", "refused", "no_rights", "echo_mismatch", "wrong_type"];

/** The reply is not a valid answer to the request; `status` says why (bad_crc, short_frame, echo_mismatch, ...). */
export class FrameError extends FieldscribeError {
  /** @param {string} status @param {string} message */
  constructor(status, message) {
    super(message, status);
    /** Process data of the same telegram, if that part was valid. @type {readonly number[]} */
    this.words = [];
  }

  get lost() {
    return !FINAL_STATUS.includes(this.status);
  }
}

/** The device confirmed a write with another value than the one `written`: `answered` is what it has now. */
export class EchoError extends FrameError {
  /** @param {string} message @param {readonly number[]} written @param {readonly number[]} answered */
  constructor(message, written, answered) {
    super("echo_mismatch", message);
    this.written = written;
    this.answered = answered;
  }
}

/** The standard's names of Modbus exceptions. @type {Readonly<Record<number, string>>} */
const STANDARD_NAMES = {
  0x01: "illegal_function",
  0x02: "illegal_data_address",
  0x03: "illegal_data_value",
  0x04: "server_device_failure",
  0x05: "acknowledge",
  0x06: "server_device_busy",
  0x08: "memory_parity_error",
  0x0a: "gateway_path_unavailable",
  0x0b: "gateway_target_device_failed_to_respond",
};

/**
 * The device refused the request with an exception `code`; `codeName` is the manual's name for it, if known. If not,
 * the message has the standard's name.
 */
export class ExceptionReplyError extends FrameError {
  /** @param {number} code @param {string} [codeName] */
  constructor(code, codeName) {
    const hex = code.toString(16).toUpperCase().padStart(2, "0");
    const called = codeName ?? STANDARD_NAMES[code];
    super("exception", `the device answered exception ${hex}h${called ? ` (${called})` : ""}`);
    this.code = code;
    this.codeName = codeName;
  }

  /** Whether a gateway says that the unit is not there (codes 0Ah and 0Bh, unless the device names them). */
  get lost() {
    return this.codeName === undefined && (this.code === 0x0a || this.code === 0x0b);
  }
}

/** The device refused the task with an error number `code`; `codeName` is the manual's name for it, if known. */
export class RefusedError extends FrameError {
  /** @param {number} code @param {string} [codeName] */
  constructor(code, codeName) {
    super("refused", `the device refused the task: error ${code}${codeName ? ` (${codeName})` : ""}`);
    this.code = code;
    this.codeName = codeName;
  }
}

/** Words of a telegram are not available: `status` is `missing` (not all arrived yet) or `torn` (inconsistent). */
export class TelegramError extends FieldscribeError {
  /** @param {string} status @param {string} message */
  constructor(status, message) {
    super(message, status);
  }
}

/** No answer arrived in time; `received` is what arrived instead. */
export class NoReplyError extends FieldscribeError {
  /** @param {string} message @param {Uint8Array} [received] */
  constructor(message, received) {
    super(message, "timeout");
    this.received = received;
  }

  get lost() {
    return true;
  }
}

/** The line itself failed: it cannot be opened, or the other side is gone. `unsent`: the request was not sent. */
export class LineError extends FieldscribeError {
  /** @param {string} message @param {boolean} [unsent] */
  constructor(message, unsent = false) {
    super(message, "line");
    this.unsent = unsent;
  }

  get lost() {
    return true;
  }
}

/** A value as text for messages. @param {unknown} value @returns {string} */
export function shown(value) {
  if (typeof value === "string") return `'${value}'`.slice(0, 80);
  if (Array.isArray(value)) return `[${value.map(shown).join(", ")}]`.slice(0, 80);
  return String(value).slice(0, 80);
}
