"""The facts under `bus`, `commands` and the groups' frames: what the family's frames need to know of the device."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fieldscribe.language.nodes import Map, Seq
from fieldscribe.model import Bus, Code, Command
from fieldscribe.resolve.drafts import humanised
from fieldscribe.resolve.scope import Scope, source_of, titles
from fieldscribe.resolve.values import integer, interval

NO_BUS = Bus((), (0, 0), None, (), (), {}, None, {}, {}, {})


def bus_of(scope: Scope) -> Bus:
    """The bus of the device; a finding when no file or two files say `bus`."""
    found = [file for file in scope.files if "bus" in file]
    if not found:
        scope.report.error(
            "missing-key",
            "no file of the device says `bus`",
            scope.header.span(),
            "add `bus:` with framings, units and functions",
        )
        return NO_BUS
    for second in found[1:]:
        scope.report.error(
            "duplicate-name",
            "`bus` is said twice",
            second.key_span("bus"),
            "write it once",
            [(found[0].key_span("bus"), "first here")],
        )
    raw: Map = found[0]["bus"]
    units = interval(raw["units"], raw.span("units"), scope.report)
    return Bus(
        framings=tuple(raw["framings"]),
        units=units or (0, 0),
        broadcast=raw.get("broadcast"),
        functions=codes(scope, raw.get("functions")),
        exceptions=codes(scope, raw.get("exceptions")),
        gaps=_gaps(scope, raw.get("gaps")),
        pad_coil_bytes=raw.get("pad_coil_bytes"),
        timing={key: str(value) for key, value in raw.get("timing", {}).items()},
        serial={key: _setting(value) for key, value in raw.get("serial", {}).items()},
        note=titles(raw.get("note")),
    )


def codes(scope: Scope, raw: Map | None) -> tuple[Code, ...]:
    """Numbered codes with their names, in the author's order."""
    result: dict[int, Code] = {}
    for key, value in (raw or {}).items():
        assert raw is not None
        number = integer(key, raw.key_span(key), scope.report)
        if number is None:
            continue
        if number in result:
            scope.report.error(
                "duplicate-enum-value", f"the code {number} is given twice", raw.key_span(key), "remove one of them"
            )
            continue
        name = value if isinstance(value, str) else str(value["name"])
        result[number] = Code(
            number, name, _code_titles(value, name), None if isinstance(value, str) else value.get("max")
        )
    return tuple(result.values())


def _code_titles(value: Map | str, name: str) -> Mapping[str, str]:
    if isinstance(value, str):
        return {"en": humanised(name)}
    texts = {key: str(text) for key, text in value.items() if len(key) == 2 and key != "id"}
    return {"en": humanised(name), **titles(value.get("title")), **texts}


def _gaps(scope: Scope, raw: Map | None) -> dict[str, tuple[tuple[int, int], ...]]:
    result: dict[str, tuple[tuple[int, int], ...]] = {}
    for space, texts in (raw or {}).items():
        found = [interval(text, texts.span(index), scope.report) for index, text in enumerate(texts)]
        result[space] = tuple(sorted(one for one in found if one is not None))
    return result


def _setting(value: Any) -> dict[str, str]:
    if isinstance(value, Map):
        return {key: str(text) for key, text in value.items()}
    if isinstance(value, Seq):
        return {str(one): str(one) for one in value}
    return {str(value): str(value)}


def commands_of(scope: Scope) -> tuple[Command, ...]:
    """The named constant writes of all files."""
    result: dict[str, Command] = {}
    for raw in scope.listed("commands"):
        address = integer(raw["at"], raw.span("at"), scope.report)
        function = integer(raw["function"], raw.span("function"), scope.report)
        value = None if raw["value"] == "any" else integer(raw["value"], raw.span("value"), scope.report)
        if raw["name"] in result:
            scope.report.error(
                "duplicate-name",
                f"the command `{raw['name']}` is declared twice",
                raw.span("name"),
                "rename one of them",
            )
        elif address is not None and function is not None:
            title = titles(raw.get("title"), humanised(raw["name"]))
            result[raw["name"]] = Command(
                raw["name"], title, titles(raw.get("note")), raw.get("space", "holding"), address, function, value,
                raw.get("wears"), raw.get("busy"), source_of(scope, raw),
            )  # fmt: skip
    return tuple(result.values())
