"""Runs the conformance vectors of a device against its generated Python package.

    python tests/conformance.py <folder of the packages> <device> <vectors.txt>

Prints one line per kind and a total; ends with 1 if any vector failed or none passed. It uses the code as users do.
"""

from __future__ import annotations

import functools
import importlib
import math
import operator
import struct
import sys
from collections import Counter
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vector_file import File, Vector

if TYPE_CHECKING:
    from collections.abc import Callable


class Script:
    """A transport of every family that expects what is sent and answers as it was told; `needs` in any order."""

    def __init__(self, vector: Vector, frame: Callable[[int, bytes], Any]) -> None:
        self.framing = vector["framing"]
        self._steps = list(vector["script"])
        self._needs = dict(vector["needs"])
        self._frame = frame
        self._came: list[bytes] = []

    def exchange(self, request: bytes) -> bytes:
        """One request and its reply."""
        if request in self._needs:
            return bytes(self._needs[request])
        sent, received = self._steps.pop(0)
        if sent != request:
            raise AssertionError(f"sent {request.hex()}, not {sent.hex()}")
        return bytes(received)

    def send(self, frame: Any) -> None:
        """One frame to the bus; what answers it comes next."""
        self._came.append(self.exchange(frame.id.to_bytes(4, "big") + frame.data))

    def receive(self) -> Any:
        """The next frame from the bus."""
        data = self._came.pop(0) if self._came else b""
        if not data:
            raise TimeoutError
        return self._frame(int.from_bytes(data[:4], "big"), data[4:])

    def receive_waiting(self) -> Any:
        """What is there already."""
        return self.receive() if self._came and self._came[0] else None

    @property
    def done(self) -> bool:
        """Whether all was sent that should be."""
        return not self._steps


class AsyncScript(Script):
    """The same for devices that wait with `await`; it never lets anything else run."""

    async def exchange(self, request: bytes) -> bytes:  # type: ignore[override]  # as the async transports are
        """One request and its reply."""
        return super().exchange(request)

    async def send(self, frame: Any) -> None:  # type: ignore[override]  # as the async transports are
        """One frame to the bus; what answers it comes next."""
        self._came.append(super().exchange(frame.id.to_bytes(4, "big") + frame.data))

    async def receive(self) -> Any:
        """The next frame from the bus."""
        return super().receive()

    def receive_waiting(self) -> Any:
        """What is there already."""
        return super().receive() if self._came and self._came[0] else None


