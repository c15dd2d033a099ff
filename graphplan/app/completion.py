"""Print a script that completes the command line in a shell.

It is made from the commands and options that there are, with the names of the packaged scenes.

examples:
  source <(graphplan completion bash)                                     for ~/.bashrc
  graphplan completion zsh > _graphplan                                   in a folder of $fpath
  graphplan completion fish > ~/.config/fish/completions/graphplan.fish
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from graphplan.app.files import write
from graphplan.mechanism.scene import FOLDER, TASK_FOLDER, packaged_names

SCENES = {  # what completes a scene or task, in each shell: a packaged one, a TOML file, or a folder on the way there
    "bash": """\
_graphplan_{0}_file() {{
    compgen -W "{1}" -- "$1"
    compgen -f -X '!*.toml' -- "$1"
    compgen -d -- "$1"
}}""",
    "zsh": """\
_graphplan_{0}() {{
    _alternative 'packaged:packaged {0}:({1})' 'files:{0} file:_files -g "*.toml"'
}}""",
    "fish": """\
function __graphplan_{0}
    printf '%s\\n' {1}
    __fish_complete_path (commandline -ct) | string match -r '.*(?:\\.toml|/)(?:\\t.*)?$'
end""",
}
FOLDERS = {"scene": FOLDER, "task": TASK_FOLDER}
CALLS = {"bash": "_graphplan_{0}_file", "zsh": "_graphplan_{0}", "fish": "(__graphplan_{0})"}
BASH = """
# in --option=value bash takes the = for a word
_graphplan() {
    local word words=()
    for word in "${COMP_WORDS[@]:0:COMP_CWORD}"; do [[ $word == "=" ]] || words+=("$word"); done
    word=${COMP_WORDS[COMP_CWORD]}
    COMP_WORDS=("${words[@]}" "${word#=}")
    COMP_CWORD=${#words[@]}
    _shtab_graphplan
}
complete -o filenames -F _graphplan graphplan
"""


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("shell", metavar="SHELL", choices=[*SCENES], help="bash, zsh or fish")


def run(options: argparse.Namespace) -> int:
    import shtab

    from graphplan.commands import commands, parser

    whole = parser(tuple(commands()))
    for action in _actions(whole):
        takes = "" if action.nargs == 0 else str(action.metavar or action.dest.upper())
        kinds = {kind.upper(): {shell: call.format(kind) for shell, call in CALLS.items()} for kind in FOLDERS}
        places = {**kinds, "FOLDER": shtab.DIRECTORY, "DRAWING": shtab.FILE}
        place = places.get(takes, shtab.FILE if "FILE" in takes or "." in takes else None)
        if place:
            action.complete = place  # type: ignore[attr-defined]
    scenes = "\n".join(SCENES[options.shell].format(kind, " ".join(packaged_names(folder)))
                       for kind, folder in FOLDERS.items())
    write(shtab.complete(whole, options.shell, preamble=scenes) + (BASH if options.shell == "bash" else ""))
    return 0


def _actions(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    """The options and arguments of all subcommands."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for command in action.choices.values():
                yield from _actions(command)
        else:
            yield action
