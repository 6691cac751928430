/* Drawings as SVG: the bits of a word, the words of a telegram, the bytes of a message, the map of a space. */

const SVG = "http://www.w3.org/2000/svg";

/** @param {string} name @param {any} facts @param {...any} children */
function drawn(name, facts, ...children) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(facts)) made.setAttribute(key, String(value));
  made.append(...children);
  return made;
}

/** @param {number} width @param {number} height @param {string} label @param {...Element} children */
function picture(width, height, label, ...children) {
  return drawn("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "img", "aria-label": label, class: "drawing" }, ...children);
}

/** Return a text that is cut where it would be wider than `width`; the whole text is its title.
 * @param {number} x @param {number} y @param {string} text @param {number} width @param {any} [facts] */
function label(x, y, text, width, facts = {}) {
  const most = Math.max(1, Math.floor(width / (facts.class === "inside" ? 5.8 : 6.7)));
  const shown = [...text].length > most ? [...text].slice(0, most - 1).join("") + "…" : text;
  const made = drawn("text", { x, y, ...facts }, shown);
  if (shown !== text) made.append(drawn("title", {}, text));
  return made;
}

/** Draw a word: a cell for each bit, the highest first, and a line from each field to its name.
 * @param {number} bits @param {any[]} fields @param {number} width @param {string} caption */
function drawBits(bits, fields, width, caption) {
  const cell = Math.max(9, Math.min(24, Math.floor((width > 640 ? 400 : width * 0.62) / bits)));
  const named = fields.filter((field) => field.name).sort((a, b) => a.low - b.low);
  const right = cell * bits + 12;
  const parts = [];
  for (const field of fields) {
    for (let bit = field.low; bit < field.low + field.width; bit += 1) {
      const x = (bits - 1 - bit) * cell;
      const box = drawn("rect", { x: x + 0.5, y: 0.5, width: cell, height: 24, class: field.name ? `bit ${field.style ?? ""}` : "bit unused", "data-bit": bit });
      parts.push(box);
      if (cell >= 11) parts.push(drawn("text", { x: x + cell / 2 + 0.5, y: 16, class: "number" }, String(bit)));
      if (field.always) parts.push(drawn("text", { x: x + cell / 2 + 0.5, y: 36, class: "number" }, field.always[field.width - 1 - (bit - field.low)]));
    }
  }
  named.forEach((field, at) => {
    const [high, low] = [field.low + field.width - 1, field.low];
    const x = (bits - 1 - (high + low) / 2) * cell + cell / 2 + 0.5;
    const y = 46 + at * 18;
    if (high > low) parts.push(drawn("path", { d: `M${(bits - 1 - high) * cell + 3} 28h${(high - low + 1) * cell - 6}`, class: "line" }));
    parts.push(drawn("path", { d: `M${x} ${field.width > 1 ? 28 : 25}V${y - 4}H${right - 4}`, class: "line" }));
    parts.push(label(right, y, `${high > low ? `${high}..${low}` : low}  ${field.name}`, width - right, { class: "name" }));
  });
  return picture(width, 46 + named.length * 18, caption, ...parts);
}

/** Return the fields of a word with the gaps between them; `always` are bits that are a constant.
 * @param {any[]} fields @param {number} bits @param {number[]} fixed */
function withGaps(fields, bits, fixed) {
  const owners = new Array(bits).fill(null);
  for (const field of fields) for (let bit = field.low; bit < Math.min(bits, field.low + field.width); bit += 1) owners[bit] = field;
  const gaps = [];
  for (let bit = 0; bit < bits; bit += 1) {
    if (owners[bit]) continue;
    const always = fixed.length && Math.floor(fixed[0] / 2 ** bit) % 2 ? String(Math.floor(fixed[1] / 2 ** bit) % 2) : "";
    gaps.push({ low: bit, width: 1, name: "", always });
  }
  return [...fields, ...gaps];
}

/** Draw boxes in rows: `boxes` have a place, a length, a text, a style and the point that a click opens.
 * @param {any[]} boxes @param {any} facts */
function drawRows(boxes, { columns, cell, height, head, caption, rowName }) {
  const rows = new Map();
  for (const box of boxes) {
    for (let at = box.at; at < box.at + box.length;) {
      const row = Math.floor(at / columns);
      const end = Math.min(box.at + box.length, (row + 1) * columns);
      if (!rows.has(row)) rows.set(row, []);
      rows.get(row).push({ ...box, from: at - row * columns, count: end - at });
      at = end;
    }
  }
  const parts = [];
  let y = 0;
  let last = null;
  for (const row of [...rows.keys()].sort((a, b) => a - b)) {
    if (last !== null && row > last + 1) {
      parts.push(drawn("path", { d: `M${head} ${y + 5}h${columns * cell}`, class: "gap" }));
      y += 10;
    }
    parts.push(drawn("text", { x: 0, y: y + height / 2 + 4, class: "name" }, rowName(row * columns)));
    const stacks = new Map();
    for (const box of rows.get(row)) stacks.set(box.from, [...(stacks.get(box.from) ?? []), box]);
    for (const [from, whole] of stacks) {
      const stack = height / whole.length < 12 ? [together(whole)] : whole;
      stack.forEach((/** @type {any} */ box, /** @type {number} */ place) => {
        const share = height / stack.length;
        const shape = drawn("rect", { x: head + from * cell + 0.5, y: y + place * share + 0.5, width: box.count * cell - 1, height: Math.max(share - 1, 1), class: `box ${box.style}`, "data-point": box.point ?? "" }, drawn("title", {}, box.title));
        parts.push(shape);
        if (share >= 12) parts.push(label(head + from * cell + 3, y + place * share + share / 2 + 3.5, box.text, box.count * cell - 4, { class: "inside" }));
      });
    }
    last = row;
    y += height + 2;
  }
  return picture(head + columns * cell + 1, y + 1, caption, ...parts);
}

/** Return one box for many at the same place, such as the elements of an array. @param {any[]} boxes */
function together(boxes) {
  return { ...boxes[0], text: `${boxes[0].text} +${boxes.length - 1}`, title: boxes.map((box) => box.title).join("\n") };
}

/** Draw the map of a space: a box for the words of each point, at its address.
 * @param {Point[]} points @param {number} width @param {string} caption */
function drawMap(points, width, caption) {
  const columns = width < 600 ? 8 : 16;
  const boxes = points.filter((point) => point.addresses.length).map((point) => {
    const at = Math.min(...point.addresses);
    const together = Math.max(...point.addresses) - at < point.addresses.length;
    return { at, length: together ? point.addresses.length : 1, text: point.code || point.name, title: `${shortAddress(at)} ${point.code} ${point.name}`, style: `access-${point.shared.access}`, point: point.name };
  });
  const head = 54;
  const cell = Math.floor((Math.min(width, 1000) - head - 2) / columns);
  return drawRows(boxes, { columns, cell, height: 22, head, caption, rowName: (/** @type {number} */ at) => shortAddress(at) });
}

/** Draw a telegram: a box for each word, with what lies in it.
 * @param {Point[]} points @param {number} words @param {number} width @param {string} caption */
function drawTelegram(points, words, width, caption) {
  const columns = width < 600 ? 2 : 4;
  const placed = points.filter((point) => point.addresses.length);
  const used = new Set(placed.flatMap((point) => [...point.addresses]));
  const boxes = placed.map((point) => {
    const at = Math.min(...point.addresses);
    const bits = point.shared.isGroup ? ` ${bitsText(point)}` : "";
    return { at, length: point.addresses.length, text: `${point.code || point.name}${bits}`, title: `word ${at} ${point.code} ${point.name}${bits}`, style: `access-${point.shared.access}`, point: point.name, low: -(point.shared.low ?? 0) };
  }).sort((a, b) => a.at - b.at || a.low - b.low);
  for (let at = 0; at < words; at += 1) if (!used.has(at)) boxes.push({ at, length: 1, text: "", title: `word ${at}: no point`, style: "unused", point: "", low: 0 });
  const head = 34;
  const cell = Math.floor((Math.min(width, 1000) - head - 2) / columns);
  const most = Math.max(1, ...boxes.map((box) => boxes.filter((other) => other.at === box.at).length));
  return drawRows(boxes, { columns, cell, height: Math.max(24, most * 15), head, caption, rowName: String });
}

/** Draw the bytes of a message with what each holds. @param {string[]} roles @param {number} width @param {string} caption */
function drawBytes(roles, width, caption) {
  const columns = width < 600 ? 4 : 8;
  const boxes = roles.map((role, at) => ({ at, length: 1, text: role, title: `byte ${at}: ${role}`, style: "role" }));
  const cell = Math.floor((Math.min(width, 1000) - 26) / columns);
  return drawRows(boxes, { columns, cell, height: 26, head: 24, caption, rowName: String });
}
