"""No operating system, runtime or target language uses the name of the device."""

from collections.abc import Iterator

from fieldscribe.resolve.analysis import Analysis

_UNSAFE = frozenset({"con", "prn", "aux", "nul", *(f"{port}{n}" for port in ("com", "lpt") for n in range(10))})


def check(analysis: Analysis) -> None:
    """Report the first reason why the name is taken."""
    header = analysis.scope.header
    name = str(header["device"])
    for taken in reasons(name):
        hint = "name it after vendor and model, such as `hitachi_l200`"
        analysis.report.error("unsafe-name", f"`{name}` {taken}", header.span("device"), hint)
        return


def reasons(name: str) -> Iterator[str]:
    """Yield the reasons why a device may not have the name, each as the rest of a sentence."""
    from fieldscribe.targets import TARGETS, target

    if name in _UNSAFE:
        yield "is no safe name for a folder on every system"
    if name == "fieldscribe" or name.startswith("fieldscribe_"):
        yield "is taken by the runtime beside the generated files"
    yield from filter(None, (target(name_of_target).device_name_taken(name) for name_of_target in TARGETS))
