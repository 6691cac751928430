"""`fieldscribe completion`: what makes a shell complete commands, options, devices and points."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

HELP = "print what makes a shell complete commands, options, devices and points"
EXAMPLE = """examples:
  fieldscribe completion bash > ~/.local/share/bash-completion/completions/fieldscribe
  fieldscribe completion zsh > ~/.zfunc/_fieldscribe
  fieldscribe completion fish > ~/.config/fish/completions/fieldscribe.fish

For zsh, ~/.zfunc must be in fpath before compinit runs. Or for the running shell alone:
  source <(fieldscribe completion bash)

ends with 2 for a shell that it does not know"""

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


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    parser.add_argument(
        "shell", choices=(*SCRIPTS, "words"), metavar="SHELL", help="bash, zsh or fish (words answers their scripts)"
    )
    parser.add_argument(
        "typed", nargs="*", metavar="WORD", help="with words: what is typed so far, the last one in part"
    )


def run(arguments: Namespace) -> int:
    """Print it; the exit code."""
    import sys

    from fieldscribe.cli import FINE

    if arguments.shell == "words":
        from fieldscribe.cli.completing import candidates

        words = (word for word in candidates(arguments.typed) if word.isprintable())
        sys.stdout.writelines(f"{word}\n" for word in words)
    else:
        sys.stdout.write(SCRIPTS[arguments.shell])
    return FINE
