"""Gives each frame to the decoder of its device, and pairs requests with their answers."""

from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterator, Sequence
from functools import lru_cache
from types import MappingProxyType
from typing import NamedTuple

from fieldscribe.arithmetic.codec import Settings
from fieldscribe.conversation.decoder import StreamDecoder, frame_decoder
from fieldscribe.diagnostics import UnclearError
from fieldscribe.families import family
from fieldscribe.families.decoded_frame import OpenRequests
from fieldscribe.families.frame_results import FrameResult, Options
from fieldscribe.listening.chunks import SILENT, Chunk, Cut, Packet
from fieldscribe.listening.exchanges import Content, Exchange
from fieldscribe.model import Device

_ASKS, _ANSWERS = ("request", "request_or_reply"), ("reply", "exception")
_MOST_OPEN = 1024
"""The most requests that may wait for an answer."""
_MOST_CONTENTS = 256
"""The most frames whose content is cached."""
NO_ANSWER = "no answer"
ALONE = "an answer without a request before it"
NOISE = "bytes that are no frame"
FOREIGN = "for a unit without a description"


class Station(NamedTuple):
    """A device on the line; without a unit it covers all units that no other station has."""

    device: Device
    unit: int | None = None
    settings: Settings = MappingProxyType({})
    """The numbers of other points that values depend on."""


class _Open(NamedTuple):
    """A request that waits for its answer."""

    cut: Cut
    result: FrameResult
    station: Station