class Runner:
    """The generated package of one device, and a check for every kind of vector."""

    def __init__(self, folder: Path, device: str) -> None:
        sys.path.insert(0, str(folder))
        package = importlib.import_module(device)
        runtime = importlib.import_module("fieldscribe_runtime")
        self.modbus, self.can, self.uss = (
            importlib.import_module(f"fieldscribe_runtime.{family}") for family in ("modbus", "can", "uss")
        )
        self.device = next(one for one in vars(package).values() if _is_device(one, runtime.AnyDevice))
        self.awaited = next(one for one in vars(package).values() if _is_device(one, runtime.AnyAsyncDevice))
        self.reason = ""
        self.error: type[Exception] = runtime.FieldscribeError
        self.special: type = runtime.Special

    def passes(self, vector: Vector) -> bool:
        """Whether the generated code does what the vector says."""
        check: Callable[[Vector], bool] | None = getattr(self, f"_{vector['kind']}", None)
        try:
            return check is not None and check(vector)
        except Exception as error:  # whatever generated code raises, the vector has failed
            self.reason = f"{type(error).__name__}: {error}"
            return False

    def _point(self, vector: Vector) -> Any:
        return self.device.POINTS[vector["point"]]

    def _outcome(self, function: Callable[..., Any], *arguments: Any) -> tuple[str, Any]:
        """The status and result of a call, or the error; a special code as a value is the status `special`."""
        try:
            result = function(*arguments)
        except self.error as error:
            return getattr(error, "status", ""), error
        return ("special" if isinstance(result, self.special) else "ok"), result

    def _decode(self, vector: Vector) -> bool:
        status, value = self._outcome(self._point(vector).decode, vector["raw"], _with(vector))
        if status == "special":
            return bool(vector["status"] == status and str(value) == vector["special"] and value.raw == vector["raw"])
        return status == vector["status"] and (status != "ok" or _pattern(value) == _pattern(vector["value"]))

    def _encode(self, vector: Vector) -> bool:
        status, raw = self._outcome(self._point(vector).encode, vector["value"], _with(vector))
        return status == vector["status"] and (status != "ok" or raw == vector["raw"])

    def _decode_count(self, vector: Vector) -> bool:
        point, raw, raws = self._point(vector), vector["raw"], _with(vector)
        status, count = self._outcome(point.decode_count, raw, raws)
        if status == "special":
            named = count.special == vector["special"] == str(point.decode(raw, raws))
            return bool(vector["status"] == status and named)
        return bool(status == vector["status"] and (status != "ok" or count == vector["count"]))

    def _encode_count(self, vector: Vector) -> bool:
        point, count, raws = self._point(vector), vector["count"], _with(vector)
        status, raw = self._outcome(point.encode_count, count, raws)
        return status == vector["status"] and (status != "ok" or raw == vector["raw"])

    def _check(self, vector: Vector) -> bool:
        status, _ = self._outcome(self._point(vector).check, vector["raw"], _with(vector))
        return bool(status == vector["status"])

    def _name(self, vector: Vector) -> bool:
        point, number = self._point(vector), vector["raw"]
        if isinstance(point.decode(number) if hasattr(point, "decode") else None, tuple):
            member = point.decode(number)[-1]
            return bool((member.name.lower() if isinstance(member, Enum) else None) == vector["name"])
        return bool(point.name_of(number) == vector["name"])

    def _special(self, vector: Vector) -> bool:
        codes = self._point(vector).special
        names = [str(codes(vector[end])) for end in ("low", "high")]
        return vector["special"] in list(codes) and names == [vector["special"]] * 2

    def _special_name(self, vector: Vector) -> bool:
        code = self._point(vector).special(vector["raw"])
        found = (None, None) if code is None else (str(code), int(code.no_value))
        return found == (vector["name"], vector["no_value"])

    def _flag(self, vector: Vector) -> bool:
        word = self._point(vector).names
        flag: Any = getattr(word, vector["flag"], None)
        if not hasattr(flag, "number"):
            flag = getattr(word, f"{vector['flag']}_")  # the plain name is a keyword or one of int's own
        bits = word[vector["flag"].upper()] if vector["flag"].upper() in word.__members__ else None
        held = bits is None or bool(int(bits) & vector["raw"]) == bool(vector["number"])
        if hasattr(word, "of"):
            held = held and self._made(vector, word, flag)
        if vector["truth"] is not None:
            stated = flag.__get__(word(vector["raw"]), word)
            held = held and int(stated) == vector["truth"]
        return bool(held and flag.number(vector["raw"]) == vector["number"])

    def _flag_name(self, vector: Vector) -> bool:
        word = self._point(vector).names
        flag: Any = getattr(word, vector["flag"], None) or getattr(word, f"{vector['flag']}_")
        return bool(flag.names(vector["raw"]).name.lower() == vector["name"])

    def _made(self, vector: Vector, word: Any, flag: Any) -> bool:
        """Whether a word made of this flag alone says so, and one made of nothing has only constant bits beside."""
        mask, constant = self._point(vector).facts.fixed or (0, 0)
        named = functools.reduce(operator.or_, map(int, word.__members__.values()), 0)
        nothing = int(word.of())
        if nothing & ~named != constant & ~named:
            return False
        names = [name for name in word.of.__annotations__ if name in {vector["flag"], f"{vector['flag']}_"}]
        if not names or vector["raw"] & mask != constant:
            return nothing & mask == constant  # a constant bit is not chosen
        state = vector["number"] if vector["truth"] is None else bool(vector["truth"])
        stated = flag.__get__(word(nothing), word)
        made = int(word.of(**{names[0]: state}))
        return bool(not (stated and not mask) and flag.number(made) == vector["number"])

    def _bits(self, vector: Vector) -> bool:
        point, word = self._point(vector), vector["word"]
        replaced = point.insert(word, vector["replaced"])
        return bool(point.extract(word) == vector["raw"] and replaced == vector["result"])

    def _words(self, vector: Vector) -> bool:
        point = self._point(vector)
        words = tuple(vector["words"])
        return bool(point.from_words(words) == vector["raw"] and point.to_words(vector["raw"]) == words)

    def _address(self, vector: Vector) -> bool:
        point = self._point(vector)
        at = point.facts.at
        found = {"point": point.facts.item, "code": point.facts.code}
        found |= {"space": at.space, "address": at.address, "words": point.size}
        if vector["raw_min"] is not None:
            found["raw_min"], found["raw_max"] = point.raw_limits
        references = {key: str(number) for key, number in point.facts.references.items()}
        found |= {"decimals": point.decimals or None, "references": references}
        return all((vector[key] or None) == (value or None) for key, value in found.items())

    def _place(self, vector: Vector) -> bool:
        at = self._point(vector).facts.at
        return (list(at.addresses), at.index, at.telegram) == (
            vector["addresses"],
            vector["index"],
            vector["telegram"],
        )

    def _fixed(self, vector: Vector) -> bool:
        return bool(self._point(vector).facts.fixed == (vector["mask"], vector["bits"]))

    def _text_decode(self, vector: Vector) -> bool:
        point = self._point(vector)
        by_address = dict(zip(point.facts.at.addresses, vector["words"], strict=True))
        raw = point.from_words([by_address[address] for address in sorted(by_address)])
        return bool(point.decode(raw).encode("latin-1") == vector["text"])

    def _text_encode(self, vector: Vector) -> bool:
        point = self._point(vector)
        status, raw = self._outcome(point.encode, vector["text"].decode("latin-1"))
        if status != "ok":
            return bool(status == vector["status"] and vector["words"] == [])
        at = point.facts.write_at or point.facts.at
        by_address = dict(zip(sorted(at.addresses), point.to_words(raw), strict=True))
        words = [by_address[address] for address in at.addresses]
        return bool(status == vector["status"] and words == vector["words"])

    def _digits(self, vector: Vector) -> bool:
        status, found = self._outcome(self._point(vector).decode, vector["raw"])
        if status == "special":
            return bool(vector["status"] == status and str(found) == vector["special"])
        return bool(status == vector["status"] and list(found) == vector["digits"])

    def _digits_encode(self, vector: Vector) -> bool:
        status, raw = self._outcome(self._point(vector).encode, tuple(vector["digits"]))
        return bool(status == vector["status"] and (status != "ok" or raw == vector["raw"]))

    def _handles(self, vector: Vector) -> list[tuple[Script, Any]]:
        """The point of a device over a script, blocking and with `await`."""
        point = self._point(vector)
        given = dict(one for one in (point.facts.variant, _only(point.facts.only_for)) if one)
        link = (self._uss_link(vector),) if "pkw" in vector else ()
        found = []
        for kind, script in ((self.device, Script), (self.awaited, AsyncScript)):
            transport = script(vector, self.can.Frame)
            device = kind(transport, vector["unit"], *link, **given)
            found.append((transport, kind.POINTS[vector["point"]].__get__(device, kind)))
        return found

    def _read(self, vector: Vector) -> bool:
        point, raws = self._point(vector), _with(vector)
        raw = _raw_of(point, vector)
        value = point.decode(raw, raws) if vector["status"] == "ok" else None
        calls: tuple[tuple[str, Any], ...] = (("read_raw", raw), ("read", value))
        return all(
            _same(self._ran(script, vector, getattr(handle, name)), expected)
            for name, expected in calls
            for script, handle in self._handles(vector)
        )

    def _ran(self, script: Script, vector: Vector, function: Callable[..., Any], *arguments: Any, **more: Any) -> Any:
        """The result of an operation that has the status of the vector, and sent all that it should."""
        status, result = self._outcome(lambda: _now(function(*arguments, **more)))
        if status != vector["status"] or not script.done:
            raise AssertionError(f"{status} instead of {vector['status']}: {result}")
        return result if status == "ok" else None

    def _write(self, vector: Vector, **more: Any) -> bool:
        point = self._point(vector)
        raw = _raw_of(point, vector)
        for script, handle in self._handles(vector):
            self._ran(script, vector, handle.write_raw, raw, **more)
        if hasattr(point, "decode") and getattr(point._form, "encodes", True):
            value = point.decode(raw, _with(vector))
            if self._outcome(point.encode, value, _with(vector))[0] == "wrong_type":
                return True  # a number of too many bits for a value is written raw alone
            for script, handle in self._handles(vector):
                self._ran(script, vector, handle.write, value, **more)
        return True

    def _store(self, vector: Vector) -> bool:
        return self._write(vector, keep=True)

    def _block(self, vector: Vector) -> bool:
        block = self.device.BLOCKS[vector["group"]][vector["index"]]
        found = {"space": block.space, "function": block.function, "address": block.address, "count": block.count}
        return all(vector[key] == value for key, value in found.items())

    def _facts(self, vector: Vector) -> bool:
        facts = self._point(vector).facts
        found = {"group": facts.group, "name": facts.name, "symbol": facts.unit or None, "default": facts.default}
        found |= {"changes": facts.changes, "changes_with": list(facts.changes_with)}
        found["variant"] = "=".join(facts.variant) if facts.variant else None
        apart = facts.write_at
        found |= {"write_space": apart and apart.space, "write_addresses": list(apart.addresses) if apart else []}
        return all(vector[key] == value for key, value in found.items())

    def _documented(self, vector: Vector) -> bool:
        names = {name: one.at for name, one in self.device.DOCUMENTED.items() if name.rstrip("_") == vector["name"]}
        [at] = names.values()
        found = at.space, at.address, len(at.addresses), at.index
        return found == tuple(vector[key] for key in ("space", "address", "words", "index"))

    def _group(self, vector: Vector) -> bool:
        members = [one for one in self.device.POINTS.values() if one.facts.group == vector["group"]]
        read = [one.facts.at for one in members if hasattr(one, "decode") and one.facts.at.space == "parameter"]
        return bool(list(dict.fromkeys(address for at in read for address in at.addresses)) == vector["addresses"])

    def _can_taken(self, vector: Vector) -> bool:
        receiver = self.can.Receiver(self.device.PROFILE, vector["telegram"], vector["unit"])
        return bool([int(receiver.take(self._can_frame(*frame))) for frame in vector["frames"]] == vector["taken"])

    def _code(self, vector: Vector) -> bool:
        names = getattr(self.device.PROFILE, "exceptions" if vector["what"] == "exception" else "errors")
        return bool(names[vector["number"]] == vector["name"])

    def _command(self, vector: Vector) -> bool:
        for kind, script in ((self.device, Script), (self.awaited, AsyncScript)):
            transport = script({**vector, "needs": {}}, self.can.Frame)
            name = next(one for one in _names_of_command(vector["command"]) if one in attributes(kind))
            handle = getattr(kind(transport, vector["unit"]), name)
            self._ran(transport, vector, handle.send)
        return True

    def _request(self, vector: Vector) -> Any:
        head = vector["unit"], vector["function"], vector["address"]
        return self.modbus.Request(*head, vector["count"], tuple(vector["values"]))

    def _build(self, vector: Vector) -> bool:
        arguments = self.device.PROFILE, vector["framing"], vector["transaction"]
        status, frame = self._outcome(self.modbus.build, self._request(vector), *arguments)
        return status == vector["status"] and (status != "ok" or frame == vector["bytes"])

    def _reply(self, vector: Vector) -> bool:
        arguments = self.device.PROFILE, vector["framing"], vector["transaction"]
        status, result = self._outcome(self.modbus.parse, self._request(vector), vector["bytes"], *arguments)
        if status != vector["status"]:
            return False
        if status == "exception":
            return bool(result.code == vector["exception"])
        return status != "ok" or result == tuple(vector["values_out"])

    _printed_build = _build
    _printed_reply = _reply

    def _can_build(self, vector: Vector) -> bool:
        profile = self.device.PROFILE
        arguments = profile.message(vector["message"]), profile, vector["unit"], vector["address"], vector["raw"]
        status, frame = self._outcome(self.can.build, *arguments)
        sent = (frame.id, frame.data) if status == "ok" else ()
        return bool(status == vector["status"] and (not sent or sent == (vector["id"], vector["bytes"])))

    def _can_frame(self, number: int, data: bytes) -> Any:
        return self.can.Frame(number, data)

    def _can_parse(self, vector: Vector) -> bool:
        frame = self._can_frame(vector["id"], vector["bytes"])
        message = self.device.PROFILE.message(vector["message"])
        status, found = self._outcome(self.can.parse, message, vector["unit"], frame)
        return bool(status == vector["status"] and (status != "ok" or found == (vector["address"], vector["raw"])))

    def _can_telegram(self, vector: Vector) -> bool:
        receiver = self.can.Receiver(self.device.PROFILE, vector["telegram"], vector["unit"])
        taken = [int(receiver.take(self._can_frame(*frame))) for frame in vector["frames"]]
        point = self._point(vector)
        addresses = point.facts.at.addresses
        status, words = self._outcome(receiver.words, addresses)
        if status != vector["status"] or taken != vector["taken"] or point.facts.at.telegram != vector["telegram"]:
            return False
        by_address = dict(zip(addresses, words, strict=True)) if status == "ok" else {}
        return status != "ok" or point.from_words([by_address[one] for one in sorted(by_address)]) == vector["raw"]

    def _uss_link(self, vector: Vector) -> Any:
        return self.uss.Link(vector["pkw"], vector["pzd"], bool(vector["single_first"]))

    def _uss_request(self, vector: Vector, **rest: Any) -> Any:
        return self.uss.Request(vector["unit"], vector["task"], vector["parameter"], vector["index"], **rest)

    def _uss_build(self, vector: Vector) -> bool:
        rest = {"width": vector["width"], "value": vector["value"], "words": tuple(vector["words"])}
        arguments = self._uss_request(vector, **rest), self.device.PROFILE, self._uss_link(vector)
        status, data = self._outcome(self.uss.build, *arguments)
        return status == vector["status"] and (status != "ok" or data == vector["bytes"])

    def _uss_broadcast(self, vector: Vector) -> bool:
        arguments = tuple(vector["mask"]), tuple(vector["words"]), self.device.PROFILE, self._uss_link(vector)
        status, data = self._outcome(self.uss.broadcast, *arguments)
        return status == vector["status"] and (status != "ok" or data == vector["bytes"])

    def _uss_reply(self, vector: Vector) -> bool:
        arguments = vector["bytes"], self.device.PROFILE, self._uss_link(vector)
        status, found = self._outcome(self.uss.parse, self._uss_request(vector), *arguments)
        if status == "refused":
            return bool(vector["status"] == status and vector["response"] == 7 and found.code == vector["error"])
        good = (found.response, found.width, found.value, 0, list(found.words)) if status == "ok" else ()
        expected = tuple(vector[key] for key in ("response", "width", "value", "error", "words")) if good else ()
        return bool(status == vector["status"] and good == expected)

    _uss_printed_build = _uss_build
    _uss_printed_reply = _uss_reply


