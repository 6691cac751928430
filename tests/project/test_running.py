"""How the suite itself runs: long tests first in each process, and nothing that is shared is made twice."""

from __future__ import annotations

import subprocess
import sys
from typing import TYPE_CHECKING

import pytest
from conftest import dealt
from support.places import TESTS

if TYPE_CHECKING:
    from pathlib import Path

HERE = TESTS


@pytest.mark.parametrize("count", [1, 2, 3, 5])
@pytest.mark.parametrize("times", [[0, 9, 0, 1, 5, 0, 0, 7, 3, 0, 0], [1, 2, 3, 4, 5, 6, 7], [0, 0, 0], [4], []])
def test_each_process_begins_with_its_share_of_long_tests(times: list[int], count: int) -> None:
    """The parts are those of xdist's worksteal: of what is left, each process gets one part for each that is left."""
    order = dealt(list(enumerate(times)), lambda one: float(one[1]), count)
    assert sorted(order) == list(enumerate(times))
    parts, rest = [], order
    for left in range(count, 0, -1):
        parts.append([time for _, time in rest[: len(rest) // left]])
        rest = rest[len(rest) // left :]
    for part in parts:
        assert part == sorted(part, reverse=True)
    longest = sorted((time for time in times if time), reverse=True)
    assert sorted((part[0] for part in parts if part and part[0]), reverse=True) == longest[:count]


def test_short_tests_stay_beside_those_of_their_file() -> None:
    short = [place for place, time in dealt(list(enumerate([0, 8, 0, 0, 6, 0])), lambda one: one[1], 2) if not time]
    assert short == sorted(short)


PROGRAM = """
import sys, time
from pathlib import Path
from support.made_once import made_once
class Factory:
    def getbasetemp(self):
        return Path(sys.argv[1])
def make(place):
    with (place / "made").open("a") as file:
        file.write("once")
    time.sleep(0.2)
    (place / "whole").touch()
print((made_once(Factory(), "shared", make) / "whole").exists())
"""


def test_what_processes_share_is_made_once_and_never_seen_in_part(tmp_path: Path) -> None:
    started = []
    for number in range(3):
        (base := tmp_path / f"popen-gw{number}").mkdir()
        words = [sys.executable, "-c", PROGRAM, str(base)]
        started.append(subprocess.Popen(words, cwd=HERE, stdout=subprocess.PIPE, text=True))
    assert [one.communicate(timeout=60)[0] for one in started] == ["True\n"] * 3
    assert (tmp_path / "shared/made").read_text("utf-8") == "once"


def test_what_failed_half_way_is_made_anew(tmp_path: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    from support.made_once import made_once

    def failing(place: Path) -> None:
        (place / "half").touch()
        raise OSError("no room")

    name = f"failing-{tmp_path.name}"
    with pytest.raises(OSError, match="no room"):
        made_once(tmp_path_factory, name, failing)
    place = made_once(tmp_path_factory, name, lambda place: (place / "whole").touch())
    assert [path.name for path in place.iterdir()] == ["whole"]
