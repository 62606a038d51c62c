"""Own the suites: sentences in one world, each with its expectation. Ours lie beside this file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pons.evals.matchers import BadMatcher, OutcomeJudge, read_expectation
from pons.evals.world import HOME, START, EvalWorld, site_world
from pons_assets import DEFAULT_SITE

OURS = Path(__file__).parent / "suites"
HOME_SITE = DEFAULT_SITE
TUNED, HELD_OUT = "tuned", "held out"
SPLITS = {"tuned": TUNED, "held": HELD_OUT}
COLUMNS = "split (tuned or held), group, sentence, expectation"
SETS = {name: (f"{name}_en", f"{name}_zh") for name in ("home", "guard", "chat", "conditions")}


class MissingSuite(Exception):
    """Nobody's fault here: the suite, or its data, is not on this machine."""


@dataclass(frozen=True, slots=True)
class Case:
    """Hold one sentence and what is expected of it."""

    text: str
    group: str
    wanted: OutcomeJudge
    split: str = TUNED
    told: str = ""
    """What came before it, for people."""
    asked: Mapping[str, Any] = field(default_factory=dict)
    """Fields of the request besides sentence, places and room: what came before, for the brain."""

    @property
    def full_text(self) -> str:
        """Return the sentence with what came before it, for people."""
        return f"{self.text} | {self.told}" if self.told else self.text


@dataclass(frozen=True, slots=True)
class Suite:
    """Hold cases and the world they are planned in."""

    name: str
    world: EvalWorld
    cases: tuple[Case, ...]


def suite_names() -> tuple[str, ...]:
    """Return the names of suites and of sets of them."""
    return (*SETS, *(path.stem for path in sorted(OURS.glob("*.tsv"))))


def load(name: str, site: Path = HOME_SITE) -> tuple[Suite, ...]:
    """Return the suites of a name, or of a file of our form.

    Args:
        name: one of `suite_names`, or the path of a .tsv file.
        site: the site whose names the suites use.

    Raises:
        MissingSuite: there is none of that name.
        SiteError: the site can't be read.
        BadMatcher: a line of the suite can't be read.
    """
    return tuple(_load(part, site) for part in SETS.get(name, (name,)))


def _load(name: str, site: Path) -> Suite:
    path = Path(name) if name.endswith(".tsv") else OURS / f"{name}.tsv"
    if not path.is_file():
        raise MissingSuite(f"no suite {name!r}; known: {', '.join(suite_names())}, or a .tsv file")
    return read_tsv(path, site_world(site, room="study"))


def read_tsv(path: Path, world: EvalWorld) -> Suite:
    """Read a suite of our form.

    Raises:
        BadMatcher: a line can't be read.
    """
    return Suite(path.stem, world, read_rows(path, lambda columns: read_case(columns, world)))


def read_rows(path: Path, read: Callable[[list[str]], Case]) -> tuple[Case, ...]:
    """Read a file's rows by their columns; what is raised names the row.

    Raises:
        BadMatcher: a row can't be read.
    """
    cases = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        try:
            cases.append(read(line.split("\t")))
        except ValueError as wrong:
            raise BadMatcher(f"{path.name}:{number}: {wrong}") from wrong
    return tuple(cases)


def read_case(columns: list[str], world: EvalWorld) -> Case:
    """Read one row. Raises BadMatcher where it can't be read."""
    if len(columns) != COLUMNS.count(", ") + 1:
        raise BadMatcher(f"{len(columns)} columns between tabs; expected 4: {COLUMNS}")
    split, group, text, expected = columns
    wanted = read_expectation(expected)
    if unknown := sorted(wanted.destinations - {START, HOME} - world.vocabulary.by_id.keys()):
        known = ", ".join(world.vocabulary.by_id)
        raise BadMatcher(f"unknown place {', '.join(unknown)}; known: {known}")
    if split not in SPLITS:
        raise BadMatcher(f"unknown split {split!r}; known: {', '.join(SPLITS)}")
    return Case(text, group, wanted, SPLITS[split])
