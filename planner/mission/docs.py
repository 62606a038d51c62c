"""Write the tables of docs/missions.md from the code, so that they state nothing else.

``python -m planner.mission.docs`` writes the part between its two marks; with ``--check`` it fails
if that part differs, with ``--print`` it prints it.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from planner.mission.transitions import ALLOWED, FIRST, TRANSITIONS, api_name
from planner.plan import ENDED, GoalState
from pons_assets import ROOT, checkout

if TYPE_CHECKING:
    from collections.abc import Iterator

PATH = ROOT / "docs" / "missions.md"
BEGIN = (
    "<!-- printed by `python -m planner.mission.docs`: edit planner/mission/transitions.py -->\n"
)
END = "<!-- end of what is printed -->\n"

_HEAD = f"""\
A goal is taken in as `{FIRST.value}`. What is absent from this table is forbidden.

| from | when | to |
|---|---|---|
"""
_COMMANDS = """
A command in any other state is refused (`bad_state`).

| command | state |
|---|---|
"""


def tables_md() -> str:
    """Return both tables: the states of a goal, and the commands that each state allows."""
    return _HEAD + "".join(_transitions()) + _COMMANDS + "".join(_commands())


def _transitions() -> Iterator[str]:
    for state in GoalState:
        if state in ENDED:
            continue
        for (at, cause), after in TRANSITIONS.items():
            if at is state:
                yield f"| `{state.value}` | {cause.value} | `{after.value}` |\n"


def _commands() -> Iterator[str]:
    for command, states in ALLOWED.items():
        names = ", ".join(f"`{state.value}`" for state in GoalState if state in states)
        yield f"| `{api_name(command)}` | {names} |\n"


def with_tables(page: str) -> str:
    """Return a page with the tables as they are now between its marks.

    Raises:
        ValueError: the page has no such marks.
    """
    before, begin, rest = page.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not (begin and end):
        raise ValueError(f"{PATH.name} has no marks; expected {BEGIN!r} and {END!r}")
    return f"{before}{begin}\n{tables_md()}\n{end}{after}"


def main(arguments: list[str]) -> int:
    """Write, check or print the tables."""
    if arguments == ["--print"]:
        print(tables_md(), end="")
        return 0
    checkout("writing docs/missions.md")
    page = PATH.read_text("utf-8")
    fresh = with_tables(page)
    if arguments == ["--check"]:
        if page != fresh:
            print(f"{PATH} is not what the tables say; run python -m planner.mission.docs")
            return 1
        return 0
    PATH.write_text(fresh, "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
