"""Plans and carries out the writes of a command, with what a person should know before."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from fieldscribe_runtime import AnyDevice
from fieldscribe_runtime.commands import carried_out_once

from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError
from fieldscribe.conversation.encoding import encode_point, require_writable
from fieldscribe.conversation.meanings import Meanings
from fieldscribe.conversation.selection import choose_point, points_by_name
from fieldscribe.diagnostics import RefusedError, UnclearError
from fieldscribe.families import family
from fieldscribe.language.numbers import NumberError, parse_integer
from fieldscribe.live.readings import Reading
from fieldscribe.model import Device, Point
from fieldscribe.text import line, shortened
from fieldscribe.wording import condition_text, label, title_text


@dataclass(frozen=True, slots=True)
class Write:
    """One write: the attribute of the device, and the raw number (None for a command).

    `text` describes it, `notes` have its rounding, `remarks` what to know before.
    """

    item: str
    raw: int | None
    keep: bool
    reading: Reading
    text: str
    notes: tuple[str, ...]
    remarks: tuple[str, ...]
    arguments: Mapping[str, int] = field(default_factory=dict)
    is_lost: bool = False
    """True if it is lost at power-off, and `keep` would keep it."""

    def carry_out(self, device: AnyDevice) -> None:
        """Write it once: without an answer, it may have arrived or not. Raises FieldscribeError."""
        with carried_out_once(device):
            if self.raw is None:
                getattr(device, self.item).send(**self.arguments)
                return
            handle: Any = device.point(self.item)
            handle.write_raw(self.raw, **({"keep": True} if self.keep else {}))


def in_requests(model: Device, writes: list[Write]) -> list[list[Write]]:
    """Return the writes by request: points that must be written together go to the place of the last one."""
    names = {point.item: point.name for point in model.points}
    partners = {point.item: point.write_with for point in model.points if point.write_with}
    made: list[list[Write]] = []
    for write in writes:

        def belongs(other: Write, item: str = write.item) -> bool:
            return names.get(other.item) in partners.get(item, ()) or names.get(item) in partners.get(other.item, ())

        joined = [request for request in made if any(map(belongs, request))]
        made = [request for request in made if request not in joined]
        made.append([*(each for request in joined for each in request), write])
    return made


def carry_out(request: list[Write], device: AnyDevice) -> None:
    """Write the points of one request, once. Raises FieldscribeError."""
    if len(request) == 1:
        request[0].carry_out(device)
        return
    with carried_out_once(device):
        device._run(device._write_together_steps({write.item: write.raw for write in request}, as_raw=True))


class Planner:
    """Plans writes in order: scales and limits use the numbers of earlier planned writes.

    `keep` makes values survive power-off; with `lenient`, a point that cannot be kept is no error. `known` are the
    settings that are read already.
    """

    def __init__(
        self,
        model: Device,
        device: AnyDevice,
        *,
        keep: bool,
        lenient: bool = False,
        known: Mapping[str, int | Fraction] | None = None,
    ) -> None:
        self._model, self._device, self._keep = model, device, keep
        self._points = {point.item: point for point in model.points}
        self._commands = {command.name: command for command in model.all_commands}
        self._settings: dict[str, int | Fraction] = {**(known or {})}
        self._raws: dict[str, int | str] = {a: one[0] for a, one in model.variants.items() if len(one) == 1}
        self._lenient = lenient

    def plan(self, words: list[str]) -> list[Write]:
        """Return the writes of `POINT=VALUE` and names of commands. Nothing is written, but settings are read.

        Raises UnclearError, RefusedError, FieldscribeError.
        """
        writes = [self._of_word(word) for word in words]
        self._require_once(writes)
        self._require_partners([self._points[write.item] for write in writes if write.item in self._points])
        if self._keep:
            commands = {self._points[write.item].keeps for write in writes if write.item in self._points}
            writes += [self._command(name) for name in self._commands if name in commands]
        return writes

    def _require_once(self, writes: list[Write]) -> None:
        """Raise UnclearError if a point is given twice."""
        items = [write.item for write in writes if write.item in self._points]
        if twice := next((item for item in items if items.count(item) > 1), None):
            message = f"{label(self._points[twice])} is given twice: nothing was written"
            raise UnclearError(message, "give one value, or write twice")

    def _require_partners(self, points: list[Point]) -> None:
        """Raise UnclearError if a point is missing that must be written together with another one."""
        others = {point.name for point in self._points.values()} - {point.name for point in points}
        for point in points:
            if missing := [name for name in point.write_with if name in others]:
                given = " ".join(f"{name}=VALUE" for name in missing)
                message = f"{label(point)} is written in one request with {', '.join(missing)}"
                raise UnclearError(message, f"write {given}, too")

    def _of_word(self, word: str) -> Write:
        name, colon, arguments = word.partition(":")
        if name in self._commands and (colon or "=" not in word):
            return self._command(name, arguments)
        name, equals, value = word.partition("=")
        name = name.strip()
        if not equals:
            message = f"`{shortened(word)}` is no command of {self._model.id}, and has no value"
            raise UnclearError(message, "write POINT=VALUE")
        point = choose_point(self._model, name.removesuffix(".raw"))
        keep = self._keep and self._kept_by_request(point)
        require_writable(point)
        if not value.strip() and point.text is None:
            raise UnclearError(f"{label(point)}: the value is missing", "write POINT=VALUE")
        self._require_existence(point)
        settings = self._needed(point)
        encoded = encode_point(self._model, point, value, settings, as_raw=name.endswith(".raw"))
        self._settings[point.name] = codec.setting_of(point, encoded.raw)
        self._raws[point.name] = encoded.raw
        reading = self._reading(point, encoded.raw, settings)
        remarks = tuple(self._remarks(point, keep))
        is_lost = not self._keep and point.keeps not in (None, "yes", "no")
        return Write(point.item, encoded.raw, keep, reading, encoded.text, encoded.notes, remarks, is_lost=is_lost)

    def _reading(self, point: Point, raw: int, settings: dict[str, int | Fraction]) -> Reading:
        """Return the reading that a point will have after the write."""
        reading = reading_of(self._model, point, raw, settings)
        if not point.readable or point.scale_arguments:
            return reading
        handle: Any = self._device.point(point.item)
        return Reading(**self._device.rows({point.item: handle.decode(raw)})[0], text=reading.text)

    def _require_existence(self, point: Point) -> None:
        """Raise RefusedError if the point does not exist while its condition is false; selections are written first."""
        if point.when is None or point.selects:
            return
        for name in point.when.names:
            if name not in self._raws and name not in self._model.variants:
                self._raws[name] = self._device.point(choose_point(self._model, name).item).read_raw()
        if self._raws.keys() >= {*point.when.names} and not point.when.holds(self._raws):
            condition = condition_text(point.when, points_by_name(self._model))
            message = f"{label(point)} does not exist now: it exists only when {condition}"
            raise RefusedError("absent", message, "write what the condition needs before it, in the same call")

    def _needed(self, point: Point) -> dict[str, int | Fraction]:
        """Return the numbers of other points that a scale or limit needs."""
        for name in point.arguments:
            if name not in self._settings:
                other = choose_point(self._model, name)
                handle: Any = self._device.point(other.item)
                self._settings[name] = codec.setting_of(other, handle.read_raw())
        return {name: self._settings[name] for name in point.arguments}

    def _kept_by_request(self, point: Point) -> bool:
        """Return True if the write request itself keeps the value. Raises UnclearError if nothing keeps it."""
        is_chosen = family(self._model.family).chooses_memory and point.telegram is None
        if self._lenient and (point.keeps == "no" or (point.keeps is None and not is_chosen)):
            return False
        if point.keeps == "no":
            raise UnclearError(f"{label(point)} cannot be kept: it is lost when switched off", "leave out --keep")
        if point.keeps is None and not is_chosen:
            raise UnclearError(f"{label(point)}: the manual does not say how it is kept", "leave out --keep")
        return point.keeps in (None, "choice")

    def _remarks(self, point: Point, keep: bool) -> Iterator[str]:
        """Yield what to know before a point is written."""
        if point.when is not None and not point.selects:
            yield f"it exists only when {condition_text(point.when, points_by_name(self._model))}"
        for name, raw in point.selects:
            other = choose_point(self._model, name)
            yield f"written first if different: {label(other)} = {Meanings(self._model, other).text(raw, {})}"
        if point.conditions:
            yield f"write only when: {', '.join(point.conditions).replace('_', ' ')}"
        if keep or point.keeps == "yes":
            yield "kept when switched off: each write wears the memory"
        elif point.keeps == "no":
            yield "lost when switched off"
        elif point.keeps is not None and not self._keep:
            yield "lost when switched off, without --keep"
        if point.takes_effect is not None:
            yield f"takes effect {point.takes_effect}"
        if point.write_with:
            yield f"the device wants it in one request with {', '.join(point.write_with)}"

    def _command(self, name: str, given: str = "") -> Write:
        """Return a command, with its arguments as in `item=3,from=1`. Raises UnclearError, RefusedError."""
        command = self._commands[name]
        arguments = _arguments(name, getattr(command, "arguments", {}), given)
        wears = getattr(command, "wears", None)
        remarks = (f"the memory is rated for {wears} of these",) if wears else ()
        numbers = "".join(f", {argument} {number}" for argument, number in arguments.items())
        text = line(f"{name} ({title_text(command.title)}){numbers}")
        reading = Reading(name, None, None, "", text, None, "ok", "")
        return Write(name, None, False, reading, text, (), remarks, arguments)


def _arguments(name: str, ends: Mapping[str, tuple[int, int]], given: str) -> dict[str, int]:
    """Return the arguments of a command by name. Raises UnclearError, RefusedError."""
    pairs = [pair.partition("=") for pair in given.split(",") if pair.strip()]
    texts = {key.strip(): text for key, _, text in pairs}
    if texts.keys() != ends.keys():
        takes = f"{name}:{','.join(f'{key}=NUMBER' for key in ends)}" if ends else name
        raise UnclearError(f"the command {name} takes {', '.join(ends) or 'no arguments'}", f"write {takes}")
    numbers: dict[str, int] = {}
    for key, (low, high) in ends.items():
        try:
            numbers[key] = parse_integer(texts[key])
        except NumberError as error:
            raise UnclearError(f"{key} of {name}: {error.message}", error.hint) from error
        if not low <= numbers[key] <= high:
            raise RefusedError("out_of_range", f"{key} of {name} is {low}..{high}, not {numbers[key]}")
    return numbers


def reading_of(model: Device, point: Point, raw: int, settings: dict[str, int | Fraction]) -> Reading:
    """Return what a point holds after the write."""
    meaning = Meanings(model, point).of(raw, settings)
    text = Meanings(model, point).text(raw, settings)
    value: float | str | None = raw if meaning.value is None else meaning.value
    if meaning.value is not None and point.text is None:
        try:
            value = float(codec.decode(point, raw, settings))
        except (CodecError, OverflowError):
            value = None
    return Reading(point.name, point.code, value, point.unit.symbol, text, raw, "ok", "")
