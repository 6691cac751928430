"""`fieldscribe completion`: shell scripts that complete commands, options, devices and points, and their answers."""

import re
import sys
from argparse import Action, ArgumentParser, Namespace
from collections.abc import Iterable, Sequence
from pathlib import Path

from fieldscribe import cli
from fieldscribe.cli.common import default_folders, known_devices
from fieldscribe.cli.terminal import FINE
from fieldscribe.language.keys.forms import ID
from fieldscribe.search import summary_of

COMPLETION_EXAMPLE = """examples:
  fieldscribe completion bash > ~/.local/share/bash-completion/completions/fieldscribe
  fieldscribe completion zsh > ~/.zfunc/_fieldscribe
  fieldscribe completion fish > ~/.config/fish/completions/fieldscribe.fish

For zsh, ~/.zfunc must be in fpath before compinit runs. For the running shell alone:
  source <(fieldscribe completion bash)

ends with 2 for an unknown shell"""

SCRIPTS = {
    "bash": """# completion of fieldscribe for bash
_fieldscribe() {
    local word
    COMPREPLY=()
    while IFS= read -r word; do
        COMPREPLY+=("$(printf %q "$word")")  # bash types it as it is: a code may be `$(...)`
    done < <("$1" completion words -- "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
    if [[ ${COMPREPLY[0]} == *= ]]; then compopt -o nospace; fi
}
complete -o default -F _fieldscribe fieldscribe
""",
    "zsh": """#compdef fieldscribe
# completion of fieldscribe for zsh
_fieldscribe() {
    local -a known
    known=("${(@f)$("${words[1]}" completion words -- "${(@)words[2,CURRENT]}" 2>/dev/null)}")
    if [[ -n ${known[1]} ]]; then compadd -- "${known[@]}"; else _files; fi
}
if [[ ${funcstack[1]} == _fieldscribe ]]; then _fieldscribe "$@"; else compdef _fieldscribe fieldscribe; fi
""",
    "fish": """# completion of fieldscribe for fish
function __fieldscribe_words
    set -l typed (commandline -opc)
    set -l known ($typed[1] completion words -- $typed[2..-1] (commandline -ct) 2>/dev/null)
    if set -q known[1]
        printf '%s\\n' $known
    else
        __fish_complete_path (commandline -ct)
    end
end
complete -c fieldscribe -f -a '(__fieldscribe_words)'
""",
}
"""The script of each shell; it runs `fieldscribe completion words -- WORD...` for each tab."""


def add_completion_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("shell", choices=(*SCRIPTS, "words"), metavar="SHELL", help="bash, zsh or fish (their scripts call `words`)")
    add("typed", nargs="*", default=[], metavar="WORD", help="with `words`: what is typed, the last word in part")


def run_completion(arguments: Namespace) -> int:
    """Print the script of the shell, or the completions of typed words, and return the exit code."""
    if arguments.shell == "words":
        words = (word for word in completions(arguments.typed) if word.isprintable())
        sys.stdout.writelines(f"{word}\n" for word in words)
    else:
        sys.stdout.write(SCRIPTS[arguments.shell])
    return FINE


def completions(typed: Sequence[str]) -> list[str]:
    """Return the words that may replace the last one; none if it may be a file, or nothing is known."""
    words = [word for place, word in enumerate(typed) if word != "=" or place + 1 == len(typed)]  # bash splits at `=`
    *before, word = [text.strip() for text in words] or [""]
    if not before:
        return _starting_with(word, (*cli.COMMANDS, "--help", "--version"))
    return _CommandLine(before[0], before[1:]).completions(word) if before[0] in cli.COMMANDS else []


def _starting_with(word: str, known: Iterable[str]) -> list[str]:
    return [name for name in dict.fromkeys(known) if name.casefold().startswith(word.casefold())]


class _CommandLine:
    """The words of a command before the completed one."""

    def __init__(self, command: str, before: list[str]) -> None:
        parser = ArgumentParser(prog=command, add_help=True)
        cli.command_named(command).add_arguments(parser)
        actions: list[Action] = parser._actions  # argparse offers no other way
        self._options = {name: action for action in actions for name in action.option_strings}
        self._positionals = [action for action in actions if not action.option_strings]
        self._given: list[str] = []
        self._open_option: Action | None = None
        self._folder: Path | None = None
        for word in before:
            self._take(word)

    def _take(self, word: str) -> None:
        option = self._options.get(word)
        if self._open_option is not None:
            self._folder = Path(word) if self._open_option.dest == "descriptions" else self._folder
            self._open_option = None
        elif option is not None:
            self._open_option = option if option.nargs != 0 else None
        elif not word.startswith("-"):
            self._given.append(word)

    def completions(self, word: str) -> list[str]:
        """Return the words that may replace `word` at the end of the line."""
        name, equals, value = word.partition("=")
        if equals and name in self._options:
            return [f"{name}={known}" for known in _starting_with(value, self._values(self._options[name]))]
        if self._open_option is not None:
            return _starting_with("" if word == "=" else word, self._values(self._open_option))
        if word.startswith("-"):
            return _starting_with(word, self._options)
        place = min(len(self._given), len(self._positionals) - 1)
        return _starting_with(word, self._values(self._positionals[place])) if place >= 0 else []

    def _values(self, action: Action) -> Iterable[str]:
        """Return the values that an argument takes, as far as they are known."""
        if action.choices is not None:
            return [str(choice) for choice in action.choices]
        metavar = str(action.metavar or "")
        if metavar in ("DEVICE", "PATH"):
            return self._devices()
        if metavar in ("POINT", "POINT|GROUP", "WHAT"):
            return self._points()
        return [f"{name}=" for name in self._points()] if metavar.startswith("POINT=") else []

    def _devices(self) -> dict[str, Path]:
        """Return the devices whose folders have the name of an id; others cannot be one word on a command line."""
        known = known_devices(default_folders() if self._folder is None else [self._folder])
        return {name: file for name, file in known.items() if re.fullmatch(ID.pattern, name)}

    def _points(self) -> Iterable[str]:
        """Return the names and codes of the points of the device that is named before."""
        known = self._devices()
        file = next((known[word] for word in self._given if word in known), None)
        summary = None if file is None else summary_of(file)
        return () if summary is None else summary.names
