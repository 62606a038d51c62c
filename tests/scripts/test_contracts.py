"""Check that the import contracts name what they are there for, as modules come and go."""

from __future__ import annotations

import ast
import configparser
import graphlib
from collections.abc import Mapping, Set
from pathlib import Path

import grimp
import pytest

DECIDERS = (("bridge/core", "step"), ("planner/mission", "advance"))
"""Where a pure decision lives, and the name of the function that takes it."""


@pytest.fixture(scope="module")
def contracts(repository: Path) -> configparser.ConfigParser:
    """Return .importlinter as it is read."""
    parser = configparser.ConfigParser()
    parser.read(repository / ".importlinter")
    return parser


def defining(folder: Path, function: str) -> list[Path]:
    """Return the files below a folder that define a function at their top level."""
    return [
        path
        for path in sorted(folder.rglob("*.py"))
        if any(
            isinstance(node, ast.FunctionDef) and node.name == function
            for node in ast.parse(path.read_text()).body
        )
    ]


@pytest.mark.parametrize(("folder", "function"), DECIDERS)
def test_who_decides_is_held_pure(
    repository: Path, contracts: configparser.ConfigParser, folder: str, function: str
) -> None:
    pure = contracts["importlinter:contract:pure-cores"]["source_modules"].split()
    modules = [
        ".".join(path.relative_to(repository).with_suffix("").parts)
        for path in defining(repository / folder, function)
    ]
    assert modules, f"no {function}() below {folder}: was it renamed? then rename it here too"
    loose = [
        module
        for module in modules
        if not any(module == name or module.startswith(f"{name}.") for name in pure)
    ]
    assert not loose, f"add to the pure-cores contract of .importlinter: {loose}"


def test_every_package_is_under_contract_and_installed(
    repository: Path, contracts: configparser.ConfigParser
) -> None:
    packages = {path.parent.name for path in repository.glob("*/__init__.py")}
    assert packages == set(contracts["importlinter"]["root_packages"].split())
    pyproject = (repository / "pyproject.toml").read_text()
    assert {name for name in packages if f'"{name}*"' not in pyproject} == {"tools"}


def find_circle(imports: Mapping[str, Set[str]]) -> list[str]:
    """Return modules of which each imports the next, and the last the first; none: an empty list.

    One circle, not all of them: the next is found once this one is gone.
    """
    try:
        graphlib.TopologicalSorter(imports).prepare()
    except graphlib.CycleError as error:
        return list(reversed(error.args[1][1:]))
    return []


def test_no_two_modules_import_each_other_not_even_for_types(
    contracts: configparser.ConfigParser,
) -> None:
    packages = contracts["importlinter"]["root_packages"].split()
    graph = grimp.build_graph(*packages, exclude_type_checking_imports=False, cache_dir=None)
    imports = {each: graph.find_modules_directly_imported_by(each) for each in graph.modules}
    assert len(imports) > 500, "all packages are read"
    assert find_circle(imports) == []


@pytest.mark.parametrize(
    ("imports", "circle"),
    [({"a": "bc", "b": "c"}, ""), ({"a": "b", "b": "a"}, "ab"),
     ({"a": "b", "b": "c", "c": "db", "d": "c"}, "bcd"), ({"a": "b", "b": "c", "c": "a"}, "abc")],
)  # fmt: skip
def test_a_circle_of_any_length_is_found(imports: dict[str, str], circle: str) -> None:
    found = find_circle({name: set(imported) for name, imported in imports.items()})
    assert set(found) <= set(circle)
    assert bool(found) == bool(circle)
    for importer, imported in zip(found, [*found[1:], *found[:1]], strict=True):
        assert imported in imports[importer]
