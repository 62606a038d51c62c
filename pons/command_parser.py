"""Parse words as people know it: examples below the help, and "did you mean" for a wrong word.

Standard library alone; what only an error needs is loaded then.
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, NoReturn

from pons.command_help import HELP

if TYPE_CHECKING:
    from collections.abc import Iterable


class PlainHelp(argparse.HelpFormatter):
    """Fill paragraphs to the terminal's width, and leave lines that are set in as they are."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        fill = super()._fill_text
        lines = text.splitlines()
        return "\n".join(
            f"{indent}{line}" if line.startswith(" ") or not line else fill(line, width, indent)
            for line in lines
        )


class CommandParser(argparse.ArgumentParser):
    """Parse one command's words; ``examples`` stand below its help."""

    def __init__(
        self, *, prog: str | None = None, description: str | None = None,
        examples: Iterable[str] = (), epilog: str | None = None, add_help: bool = True,
    ) -> None:  # fmt: skip
        shown = "\n".join(["examples:", *(f"  {example}" for example in examples)])
        super().__init__(
            prog=prog,
            description=description,
            epilog=epilog or (shown if examples else None),
            add_help=add_help,
            formatter_class=PlainHelp,
        )

    def _check_value(self, action: argparse.Action, value: object) -> None:
        """Refuse a word that is none of the choices, by the nearest of them.

        Raises:
            ArgumentError: it is none of them.
        """
        if action.choices is None or value in action.choices:
            return
        from difflib import get_close_matches

        known = [str(choice) for choice in action.choices]
        near = get_close_matches(str(value), known, n=3, cutoff=0.5)
        listed = ", ".join(known)
        hint = f"did you mean {' or '.join(near)}?" if near else f"there are: {listed}"
        raise argparse.ArgumentError(action, f"{str(value)!r} is unknown; {hint}")

    def error(self, message: str) -> NoReturn:
        """Say what is wrong in a line, and where the help is; exit status 2."""
        self.exit(2, f"{self.prog}: {message}\n`{self.prog} --help` says more.\n")


def add_command(
    words: argparse._SubParsersAction[CommandParser], name: str, *, reads_own: bool = False
) -> CommandParser:
    """Add a command with the help that HELP has for it."""
    line, sentences, examples = HELP[name]
    if reads_own:
        return words.add_parser(name, help=line, add_help=False)
    return words.add_parser(name, help=line, description=sentences, examples=examples)
