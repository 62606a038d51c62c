"""Know a person's terminal: its language, its colours, and the path by which ``pons`` is called.

Standard library alone and quick to import: an order to stop passes by here.
"""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import TextIO

LOCALE = ("LC_ALL", "LC_MESSAGES", "LANG")
"""The first of these that is set names the language (POSIX)."""
_COLOURS = {"red": 31, "green": 32, "yellow": 33, "blue": 34, "bold": 1, "dim": 2}


def speaks_chinese() -> bool:
    """Return whether the person's locale is Chinese; English is said in every other."""
    said = next((given for name in LOCALE if (given := os.environ.get(name))), "")
    return said.lower().startswith("zh")


def pick(english: str, chinese: str) -> str:
    """Return the one sentence of a pair that this person reads."""
    return chinese if speaks_chinese() and chinese else english


def pick_of(told: Mapping[str, str]) -> str:
    """Return the one sentence of a message by language; empty where it has none."""
    return pick(str(told.get("en", "")), str(told.get("zh", "")))


def refusal(error: Exception, told: Mapping[str, str]) -> str:
    """Return a refusal in the one language: its code stays, whoever reads it.

    English has the facts in the error itself, and the planner's sentence below where that adds one.
    """
    line = str(error)
    if speaks_chinese() and told.get("zh"):
        return f"{line.partition(': ')[0]}: {told['zh']}"
    return line + below(line, told)


def below(line: str, told: Mapping[str, str]) -> str:
    """Return a sentence to print below a line, set in; empty where the line says it already."""
    sentence = pick_of(told)
    return f"\n  {sentence}" if sentence and sentence not in line else ""


def paint(text: str, colour: str, stream: TextIO | None = None) -> str:
    """Return text in a colour where the stream is a terminal, and NO_COLOR is not set."""
    shown = sys.stdout if stream is None else stream
    plain = os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb"
    return text if plain or not shown.isatty() else f"\x1b[{_COLOURS[colour]}m{text}\x1b[0m"


def command_path() -> str:
    """Return how a person calls this very command from here: by its name, or by a path."""
    here = os.path.join(os.path.dirname(sys.executable), "pons")  # noqa: PTH118, PTH120  # as below
    folders = os.environ.get("PATH", os.defpath).split(os.pathsep)
    named = (os.path.join(folder, "pons") for folder in folders)  # noqa: PTH118  # quick to import
    first = next((path for path in named if os.access(path, os.X_OK)), None)
    if first is not None and (not os.path.exists(here) or os.path.samefile(first, here)):  # noqa: PTH110, PTH121
        return "pons"
    if not os.path.exists(here):  # noqa: PTH110
        return f"{sys.executable} -m pons"
    from_here = os.path.relpath(here)
    return here if from_here.startswith("..") else from_here
