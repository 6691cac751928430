"""Reads the facts that only USS has, and reports what its telegrams cannot carry."""

from collections.abc import Iterator, Sequence

from fieldscribe.diagnostics import Report
from fieldscribe.families.uss import UssBus, UssFrame, of_bus
from fieldscribe.families.uss.telegrams import VARIABLE
from fieldscribe.language.nodes import Map
from fieldscribe.model import Bus, Code, Telegram, Variant
from fieldscribe.resolve.bus import FamilyReader, codes_under, ends_of
from fieldscribe.resolve.scope import Scope
from fieldscribe.resolve.values import integer, interval

_MOST_PZD = 16


class UssReading(FamilyReader):
    """Reads the lengths of the parameter part and of process data, and the response ids."""

    def bus(self, scope: Scope, node: Map, functions: tuple[Code, ...]) -> UssBus:
        """Return the response ids, and the lengths of the parts."""
        del functions
        return UssBus(
            responses=codes_under(scope, node, "responses"),
            pkw=tuple(dict.fromkeys(node.get("pkw", ()))),
            pzd=ends_of(scope, node, "pzd", "is no count of words", _MOST_PZD),
            variant_pzd=tuple(_variant_pzd(scope)) if "pzd" in node else (),
            bitrate=node.get("bitrate"),
        )

    def frame(self, scope: Scope, node: Map, framing: str) -> UssFrame:
        """Return the length of the parameter part on the link."""
        del scope
        return UssFrame(None if framing in ("pzd", "broadcast") else node.get("pkw", VARIABLE))

    def refuses(self, scope: Scope, bus: Bus, node: Map) -> bool:
        """Report a length that the parameter part cannot have; return True if there was one."""
        lengths = of_bus(bus).pkw
        if not lengths or node.get("pkw", lengths[0]) in lengths:
            return False
        message = f"the parameter part cannot have the length {node['pkw']}"
        hint = f"known under `bus`: {', '.join(map(str, lengths))}"
        scope.report.error("wrong-choice", message, node.span("pkw"), hint)
        return True

    def telegram(self, scope: Scope, node: Map, before: Sequence[Telegram]) -> None:
        """Report process data that cannot exist: an unknown or second direction, too many words, a message."""
        name, direction, report, bus = str(node["name"]), node["direction"], scope.report, scope.bus
        if "message" in node:
            hint = "leave it out: the frames of uss are known"
            report.error("family-key", "messages are for the family can", node.key_span("message"), hint)
        if direction not in ("request", "response"):
            hint = "write `direction: request` for what the master sends, `response` for what the device sends"
            report.error("wrong-choice", f"process data are no {direction} telegram", node.span("direction"), hint)
        other = next((telegram for telegram in before if telegram.direction == direction), None)
        if other is not None:
            text = f"`{other.name}` and `{name}` are both of direction {direction}"
            hint = "a telegram has process data once in each direction: make them one, or points with `when`"
            report.error("two-meanings", text, node.span("direction"), hint)
        ends = None if bus is None or "pzd" not in bus else interval(str(bus["pzd"]), bus.span("pzd"), Report())
        if ends is not None and node["length"] > ends[1]:
            text = f"`{name}` has {node['length']} words, the process data at most {ends[1]}"
            report.error("too-many-items", text, node.span("length"), "correct `length`, or `pzd` under `bus`")


def _variant_pzd(scope: Scope) -> Iterator[tuple[Variant, int]]:
    """Yield the variants that take fewer words of process data than the whole product, by their property `pzd`."""
    for axis, entry in scope.axes.items():
        for value, properties in entry["values"].items():
            span = properties.span("pzd")
            most = integer(properties["pzd"], span, scope.report) if "pzd" in properties else None
            if most is not None and not 0 <= most <= _MOST_PZD:
                message = f"{most} is no count of words"
                scope.report.error("address-outside-space", message, span, f"write 0..{_MOST_PZD}")
            elif most is not None:
                yield Variant(axis, value), most


READING = UssReading()
