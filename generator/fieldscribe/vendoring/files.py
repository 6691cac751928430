"""The files that a project needs to use a device in one language: path below the project's folder, and text."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from fieldscribe.code_view import for_code
from fieldscribe.targets.heads import LEFT_OUT

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device

LANGUAGES = ("c", "python", "rust")
"""The languages that a project can take a device in."""

LANGUAGE_OF = {"frames": "c", "single_file": "c", "wheel": "python"}
"""Switches of a wish, each with the language that has it."""

LICENCE = "LICENSE-fieldscribe.txt"
_POINTS_IN_A_HEAD = 60
"""A longer list of points stands in the manifest alone."""


@dataclass(frozen=True, slots=True)
class Wish:
    """What a project wants of a device: a language, some points (none: all), and how.

    `name` is what the device is called in code, where that is not its id. `frames` and `single_file` are for C, `wheel`
    for Python.
    """

    language: str
    points: tuple[str, ...] = ()
    name: str | None = None
    frames: bool = True
    single_file: bool = False
    wheel: bool = False

    def command(self, device: str) -> tuple[str, ...]:
        """The words of the command that makes the files anew."""
        words = ["fieldscribe", "vendor", self.language, device]
        if self.name is not None:
            words += ["--as", self.name]
        if self.points:
            points = ",".join(self.points)
            fits = len(points) <= _POINTS_IN_A_HEAD and not any("," in point for point in self.points)
            words += ["--points", points if fits else LEFT_OUT]
        words += ["--single-file"] if self.single_file else []
        words += [] if self.frames else ["--no-frames"]
        words += ["--wheel"] if self.wheel else []
        return tuple(words)

    def as_data(self, device: str) -> dict[str, object]:
        """What a manifest says of it."""
        said: dict[str, object] = {"device": device, "points": list(self.points)}
        said |= {} if self.frames else {"frames": False}
        return said | {key: True for key in ("single_file", "wheel") if getattr(self, key)}

    def contents(self, device: Device) -> Iterator[tuple[str, bytes]]:
        """The files, as bytes. Raises UnclearError, and ModuleNotFoundError for wheels without hatchling."""
        texts = dict(files_of(device, self))
        if self.wheel:
            from fieldscribe.vendoring.wheel import wheels_of

            yield from wheels_of(texts)
            texts = {LICENCE: texts[LICENCE]}
        for path, text in texts.items():
            yield path, text.encode()


def files_of(device: Device, wish: Wish) -> Iterator[tuple[str, str]]:
    """The texts that the wish is about. Raises UnclearError."""
    from fieldscribe.render import render
    from fieldscribe.resources import templates_dir
    from fieldscribe.targets import target
    from fieldscribe.vendoring.choosing import chosen

    reduced = chosen(device, wish.points) if wish.points else device
    named = replace(for_code(reduced), id=wish.name or device.id, asked=wish.command(device.id))
    offered = target(wish.language)
    files = {path: (templates_dir() / source).read_text("utf-8") for path, source in offered.vendored_runtime(named)}
    files |= offered.vendored(named, render)
    if not wish.frames:
        files = {path: text for path, text in files.items() if path not in _of_frames(named)}
    if wish.single_file:
        from fieldscribe.targets.c.header import joined

        files = {f"{named.id}.h": joined(files, named)}
    yield from files.items()
    yield LICENCE, (templates_dir() / LICENCE).read_text("utf-8")


def _of_frames(device: Device) -> frozenset[str]:
    """The headers in C that only frames need."""
    return frozenset((f"fieldscribe_{device.family}.h", f"{device.id}_{device.family}.h"))
