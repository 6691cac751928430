"""Every erratum with printed values explains an existing disagreement."""

from fieldscribe.language.nodes import Map
from fieldscribe.model import Named
from fieldscribe.resolve.analysis import Analysis


def check(analysis: Analysis) -> None:
    """Report printed values of errata with which nothing disagrees."""
    for erratum in analysis.errata:
        printed = erratum.node["printed"]
        on_bus = any(isinstance(about, Named) for about in erratum.subjects)
        if not isinstance(printed, Map) or (on_bus and not analysis.bus_is_whole):
            continue
        for key in printed:
            if key not in erratum.used:
                message = f"the erratum `{erratum.erratum.id}` explains `{key}`, but no printed `{key}` disagrees"
                hint = f"give what is printed under `printed: {{{key}: …}}` of the point, or say it as a sentence"
                analysis.report.error("erratum-unused", message, printed.key_span(key), hint)
