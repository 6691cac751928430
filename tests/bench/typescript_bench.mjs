// Decoding in TypeScript beside a hand-written read; typescript_bench.py runs it
const { baseFrequency, outputFrequency } = await import("hitachi-l200");

const SIZE = 1 << 16;
const bytes = new Uint8Array(2 * SIZE).map((_, at) => (at * 31) & 0xff);
const view = new DataView(bytes.buffer);

function byHand() {
  let sum = 0;
  for (let at = 0; at < bytes.length; at += 2) sum += view.getUint16(at) / 10;
  return sum;
}

function generated() {
  let sum = 0;
  for (let at = 0; at < bytes.length; at += 2) sum += baseFrequency.decodeBytes(bytes, at);
  return sum;
}

function fromNumbers() {
  let sum = 0;
  for (let at = 0; at < bytes.length; at += 2) sum += baseFrequency.decode(view.getUint16(at));
  return sum;
}

function seconds(work) {
  const from = process.hrtime.bigint();
  work();
  return Number(process.hrtime.bigint() - from) / 1e9;
}

if (byHand() !== generated() || byHand() !== fromNumbers()) throw new Error("other values");
outputFrequency.decodeBytes(bytes); // another form at the same call sites, as in real programs
const best = [Infinity, Infinity, Infinity];
for (let round = 0; round < 300; round++) {
  [byHand, generated, fromNumbers].forEach((work, at) => (best[at] = Math.min(best[at], seconds(work))));
}
console.log(JSON.stringify({ byHand: best[0] / SIZE, decodeBytes: best[1] / SIZE, decode: best[2] / SIZE }));
