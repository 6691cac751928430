"""A bench: lines with their devices, made from mappings of a bench file, the command line or a test.

A mapping from a file has the place of each key, which error messages start with.
"""

from collections.abc import Mapping
from contextlib import suppress
from decimal import Decimal
from difflib import get_close_matches
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeVar

from fieldscribe.diagnostics import Report, Span, UnclearError, did_you_mean
from fieldscribe.families import family
from fieldscribe.language.load import load
from fieldscribe.language.nodes import Map, Seq, read_source
from fieldscribe.model import Device
from fieldscribe.pipeline import DEVICE_FILE, load_device
from fieldscribe.resources import descriptions_dir
from fieldscribe.simulation.behaviour_file import FILE, read_behaviour
from fieldscribe.simulation.behaviour_rules import Rules
from fieldscribe.simulation.device import Clock, SimulatedDevice
from fieldscribe.simulation.layout import Layout
from fieldscribe.simulation.line import Fault, Line, Trace

LOCAL = Path("descriptions")
Made = TypeVar("Made")


class BrokenError(UnclearError):
    """A file has errors; `report` has all of them."""

    def __init__(self, report: Report) -> None:
        super().__init__(report.findings[0].message, report.findings[0].hint or "")
        self.report = report


@lru_cache(maxsize=64)
def layout_of(
    name: str, variants: tuple[str, ...] = (), given: tuple[tuple[str, int], ...] = (), folder: Path = LOCAL
) -> Layout:
    """Return the layout of a device. Raises UnclearError."""
    return Layout(_model(name, folder), variants, dict(given))


@lru_cache(maxsize=16)
def rules_of(name: str, folder: Path = LOCAL, *, needed: bool = True) -> Rules | None:
    """Return the rules of a description's behaviour file; None without one. Raises UnclearError, also if `needed`."""
    file, report = _file(name, folder), Report()
    rules = read_behaviour(file, _model(name, folder), report)
    if report.has_errors:
        raise BrokenError(report)
    if rules is None and needed:
        raise UnclearError(f"`{name}` has no behaviour", f"write a {FILE} beside {file}")
    return rules


@lru_cache(maxsize=16)
def _model(name: str, folder: Path) -> Device:
    report = Report()
    return _read(load_device(_file(name, folder), report), report)


def _file(name: str, folder: Path) -> Path:
    paths = [folder / name, Path(name), LOCAL / name, descriptions_dir() / name]
    files = (path if path.is_file() else path / DEVICE_FILE for path in paths)
    file = next((file for file in files if file.is_file()), None)
    if file is None:
        ids = [path.parent.name for path in descriptions_dir().glob(f"*/{DEVICE_FILE}")]
        near = did_you_mean(get_close_matches(name, ids, 1, 0.5))
        raise UnclearError(f"there is no device `{name[:80]}`", near or f"give an id, or a folder with a {DEVICE_FILE}")
    return file


def _read(made: Made | None, report: Report) -> Made:
    if made is None:
        raise BrokenError(report)
    return made


Settings = Mapping[str, Any]
Item = TypeVar("Item")
_Kinds = Mapping[str, tuple[tuple[type, ...], str]]
MOST_DEVICES = 10_000
_LONGEST = 1e8
_FIRST_LINES = "write `lines:`, below it `- tcp: 5020` and its `devices`"
_BITS = 11
"""The bits of a character on a serial line, with start, parity and stop bits."""

_TEXT, _WHOLE, _YES_NO = ((str,), "a text"), ((int,), "a whole number"), ((bool, str), "yes or no")
_LIST, _MAP = ((list,), "a list"), ((dict,), "a mapping")
_PLACES: _Kinds = {
    "tcp": ((int, str), "[HOST:]PORT"),
    "serial": ((str, type(None)), "a path, or nothing"),
    "can": _TEXT,
}
_BENCH: _Kinds = {"lines": _LIST, "seed": _WHOLE, "time_scale": ((int, float, Decimal), "a number"), "strict": _YES_NO}
_LINE: _Kinds = {**_PLACES, "framing": _TEXT, "speed": _WHOLE, "faults": _LIST, "devices": _LIST}
_WHICH: _Kinds = {"device": _TEXT, "unit": _WHOLE, "units": _TEXT, "variant": _MAP, "given": _MAP, "behaviour": _YES_NO}
_DEVICE: _Kinds = {**_WHICH, "values": _MAP, "unmet": _LIST, "refusals": _MAP}


def read_bench(file: Path) -> Settings:
    """Return the mapping of a bench file. Raises UnclearError."""
    report = Report()
    source = read_source(file, report, beginning=_FIRST_LINES)
    documents = [] if source is None else load(source, report)
    if report.has_errors:
        first = report.findings[0]
        raise _at(first.span, first.message, first.hint or "")
    if len(documents) != 1 or documents[0] is None:
        raise UnclearError(f"{file}:1:1: a bench file is one mapping with `lines`", "")
    return documents[0]


