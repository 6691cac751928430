"""The device passes the checks of its own family."""

from fieldscribe.resolve.analysis import Analysis


def check(analysis: Analysis) -> None:
    """Run the checks of the family in their order."""
    part = analysis.scope.family.part("checks")
    for check_of_family in () if part is None else part.CHECKS:
        check_of_family(analysis)
