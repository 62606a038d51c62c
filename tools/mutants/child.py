"""Put one mutant into this process, which was forked for it.

A function's code is replaced in the live function. A constant is replaced in every module that
took it by name, where it and what its module makes of it are plain values. All else, tables and
classes, needs core and tests imported anew.
"""

from __future__ import annotations

import ast
import importlib.util
import re
import sys
from enum import Enum
from types import CodeType, FunctionType, ModuleType

import pytest

from tools.mutants.line_tests import LineTests, fails, file_of, plain

PYTEST = ["-q", "-x", "-s", "--assert=plain", "-p", "no:randomly", "-p", "no:cacheprovider"]
OURS = ("bridge.", "tests", "tools.lockstep")
PACKAGE = "bridge.core."


def function_at(module: ModuleType, qualname: str) -> tuple[FunctionType, str] | None:
    """Return the live function that holds a function of this name, and its own name."""
    while qualname:
        found: object = module
        for part in qualname.split("."):
            found = vars(found).get(part) if hasattr(found, "__dict__") else None
        for inner in ("fget", "func", "__func__", "__wrapped__"):
            found = getattr(found, inner, found)
        if isinstance(found, FunctionType):
            return found, qualname
        qualname = qualname.rpartition(".")[0]
    return None


def put_function(function: FunctionType, qualname: str, code: CodeType) -> None:
    """Give a live function the code that it has in a module's code."""
    for part in qualname.split("."):
        code = next(c for c in code.co_consts if isinstance(c, CodeType) and c.co_name == part)
    function.__code__ = code


def put_constants(module: ModuleType, code: CodeType) -> dict[str, set[int]] | None:
    """Replace a module's changed constants wherever they are known by name.

    Returns the lines that name one of them, by module; None where something else has changed too.
    """
    made: dict[str, object] = {"__name__": module.__name__, "__file__": module.__file__}
    exec(code, made)  # the mutant, compiled here
    changed: dict[str, object] = {}
    for name, value in made.items():
        live = vars(module).get(name)
        if name.startswith("__") or isinstance(value, FunctionType | type | ModuleType):
            continue
        if live is not value and live != value:
            if not _plain(live, module.__name__) or not _plain(value, module.__name__):
                return None
            changed[name] = value
    lines: dict[str, set[int]] = {}
    for name, value in changed.items():
        live = vars(module)[name]
        for other in [m for key, m in sys.modules.items() if key.startswith(OURS)]:
            if vars(other).get(name) is live:
                setattr(other, name, value)
                if other.__name__.startswith(PACKAGE):
                    lines.setdefault(other.__name__.removeprefix(PACKAGE), set()).update(
                        _naming(other, name)
                    )
    return lines or None


def _plain(value: object, module: str) -> bool:
    if isinstance(value, tuple | frozenset):
        return all(_plain(one, module) for one in value)
    if isinstance(value, Enum):
        return type(value).__module__ != module
    if isinstance(value, FunctionType):
        return value.__module__ != module
    return value is None or isinstance(value, int | float | str | bool)


def _naming(module: ModuleType, name: str) -> set[int]:
    source = file_of(module.__name__.removeprefix(PACKAGE)).read_text("utf-8")
    word = re.compile(rf"\b{name}\b")
    held: set[int] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.FunctionDef):
            text = "\n".join(source.splitlines()[node.lineno - 1 : node.end_lineno])
            if word.search(text):
                held.update(range(node.lineno, (node.end_lineno or node.lineno) + 1))
    return held


class Anew:
    """Be pytest's run loop in the process of a mutant that needs all imported anew."""

    failed = False

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """Run all tests without hypothesis until one fails."""
        items = plain(session.items)
        following = [*items[1:], None]
        self.failed = any(fails(one, after) for one, after in zip(items, following, strict=True))
        return True


def import_anew(module: str, code: CodeType, stages: list[list[str]], chosen: str) -> bool:
    """Import core and tests again with one module changed; tell whether a test of them fails."""
    for loaded in [one for one in sys.modules if one.startswith(OURS)]:
        del sys.modules[loaded]

    class MutantImporter:
        def find_spec(self, wanted: str, *_: object) -> object:
            return importlib.util.spec_from_loader(wanted, self) if wanted == module else None  # type: ignore[arg-type]  # a loader by its methods

        def create_module(self, _: object) -> None:
            return None

        def exec_module(self, made: ModuleType) -> None:
            made.__file__ = str(file_of(module.removeprefix(PACKAGE)))
            exec(code, made.__dict__)  # the mutant, compiled here

    sys.meta_path.insert(0, MutantImporter())  # type: ignore[arg-type]  # a finder by its method
    for files in stages:
        loop = Anew()
        ended = pytest.main([*PYTEST, "-m", chosen, *files], plugins=[loop])
        if loop.failed or ended not in {pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED}:
            return True
    return False


def files_first(walked: LineTests, name: str) -> list[list[str]]:
    """Return the files of tests in two stages: the quickest that walk the module, then the rest."""
    whole: dict[str, float] = {}
    near: set[str] = set()
    own = name.rpartition(".")[2]
    walks = {key for keys in walked.lines.get(name, {}).values() for key in keys}
    for key, item in walked.items.items():
        file = str(item.path)
        whole[file] = whole.get(file, 0.0) + walked.took[key]
        if key in walks or own in item.path.stem:
            near.add(file)
    order = sorted(whole, key=lambda file: (own not in file, whole[file]))
    first = [file for file in order if file in near or not near][:6]
    return [first, [file for file in order if file not in first]]
