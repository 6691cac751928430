/* Code that reads and writes one point, to copy: the names are those of the generated code, which come with the point. */

/** @type {Record<string, string>} */
const LANGUAGE_NAMES = { c: "C", python: "Python", rust: "Rust", typescript: "TypeScript" };

/** Return the code of a point by language; empty for what is only documented. @param {PageDevice} device @param {Point} point */
function snippetsOf(device, point) {
  /** @type {Record<string, string>} */
  const made = {};
  if (!point.shared.generated) return made;
  for (const [language, deviceName] of Object.entries(device.names)) {
    const at = Object.keys(device.names).indexOf(language);
    made[language] = SNIPPETS[language](device, point, deviceName, point.identifiers[at] || point.name).filter(Boolean).join("\n");
  }
  return made;
}

/** Return true for a word of a telegram or a signal of a message, which no request reads alone. @param {Point} point */
function isCyclic(point) {
  return point.shared.telegram !== undefined;
}

/** @param {Point} point */
function reads(point) {
  return point.shared.access.includes("r");
}

/** @param {Point} point */
function writes(point) {
  return point.shared.access.includes("w");
}

/** Return the unit of integers in C: `10^-1 Hz`. @param {Point} point */
function countUnit(point) {
  const { counts, unit = "" } = point.shared;
  return counts > 0 ? `in 10^-${counts} ${unit}`.trim() : unit && `in ${unit}`;
}

/** Return the C expression for the raw number in the words of a telegram. @param {Point} point @param {string} name @param {string} word */
function rawInC(point, name, word) {
  if (point.shared.isGroup) return `${name}_extract(${word})`;
  return point.addresses.length > 1 || point.shared.type?.startsWith("s") ? `${name}_from_words(&${word})` : word;
}

/** @type {Record<string, (device: PageDevice, point: Point, type: string, name: string) => (string | false)[]>} */
const SNIPPETS = {
  /** @param {PageDevice} device @param {Point} point @param {string} prefix @param {string} name */
  c(device, point, prefix, name) {
    const what = point.shared.counts >= 0 ? "count" : "value";
    const tail = point.shared.counts >= 0 ? "_count" : "";
    const remark = countUnit(point) && ` /* ${countUnit(point)} */`;
    const head = `#include "${device.id}_${device.family}.h"\n`;
    const address = `${prefix}_${name}`.toUpperCase() + "_ADDRESS";
    if (isCyclic(point)) return [head, `raw = ${rawInC(point, `${prefix}_${name}`, `words[${address}]`)};${point.shared.form === "integer" ? remark : ""}`];
    if (point.shared.form === "text") return [head, `const uint16_t address = ${address}; /* read its words, then call ${prefix}_${name}_decode */`];
    if (device.family === "can") {
      return [
        head,
        reads(point) && `status = fieldscribe_can_read(&${prefix}_can_dialogue, unit, &${prefix}_${name}_frame.read, &frame);`,
        writes(point) && `status = fieldscribe_can_write(&${prefix}_can_dialogue, unit, &${prefix}_${name}_frame.write, raw, &frame);`,
      ];
    }
    return [
      head,
      reads(point) && `status = ${prefix}_read_${name}(&drive, &${what});${remark}`,
      writes(point) && `status = ${prefix}_write_${name}(&drive, ${what});${remark}`,
    ];
  },
  /** @param {PageDevice} device @param {Point} point @param {string} type @param {string} name */
  python(device, point, type, name) {
    const remark = point.shared.unit ? `  # ${point.shared.unit}` : "";
    const head = `from ${device.id} import ${type}\n`;
    if (isCyclic(point)) return [head, `point = ${type}.${name}`, "value = point.decode(raw)" + remark];
    return [
      head,
      reads(point) && `value = device.${name}.read()${remark}`,
      writes(point) && `device.${name}.write(value)${remark}`,
    ];
  },
  /** @param {PageDevice} device @param {Point} point @param {string} crate @param {string} name */
  rust(device, point, crate, name) {
    const remark = point.shared.unit ? ` // ${point.shared.unit}` : "";
    const head = `use ${crate}::points as p;\n`;
    if (isCyclic(point) || device.family === "can") return [head, `let value = p::${name}::decode(raw);${remark}`];
    return [
      head,
      reads(point) && `let value = device.read::<p::${name}>()?;${remark}`,
      writes(point) && `device.write::<p::${name}>(value)?;${remark}`,
    ];
  },
  /** @param {PageDevice} device @param {Point} point @param {string} type @param {string} name */
  typescript(device, point, type, name) {
    const remark = point.shared.unit ? ` // ${point.shared.unit}` : "";
    const head = `import { ${type} } from "${device.id.replaceAll("_", "-")}";\n`;
    return [
      head,
      reads(point) && `const value = await device.${name}.read();${remark}`,
      writes(point) && `await device.${name}.write(value);${remark}`,
    ];
  },
};