class Bench:
    """Lines whose devices share a clock; paths of descriptions are relative to `folder`. Raises UnclearError."""

    def __init__(self, settings: Settings, folder: Path = Path(), trace: Trace | None = None) -> None:
        _check(settings, _BENCH, "lines")
        if not settings["lines"]:
            raise _wrong(settings, "lines", "there is no line", "write `- tcp: 5020` and its `devices`")
        self.clock = Clock(float(settings.get("time_scale", 1)))
        if not 0 <= self.clock.scale <= 1e6:
            raise _wrong(settings, "time_scale", "a time scale is a number from 0 (time stops) to a million", "")
        self._folder, self._seed, self._trace = folder, settings.get("seed", 0), trace
        self._strict = settings.get("strict") in (True, "yes")
        self.lines = [self._line(_item(settings["lines"], place)) for place in range(len(settings["lines"]))]

    def _line(self, settings: Settings) -> Line:
        _check(settings, _LINE, "devices")
        places = [(key, str(settings[key] or "")) for key in _PLACES if key in settings]
        if len(places) > 1 or not settings["devices"]:
            raise _wrong(settings, None, "a line is one of tcp, serial and can, and has devices", "write `tcp: 5020`")
        entries = [_item(settings["devices"], place) for place in range(len(settings["devices"]))]
        devices = [device for entry in entries for device in self._devices(entry)]
        on, at = places[0] if places else ("", "")
        name = devices[0].device.family
        if other := next((each.device.family for each in devices if each.device.family != name), None):
            raise _wrong(settings, None, f"devices of {name} and {other} cannot share a line", "give each a line")
        part = family(name).part("simulation")
        on = on or next(iter(part.LINES))
        framing = settings.get("framing") or next(iter(part.LINES.get(on, ("",))))
        if framing not in part.LINES.get(on, ()):
            hint = "; ".join(f"{line}: {' or '.join(framings)}" for line, framings in part.LINES.items())
            raise _wrong(
                settings, None, f"{devices[0].device.id} is on no {on} line{f' with {framing}' * bool(framing)}", hint
            )
        units = [device.unit for device in devices]
        if twice := next((unit for unit in units if units.count(unit) > 1), None):
            raise _wrong(
                settings, "devices", f"two devices on the line have the unit {twice}", "give each another unit"
            )
        if settings.get("speed") and on == "tcp":
            raise _wrong(settings, "speed", "a TCP line has no speed", "leave it out, or answer at a serial port")
        core, speed = part.core_of(devices, framing), settings.get("speed", 0)
        core.character = _BITS / speed if speed > 0 and on == "serial" else 0.0
        line = Line(core, self.clock, name=at or devices[0].device.id, seed=self._seed)
        line.on, line.at, line.speed, line.trace = on, at, speed, self._trace
        line.faults.waiting.extend(Fault.of(str(fault)) for fault in settings.get("faults", ()))
        return line

    def _devices(self, settings: Settings) -> list[SimulatedDevice]:
        _check(settings, _DEVICE, "device")
        name, moves = settings["device"], settings.get("behaviour")
        variants = tuple(f"{axis}={value}" for axis, value in settings.get("variant", {}).items())
        if moves not in (None, True, False, "yes", "no"):
            raise _wrong(settings, "behaviour", f"`{moves}` is not yes or no", "leave it out, or write `no`")
        try:
            layout = layout_of(name, variants, tuple(settings.get("given", {}).items()), self._folder)
        except UnclearError as error:
            if isinstance(error, BrokenError):  # the description has errors, which have places of their own
                raise
            raise _wrong(settings, "device", error.message, error.hint) from None
        rules = None if moves in (False, "no") else rules_of(name, self._folder, needed=moves is not None)
        low, high = layout.device.bus.units
        devices = []
        for unit in _units(settings, layout.device.bus.usual_unit):
            if not low <= unit <= high and high:
                raise _wrong(settings, None, f"{layout.device.id} has no unit {unit}", f"its units are {low} to {high}")
            device = SimulatedDevice(layout, unit, seed=self._seed, clock=self.clock, strict=self._strict, rules=rules)
            try:
                device.refusals.update(_refusals(settings, layout.device.family))
                device.meet(settings.get("unmet", ()), holds=False)
                device.values.update(settings.get("values", {}))
            except (KeyError, ValueError) as error:
                raise _wrong(settings, None, str(error.args[0]), "") from None
            devices.append(device)
        return devices


def _units(settings: Settings, usual: int) -> range:
    """Return the units of an entry; several only as an interval such as `1..20`."""
    if "units" not in settings:
        unit = settings.get("unit", usual)
        return range(unit, unit + 1)
    low, _, high = (part.strip() for part in settings["units"].partition(".."))
    if not (low.isdecimal() and high.isdecimal() and 0 <= int(high) - int(low) < MOST_DEVICES):
        raise _wrong(settings, "units", f"`{settings['units'][:40]}` is no interval", "write it as 1..10")
    return range(int(low), int(high) + 1)


