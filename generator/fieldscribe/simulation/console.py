"""What a person may say to a running bench, one line at a time."""

from __future__ import annotations

from fieldscribe.simulation.bench import Bench
from fieldscribe.simulation.device import SimulatedDevice
from fieldscribe.simulation.faults import Fault
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


def carry_out(bench: Bench, text: str) -> str:
    """Return what to print for a line of text. Raises UnclearError, and EOFError for `quit`."""
    unit, _, words = text.strip().partition(" ") if text.strip().startswith("@") else ("", "", text.strip())
    verb, _, rest = words.strip().partition(" ")
    devices = [device for line in bench.lines for device in line.core.devices if unit in ("", f"@{device.unit}")]
    if not devices:
        raise UnclearError(f"no device has the unit `{unit[1:21]}`", "")
    try:
        if verb == "advance":
            bench.clock.advance(max(0.0, float(rest)))
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
            return HELP if verb == "help" else f"there is no `{verb[:20]}`; `help` lists what there is" * bool(verb)
    except (KeyError, ValueError) as error:
        raise UnclearError(str(error.args[0]), "") from None
    return ""


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
