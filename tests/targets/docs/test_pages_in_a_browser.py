"""What pages decode and run in Chromium: every frame of the vectors and of the manuals, hostile logs, the vectors."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import pytest
from fieldscribe.cli import main
from fieldscribe.families.modbus.frames import crc16
from support.described import SHIPPED, shipped
from support.made_once import made_once
from support.places import ROOT, TESTS
from support.quick import full_but
from support.toolchains import NODE_MODULES, npm_package, succeed, tool
from support.vector_file import File, Vector, counts_of

NOISE = Random(27).randbytes(500_000).decode("latin-1").replace("\r", "") + "\n(" * 50_000
SOUND_ALONE = {
    "wrong_function",
    "wrong_unit",
    "wrong_transaction",
    "echo_mismatch",
    "wrong_parameter",
    "wrong_response",
}
"""Replies that do not fit the request, and may be sound requests of their own."""
SOUND = ("asked", "ok", "parsed", "came", "printed")
TYPED = (
    ("hitachi_l200", "01 06 10 28 FF F4 4D 75", "1 frame, 1 with", "6552.4 Hz is outside 0..400 Hz", "unit 1, 06h"),
    ("hitachi_l200", "0x01,0x06,0x10,0x02,0x00,0x05,0xED,0x09", "1 frame, 1 with", "it is read only"),
    ("hitachi_l200", "12:00:01.250 TX: 010300100005840C", "1 frame, 1 with", "at most 4 of them", "12:00:01.250"),
    ("hitachi_l200", "01:03:00:2E:00:03:64:02", "1 frame, 1 with", "the manual closes 002Fh to 08FFh"),
    ("hitachi_l200", "[2026-01-02 03:04:05] FA 03 10 28 00 01 15 19", "1 with", "the device cannot have unit 250"),
    (
        "hitachi_l200",
        "01 03 10 28 00 01 00 C2 01 03 02 01 F4 B8 53",
        "2 frames, nothing wrong",
        "= 50 Hz (raw 500 = 01F4h)",
    ),
    ("hitachi_l200", "01 03 02 01 F4 B8 54", "1 frame, 1 with", "the checksum is wrong", "these bytes give B8 53"),
    (
        "hitachi_l200",
        "01 83 02 C0 F1\n01 03 1",
        "1 frame, 1 with",
        "exception 02h address_not_found",
        "two make a byte",
    ),
    ("hitachi_l200", "0001 0000 0006 01 03 1028 0001", "1 frame", "the manual knows only RTU frames"),
    (
        "hitachi_l200",
        "<img src=x onerror=alert(1)><script>alert(1)</script>",
        "1 line without a frame",
        "is not hexadecimal",
    ),
    ("hitachi_l200", NOISE, "lines without a frame"),
    ("hitachi_l200", "0" * 1_000_000, "1 line without a frame", "no frame is as long"),
    ("hitachi_l200", "01 03 10 28 00 01 00 C2\n" * 20_000, "20000 frames, nothing wrong"),
    ("nord_sk5xxe", "01060c80047fc852", "1 frame, nothing wrong", "command switch_on"),
    ("siemens_mm4", "02 0E 01 143A 0000 0000 0000 047F 3333 58", "1 frame", "task 1 read_value", "enable_operation"),
    ("siemens_mm4", "143A 0000 0000 0000\n243A 0000 4248 0000", "2 frames", "P1082", "= 50 Hz (raw 1112014848"),
    ("siemens_mm4", "TX FA31\nRX FA31", "2 frames", "STW control_word", "ZSW status_word"),
    ("hitachi_l200", "1.5 0103102800 0100C2\n1.5125 01 03 02 01 F4 B8 53", "2 frames", "answered after 12.5 ms"),
    ("siemens_mm4", "02 0E 01 143A 0000 0000 0000 047F 3333 59", "1 with", "the check byte is wrong"),
    ("siemens_mm4", NOISE, "without a frame"),
    ("woodward_mpu2s", "can0  321   [8]  DD 00 05 15 13 88 00 64", "1 frame", "generator_frequency = 50 Hz", "PGNEXPO"),
    ("woodward_mpu2s", "(1700000000.25) can0 321#DD00051513880064\n321 DD 01 03 02 00 00 07 D0", "2 frames, nothing"),
    (
        "woodward_mpu2s",
        "321#DD010302000007D0\n321#DD00051513880064",
        "2 frames",
        "generator_active_power = 100000 W (raw 100 =",
    ),
    ("woodward_mpu2s", "33F#FF0101FB0000FEFB\n33F#R", "2 frames, 2 with", "the checksum is wrong", "remote request"),
    ("woodward_mpu2s", "123#1122\nDD 00", "1 frame", "not of this device", "it has no identifier"),
    ("woodward_mpu2s", NOISE, "without a frame"),
)
"""Device, what is pasted, and what the page says then: of all lines, and of single ones."""
SINK = TESTS / "devices/kitchen_sink"
PAGE, INDEX, WRITE = "0106750000015206", "01067501000b83c1", "01067510002d521e"
WINDOW = ((PAGE, PAGE, WRITE), (PAGE, PAGE, INDEX, INDEX, WRITE))
"""A write to a window whose page, and then whose index too, the device has taken before."""
STEPS = {
    "01 10 7420 0002 04 8B75 748A": "command start_engine, step 1: Start the engine",
    "01 10 7420 0003 06 0005 0002 FFFA": "command close_breaker, step 1: Close breaker; unit = 5",
    "01 10 7420 0003 06 0005 0002 FFFB": "no point is described here",
    "01 06 7424 FFF5": "command close_breaker, step 2: Close breaker; delay = -5",
    "01 0F 7420 0003 01 05": "command ask, step 5: Ask",
}
"""Frames without their checksum, and what the page and the command line say of the words."""
SNIPPETS = {
    "c": (r"\b(?:{0}|fieldscribe)_(?!\w+\.h)\w+", ("{}*.h", "fieldscribe*.h")),
    "python": (r"(?:device\.|point = \w+\.|import )(\w+)", ("{}/*.py",)),
    "rust": (r"p::(\w+)", ("{}/src/*.rs",)),
    "typescript": (r"(?:device\.|import {{ |from \")([\w-]+)", ("{}/*.d.ts", "{}/package.json")),
}
"""The names in the code to copy by language, and the generated files that have them."""
_LINK = ("pkw", "pzd", "single_first")
_REQUEST = ("framing", "unit", "transaction", "function", "address", "count", "values")
_TASK = (*_LINK, "unit", "task", "parameter", "index", "width", "value", "words")

pytestmark = pytest.mark.full(seconds=0.2)  # but for the first, which visits all pages


class Job(NamedTuple):
    """Frames, and what is known of the last one: its status in the vectors, and raw numbers by point."""

    frames: list[str]
    status: str
    raws: dict[str, Any] = {}  # noqa: RUF012  # a tuple holds it, and nobody changes it
    exception: int | None = None
    settings: dict[str, Any] = {}  # noqa: RUF012  # likewise


def _with_crc(frame: str) -> list[str]:
    data = bytes.fromhex(frame)
    return [(data + crc16(data).to_bytes(2, "little")).hex()]


@pytest.fixture(scope="module")
def heard(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What the pages say of all jobs and texts, by device: one browser visits all pages."""
    npm_package("playwright-core")

    def try_pages(folder: Path) -> None:
        texts = {
            str(ROOT / f"generated/docs/{device}.html"): {
                "jobs": [{"text": "\n".join(job.frames), "settings": job.settings} for job in _jobs(device)],
                "typed": [text for of, text, *_ in TYPED if of == device],
                "spoil": _spoiled_line(_vectors(device)),
            }
            for device in SHIPPED
        }
        assert main(["generate", str(SINK), "--target", "docs,vectors", "--out", str(folder)]) == 0
        spoiled = _spoiled_line((folder / "vectors/kitchen_sink.txt").read_text("utf-8"))
        jobs = [{"text": "\n".join(frames), "settings": {}} for frames in (*WINDOW, *map(_with_crc, STEPS))]
        texts[str(folder / "docs/kitchen_sink.html")] = {"jobs": jobs, "typed": [], "spoil": spoiled}
        (folder / "jobs.json").write_text(json.dumps(texts), "utf-8")
        program = Path(__file__).with_name("try_pages.mjs")
        browser = tool("chromium-headless-shell")
        (folder / "heard.json").write_text(
            succeed([tool("node"), program, browser, NODE_MODULES, folder / "jobs.json"]), "utf-8"
        )

    done = json.loads((made_once(tmp_path_factory, "pages_tried", try_pages) / "heard.json").read_text("utf-8"))
    assert done["troubles"] == []
    return {Path(page).stem: said for page, said in done["found"].items()}


