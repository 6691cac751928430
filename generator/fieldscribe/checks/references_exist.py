"""Names refer to what exists: `keep_with` to a command, `busy` of a command to a point."""

from fieldscribe.families import families
from fieldscribe.resolve.analysis import Analysis


def check(analysis: Analysis) -> None:
    """Report names of commands and points that do not exist."""
    scope = analysis.scope
    declared = {str(node["name"]) for node in scope.listed("commands")}
    for resolved in analysis.resolved:
        keeps = resolved.point.keeps
        if keeps == "choice" and not scope.family.chooses_memory:
            message = f"a {scope.family.name} request cannot choose where the device keeps the value"
            choosers = " and ".join(family.name for family in families() if family.chooses_memory)
            hint = (
                "write `keeps: yes`, `keeps: no`, or `keep_with` and the command that stores; "
                f"`choice` is for the tasks of {choosers}"
            )
            scope.report.error("wrong-choice", message, resolved.facts.span("keeps"), hint)
        elif keeps not in (None, "no", "yes", "choice", *declared):
            scope.unknown("command", str(keeps), resolved.facts.span("keep_with"), sorted(declared))
    for node in scope.listed("commands"):
        busy = node.get("busy")
        if busy is not None and analysis.symbols.find(busy) is None:
            analysis.symbols.unknown(busy, node.span("busy"))
