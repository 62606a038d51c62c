"""Hold the checkout to its house rules. Reads files as text; imports none of them."""

from __future__ import annotations

import ast
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.known import known

MAX_FILE_LINES = 350
MAX_TEST_LINES = 500
"""Also for a file that is one table or one state, named in ONE_TABLE."""
ONE_TABLE = frozenset({"bridge/core/state.py", "bridge/core/faults/detectors.py"})
MAX_FUNCTION_LINES = 60
MAX_README_LINES = 120
BODY = (ast.stmt, ast.ExceptHandler, ast.match_case)
# Split, so that this file does not hold what it looks for.
FOREIGN = re.compile(
    "|".join(["/wo" + "rk/", "/ro" + "ot/", "py" + r"pi\.org", "python" + "hosted"])
)
TEXT = (".py", ".md", ".toml", ".sh", ".yaml", ".yml", ".json", ".lock", ".cfg", "")


@pytest.fixture(scope="module")
def tracked(repository: Path) -> list[Path]:
    """Return the files that git tracks, or skip where there is no git or no checkout."""
    try:
        listed = subprocess.run(
            ["git", "ls-files", "-z"], cwd=repository, capture_output=True, text=True, check=True
        ).stdout
    except (FileNotFoundError, subprocess.CalledProcessError):
        pytest.skip("not a git checkout")
    paths = [repository / name for name in listed.split("\0") if name]
    return [path for path in paths if path.is_file()]


@dataclass(frozen=True)
class Shape:
    """Hold what is asked of one Python file; its tree is large and not kept."""

    lines: int
    law: bool
    functions: dict[str, int]
    """Lines of each, by where it begins and its name."""


@pytest.fixture(scope="module")
def shapes(repository: Path, tracked: list[Path]) -> dict[str, Shape]:
    """Return the shape of every Python file that git tracks."""
    return {
        str(path.relative_to(repository)): shape(path.read_text())
        for path in tracked
        if path.suffix == ".py"
    }


def shape(source: str) -> Shape:
    tree = ast.parse(source)
    functions, left = {}, [tree.body]
    while left:
        for node in left.pop():
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                lines = (node.end_lineno or node.lineno) - node.lineno + 1
                functions[f"{node.lineno} {node.name}"] = lines
            # Functions stand among statements only; there are ten times as many expressions.
            left += [part for _, part in ast.iter_fields(node) if is_body(part)]
    return Shape(len(source.splitlines()), bool(ast.get_docstring(tree)), functions)


def is_body(part: object) -> bool:
    return bool(part) and isinstance(part, list) and isinstance(part[0], BODY)


def test_readme_is_short(repository: Path) -> None:
    assert len((repository / "README.md").read_text().splitlines()) <= MAX_README_LINES


def test_files_stay_small(shapes: dict[str, Shape]) -> None:
    assert {path: it.lines for path, it in shapes.items() if it.lines > most_lines(path)} == {}


def most_lines(path: str) -> int:
    """Return the cap of one Python file."""
    is_wide = path.startswith("tests/") or path in ONE_TABLE
    return MAX_TEST_LINES if is_wide else MAX_FILE_LINES


def test_a_test_of_the_core_stands_where_its_module_does(repository: Path) -> None:
    """Name it test_<module>.py or test_<module>_<idea>.py; laws/ holds those of the whole step."""
    tests = repository / "tests/bridge/core"
    stray = []
    for path in tests.rglob("test_*.py"):
        wing = path.parent.relative_to(tests)
        modules = [f"test_{one.stem}_" for one in (repository / "bridge/core" / wing).glob("*.py")]
        if wing != Path("laws") and not f"{path.stem}_".startswith(tuple(modules)):
            stray.append(str(path.relative_to(tests)))
    assert not stray


def test_functions_stay_small(shapes: dict[str, Shape]) -> None:
    long = [
        f"{path}:{where}: {lines} lines"
        for path, it in shapes.items()
        for where, lines in it.functions.items()
        if lines > MAX_FUNCTION_LINES
    ]
    assert not long


def test_every_function_is_looked_at() -> None:
    inner = "def a():\n  try:\n    pass\n  except E:\n    async def b():\n      pass\n"
    cases = "match c:\n  case 1:\n    class D:\n      def e(self): pass\n"
    assert shape(inner + cases).functions == {"1 a": 6, "5 b": 2, "10 e": 1}


def test_every_python_file_opens_with_its_law(shapes: dict[str, Shape]) -> None:
    assert [path for path, it in shapes.items() if not it.law] == []


def test_no_file_names_a_builder_s_place(tracked: list[Path]) -> None:
    hits = [
        f"{path}: {match.group()}"
        for path in tracked
        if path.suffix in TEXT
        for match in FOREIGN.finditer(path.read_text(errors="replace"))
    ]
    assert not hits


def test_make_help_lists_every_target(repository: Path) -> None:
    makefile = (repository / "Makefile").read_text()
    phony = known(re.search(r"^\.PHONY: (.*)$", makefile, re.MULTILINE))
    printed = subprocess.run(
        ["make"], cwd=repository, capture_output=True, text=True, check=True
    ).stdout
    assert re.findall(r"^  make (\S+)", printed, re.MULTILINE) == phony.group(1).split()


def test_each_decision_record_is_whole(repository: Path) -> None:
    records = sorted((repository / "docs" / "adr").glob("[0-9]*.md"))
    numbers = [int(path.name[:4]) for path in records]
    assert numbers == list(range(len(records))), "numbered without gap or double"
    for path in records:
        text = path.read_text()
        missing = [
            part
            for part in ("Status:", "## Context", "## Decision", "## Consequences")
            if part not in text
        ]
        assert not missing, f"{path.name} lacks {missing}"


def test_links_in_our_pages_lead_somewhere(repository: Path, tracked: list[Path]) -> None:
    pages = [path for path in tracked if path.suffix == ".md"]
    links = [
        (page, target)
        for page in pages
        for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text())
    ]
    broken = [
        f"{page.relative_to(repository)} -> {target}"
        for page, target in links
        if not (page.parent / target).exists()
    ]
    assert not broken


def test_ci_runs_the_two_commands_that_the_readme_gives(repository: Path) -> None:
    script = (repository / ".ci" / "run").read_text().splitlines()
    assert [line for line in script if line.startswith("make ")] == ["make check", "make e2e"]
    assert 'Step("test", ("make", "test"))' in (repository / "scripts" / "check.py").read_text()
    assert "make test" in (repository / "README.md").read_text()