def _vectors(device: str) -> str:
    return (ROOT / f"generated/vectors/{device}.txt").read_text("utf-8")


def _spoiled_line(vectors: str) -> tuple[str, str]:
    """A line of the vectors, and the same with another address."""
    line = next(line for line in vectors.split("\n") if line.startswith("address\t"))
    kind, space, address, *others = line.split("\t")
    return line, "\t".join((kind, space, str(int(address) + 1), *others))


def _text(frame: bytes, device: str) -> str:
    if shipped(device).family != "can":
        return frame.hex()
    return f"{int.from_bytes(frame[:4], 'big'):03X}#{frame[4:].hex()}"


def _key(vector: Vector, fields: tuple[str, ...]) -> str:
    return repr([vector.get(field) for field in fields])


def _settings(vector: Vector) -> dict[str, Any]:
    link = {key: vector[key] for key in ("pkw", "pzd") if vector.get(key) is not None}
    return {**link, "known": {base: int(start) for base, start in (vector.get("starts") or {}).items()}}


def _jobs(device: str) -> Iterator[Job]:
    """The frames of all vectors that have frames."""
    for frame in shipped(device).frames:
        if frame.valid:
            asked = [one.corrected.hex() for one in shipped(device).frames if one.name == frame.answers]
            framing = (
                f"{frame.framing} response"
                if (frame.framing, frame.direction) == ("pzd", "response")
                else frame.framing
            )
            raws = dict(frame.meaning)
            yield Job([*asked, frame.corrected.hex()], "printed", raws, settings={"framing": framing})
    built: dict[str, bytes] = {}
    for vector in File(_vectors(device)):
        kind, status = vector["kind"], vector.get("status") or ""
        fields = _TASK if kind.startswith("uss") else _REQUEST
        if kind in ("read", "write", "store"):
            yield from _conversation(device, vector)
        elif kind.endswith("build") and status == "ok":
            built[_key(vector, fields)] = vector["bytes"]
            if "id" not in vector:
                yield Job([vector["bytes"].hex()], "asked", settings=_settings(vector))
        elif kind in ("reply", "uss_reply") and _key(vector, fields) in built and vector["bytes"]:
            frames = [built[_key(vector, fields)].hex(), vector["bytes"].hex()]
            code = (
                vector.get("exception")
                if status == "exception"
                else vector.get("error")
                if status == "refused"
                else None
            )
            yield Job(frames, status, exception=code, settings=_settings(vector))
        elif kind == "can_reply" and status != "wrong_id":
            yield Job([f"{vector['id']:03X}#{(vector['bytes'] or b'').hex()}"], "parsed" if status == "ok" else status)
        elif kind == "can_telegram" and status == "ok":
            frames = [f"{identifier:03X}#{data.hex()}" for identifier, data in vector["frames"]]
            yield Job(frames, "came", {vector["point"]: vector["raw"]})


