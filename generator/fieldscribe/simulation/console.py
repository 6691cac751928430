"""What a person may say to a running bench, one line at a time."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from fieldscribe.simulation.clock import Clock
from fieldscribe.simulation.device import SimulatedDevice
from fieldscribe.simulation.faults import Fault
from fieldscribe.simulation.line import Line
from fieldscribe.user_errors import UnclearError

HELP = """\
get POINT           the value that a device holds
set POINT=VALUE     let it hold another one, whatever its rules say
unmet CONDITION     refuse the writes that need a condition; `met CONDITION` ends that
fault KIND ...      spoil answers: `fault late 0.5 x3`, `fault cut 4 10%`; `clear` ends all faults
restart             switch the devices off and on: what was not stored is lost
advance SECONDS     let time pass at once
quit                end
behind @UNIT, as in `@3 get A020`, a line is about that unit alone"""


class Console:
    """Carries out lines of text on the devices of a bench."""

    def __init__(self, lines: Sequence[Line], clock: Clock) -> None:
        self._lines, self._clock = lines, clock

    def said(self, text: str) -> str:
        """Return what to print for a line. Raises UnclearError, and EOFError for `quit`."""
        words = text.strip()
        devices = [device for line in self._lines for device in line.core.devices]
        if words.startswith("@"):
            unit, _, words = words[1:].partition(" ")
            devices = [device for device in devices if str(device.unit) == unit]
            if not devices:
                raise UnclearError(f"no device has the unit `{unit[:20]}`", "")
        verb, _, rest = words.partition(" ")
        rest = rest.strip()
        if verb in ("fault", "clear"):
            for line in self._lines:
                line.faults.clear() if verb == "clear" else line.faults.add(Fault.of(rest))
            return ""
        if verb == "advance":
            return self._advance(rest)
        if verb == "quit":
            raise EOFError
        does = _VERBS.get(verb)
        if does is None:
            return (
                HELP if verb == "help" else "" if not verb else f"there is no `{verb[:20]}`; `help` lists what there is"
            )
        try:
            answers = [does(device, rest) for device in devices]
        except (KeyError, ValueError) as error:
            raise UnclearError(str(error.args[0]), "") from None
        return "\n".join(filter(None, answers))

    def _advance(self, text: str) -> str:
        try:
            self._clock.advance(max(0.0, float(text)))
        except ValueError:
            raise UnclearError(f"`{text[:20]}` is no number of seconds", "") from None
        return ""


def _get(device: SimulatedDevice, name: str) -> str:
    return f"{device.unit} {name} = {device.values[name]}"


def _set(device: SimulatedDevice, pair: str) -> str:
    name, equals, value = pair.partition("=")
    if not equals:
        raise ValueError("write set POINT=VALUE")
    device.values[name.strip()] = value.strip()
    return ""


def _restart(device: SimulatedDevice, _rest: str) -> str:
    device.restart()
    return ""


def _meets(holds: bool) -> Callable[[SimulatedDevice, str], str]:
    def change(device: SimulatedDevice, name: str) -> str:
        if name not in device.conditions:
            raise ValueError(
                f"there is no condition `{name[:40]}`: {', '.join(device.conditions) or 'no write asks for one'}"
            )
        device.conditions[name] = holds
        return ""

    return change


_VERBS = {"get": _get, "set": _set, "restart": _restart, "unmet": _meets(False), "met": _meets(True)}
