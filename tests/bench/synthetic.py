"""Writes a made-up Modbus device of any size: the mix of points that real maps have."""

from __future__ import annotations

import sys
from pathlib import Path

HEADER = """fieldscribe: 1
device: {name}_{count}
version: 1.0.0
vendor: Nobody
model: Synthetic
title: {{en: Synthetic device, de: Erfundenes Gerät}}
family: modbus
documents: {{manual: {{title: Synthetic, language: en}}}}
parts: [{parts}]
bus:
  framings: [rtu, tcp]
  units: 1..247
  broadcast: 0
  functions:
    03h: {{name: read_holding_registers, max: 125}}
    06h: {{name: write_register, max: 1}}
    10h: {{name: write_registers, max: 123}}
"""

GROUP = """group: group_{number}
title: {{en: Group {number}, de: Gruppe {number}}}
space: holding
access: rw
source: {{document: manual, section: "{number}"}}
numbering: {{modicon: wire + 1, reference: 400000 + modicon}}
points:
"""

HEAD = """- code: P{index}
  name: point_{index}
  title: {{en: Point number {index}, de: Punkt Nummer {index}}}
  at: {address}
  line: {line}
"""

KINDS = (
    "  range: 0..{high}\n  scale: value = raw * 0.1\n  unit: Hz\n",
    '  range: 0..{high}\n  scale: value = raw * 0.1\n  unit: "%"\n',
    "  range: 0..65535\n  unit: h\n  access: r\n",
    "  type: s16\n  range: -400..{high}\n  scale: value = raw * 0.1\n  unit: °C\n",
    "  range: 0..3\n  enum: {0: off_mode, 1: slow, 2: fast, 3: automatic}\n",
    "  type: u32\n  range: 1..{high}\n  scale: value = raw * 0.01\n  unit: s\n",
    "  range: 5..{high}\n  scale: raw = value * 256\n  unit: Hz\n",
    "  access: r\n  flags: {0: ready, 1: running, 2: warning, 3: {name: fault, active: 0}, 7: at_speed}\n",
    "  range: 0..{high}\n  unit: s\n",
    "  range: 0, 1, 2, 5\n",
)
HIGHEST = (4000, 1000, 0, 1250, 0, 300000, 17920, 0, 100, 0)
"""The upper limit of each kind that has one, where all points of a kind have the same."""
PRINTED = "  printed: {{modicon: [{modicon:04X}h, {modicon}], wire: [{address:04X}h, {address}]}}\n"
GROUP_SIZE = 500

FRAME = """fieldscribe: 1
device: four_points
version: 1.0.0
vendor: Nobody
model: Four
title: {en: Four points of a frame}
family: modbus
documents: {manual: {title: Four, language: en}}
parts: [status.yaml]
bus:
  framings: [rtu]
  units: 1..32
  broadcast: 0
  functions:
    03h: {name: read_holding_registers, max: 32}
    10h: {name: write_registers, max: 32}
"""
FRAME_POINTS = """group: status
title: {en: Status}
space: holding
access: rw
source: {document: manual, section: "1"}
points:
- {name: out_freq, title: {en: Output frequency}, at: 0, type: s16, scale: raw = value * 256, unit: Hz, line: 1}
- {name: out_volt, title: {en: Output voltage}, at: 1, type: u16, scale: raw = value * 50, unit: V, line: 2}
- {name: set_freq, title: {en: Setpoint frequency}, at: 2, type: s16, scale: raw = value * 256, unit: Hz, line: 3}
- {name: link_volt, title: {en: Link voltage}, at: 3, type: u16, scale: raw = value * 50, unit: V, line: 4}
"""


def write_frame_device(folder: Path) -> Path:
    """A device with four scaled points side by side, below `folder`; its folder."""
    place = folder / "four_points"
    place.mkdir(parents=True, exist_ok=True)
    (place / "device.yaml").write_text(FRAME, "utf-8")
    (place / "status.yaml").write_text(FRAME_POINTS, "utf-8")
    return place


def write_device(folder: Path, count: int, name: str = "synthetic", *, varied: bool = False) -> Path:
    """A device with `count` points of ten shapes below `folder`, with limits of their own if varied; its folder."""
    place = folder / f"{name}_{count}"
    place.mkdir(parents=True, exist_ok=True)
    numbers = range(1, (count + GROUP_SIZE - 1) // GROUP_SIZE + 1)
    parts = ", ".join(f"group_{number}.yaml" for number in numbers)
    (place / "device.yaml").write_text(HEADER.format(name=name, count=count, parts=parts), "utf-8")
    address = 0
    for number in numbers:
        text = [GROUP.format(number=number)]
        for index in range((number - 1) * GROUP_SIZE, min(count, number * GROUP_SIZE)):
            kind = KINDS[index % len(KINDS)]
            text.append(HEAD.format(index=index, address=address, line=index + 1))
            text.append(kind.replace("{high}", str(_highest(index, varied=varied))))
            text.append(PRINTED.format(address=address, modicon=address + 1))
            address += 2 if "u32" in kind else 1
        (place / f"group_{number}.yaml").write_text("".join(text), "utf-8")
    return place


def _highest(index: int, *, varied: bool) -> int:
    return 900 + index // 10 % 750 if varied else HIGHEST[index % len(KINDS)]


SIGNALS = (
    ("(0.1,0) [0|400]", "+", "Hz"),
    ("(0.1,0) [0|100]", "+", "%"),
    ("(1,0) [0|65535]", "+", "h"),
    ("(0.1,0) [-40|125]", "-", "°C"),
    ("(1,0) [0|3]", "+", ""),
    ("(0.01,0) [0.01|3000]", "+", "s"),
    ("(0.00390625,0) [0.01953125|70]", "+", "Hz"),
    ("(1,0) [0|65535]", "+", ""),
    ("(1,0) [0|100]", "+", "s"),
    ("(1,0) [0|5]", "+", ""),
)
"""Scale, limits, sign and unit of the kinds, as a DBC says them."""
EXTENDED = 1 << 31
"""Marks an id of 29 bits in a DBC."""
SIGNALS_OF_A_MESSAGE = 4
NAMED = 4
"""The kind whose numbers have names."""


def write_dbc(folder: Path, count: int) -> Path:
    """The same points as signals of a DBC below `folder`, four of 16 bits a message, with titles; the file."""
    frames, comments, values = [], [], []
    for index in range(count):
        kind = index % len(KINDS)
        scale, sign, unit = SIGNALS[kind]
        message = EXTENDED + index // SIGNALS_OF_A_MESSAGE
        place = index % SIGNALS_OF_A_MESSAGE
        if place == 0:
            frames.append(f"\nBO_ {message} message_{index}: 8 device")
        frames.append(f' SG_ point_{index} : {16 * place}|16@1{sign} {scale} "{unit}" master')
        comments.append(f'CM_ SG_ {message} point_{index} "Point number {index}";')
        if kind == NAMED:
            values.append(f'VAL_ {message} point_{index} 0 "off_mode" 1 "slow" 2 "fast" 3 "automatic" ;')
    file = folder / f"signals_{count}.dbc"
    head = 'VERSION ""\n\nNS_ :\n\nBS_:\n\nBU_: device master'
    file.write_text("\n".join([head, *frames, "", *comments, *values, ""]), "cp1252")
    return file


if __name__ == "__main__":
    print(write_device(Path(sys.argv[1]), int(sys.argv[2])))
