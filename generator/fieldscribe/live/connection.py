"""Opens a line, and makes devices of the Python runtime on it from the model."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.live.devices import device_class
from fieldscribe.live.lines import LineAddress, OpenLine, families_of, require_line
from fieldscribe.model import Device
from fieldscribe.resources import use_python_runtime
from fieldscribe.targets.python.identifiers import parameter
from fieldscribe.user_errors import UnclearError

use_python_runtime()

if TYPE_CHECKING:
    from fieldscribe_runtime import AnyDevice, FieldscribeError


class Connection:
    """A line that devices are on. It opens when it is used first."""

    def __init__(self, line: LineAddress, timeout: float | None) -> None:
        """Raises UnclearError for a line that cannot be opened."""
        from fieldscribe_runtime import FieldscribeError

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
        """Return the ends of the unit numbers that such a line may have. Raises UnclearError if that depends."""
        if not hasattr(self._part, "any_device"):
            raise UnclearError(f"on {self.line.scheme}:// nothing can be asked without a description", "give DEVICE")
        ends: tuple[int, int] = self._part.UNITS
        return ends

    def any_device(self, unit: int) -> AnyDevice:
        """Return a device of which nothing is known but its unit."""
        made: AnyDevice = self._part.any_device(self._open, unit)
        return made

    def probe(self, device: AnyDevice) -> str:
        """Ask such a device for something that is only read; return what came. Raises FieldscribeError."""
        text: str = self._part.probe(device)
        return text

    def device(self, model: Device, unit: int, retries: int = 0) -> AnyDevice:
        """Return a device of the runtime on this line. Raises UnclearError for what the line or the device cannot."""
        from fieldscribe_runtime import FieldscribeError

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
        """Give the line back."""
        self._open.transport.close()


_SETTINGS = {"bad_unit": "give --unit", "bad_framing": "take another kind of line"}


def advice(error: FieldscribeError) -> str:
    """Return what to look at after an error of the line; empty for what the device itself refused."""
    if not error.lost:
        return ""
    if error.status == "line":
        return "is the line right, is the device on, and does no other program use the port?"
    return "are the unit and the settings of the line right? `fieldscribe scan` shows who answers"
