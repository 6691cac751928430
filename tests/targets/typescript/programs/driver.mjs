// Drives a generated device by lines of JSON on standard input: {"on": "baseFrequency", "call": "read", "arguments": []}
// gives {"result": 50} or {"error": {...}}. Arguments: package, class, line, options of the device.
import { connect } from "node:net";
import { createInterface } from "node:readline";
import { NoReplyError } from "fieldscribe-runtime";

/** A bus of CAN behind a socket: frames are 4 bytes of identifier, one of length, and 8 of data. */
class BridgeLine {
  constructor(port) {
    this.socket = connect({ host: "127.0.0.1", port, noDelay: true });
    this.held = Buffer.alloc(0);
    this.socket.on("data", (data) => {
      this.held = Buffer.concat([this.held, data]);
      for (; this.held.length >= 13; this.held = this.held.subarray(13)) {
        const frame = {
          id: this.held.readUInt32BE(0) & 0x1fffffff,
          data: new Uint8Array(this.held.subarray(5, 5 + this.held[4])),
        };
        this.onFrame?.(frame);
      }
    });
  }

  async exchange(request, reply) {
    if (request) {
      const bytes = Buffer.alloc(13);
      bytes.writeUInt32BE((request.extended ? 0x80000000 : 0) + request.id);
      bytes[4] = request.data.length;
      bytes.set(request.data, 5);
      this.socket.write(bytes);
    }
    if (reply.broadcast) return undefined;
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new NoReplyError("no frame came")), reply.patience * 1000);
      this.onFrame = (frame) => {
        if (!reply.accepts(frame)) return;
        clearTimeout(timer);
        this.onFrame = undefined;
        resolve(frame);
      };
    });
  }

  close() {
    this.socket.destroy();
  }
}

/** The line, with no more modules than it needs: they take longer than a session. */
async function opened({ kind, port, path, framing, timeout = 0.3 }) {
  if (kind === "can") return new BridgeLine(port);
  const { TcpLine } = await import("fieldscribe-runtime/tcp");
  if (kind === "tcp") return new TcpLine("127.0.0.1", { port, framing, timeout });
  const { SerialLine } = await import("fieldscribe-runtime/serialport");
  if (kind === "serial") return new SerialLine(path, { framing, timeout, mode: "8N1", baudRate: 115200 });
  const { ModbusSerialLine } = await import("fieldscribe-runtime/modbus-serial");
  const { default: ModbusRTU } = await import("modbus-serial");
  const client = new ModbusRTU();
  client.setTimeout(timeout * 1000);
  if (path) await client.connectRTUBuffered(path, { baudRate: 115200 });
  else await client.connectTCP("127.0.0.1", { port });
  return Object.assign(new ModbusSerialLine(client), { close: () => client.close(() => undefined) });
}

function plain(value) {
  if (value === undefined) return { undefined: true };
  if (value instanceof Error)
    return { error: { ...value, kind: value.name, message: value.message, status: value.status } };
  if (typeof value === "bigint") return { bigint: String(value) };
  if (typeof value === "number" && !Number.isFinite(value)) return { number: String(value) };
  if (value instanceof Map) return plain(Object.fromEntries(value));
  if (Array.isArray(value)) return value.map(plain);
  if (value instanceof Date || value === null || typeof value !== "object") return value;
  const kind = Object.getPrototypeOf(value)?.constructor?.name;
  return {
    ...(kind === "Object" ? {} : { kind }),
    ...Object.fromEntries(Object.entries(value).map(([name, one]) => [name, plain(one)])),
  };
}

const [name, className, where, options] = process.argv.slice(2);
const generated = await import(name);
const line = await opened(JSON.parse(where));
let device;
let failure;
try {
  device = new generated[className](line, JSON.parse(options));
} catch (error) {
  failure = error;
}
for await (const text of createInterface({ input: process.stdin })) {
  const { on, call, arguments: given = [], set } = JSON.parse(text);
  let answer;
  try {
    if (failure) throw failure;
    if (set) answer = { result: plain(Object.assign(device, set) && null) };
    else if (call === "table")
      answer = {
        result: [...device.table.points].map(([attribute, { name, decode, encode, at }]) => ({
          attribute,
          name,
          readable: Boolean(decode),
          writable: Boolean(encode),
          telegram: at.telegram,
        })),
      };
    else {
      const subject = on === undefined ? device : (device[on] ?? device.point(on));
      answer = { result: plain(await subject[call](...given)) };
    }
  } catch (error) {
    answer = plain(error);
    answer.error.stack = error.stack;
  }
  process.stdout.write(`${JSON.stringify(answer)}\n`);
}
line.close();
