"""Renders a stranger's Jinja template: run as a program, in a process of its own with limits of time and memory.

It reads the file that its first argument names, and writes the text to standard output. Included templates are in the
folder of the file. The sandbox lets a template read values and call functions without effects; it may change only its
own lists. A violation or an error ends in a message on standard error and exit code 3.
"""

import sys
from pathlib import Path
from typing import Any

from jinja2 import FunctionLoader, StrictUndefined, TemplateError
from jinja2.exceptions import SecurityError
from jinja2.sandbox import ImmutableSandboxedEnvironment

SECONDS, MOST_MEMORY, MOST_CHARACTERS = 20, 512 << 20, 16 << 20
"""Limits: seconds of a processor, bytes of memory, characters of the rendered text."""
REFUSED = 3


class _Sandbox(ImmutableSandboxedEnvironment):
    """A sandbox whose templates may append to lists, because all lists belong to the template."""

    def is_safe_attribute(self, obj: Any, attr: str, value: Any) -> bool:
        return (type(obj) is list and attr == "append") or super().is_safe_attribute(obj, attr, value)


def _limit() -> None:
    """Limit time and memory, if the system can (Windows cannot: there only the caller's timeout applies)."""
    try:
        import resource
    except ModuleNotFoundError:
        return
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))


def _render(path: Path) -> None:
    folder = path.resolve().parent

    def included(name: str) -> str | None:
        file = (folder / name).resolve()
        return file.read_text("utf-8") if file.parent == folder and file.is_file() else None

    environment = _Sandbox(loader=FunctionLoader(included), undefined=StrictUndefined)
    room = MOST_CHARACTERS
    for text in environment.from_string(path.read_text("utf-8")).generate():
        room -= len(text)
        if room < 0:
            raise SecurityError(f"the text has more than {MOST_CHARACTERS} characters")
        sys.stdout.write(text)


if __name__ == "__main__":
    _limit()
    sys.stdout.reconfigure(encoding="utf-8", newline="\n")  # type: ignore[union-attr]  # a program has a stream of text
    try:
        _render(Path(sys.argv[1]))
        sys.stdout.flush()
    except MemoryError:
        sys.exit(f"it needs more than {MOST_MEMORY >> 20} MiB")
    except (TemplateError, RecursionError, UnicodeError, ArithmeticError, LookupError, TypeError, ValueError) as error:
        print(str(error) or type(error).__name__, file=sys.stderr)
        sys.exit(REFUSED)
