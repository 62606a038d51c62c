"""Hold the checkout to its house rules. Reads files as text; imports none of them."""

from __future__ import annotations

import ast
import re
import subprocess
from pathlib import Path

import pytest

MAX_FILE_LINES = 350
MAX_FUNCTION_LINES = 60
MAX_README_LINES = 120
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


def test_readme_is_short(repository: Path) -> None:
    assert len((repository / "README.md").read_text().splitlines()) <= MAX_README_LINES


def test_files_stay_small(tracked: list[Path]) -> None:
    counts = {path: len(path.read_text().splitlines()) for path in tracked if path.suffix == ".py"}
    assert {str(path): n for path, n in counts.items() if n > MAX_FILE_LINES} == {}


def test_functions_stay_small(tracked: list[Path]) -> None:
    long = []
    for path in (path for path in tracked if path.suffix == ".py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                lines = (node.end_lineno or node.lineno) - node.lineno + 1
                if lines > MAX_FUNCTION_LINES:
                    long.append(f"{path}:{node.lineno} {node.name}: {lines} lines")
    assert not long


def test_every_python_file_opens_with_its_law(tracked: list[Path]) -> None:
    files = [path for path in tracked if path.suffix == ".py"]
    assert [str(path) for path in files if not ast.get_docstring(ast.parse(path.read_text()))] == []


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
    phony = re.search(r"^\.PHONY: (.*)$", makefile, re.MULTILINE)
    assert phony is not None
    printed = subprocess.run(
        ["make"], cwd=repository, capture_output=True, text=True, check=True
    ).stdout
    assert re.findall(r"^  make (\S+)", printed, re.MULTILINE) == phony.group(1).split()
