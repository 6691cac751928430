"""The USS family: telegrams with a parameter part (PKW) and process data (PZD)."""

from dataclasses import dataclass

from fieldscribe.families import BusKeys, Codes, Family, Option
from fieldscribe.model import Bus, Code, FamilyFacts, Frame, Variant

_BOTH = ("decode", "encode")
_ALL = (*_BOTH, "listen")

FAMILY = Family(
    name="uss",
    folder=__name__,
    spaces={"parameter": "word", "telegram": "word"},
    last_address=31999,
    bus=BusKeys(("pkw", "pzd", "functions", "responses"), frozenset({"bitrate"}), (0, 15), last_unit=31, broadcast=32),
    framings=("uss", "pkw", "pzd", "broadcast"),
    codes=(
        Codes("functions", "function", "task", "responses"),
        Codes("responses", "response", "response", "functions"),
        Codes("exceptions", "exception", "error", "functions"),
    ),
    indexed=frozenset({"parameter"}),
    words={"parameter": 2},
    frame_keys=("pkw",),
    chooses_memory=True,
    options=(
        Option("pkw", "words of the parameter part (P2013; default: 127)", _ALL, int, "N"),
        Option("pzd", "words of process data (P2012; default: 2)", _ALL, int, "N"),
        Option("single_first", "single words are in the first value word although --pkw is 4 (some firmware)", _ALL),
        Option(
            "direction",
            "direction of the frames (default: an answer follows a request to the same unit)",
            ("decode",),
            str,
            choices=("request", "response"),
        ),
        Option("keep", "write to the EEPROM, not only to the RAM", ("encode",)),
    ),
)


@dataclass(frozen=True, slots=True)
class UssBus(FamilyFacts):
    """The response ids, and the lengths that the parts of a telegram may have.

    `pkw` are the allowed lengths of the parameter part in words (127 is variable), `pzd` is the interval of allowed
    words of process data; `variant_pzd` has variants with a lower maximum.
    """

    responses: tuple[Code, ...] = ()
    pkw: tuple[int, ...] = ()
    pzd: tuple[int, int] = (0, 0)
    variant_pzd: tuple[tuple[Variant, int], ...] = ()
    bitrate: int | None = None


@dataclass(frozen=True, slots=True)
class UssFrame(FamilyFacts):
    """`pkw`: the words of the parameter part, as set for the link (127 is variable); None without such a part."""

    pkw: int | None = None


def of_bus(bus: Bus) -> UssBus:
    """Return the facts of a bus that only this family has."""
    return bus.family_facts if isinstance(bus.family_facts, UssBus) else UssBus()


def of_frame(frame: Frame) -> UssFrame:
    """Return the facts of a worked example that only this family has."""
    return frame.family_facts if isinstance(frame.family_facts, UssFrame) else UssFrame()
