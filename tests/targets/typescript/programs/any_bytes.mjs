// Gives random and spoiled bytes to all parsers and receivers, and prints how often each status came.
import { FieldscribeError } from "fieldscribe-runtime";
import { TelegramReceiver } from "fieldscribe-runtime/can";
import { parseCanFrame } from "fieldscribe-runtime/can-frames";
import { buildModbusRequest, modbusReplyShape, parseModbusReply } from "fieldscribe-runtime/modbus-frames";
import { ReplyReader } from "fieldscribe-runtime/receiving";
import { buildUssRequest, parseUssReply, ussReplyShape } from "fieldscribe-runtime/uss-frames";
import { FroniusDatamanager } from "fronius-datamanager";
import { HitachiL200 } from "hitachi-l200";
import { SiemensMm4 } from "siemens-mm4";
import { WoodwardMpu2s } from "woodward-mpu2s";

let state = 1;
/** A random number below an end; always the same ones. */
function random(end) {
  state = (Math.imul(state, 1103515245) + 12345) >>> 0;
  return (state >>> 8) % end;
}

/** Random bytes, or good ones with one that is wrong, one too many, or some too few. */
function spoiled(good) {
  if (random(3) === 0) return Uint8Array.from({ length: random(300) }, () => random(256));
  const bytes = Uint8Array.from([...good, random(256)]).subarray(0, 1 + random(good.length + 1));
  bytes[random(bytes.length)] ^= random(2) << random(8);
  return bytes;
}

const seen = {};
function tried(work) {
  let status = "ok";
  try {
    work();
  } catch (error) {
    if (!(error instanceof FieldscribeError)) throw error;
    ({ status } = error);
  }
  seen[status] = (seen[status] ?? 0) + 1;
}

const read = { unit: 1, function: 3, address: 0x1028, count: 1 };
const rtu = Uint8Array.of(1, 3, 2, 1, 0xf4, 0xb8, 0x53);
const tcp = Uint8Array.of(0, 7, 0, 0, 0, 5, 1, 3, 2, 1, 0xf4);
const link = { pkw: 4, pzd: 2 };
const task = { unit: 1, task: 1, parameter: 700, words: [0, 0] };
const uss = buildUssRequest(task, SiemensMm4.facts.profile, link);
const { profile: can } = WoodwardMpu2s.facts;
const receivers = can.telegrams.map(({ name }) => new TelegramReceiver(can, name, 1));
for (let round = 0; round < 4_000; round++) {
  tried(() => parseModbusReply(read, spoiled(rtu), HitachiL200.facts.profile, "rtu"));
  tried(() => parseModbusReply(read, spoiled(tcp), FroniusDatamanager.facts.profile, "tcp", 7));
  tried(() => parseUssReply(task, spoiled(uss), SiemensMm4.facts.profile, link));
  const message = can.messages[random(can.messages.length)];
  const frame = { id: random(2) ? message.canId : random(0x20000000), data: spoiled(new Uint8Array(8)) };
  tried(() => parseCanFrame(message, 1, frame));
  tried(() => receivers.forEach((receiver) => receiver.take(frame)));
  const request = buildModbusRequest(read, HitachiL200.facts.profile);
  for (const shape of [modbusReplyShape(request, "rtu"), modbusReplyShape(tcp, "tcp"), ussReplyShape(uss)]) {
    const reader = new ReplyReader(shape);
    tried(() => {
      for (let part = 0; part < 4 && !reader.take(spoiled(rtu)); part++);
    });
    tried(() => reader.giveUp());
  }
}
console.log(JSON.stringify(seen));