def _is_device(candidate: object, base: type) -> bool:
    return isinstance(candidate, type) and issubclass(candidate, base)


def _with(vector: Vector) -> dict[str, int]:
    return {name: int(raw) for name, raw in vector.get("with", {}).items()}


def _only(only_for: Any) -> tuple[str, Any] | None:
    """One of the values of an axis for which a point exists."""
    return (only_for[0], only_for[1][0]) if only_for else None


def _names_of_command(name: str) -> tuple[str, ...]:
    """What a command may be called: a point has the plain name where both have the same, a keyword gets an underscore."""
    return f"{name}_command", name, f"{name}_"


def attributes(kind: type) -> dict[str, Any]:
    """What a class has, with what it is made of, as it stands there."""
    return {name: one for base in reversed(kind.__mro__) for name, one in vars(base).items()}


def _now(result: Any) -> Any:
    """A result, also of a coroutine that never really waits."""
    if not hasattr(result, "send"):
        return result
    try:
        result.send(None)
    except StopIteration as done:
        return done.value
    raise AssertionError("it waits for something else than its transport")


def _same(one: Any, other: Any) -> bool:
    return bool(one == other or (isinstance(one, float) and math.isnan(one) and math.isnan(other)))


def _raw_of(point: Any, vector: Vector) -> Any:
    """The raw number of a vector, also of one that gives its words."""
    return point.from_words(vector["words"]) if vector["words"] else vector["raw"]


