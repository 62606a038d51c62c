"""Hold the table of hazards to the code and the tests that it names."""

from __future__ import annotations

import ast
import importlib
import inspect
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from bridge.core.faults.detectors import DETECTORS
from bridge.core.faults.fault_table import ROWS
from bridge.core.faults.hazards import HAZARDS, LAWS, Hazard
from bridge.core.safety_page import safety_md

HERE = Path(__file__).parents[1]
GATES = ("OBSTACLE", "FENCE", "CONTACT")
ALL = (*HAZARDS, *LAWS)
ROW_HAZARDS = tuple(hazard for hazard in HAZARDS if hazard.guard not in GATES)


def function_of(hazard: Hazard) -> Callable[..., object]:
    module, _, name = hazard.function.rpartition(".")
    found: Callable[..., object] = getattr(importlib.import_module(f"bridge.core.{module}"), name)
    return found


@cache
def sources_in(file: str) -> dict[str, str]:
    """Return the source of each test in a file, by its id without parameters."""
    (path,) = HERE.rglob(file)  # the name is unique
    source = path.read_text("utf-8")
    lines = source.splitlines()
    found: dict[str, str] = {}

    def walk(nodes: list[ast.stmt], prefix: str) -> None:
        for node in nodes:
            if isinstance(node, ast.ClassDef):
                walk(node.body, f"{prefix}{node.name}::")
            elif isinstance(node, ast.FunctionDef) and node.name.startswith("test_"):
                first = min([node.lineno, *(one.lineno for one in node.decorator_list)])
                found[f"{prefix}{node.name}"] = "\n".join(lines[first - 1 : node.end_lineno])

    walk(ast.parse(source).body, "")
    return found


def test_every_row_and_every_gate_has_its_hazard_and_nothing_else_does() -> None:
    assert {hazard.guard for hazard in HAZARDS} == {row.id for row in ROWS} | set(GATES)


def test_every_detector_guards_against_something() -> None:
    assert set(DETECTORS) <= {function_of(hazard) for hazard in HAZARDS}


@pytest.mark.parametrize("hazard", ROW_HAZARDS, ids=lambda hazard: hazard.guard)
def test_a_row_is_raised_by_the_function_that_is_named(hazard: Hazard) -> None:
    assert f'"{hazard.guard}.' in inspect.getsource(function_of(hazard))


@pytest.mark.parametrize("hazard", ALL, ids=lambda hazard: hazard.function)
def test_the_tests_that_are_named_exist(hazard: Hazard) -> None:
    assert callable(function_of(hazard))
    assert hazard.tests
    for test in hazard.tests:
        file, _, name = test.partition("::")
        assert name in sources_in(file), f"{file} has {sorted(sources_in(file))}"


@pytest.mark.parametrize("hazard", ROW_HAZARDS, ids=lambda hazard: hazard.guard)
def test_the_tests_of_a_row_name_it(hazard: Hazard) -> None:
    named = re.compile(rf"(?<![A-Z]){hazard.guard}(?![A-Z_])")
    for test in hazard.tests:
        file, _, name = test.partition("::")
        assert named.search(sources_in(file)[name]), f"{test} does not name {hazard.guard}"


def test_the_page_tells_each() -> None:
    page = safety_md()
    for hazard in ALL:
        assert hazard.what in page
        assert f"`{hazard.function}`" in page
        assert all(f"`{test}`" in page for test in hazard.tests)
