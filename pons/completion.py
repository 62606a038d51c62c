"""Print a script that completes pons in a shell: ``pons completion bash|zsh|fish``.

The script holds every word, so that completing starts no process. Zsh reads bash's by bashcompinit.
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

_BASH = """\
_pons() {{
    local path= word
    for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        case "$path $word" in
{steps}
        esac
    done
    local now="${{COMP_WORDS[COMP_CWORD]}}" words=
    case "$path" in
{choices}
    esac
    COMPREPLY=($(compgen -W "$words" -- "$now"))
    [[ ${{#COMPREPLY[@]}} -gt 0 ]] || COMPREPLY=($(compgen -f -- "$now"))
}}
complete -o filenames -F _pons pons
"""
_ZSH = "#compdef pons\nautoload -U +X bashcompinit && bashcompinit\n"


def run(shell: str) -> int:
    """Print the script; 0."""
    tree = dict(_branches("", grammars()))
    print(
        _fish(tree) if shell == "fish" else (_ZSH if shell == "zsh" else "") + _bash(tree), end=""
    )
    return 0


def grammars() -> argparse.ArgumentParser:
    """Return the whole grammar, with that of the commands that read their own words."""
    from pons import mapping, robot, site_grammar, skill_command
    from pons.grammar import MAP, ROBOT, SITE, SKILL, parser

    top = parser()
    commands = _commands(top)
    commands[ROBOT], commands[SKILL] = robot.parser(), skill_command.parser()
    commands[SITE], commands[MAP] = site_grammar.parser(), mapping.parser()
    return top


def _commands(grammar: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    """Return the commands below a grammar, by name; may be changed."""
    for action in grammar._actions:  # noqa: SLF001  # argparse has no public list of them
        if isinstance(action, argparse._SubParsersAction):  # noqa: SLF001
            found: dict[str, argparse.ArgumentParser] = action.choices
            return found
    return {}


def _branches(
    path: str, grammar: argparse.ArgumentParser
) -> Iterator[tuple[str, dict[str, list[str]]]]:
    """Yield each path of commands with the words that may follow: commands, choices, options."""
    below = _commands(grammar)
    options: list[str] = []
    choices = list(below)
    for action in grammar._actions:  # noqa: SLF001
        options += action.option_strings
        if not below and not action.option_strings and action.choices is not None:
            choices += [str(choice) for choice in action.choices]
    yield path, {"commands": list(below), "choices": choices, "options": options}
    for name, branch in below.items():
        yield from _branches(f"{path} {name}", branch)


def _bash(tree: dict[str, dict[str, list[str]]]) -> str:
    steps, choices = [], []
    for path, words in tree.items():
        steps += [
            f'            "{path} {name}") path="{path} {name}";;' for name in words["commands"]
        ]
        shown = " ".join([*words["choices"], *words["options"]])
        choices.append(f'        "{path}") words="{shown}";;')
    return _BASH.format(steps="\n".join(steps), choices="\n".join(choices))


def _fish(tree: dict[str, dict[str, list[str]]]) -> str:
    lines = []
    for path, words in tree.items():
        names = path.split()
        seen = [f"__fish_seen_subcommand_from {name}" for name in names]
        later = " ".join(words["commands"])
        open_still = [f"not __fish_seen_subcommand_from {later}"] if later else []
        when = "; and ".join([*seen, *open_still]) or "true"
        lines += [f'complete -c pons -n "{when}" -a "{word}"' for word in words["choices"]]
        lines += [
            f'complete -c pons -n "{when}" -l {option[2:]}'
            for option in words["options"]
            if option.startswith("--")
        ]
    return "\n".join(lines) + "\n"
