"""Hold README, the story of a goal and the glossary to the tree: what they name is there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from pons.grammar import parser

FILE = re.compile(r"`((?:planner|bridge|wire|sim|tools|scripts|localization)/[\w/.-]+\.py)`")
COMMAND = re.compile(r"(?<![\w/.-])pons ([a-z]+(?:-[a-z]+)?)\b")
TARGET = re.compile(r"\bmake ([a-z-]+)\b")
WORDS = re.findall(r"^    ([a-z-]+)\b", parser().format_help(), re.MULTILINE)
PAGES = ("README.md", "docs/install.md", "docs/real-robot.md", "docs/a-goal.md")


def read(repository: Path, name: str) -> str:
    return (repository / name).read_text("utf-8")


@pytest.mark.parametrize("name", PAGES)
def test_each_file_that_a_page_names_exists(repository: Path, name: str) -> None:
    named = FILE.findall(read(repository, name))
    assert [path for path in named if not (repository / path).is_file()] == []


def test_the_story_goes_from_the_request_to_the_wheel(repository: Path) -> None:
    hops = FILE.findall(read(repository, "docs/a-goal.md"))
    assert hops.index("planner/api/goals.py") < hops.index("planner/mission/reducer.py")
    assert hops.index("planner/mission/reducer.py") < hops.index("bridge/core/step.py")
    assert hops.index("bridge/core/step.py") < hops.index("bridge/drive/sim.py")


@pytest.mark.parametrize("name", PAGES)
def test_each_command_that_a_page_gives_is_there(repository: Path, name: str) -> None:
    spans = re.findall(r"```sh\n(.*?)```|`([^`\n]+)`", read(repository, name), re.DOTALL)
    text = "\n".join(block or words for block, words in spans)
    assert set(COMMAND.findall(text)) <= set(WORDS)
    targets = re.findall(r"^([a-z0-9-]+):.*## ", read(repository, "Makefile"), re.MULTILINE)
    assert set(TARGET.findall(text)) <= set(targets)


def test_readme_shows_one_picture_one_diagram_and_three_commands(repository: Path) -> None:
    text = read(repository, "README.md")
    (picture,) = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", text)
    assert (repository / picture).stat().st_size <= 400_000
    commands, _diagram = re.findall(r"```(?:sh)?\n(.*?)```", text, re.DOTALL)
    assert len(commands.splitlines()) == 3


def test_the_glossary_has_about_sixty_words_each_once_and_each_with_its_neighbour(
    repository: Path,
) -> None:
    lines = read(repository, "docs/glossary.md").splitlines()
    rows = [line.strip("|").split("|") for line in lines if line.startswith("| ")]
    words = [row[0].strip() for row in rows if row[0].strip() != "our word"]
    assert 55 <= len(words) <= 90
    assert len(set(words)) == len(words)
    assert [row for row in rows if len(row) != 3 or not all(cell.strip() for cell in row)] == []
