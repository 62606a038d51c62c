"""Hold the core's files apart: imports run one way, and each field of the state has one writer."""

from __future__ import annotations

import ast
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

from bridge import core

ROOT = Path(core.__file__).parent


@cache
def trees() -> dict[str, ast.Module]:
    """Return each module of the core, by its dotted name below bridge.core."""
    return {
        ".".join(path.relative_to(ROOT).with_suffix("").parts): ast.parse(path.read_text("utf-8"))
        for path in sorted(ROOT.rglob("*.py"))
        if path.name != "__init__.py"
    }


def imports_of(tree: ast.Module) -> set[str]:
    """Return the modules of the core that a module imports, under TYPE_CHECKING too."""
    found: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("bridge.core"):
            below = (node.module or "").removeprefix("bridge.core").removeprefix(".")
            for name in (below, *(f"{below}.{alias.name}".lstrip(".") for alias in node.names)):
                if name in trees():
                    found.add(name)
    return found


def test_no_two_files_import_each_other_and_no_more_do_so_in_a_circle() -> None:
    graph = {name: imports_of(tree) for name, tree in trees().items()}
    assert sum(map(len, graph.values())) > 100
    TopologicalSorter(graph).prepare()  # raises CycleError, with the circle
