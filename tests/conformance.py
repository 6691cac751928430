"""Runs the conformance vectors of a device against its generated Python package.

    python tests/conformance.py <folder of the packages> <device> <vectors.txt>

Prints one line per kind and a total; ends with 1 if any vector failed or none passed. It uses the code as users do.
"""

from __future__ import annotations

import importlib
import struct
import sys
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vector_file import File, Vector

if TYPE_CHECKING:
    from collections.abc import Callable


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
        self.error: type[Exception] = runtime.FieldscribeError

    def passes(self, vector: Vector) -> bool:
        """Whether the generated code does what the vector says."""
        check: Callable[[Vector], bool] | None = getattr(self, f"_{vector['kind']}", None)
        try:
            return check is not None and check(vector)
        except Exception:  # whatever generated code raises, the vector has failed
            return False

    def _point(self, vector: Vector) -> Any:
        return self.device.POINTS[vector["point"]]

    def _outcome(self, function: Callable[..., Any], *arguments: Any) -> tuple[str, Any]:
        """The status and result of a call; None as a value is the status `no_value`."""
        try:
            result = function(*arguments)
        except self.error as error:
            return getattr(error, "status", ""), error
        return "ok", result

    def _decode(self, vector: Vector) -> bool:
        status, value = self._outcome(self._point(vector).decode, vector["raw"], _with(vector))
        if status == "ok" and value is None:
            status = "no_value"
        return status == vector["status"] and (status != "ok" or _pattern(value) == _pattern(vector["value"]))

    def _encode(self, vector: Vector) -> bool:
        status, raw = self._outcome(self._point(vector).encode, vector["value"], _with(vector))
        return status == vector["status"] and (status != "ok" or raw == vector["raw"])

    def _decode_count(self, vector: Vector) -> bool:
        point, raw, raws = self._point(vector), vector["raw"], _with(vector)
        status, count = self._outcome(point.decode_count, raw, raws)
        return bool(status == vector["status"] and (status != "ok" or count == vector["count"]))

    def _encode_count(self, vector: Vector) -> bool:
        point, count, raws = self._point(vector), vector["count"], _with(vector)
        status, raw = self._outcome(point.encode_count, count, raws)
        return status == vector["status"] and (status != "ok" or raw == vector["raw"])

    def _check(self, vector: Vector) -> bool:
        status, _ = self._outcome(self._point(vector).check, vector["raw"], _with(vector))
        return bool(status == vector["status"])

    def _name(self, vector: Vector) -> bool:
        return bool(self._point(vector).name_of(vector["raw"]) == vector["name"])

    def _special(self, vector: Vector) -> bool:
        return bool(self._point(vector).specials.get(vector["special"]) == (vector["low"], vector["high"]))

    def _flag(self, vector: Vector) -> bool:
        word = self._point(vector).names
        flag: Any = getattr(word, vector["flag"], None)
        if not hasattr(flag, "number"):
            flag = getattr(word, f"{vector['flag']}_")  # the plain name is a keyword or one of int's own
        return bool(flag.number(vector["raw"]) == vector["number"])

    def _flag_name(self, vector: Vector) -> bool:
        word = self._point(vector).names
        flag: Any = getattr(word, vector["flag"], None) or getattr(word, f"{vector['flag']}_")
        return bool(flag.names(vector["raw"]).name.lower() == vector["name"])

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
        return bool(list(self._point(vector).decode(vector["raw"])) == vector["digits"])

    def _digits_encode(self, vector: Vector) -> bool:
        status, raw = self._outcome(self._point(vector).encode, tuple(vector["digits"]))
        return bool(status == vector["status"] and (status != "ok" or raw == vector["raw"]))

    def _block(self, vector: Vector) -> bool:
        block = self.device.BLOCKS[vector["group"]][vector["index"]]
        found = {"space": block.space, "function": block.function, "address": block.address, "count": block.count}
        return all(vector[key] == value for key, value in found.items())

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


def _pattern(value: float) -> str:
    return struct.pack(">d", value).hex()


def run(folder: Path, device: str, vectors: Path, show: int = 0) -> tuple[Counter[str], Counter[str], list[Vector]]:
    """How many vectors of each kind passed and failed, and the first `show` that failed."""
    runner = Runner(folder, device)
    passed: Counter[str] = Counter()
    failed: Counter[str] = Counter()
    shown: list[Vector] = []
    file = File(vectors.read_text(encoding="utf-8"))
    for vector in file:
        good = runner.passes(vector)
        (passed if good else failed)[vector["kind"]] += 1
        if not good and len(shown) < show:
            shown.append(vector)
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