def _conversation(device: str, vector: Vector) -> Iterator[Job]:
    """What a client sends and hears when it reads or writes a point."""
    needs = [_text(frame, device) for pair in vector.get("needs") or () for frame in pair]
    frames = [_text(frame, device) for pair in vector["script"] for frame in pair if frame]
    if vector["script"][-1][1]:
        ends = vector["status"] == "ok" and vector["raw"] is not None
        raws = {vector["point"]: vector["raw"]} if ends else {}
        yield Job([*needs, *frames], vector["status"], raws, settings=_settings(vector))


def _wrong(job: Job, heard: list[dict[str, Any]]) -> list[str]:
    """Why the page is wrong about a job; empty if it is right."""
    last, said = heard[-1], [each for frame in heard for each in frame["items"]]
    is_sound = not (last["faults"] or last["findings"])
    is_alone = job.status in SOUND_ALONE and last["kind"] == "request"
    is_of_other_framing = heard[0]["summary"][:3] != last["summary"][:3]
    is_refusal = job.status in ("exception", "refused", "no_rights", "no_answer")
    reasons = {
        "frames are missing": len(heard) < len(job.frames),
        "a sound frame has faults": job.status in SOUND and last["faults"],
        "it is no reply": job.status == "ok" and last["kind"] not in ("reply", "exception", "request"),
        "it is no exception": job.status == "exception" and last["kind"] != "exception",
        "it is another exception": job.exception is not None and last.get("exception") != job.exception,
        "a wrong frame has no fault": is_sound
        and not (job.status in SOUND or is_refusal or is_alone or is_of_other_framing),
    }
    for name, raw in job.raws.items():
        raws = {str(each["raw"]) for each in said if name.startswith(each.get("name", "-")) and "raw" in each}
        reasons[f"{name} is {raws}, not {raw}"] = str(raw) not in raws
    return [reason for reason, holds in reasons.items() if holds]


