"""An exchange: a request with its answer, in words and for JSON."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from fieldscribe.families.frame_results import FrameResult, Item
from fieldscribe.listening.chunks import Cut
from fieldscribe.model import Device
from fieldscribe.wording.frames import spaced

_MOST_BYTES = 16
"""How many bytes of what is no frame are printed."""


@dataclass(frozen=True)
class Exchange:
    """A request with its answer, one of them alone, or a frame that nobody answers.

    `place` is who asks, where that is known; `action` what is done, in a word; `took` is in seconds. A frame for a unit
    without a description has no device.
    """

    time: float | None
    place: str
    unit: int | None
    device: Device | None
    action: str
    request: FrameResult | None
    reply: FrameResult | None
    cuts: tuple[Cut, ...]
    faults: tuple[str, ...] = ()
    took: float | None = None

    @property
    def main(self) -> FrameResult | None:
        """The frame that says most."""
        return self.request if self.reply is None or (self.request and not self.reply.items) else self.reply

    @property
    def items(self) -> Sequence[Item]:
        """What was read or written."""
        return self.main.items if self.main else ()

    @property
    def remark(self) -> str:
        """What is said of frames without items; the bytes of those that are foreign, or none."""
        return self.main.summary if self.main else spaced(self.cuts[0].data[:_MOST_BYTES])

    @cached_property
    def findings(self) -> dict[str, str]:
        """What is against the manual and which numbers are outside their range, by point; and what was refused."""
        found: dict[str, str] = {}
        for result in (self.request, self.reply):
            if result is not None:
                found.update(dict.fromkeys(result.findings, ""))
                for item in result.items:
                    if item.findings or item.doubts:
                        found[item.about] = ", ".join((*item.findings, *item.doubts))
        if self.reply is not None and self.reply.refusal:
            found[self.reply.refusal] = ""
        return found

    @property
    def frames(self) -> Iterator[tuple[str, FrameResult | None]]:
        """The frames in the notation of their users, each with what it is."""
        results = [result for result in (self.request, self.reply) if result is not None]
        for place, cut in enumerate(self.cuts):
            result = results[place] if place < len(results) else None
            captured = None if result is None else result.captured
            yield spaced(cut.data) if captured is None else captured.text, result

    def as_data(self) -> dict[str, object]:
        """Return the same for JSON."""
        plain = ("point", "code", "raw", "value")
        items = [{**{key: getattr(item, key) for key in plain}, "text": item_text(item)} for item in self.items]
        return {
            "time": self.time,
            "who": self.place or None,
            "unit": self.unit,
            "device": None if self.device is None else self.device.id,
            "action": self.action,
            "items": items,
            "took": self.took,
            "exception": None if self.reply is None else self.reply.exception,
            "faults": list(self.faults),
            "findings": [finding_text(*finding) for finding in self.findings.items()],
        }


def item_text(item: Item) -> str:
    """Return a point with its value, short: `output_frequency = 5 Hz`."""
    if item.bit_texts is not None and item.raw is not None:
        return f"{item.point} = {item.bit_texts.true(item.raw)}"
    if item.point is None:
        return item.summary
    if item.carries:
        return f"{item.point}: {item.carries}"
    return f"{item.point} = {item.meaning}" if item.meaning or item.raw is not None else item.point


def finding_text(key: str, text: str) -> str:
    """Return a finding with what it is about."""
    return f"{key}: {text}" if text else key


def seconds(time: float) -> str:
    """Return a time as people read it: `4.2 ms`, `1.25 s`."""
    return f"{1000 * time:.1f} ms" if time < 1 else f"{time:.2f} s"