def _refusals(settings: Settings, name: str) -> Mapping[str, int]:
    """Return the numbers for kinds of refusals of a device of a family. Raises UnclearError."""
    part = family(name).part("simulation")
    given: Mapping[str, int] = settings.get("refusals", {})
    for kind, number in given.items():
        if kind not in part.REFUSALS:
            known = ", ".join(part.REFUSALS) or "none: nobody answers a refused request"
            raise _wrong(given, kind, f"{name} has no refusal `{str(kind)[:40]}`", f"there are {known}")
        if type(number) is not int or not 0 <= number <= part.LARGEST_CODE:
            message = f"the number of `{kind}` is a whole number from 0 to {part.LARGEST_CODE}"
            raise _wrong(given, kind, message, "0 accepts the write silently")
    return given


def _item(items: list[Any], place: int) -> Settings:
    if not isinstance(items[place], dict):
        raise _at(items.span(place) if isinstance(items, Seq) else None, "this is no mapping", "write `- key: value`")
    item: Settings = items[place]
    return item


def _check(settings: Settings, kinds: _Kinds, needed: str) -> None:
    """Raise UnclearError unless the keys of a mapping and their values are of these kinds."""
    for key, value in settings.items():
        if key not in kinds:
            near = did_you_mean([known for known in kinds if known[:3] == key[:3]])
            raise _wrong(settings, key, f"there is no key `{key[:40]}` here", near or f"there are {', '.join(kinds)}")
        types, words = kinds[key]
        if not isinstance(value, types) or (isinstance(value, bool) and bool not in types):
            raise _wrong(settings, key, f"`{key}` is {words}", "")
    if needed not in settings:
        raise _wrong(settings, None, f"the key `{needed}` is missing", f"add `{needed}: …`")


def _wrong(settings: Settings, key: str | None, message: str, hint: str) -> UnclearError:
    return _at(settings.span(key) if isinstance(settings, Map) else None, message, hint)


def _at(span: Span | None, message: str, hint: str) -> UnclearError:
    return UnclearError(f"{span.file}:{span.line}:{span.column}: {message}" if span is not None else message, hint)


HELP = """\
get POINT           print the value of a point
set POINT=VALUE     set a value, whatever the rules of the device say
unmet CONDITION     refuse the writes that need a condition; `met CONDITION` ends that
fault KIND ...      spoil answers: `fault late 0.5 x3`, `fault cut 4 10%`; `clear` removes all faults
restart             switch the devices off and on: what was not stored is lost
advance SECONDS     advance the clock at once
quit                end
@UNIT before a command, as in `@3 get A020`, selects one unit"""


def carry_out(bench: Bench, text: str) -> str:
    """Carry out a console command and return what to print. Raises UnclearError, and EOFError for `quit`."""
    unit, _, words = text.strip().partition(" ") if text.strip().startswith("@") else ("", "", text.strip())
    verb, _, rest = words.strip().partition(" ")
    devices = [device for line in bench.lines for device in line.core.devices if unit in ("", f"@{device.unit}")]
    if not devices:
        raise UnclearError(f"no device has the unit `{unit[1:21]}`", "")
    try:
        if verb == "advance":
            bench.clock.advance(_seconds(rest))
        elif verb == "fault":
            for line in bench.lines:
                line.faults.waiting.append(Fault.of(rest))
        elif verb == "clear":
            for line in bench.lines:
                line.faults.waiting.clear()
        elif verb == "quit":
            raise EOFError
        elif verb in ("get", "set", "restart", "met", "unmet"):
            return "\n".join(filter(None, (_one(device, verb, rest) for device in devices)))
        else:
            return (
                _help(devices)
                if verb == "help"
                else f"there is no `{verb[:20]}`; `help` lists what there is" * bool(verb)
            )
    except (KeyError, ValueError) as error:
        raise UnclearError(str(error.args[0]), "") from None
    return ""


def _help(devices: list[SimulatedDevice]) -> str:
    """Return what the commands do, and the quantities of behaviours that `get` and `set` take like points."""
    rules = [device.behaviour.rules for device in devices if device.behaviour is not None]
    quantities = {name: quantity for each in rules for name, quantity in each.plant.items()}
    rows = [
        f"{name:<19} {each.title}{f' ({each.unit})' if each.unit else ''}".rstrip() for name, each in quantities.items()
    ]
    return "\n".join([HELP, *(["", "also POINT, but only here:"] if rows else []), *rows])


def _seconds(text: str) -> float:
    """Return a number of seconds of up to three years. Raises UnclearError."""
    with suppress(ValueError):
        if 0 <= (seconds := float(text)) <= _LONGEST:
            return seconds
    raise UnclearError(f"`{text[:40]}` is no number of seconds", f"it is at most {_LONGEST:.0f}, as in `advance 60`")


def _one(device: SimulatedDevice, verb: str, rest: str) -> str:
    if verb != "restart" and not rest.strip():
        raise UnclearError(f"`{verb}` needs more", "`help` says what")
    if verb == "get":
        return f"{device.unit} {rest} = {device.values[rest]}"
    if verb == "set":
        name, _, value = rest.partition("=")
        device.values[name.strip()] = value.strip()
    elif verb == "restart":
        device.restart()
    else:
        device.meet([rest], holds=verb == "met")
    return ""
