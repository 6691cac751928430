// What type checkers must refuse: each line below `@ts-expect-error` is an error, and nothing else is.
import * as eastron from "eastron-sdm630";
import * as fronius from "fronius-datamanager";
import * as l200 from "hitachi-l200";
import * as jumo from "jumo-controller";
import * as nord from "nord-sk5xxe";
import * as mm4 from "siemens-mm4";
import * as mpu2s from "woodward-mpu2s";
import { FieldscribeError, SpecialCode, type Line, type UnknownNumber } from "fieldscribe-runtime";

export const all = [eastron, fronius, l200, jumo, nord, mm4, mpu2s];

// values
const hertz: number = l200.baseFrequency.decode(500);
const raw: number = l200.baseFrequency.encode(hertz);
const count: bigint = l200.baseFrequency.decodeCount(raw);
export const shown: string = l200.baseFrequency.text(hertz) + count;
// @ts-expect-error a quantity is no text
l200.baseFrequency.encode("50");
// @ts-expect-error a raw number of 16 bits is no bigint
l200.baseFrequency.decode(500n);

// access
l200.outputFrequency.decode(1);
// @ts-expect-error it is only read
l200.outputFrequency.encode(1);
// @ts-expect-error it is only written
mm4.controlWord.decode(1);

// names
const command = l200.runCommand.decode(1);
l200.runCommand.encode(l200.RunCommand.RUN);
export const isRunning: boolean = command === l200.RunCommand.RUN;
// @ts-expect-error a closed enum takes its own numbers only
l200.runCommand.encode(7);
// @ts-expect-error what a device sends may have no name
l200.runCommand.encode(command);
mm4.userAccessLevel.encode(5 as UnknownNumber);
// @ts-expect-error an open enum takes a number without a name only if one says so
mm4.userAccessLevel.encode(5);
// @ts-expect-error there is no such name
export const missing = l200.RunCommand.FLY;
// @ts-expect-error names are constants
l200.RunCommand.RUN = 2;

// what other points decide
fronius.acCurrent.decode(120, { acCurrentExponent: -2 });
// @ts-expect-error the scale needs the exponent
fronius.acCurrent.decode(120);
// @ts-expect-error it needs that of currents
fronius.acCurrent.decode(120, { acVoltageExponent: -2 });
// @ts-expect-error the limits need two points
l200.upperFrequencyLimit.encode(50, { lowerFrequencyLimit: 0 });
l200.upperFrequencyLimit.decode(500);

// special codes
const limit = l200.upperFrequencyLimit.decode(0);
// @ts-expect-error it may be a special code, which is no number
export const double: number = limit * 2;
if (!(limit instanceof SpecialCode)) limit.toFixed(1);
export const inactive = l200.upperFrequencyLimit.special.inactive;
// @ts-expect-error there is no such code
l200.upperFrequencyLimit.special.overRange;

// words
const word = mm4.statusWord.decode(1);
export const ready: boolean = word.readyToRun;
mm4.controlWord.encode(mm4.ControlWord.of({ on: true }));
// @ts-expect-error the word has no such flag
mm4.ControlWord.of({ flying: true });

// devices
export const version: string = l200.HitachiL200.facts.version;
export async function talk(line: Line): Promise<void> {
  const drive = new l200.HitachiL200(line, { unit: 1, voltageClass: "200V" });
  const read: number = await drive.baseFrequency.read();
  await drive.baseFrequency.write(read);
  const named = await drive.readMany(["baseFrequency", "digitalOutputs"]);
  named.baseFrequency.toFixed(named.digitalOutputs.relayAl ? 1 : 2);
  // @ts-expect-error it was not asked for
  named.outputFrequency;
  const group = await drive.readMany("status");
  // @ts-expect-error a point may not exist in this device
  group.outputFrequency.toFixed(1);
  group.outputFrequency?.toFixed(1);
  await drive.readMany([l200.baseFrequency, "outputFrequency"]);
  const tried = await drive.readMany(["baseFrequency"], { errors: "return" });
  // @ts-expect-error its error may stand there
  tried.baseFrequency?.toFixed(1);
  if (!(tried.baseFrequency instanceof FieldscribeError)) tried.baseFrequency?.toFixed(1);
  await drive.enter.send();
  // @ts-expect-error there is no such group
  await drive.readMany("statuses");
  // @ts-expect-error the point is of another device
  await drive.readMany([mm4.maximumFrequency]);
  // @ts-expect-error it is only read
  await drive.outputFrequency.write(1);
  // @ts-expect-error nothing keeps it for good but the command
  await drive.baseFrequency.write(50, { keep: true });
  // @ts-expect-error there is no such voltage
  new l200.HitachiL200(line, { unit: 1, voltageClass: "230V" });
  // @ts-expect-error every device has a unit
  new l200.HitachiL200(line, {});
  // @ts-expect-error a command has no value
  await drive.readMany(["enter"]);
  const other = new mm4.SiemensMm4(line, { unit: 0, link: { pkw: 4, pzd: 2 } });
  await other.maximumFrequency.write(50, { keep: true });
  // @ts-expect-error it is only written
  await other.readMany(["controlWord"]);
}