@pytest.mark.parametrize("device", full_but(SHIPPED[1:], SHIPPED, seconds=30))
def test_every_frame_of_the_vectors(device: str, heard: dict[str, Any]) -> None:
    """Requests, replies and exceptions with their points; those that are spoiled, with what is wrong."""
    jobs = list(_jobs(device))
    assert len(jobs) > 100
    pairs = zip(jobs, heard[device]["decoded"], strict=True)
    assert [(why, job, frames[-1]) for job, frames in pairs if (why := _wrong(job, frames))] == []


def test_an_address_means_what_is_selected(heard: dict[str, Any]) -> None:
    """Of a write to the window: behind its page alone, and behind page and index."""
    early, late = (frames[-1]["items"] for frames in heard["kitchen_sink"]["decoded"][: len(WINDOW)])
    assert [each["name"] for each in late] == ["input_delay_index_2"]
    assert {each["name"] for each in early} == {f"input_delay_index_{index}" for index in (1, 2, 3)}


@pytest.mark.parametrize("place", range(len(STEPS)))
def test_the_words_of_a_step_name_its_command(
    place: int, heard: dict[str, Any], capsys: pytest.CaptureFixture[str]
) -> None:
    frame, said = list(STEPS.items())[place]
    assert said in heard["kitchen_sink"]["decoded"][len(WINDOW) + place][-1]["items"][0]["text"]
    main(["decode", str(SINK), *_with_crc(frame)])
    assert said in capsys.readouterr().out


@pytest.mark.parametrize("place", range(len(TYPED)))
def test_what_is_said_of_pasted_text(place: int, heard: dict[str, Any]) -> None:
    device, text, *said = TYPED[place]
    shown = heard[device]["shown"][[one[0] for one in TYPED[:place]].count(device)]
    assert shown["strange"] == 0
    for each in said:
        assert each in f"{shown['status']}\n{shown['text']}", text[:200]


@pytest.mark.parametrize("device", SHIPPED)
def test_a_long_paste_is_decoded_whole_and_shown_in_part(device: str, heard: dict[str, Any]) -> None:
    length, is_fixed, status, *cleared = heard[device]["long"]
    assert (length, is_fixed) == (3 * 2000 - 1, True)
    assert "5000" in status
    assert "the field shows the beginning alone" in status
    assert cleared == [0, False]


@pytest.mark.parametrize("device", SHIPPED)
def test_the_page_runs_its_vectors(device: str, heard: dict[str, Any]) -> None:
    """As many of each kind as the vectors announce; a spoiled one is shown."""
    good, spoiled = heard[device]["ran"]
    counts = {kind: str(count) for kind, count in counts_of(_vectors(device), "typescript").items() if count}
    assert {kind: passed for kind, passed, *_ in good["rows"]} == counts
    assert (good["failures"], good["status"]) == ([], f"all {sum(map(int, counts.values()))} vectors passed")
    assert spoiled["status"].startswith("1 vector failed")
    assert len(spoiled["failures"]) == 1
    assert "address" in spoiled["failures"][0]


@pytest.mark.parametrize("device", SHIPPED)
@pytest.mark.parametrize("language", SNIPPETS)
def test_code_to_copy_has_the_names_of_the_generated_code(language: str, device: str, heard: dict[str, Any]) -> None:
    names, where = SNIPPETS[language]
    files = [file for each in where for file in (ROOT / "generated" / language).glob(each.format(device))]
    known = {word for file in files for word in re.findall(r"[\w-]+", file.read_text("utf-8"))}
    texts = [each[language] for each in heard[device]["snippets"] if each]
    used = {name for text in texts for name in re.findall(names.format(device), text, re.IGNORECASE)}
    assert len(texts) <= 2 * len(used)
    assert used - known == set()
