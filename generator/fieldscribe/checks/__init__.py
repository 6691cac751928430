"""What must be true of a device beyond the shape of its keys. Each file checks one fact and has its name."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from fieldscribe.resolve.analysis import Analysis


def run_checks(analysis: Analysis) -> None:
    """Run all checks, also those of the family. Errata come after the checks that use them, names last."""
    from fieldscribe.checks import (
        addresses_do_not_overlap,
        conditions_can_hold,
        defaults_are_allowed,
        device_name_is_free,
        enums_fit_their_range,
        errata_are_used,
        every_point_has_a_source,
        fixed_bits_can_be_written,
        frames_agree,
        groups_use_what_they_say,
        lines_run_upwards,
        meanings_do_not_compete,
        names_do_not_clash,
        printed_facts_agree,
        references_exist,
        write_addresses_are_used,
    )

    family_part = analysis.scope.family.part("checks")
    checks: tuple[Callable[[Analysis], None], ...] = (
        device_name_is_free.check,
        every_point_has_a_source.check,
        lines_run_upwards.check,
        meanings_do_not_compete.check,
        conditions_can_hold.check,
        write_addresses_are_used.check,
        addresses_do_not_overlap.check,
        groups_use_what_they_say.check,
        enums_fit_their_range.check,
        fixed_bits_can_be_written.check,
        defaults_are_allowed.check,
        references_exist.check,
        printed_facts_agree.check,
        *(() if family_part is None else family_part.CHECKS),
        frames_agree.check,
        errata_are_used.check,
        names_do_not_clash.check,
    )
    for check in checks:
        check(analysis)
