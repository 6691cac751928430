"""Checks: what must be true of a device beyond the shape of its keys. One module checks one fact and is named after it.

To add a check:

1. Write a module named after the fact, such as `addresses_do_not_overlap.py`, with a function `check(analysis)`. It
   reads the resolved points (`analysis.resolved`: each with its model `point` and its `facts` in the text) and reports
   each finding with `analysis.report.error(rule, message, span, hint)`, or with `warning` if the device can be compiled
   all the same. `facts.span(key)` is the place of a key. Skip points whose `facts.failed` has a key that the check
   depends on: they have a finding already. Try the check on `descriptions/` and `tests/devices/` first.
   `coexistence` knows which points never exist together, `identifier_places` where a name in code comes from.
2. Add the module to `CHECKS` below, before `errata_are_used` if an erratum may explain what the check finds.
3. Add a wrong description to `tests/bad` with the expected findings as its first comments. With FIELDSCRIBE_ACCEPT=1 in
   the environment `pytest tests/checks/test_bad.py` writes these comments; read what it wrote.
"""

from importlib import import_module

from fieldscribe.resolve.analysis import Analysis

CHECKS = (
    "device_name_is_free",
    "every_point_has_a_source",
    "lines_run_upwards",
    "meanings_do_not_compete",
    "conditions_can_hold",
    "write_addresses_are_used",
    "addresses_do_not_overlap",
    "named_points_fit",
    "groups_use_what_they_say",
    "numbers_fit_their_type",
    "fixed_bits_can_be_written",
    "defaults_are_allowed",
    "references_exist",
    "printed_facts_agree",
    "checks_of_the_family",
    "frames_agree",
    "errata_are_used",
    "names_do_not_clash",
)
"""The checks in their order."""


def run_checks(analysis: Analysis) -> None:
    """Run all checks on a resolved device."""
    for name in CHECKS:
        import_module(f"fieldscribe.checks.{name}").check(analysis)
