"""Opens a line, makes runtime devices on it from the model, and scans for units that answer."""

from collections.abc import Iterator
from typing import NamedTuple

from fieldscribe_runtime import AnyDevice, FieldscribeError, LineError, NoReplyError, OtherDeviceError, RequestError

from fieldscribe.live.devices import device_class
from fieldscribe.live.lines import LineAddress, OpenLine, families_of, require_line
from fieldscribe.live.readings import GOOD, Choice, Reader
from fieldscribe.model import Device
from fieldscribe.targets.python.identifiers import parameter
from fieldscribe.text import shortened
from fieldscribe.user_errors import UnclearError

__all__ = ["Answer", "AnyDevice", "Connection", "FieldscribeError", "Scanner", "advice", "read_units"]


class Connection:
    """A line with devices. It opens when it is first used."""

    def __init__(self, line: LineAddress, timeout: float | None) -> None:
        """Raises UnclearError for a line that cannot be opened."""
        self.line = line
        self._part = families_of(line)[0].part("lines")
        try:
            transport = self._part.open_line(line, {} if timeout is None else {"timeout": timeout})
        except FieldscribeError as error:
            raise line.wrong(str(error)) from error
        except ModuleNotFoundError as error:
            raise UnclearError(f"{line.scheme}://: {error}", "pip install 'fieldscribe[live]'") from error
        self._open = OpenLine(line, transport, timeout)
        self._classes: dict[str, type[AnyDevice]] = {}

    @property
    def usual_units(self) -> tuple[int, int]:
        """Return the lowest and highest unit number of the line. Raises UnclearError if that needs a description."""
        if not hasattr(self._part, "any_device"):
            raise UnclearError(f"on {self.line.scheme}:// nothing can be asked without a description", "give DEVICE")
        ends: tuple[int, int] = self._part.UNITS
        return ends

    def any_device(self, unit: int) -> AnyDevice:
        """Return a device without a description, with just a unit."""
        made: AnyDevice = self._part.any_device(self._open, unit)
        return made

    def probe(self, device: AnyDevice) -> str:
        """Send a harmless read to a device without a description; return the answer. Raises FieldscribeError."""
        text: str = self._part.probe(device)
        return text

    def device(self, model: Device, unit: int, retries: int = 0) -> AnyDevice:
        """Return a runtime device on this line. Raises UnclearError if line and device do not fit."""
        require_line(self.line, model)
        if model.id not in self._classes:
            self._classes[model.id] = device_class(model)
        chosen = {parameter(axis): values[0] for axis, values in model.variants.items() if len(values) == 1}
        try:
            made: AnyDevice = self._part.device_on(self._open, self._classes[model.id], model, unit, chosen)
            made.retries = retries
        except FieldscribeError as error:
            raise UnclearError(f"{model.id}: {error}", _SETTINGS.get(error.status, "")) from error
        return made

    def close(self) -> None:
        """Close the line."""
        self._open.transport.close()


_SETTINGS = {"bad_unit": "give --unit", "bad_framing": "take another kind of line"}


def advice(error: FieldscribeError) -> str:
    """Return a hint after an error of the line; empty if the device refused."""
    if not error.lost:
        return ""
    if error.status == "line":
        return "is the line right, is the device on, and does no other program use the port?"
    return "are the unit and the settings of the line right? `fieldscribe scan` shows who answers"


class Answer(NamedTuple):
    """The answer of a unit, if any: `answers`, `is_other` (another device than the one looked for).

    `is_of_another`: the answer was from another unit.
    """

    unit: int
    answers: bool
    text: str = ""
    is_other: bool = False
    is_of_another: bool = False


def read_units(text: str | None, ends: tuple[int, int]) -> list[int]:
    """Return the unit numbers of a list such as `1-31,40`; all of a device without a list. Raises UnclearError."""
    units: dict[int, None] = {}
    for part in (text or f"{ends[0]}-{ends[1]}").split(","):
        low, dash, high = part.strip().partition("-")
        numbers = [low, high if dash else low]
        if not all(number.isascii() and number.isdigit() and len(number) < 6 for number in numbers):
            raise UnclearError(f"`{shortened(part)}` is no unit", "write --units 1-31,40")
        first, last = map(int, numbers)
        if not ends[0] <= first <= last <= ends[1]:
            raise UnclearError(f"units are {ends[0]} to {ends[1]}, not `{shortened(part)}`", "write --units 1-31,40")
        units.update(dict.fromkeys(range(first, last + 1)))
    return list(units)


class Scanner:
    """Sends a harmless read to the units of a line, one after the other."""

    def __init__(self, connection: Connection, model: Device | None) -> None:
        """Raises UnclearError if the line needs a description."""
        self._connection, self._model = connection, model
        self.requests = 0
        self.ends = connection.usual_units if model is None else model.bus.units
        self._points = [] if model is None else _harmless_points(model)

    def answers(self, units: list[int]) -> Iterator[Answer]:
        """Yield the answer of each unit; a unit whose answer came late is asked once more.

        Raises FieldscribeError if the line itself fails.
        """
        silent: int | None = None
        for unit in units:
            answer = self._answer(unit)
            if answer.is_of_another and silent is not None:
                again = self._answer(silent)
                yield again if again.answers else Answer(silent, True, "it answers late: try a longer --timeout")
                answer = self._answer(unit)
            yield answer
            silent = None if answer.answers else unit

    def _answer(self, unit: int) -> Answer:
        device = self._connection.device(self._model, unit) if self._model else self._connection.any_device(unit)
        try:
            return Answer(unit, True, self._asked(device))
        except OtherDeviceError as error:
            return Answer(unit, True, f"another device: {error}", True)
        except (LineError, RequestError):
            raise
        except NoReplyError:
            return Answer(unit, False)
        except FieldscribeError as error:
            is_late = error.status == "wrong_unit"
            return Answer(unit, not error.lost or bool(error.received), _remark(error), is_of_another=is_late)
        finally:
            self.requests += device.traffic.requests

    def _asked(self, device: AnyDevice) -> str:
        if self._model is None:
            return self._connection.probe(device)
        found = device.identify() if self._model.identifications else {}
        name = self._model.id if self._model.identifications else ""
        variants = [f"{axis}={value}" for axis, value in found.items()]
        readings = Reader(self._model, device).read(Choice(self._points, frozenset())) if not name else []
        for reading in readings:
            if reading.status not in GOOD:
                return f"{reading.label}: {reading.text}"
        return ", ".join([*filter(None, [name]), *variants, *(f"{one.label} = {one.text}" for one in readings)])


def _remark(error: FieldscribeError) -> str:
    """Return the text for an invalid answer."""
    if error.lost:
        return f"an answer that is damaged: {error}; two units of one number, or other settings of the line?"
    return str(error)


def _harmless_points(model: Device) -> list[str]:
    """Return the point to read from each unit: the first that needs no other, a read-only one if possible."""
    readable = [point for point in model.points if point.readable and point.generated and point.base is None]
    alone = [point for point in readable if point.telegram is None and not point.arguments and not point.variant]
    simple = [point for point in alone if not point.flags] or alone
    only_read = [point for point in simple if not point.writable]
    return [point.item for point in (only_read or simple or readable)[:1]]
