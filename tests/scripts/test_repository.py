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


@pytest.fixture(scope="module")
def trees(tracked: list[Path]) -> dict[Path, ast.Module]:
    """Return every Python file that git tracks, parsed once."""
    return {path: ast.parse(path.read_text()) for path in tracked if path.suffix == ".py"}


def test_readme_is_short(repository: Path) -> None:
    assert len((repository / "README.md").read_text().splitlines()) <= MAX_README_LINES


def test_files_stay_small(tracked: list[Path]) -> None:
    counts = {path: len(path.read_text().splitlines()) for path in tracked if path.suffix == ".py"}
    assert {str(path): n for path, n in counts.items() if n > MAX_FILE_LINES} == {}


def test_functions_stay_small(trees: dict[Path, ast.Module]) -> None:
    long = []
    for path, tree in trees.items():
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                lines = (node.end_lineno or node.lineno) - node.lineno + 1
                if lines > MAX_FUNCTION_LINES:
                    long.append(f"{path}:{node.lineno} {node.name}: {lines} lines")
    assert not long


def test_every_python_file_opens_with_its_law(trees: dict[Path, ast.Module]) -> None:
    assert [str(path) for path, tree in trees.items() if not ast.get_docstring(tree)] == []


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