class Listener:
    """Turns chunks into exchanges. Raises UnclearError for devices that cannot be on one line."""

    def __init__(self, stations: Sequence[Station], options: Options) -> None:
        names = {station.device.family for station in stations}
        if len(names) > 1:
            raise UnclearError(f"devices of {' and '.join(sorted(names))} are not on one line", "listen to one family")
        self.part = family(stations[0].device.family).part("lines")
        if self.part is None:
            raise UnclearError(f"nothing here cuts what devices of {', '.join(names)} say into frames")
        self.each: Callable[[Packet], object] | None = None
        """Gets each frame as a packet of a capture."""
        self._cutter = self.part.cutter()
        self._stations, self._options = stations, options
        self._named = {station.unit: station for station in stations if station.unit is not None}
        self._default = next((station for station in stations if station.unit is None), None)
        self._decoders: dict[tuple[int, str | None], StreamDecoder] = {}
        self._open: OrderedDict[Hashable, _Open] = OrderedDict()
        self._requests = lru_cache(_MOST_OPEN)(lambda _exchange: OpenRequests())
        self._contents: dict[tuple[int, int], Content] = {}
        """The content by identity of request and answer: decoders return the same objects for repeated frames."""
        self._units: set[int | None] = set()
        """The units that a valid frame was for or from."""
        self.others = 0
        """Chunks that cannot be frames of this family."""

    def take(self, chunk: Chunk) -> list[Exchange]:
        """Return the exchanges that end with this chunk."""
        if chunk.kind not in self.part.KINDS:
            self.others += chunk.kind != SILENT
            return []
        return [exchange for cut in self._cutter.take(chunk) for exchange in self._frame(cut)]

    def rest(self) -> Iterator[Exchange]:
        """Return what is left at the end; the last requests may have been answered later."""
        for cut in self._cutter.rest():
            yield from self._frame(cut)
        for waiting in self._open.values():
            yield self._exchange(waiting, None, None)
        self._open.clear()

    def _frame(self, cut: Cut) -> list[Exchange]:
        if self.each is not None:
            self.each(self.part.packet(cut))
        if cut.damaged and cut.unit not in self._units:
            return [Exchange(cut.time, cut.place, Content(), (cut,), (NOISE,))]
        key: tuple[Hashable, ...] = cut.place, cut.exchange
        requests = self._requests(key)
        gone: list[Exchange] = []
        if cut.sent and key in self._open:  # the client gave up waiting
            gone = [self._unanswered(key)]
            requests.clear()
        station, result = self._decoded(cut, requests)
        if result is None or station is None:
            return [*gone, Exchange(cut.time, cut.place, Content(cut.unit), (cut,), (FOREIGN,))]
        if not cut.damaged:
            self._units.add(result.unit)
        if result.kind == "cyclic":
            return [*gone, Exchange(cut.time, cut.place, self._content(station, None, result), (cut,), result.faults)]
        return gone + self._paired(cut, (*key, result.unit) if cut.unit is None else key, station, result)

    def _paired(self, cut: Cut, key: Hashable, station: Station, result: FrameResult) -> list[Exchange]:
        waiting = self._open.get(key)
        if result.kind in _ASKS and cut.sent is not False:
            gone = [] if waiting is None else [self._unanswered(key)]
            self._open[key] = _Open(cut, result, station)
            return gone + ([self._unanswered(next(iter(self._open)))] if len(self._open) > _MOST_OPEN else [])
        if result.kind in _ANSWERS and waiting is not None and waiting.result.unit == result.unit:
            del self._open[key]
            return [self._exchange(waiting, result, cut)]
        lonely = (ALONE,) if result.kind in _ANSWERS or result.kind in _ASKS else ()
        asks = result.kind == "broadcast"
        content = self._content(station, *((result, None) if asks else (None, result)))
        return [Exchange(cut.time, cut.place, content, (cut,), (*result.faults, *lonely))]

    def _unanswered(self, key: Hashable) -> Exchange:
        waiting = self._open.pop(key)
        silent = waiting.result.kind in _ASKS and waiting.result.unit != waiting.station.device.bus.broadcast
        return self._exchange(waiting, None, None, (NO_ANSWER,) if silent else ())

    def _decoded(self, cut: Cut, requests: OpenRequests) -> tuple[Station | None, FrameResult | None]:
        """Return the station that a frame is for or from, and its decoded form there; None for a foreign one."""
        if cut.unit is not None:
            station = self._named.get(cut.unit, self._default)
            if station is None and cut.unit == self._stations[0].device.bus.broadcast:
                station = self._stations[0]
            return station, None if station is None else self._decoder(station, cut.framing).decode(
                cut.frame, requests=requests
            )
        first = None
        for station in self._stations:
            result = self._decoder(station, cut.framing).decode(cut.frame, requests=requests)
            if result.kind != "other" and station.unit in (None, result.unit):
                return station, result
            first = first or (station, result)
        return first if first and first[1].kind != "other" and first[0].unit is None else (None, None)

    def _decoder(self, station: Station, framing: str | None) -> StreamDecoder:
        key = id(station), framing
        if key not in self._decoders:
            options = Options(framing or self._options.framing, of_family=self._options.of_family)
            self._decoders[key] = StreamDecoder(
                station.device, station.settings, frame_decoder(station.device, options), doubting=True
            )
        return self._decoders[key]

    def _exchange(
        self, waiting: _Open, reply: FrameResult | None, cut: Cut | None, faults: tuple[str, ...] = ()
    ) -> Exchange:
        first, request, station = waiting
        took = None if cut is None or cut.time is None or first.time is None else round(cut.time - first.time, 6)
        faults = (*request.faults, *(reply.faults if reply else ()), *faults)
        cuts = (first,) if cut is None else (first, cut)
        return Exchange(first.time, first.place, self._content(station, request, reply), cuts, faults, took)

    def _content(self, station: Station, request: FrameResult | None, reply: FrameResult | None) -> Content:
        key = id(request), id(reply)
        if key not in self._contents:
            if len(self._contents) >= _MOST_CONTENTS:
                self._contents.clear()
            main = request or reply
            unit, action = (None, "") if main is None else (main.unit, self.part.action(main))
            self._contents[key] = Content(unit, station.device, action, request, reply)
        return self._contents[key]