def _pattern(value: float) -> str:
    """The bits of a number; all that are no number count as one."""
    return struct.pack(">d", value).hex() if not math.isnan(value) else "nan"


def run(folder: Path, device: str, vectors: Path, show: int = 0) -> tuple[Counter[str], Counter[str], list[Vector]]:
    """How many vectors of each kind passed and failed, and the first `show` that failed."""
    runner = Runner(folder, device)
    passed: Counter[str] = Counter()
    failed: Counter[str] = Counter()
    shown: list[Vector] = []
    file = File(vectors.read_text(encoding="utf-8"))
    for vector in file:
        if vector["kind"] not in file.counts:
            continue  # Python has no such thing
        runner.reason = ""
        good = runner.passes(vector)
        (passed if good else failed)[vector["kind"]] += 1
        if not good and len(shown) < show:
            shown.append({**vector, "reason": runner.reason})
    if file.counts != dict(passed + failed):
        shown.append({"kind": "other counts than the file says"})
        failed["incomplete"] += 1
    return passed, failed, shown


def main(arguments: list[str]) -> int:
    """The command line."""
    if len(arguments) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    passed, failed, shown = run(Path(arguments[0]), arguments[1], Path(arguments[2]), show=20)
    for vector in shown:
        print(vector, file=sys.stderr)
    for kind in dict.fromkeys((*passed, *failed)):
        print(f"{kind} {passed[kind]} passed, {failed[kind]} failed")
    print(f"total {passed.total()} passed, {failed.total()} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
