"""Count what each room of the house holds: ``python -m scripts.rooms [--write]``.

A room is a package, or a part of planner, bridge or pons. Of each: its lines of Python, and its
files that one neighbour of their own folder alone imports, which are usually a part of it. The
bounds stand in tests/scripts/known_rooms.txt and may only shrink: ``--write`` lowers what has
become less and raises nothing. Whoever must raise one writes the new number there by hand, and
behind it the number of the decision in docs/adr that says why.
"""

from __future__ import annotations

import ast
import sys
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from scripts.names import ROOT, list_sources

KNOWN = ROOT / "tests" / "scripts" / "known_rooms.txt"
_PARTED = frozenset({"planner", "bridge", "pons"})
"""Packages whose folders are rooms of their own."""
_PRODUCT_BESIDE = frozenset({"tools", "tests", "scripts", "examples", "deploy"})
"""What the product can do without."""


class RoomCount(NamedTuple):
    """Hold the counts of one room, or their bounds."""

    lines: int = 0
    lone_files: int = 0
    """Imported by one file of their own folder and by nothing else."""
    decision: str = ""
    """The number of the record that raised a bound last; empty where none did."""


def room_of(path: str) -> str:
    """Return the name of the room in which a file stands."""
    top, *rest = Path(path).parts
    return f"{top}/{rest[0]}" if top in _PARTED and len(rest) > 1 else top


def count_rooms(sources: Mapping[str, str]) -> dict[str, RoomCount]:
    """Return the counts of each room.

    Args:
        sources: Python text by path.
    """
    lines: defaultdict[str, int] = defaultdict(int)
    for path, text in sources.items():
        lines[room_of(path)] += text.count("\n")
    lone: defaultdict[str, int] = defaultdict(int)
    for path in find_lone_files(sources):
        lone[room_of(path)] += 1
    return {name: RoomCount(count, lone[name]) for name, count in lines.items()}


def find_lone_files(sources: Mapping[str, str]) -> list[str]:
    """Return the files of the product that one neighbour of their folder alone imports."""
    product = {p: text for p, text in sources.items() if Path(p).parts[0] not in _PRODUCT_BESIDE}
    modules = {path.removesuffix(".py").replace("/", "."): path for path in product}
    importers: defaultdict[str, set[str]] = defaultdict(set)
    for path, text in product.items():
        for name in _imported_names(text):
            target = modules.get(name) or modules.get(name.rpartition(".")[0])
            if target is not None and target != path:
                importers[target].add(path)
    return sorted(
        path
        for path, by in importers.items()
        if len(by) == 1
        and not path.endswith("__init__.py")
        and Path(min(by)).parent == Path(path).parent
        and not min(by).endswith(("__init__.py", "__main__.py"))
    )


def _imported_names(text: str) -> set[str]:
    """Return the dotted names that a file imports, a module's members as members of it."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module is not None:
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return names


def read_bounds(text: str) -> dict[str, RoomCount]:
    """Return the bounds of a list: ``room lines lone_files [decision]`` a line."""
    rows = (line.split() for line in text.splitlines() if line and not line.startswith("#"))
    return {
        name: RoomCount(int(lines), int(lone), *decision) for name, lines, lone, *decision in rows
    }


def find_grown(rooms: Mapping[str, RoomCount], bounds: Mapping[str, RoomCount]) -> list[str]:
    """Return a sentence for each room that is larger than its bound, or has none."""
    said = []
    for name, room in sorted(rooms.items()):
        bound = bounds.get(name)
        if bound is None:
            said.append(f"{name} is a room without a bound: {room.lines} lines")
        elif room.lines > bound.lines:
            said.append(f"{name} has {room.lines} lines, at most {bound.lines} are allowed")
        elif room.lone_files > bound.lone_files:
            said.append(f"{name} has {room.lone_files} lone files, allowed: {bound.lone_files}")
    return said


def main(arguments: list[str]) -> int:
    """Print the table, and with ``--write`` lower the bounds; 1 where a room has grown."""
    text = KNOWN.read_text("utf-8")
    rooms, bounds = count_rooms(list_sources()), read_bounds(text)
    for name, room in sorted(rooms.items()):
        bound = bounds.get(name, RoomCount())
        print(f"{name:24} {room.lines:7} of {bound.lines:7}, {room.lone_files:3} lone files")
    product = sum(r.lines for name, r in rooms.items() if name not in _PRODUCT_BESIDE)
    print(f"{'the product':24} {product:7}")
    if "--write" in arguments:
        head = [line for line in text.splitlines() if line.startswith("#")]
        rows = [_lower(name, bounds[name], rooms[name]) for name in sorted(bounds.keys() & rooms)]
        KNOWN.write_text("\n".join([*head, *rows]) + "\n", "utf-8")
    grown = find_grown(rooms, bounds)
    print(*grown, sep="\n", end="\n" if grown else "")
    return int(bool(grown))


def _lower(name: str, bound: RoomCount, room: RoomCount) -> str:
    lines, lone = min(bound.lines, room.lines), min(bound.lone_files, room.lone_files)
    return f"{name} {lines} {lone} {bound.decision}".rstrip()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
