"""Shells: the command line as data, and the scripts by which bash, zsh and fish complete it."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Argument:
    """An option by its flags, or an argument without any: what it takes, by name, and what completes that.

    `place` is scene, folder, file or nothing; where there are `choices` these complete it.
    """

    flags: tuple[str, ...]
    says: str
    takes: str
    place: str
    choices: tuple[str, ...]

    @property
    def by_place(self) -> bool:
        """Whether it stands without a flag."""
        return not self.flags


@dataclass(frozen=True)
class Command:
    """A subcommand with all that may follow it."""

    name: str
    says: str
    arguments: tuple[Argument, ...]

    @property
    def flags(self) -> list[str]:
        """All its options."""
        return [flag for argument in self.arguments for flag in argument.flags]


# --- bash ----------------------------------------------------------------------------------------------------------

BASH = """\
# bash completion for graphplan: source <(graphplan completion bash)
_graphplan_words() {{ COMPREPLY+=($(compgen -W "$*" -- "$word")); }}
_graphplan_folder() {{ COMPREPLY+=($(compgen -d -- "$word")); }}
_graphplan_file() {{ COMPREPLY+=($(compgen -f -- "$word")); }}
_graphplan_scene() {{
    _graphplan_words {scenes}
    COMPREPLY+=($(compgen -f -X '!*.toml' -- "$word"))
    _graphplan_folder
}}
_graphplan() {{
    local IFS=$'\\n' word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}
    if [[ $word == "=" ]]; then word=""; elif [[ $before == "=" ]]; then before=${{COMP_WORDS[COMP_CWORD-2]}}; fi
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then _graphplan_words {commands}; return; fi
    case "${{COMP_WORDS[1]}} $before" in
{options}
    esac
    case "${{COMP_WORDS[1]}} $word" in
{flags}
    esac
    case "${{COMP_WORDS[1]}}" in
{places}
    esac
}}
complete -o filenames -F _graphplan graphplan
"""


def bash(commands: Sequence[Command], scenes: Sequence[str]) -> str:
    """The script for bash."""
    options, flags, places = [], [], []
    for command in commands:
        flags.append(f'        "{command.name} -"*) _graphplan_words {" ".join(command.flags)}; return ;;')
        for argument in command.arguments:
            if argument.takes and not argument.by_place:
                case = "|".join(f'"{command.name} {flag}"' for flag in argument.flags)
                options.append(f"        {case}) {_in_bash(argument)}; return ;;")
        found = "; ".join(_in_bash(argument) for argument in command.arguments if argument.by_place)
        places += [f"        {command.name}) {found} ;;"] if found else []
    names = (command.name for command in commands)
    return BASH.format(scenes=" ".join(scenes), commands=" ".join(names), options="\n".join(options),
                       flags="\n".join(flags), places="\n".join(places))


def _in_bash(argument: Argument) -> str:
    """What completes an argument in bash."""
    if argument.choices:
        return f"_graphplan_words {' '.join(argument.choices)}"
    return f"_graphplan_{argument.place}" if argument.place else ":"


# --- zsh -----------------------------------------------------------------------------------------------------------

ZSH = """\
#compdef graphplan
# zsh completion for graphplan: source <(graphplan completion zsh), or a file _graphplan in a folder of $fpath
_graphplan_scene() {{
    _alternative 'packaged:packaged scene:({scenes})' 'files:scene file:_files -g "*.toml"'
}}
_graphplan() {{
    local -a commands=(
{commands}
    )
    if ((CURRENT == 2)); then _describe command commands; return; fi
    local command=$words[2]
    shift words
    ((CURRENT--))
    case $command in
{cases}
    esac
}}
if [[ $funcstack[1] == _graphplan ]]; then _graphplan "$@"; else compdef _graphplan graphplan; fi
"""


def zsh(commands: Sequence[Command], scenes: Sequence[str]) -> str:
    """The script for zsh."""
    said = [f"        {shlex.quote(command.name + ':' + command.says)}" for command in commands]
    cases = []
    for command in commands:
        options = [spec for argument in command.arguments for spec in _in_zsh(argument)]
        specs = " \\\n            ".join([*options, *_by_place_in_zsh(command)])
        cases.append(f"        {command.name}) _arguments -s \\\n            {specs} ;;")
    return ZSH.format(scenes=" ".join(scenes), commands="\n".join(said), cases="\n".join(cases))


def _completed_in_zsh(argument: Argument) -> str:
    """What completes an argument in zsh."""
    places = {"scene": "_graphplan_scene", "folder": "_files -/", "file": "_files", "": " "}
    return f"({' '.join(argument.choices)})" if argument.choices else places[argument.place]


def _by_place_in_zsh(command: Command) -> list[str]:
    """The arguments without a flag as `_arguments` reads them: as one, which what is known of the last completes."""
    found = [argument for argument in command.arguments if argument.by_place]
    names = " or ".join(argument.takes for argument in found)
    return [shlex.quote(f"*:{names}:{_completed_in_zsh(found[-1])}")] if found else []


def _in_zsh(argument: Argument) -> list[str]:
    """An option as `_arguments` reads it: once for each of its flags, which exclude each other."""
    value = f":{argument.takes}:{_completed_in_zsh(argument)}" if argument.takes else ""
    says = argument.says.replace("[", "\\[").replace("]", "\\]")
    others = f"({' '.join(argument.flags)})"
    ends = [("=" if flag.startswith("--") else "+") if argument.takes else "" for flag in argument.flags]
    return [shlex.quote(f"{others}{flag}{end}[{says}]{value}")
            for flag, end in zip(argument.flags, ends, strict=True)]


# --- fish ----------------------------------------------------------------------------------------------------------

FISH = """\
# fish completion for graphplan: graphplan completion fish | source
complete -c graphplan -f
function __graphplan_scene
    printf '%s\\n' {scenes}
    __fish_complete_path (commandline -ct) | string match -r '.*(?:\\.toml|/)(?:\\t.*)?$'
end
"""


def fish(commands: Sequence[Command], scenes: Sequence[str]) -> str:
    """The script for fish."""
    lines = [f"complete -c graphplan -n __fish_use_subcommand -a {command.name} -d {_quoted(command.says)}"
             for command in commands]
    for command in commands:
        for argument in command.arguments:
            lines.append(f"complete -c graphplan -n '__fish_seen_subcommand_from {command.name}' {_in_fish(argument)}")
    return FISH.format(scenes=" ".join(scenes)) + "\n".join(lines) + "\n"


def _in_fish(argument: Argument) -> str:
    """An argument as `complete` reads it."""
    places = {"scene": "(__graphplan_scene)", "folder": "(__fish_complete_directories)",
              "file": "(__fish_complete_path)", "": ""}
    values = _quoted(" ".join(argument.choices) or places[argument.place])
    if argument.by_place:
        return f"-a {values}"
    flags = " ".join(f"-l {flag[2:]}" if flag.startswith("--") else f"-s {flag[1:]}" for flag in argument.flags)
    return f"{flags} -d {_quoted(argument.says)}" + (f" -x -a {values}" if argument.takes else "")


def _quoted(text: str) -> str:
    """A text in single quotes, as fish reads them."""
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


SHELLS: dict[str, Callable[[Sequence[Command], Sequence[str]], str]] = {"bash": bash, "zsh": zsh, "fish": fish}
