"""Know which suites there are, by name: ours beside this file, others' where their data lies."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from pons.evals.cases import MissingSuite, Suite, read_tsv
from pons.evals.external_suites import chinese, gpsr
from pons.evals.world import site_world
from pons_assets import DEFAULT_SITE, ROOT

OURS = Path(__file__).parent / "suites"
TURNS = Path(__file__).parent / "turns"
HOME_SITE = DEFAULT_SITE
DATA = ROOT.parent / "shared" / "data" / "commands"
"""Where the orders of others lie, beside a checkout; --data names another folder."""
SETS = {
    "home": ("home_en", "home_zh"),
    "guard": ("guard_en", "guard_zh"),
    "chat": ("chat_en", "chat_zh"),
    "conditions": ("conditions_en", "conditions_zh"),
    "turns": ("turns_en", "turns_zh"),
    "outside": ("gpsr", "zh"),
}


OTHERS = ("talk", "memory", "orders", "person", "trial", "look")
"""Suites of another form, with readers of their own."""


def suite_names() -> tuple[str, ...]:
    """Return the names of suites and of sets of them."""
    ours = (path.stem for path in sorted(OURS.glob("*.tsv")))
    return (*SETS, *ours, *SETS["turns"], "gpsr", "zh")


def load(name: str, data: Path = DATA, site: Path = HOME_SITE) -> tuple[Suite, ...]:
    """Return the suites of a name, or of a file of our form.

    Args:
        name: one of `known`, or the path of a .tsv file.
        data: the folder of the orders of others.
        site: the site whose names our own suites use.

    Raises:
        MissingSuite: no such suite, or its data is not here.
        SiteError: the site can't be read.
        BadMatcher: a line of the suite can't be read.
    """
    return tuple(_one(part, data, site) for part in SETS.get(name, (name,)))


def _one(name: str, data: Path, site: Path) -> Suite:
    if name in ("gpsr", "zh"):
        return (gpsr(data) if name == "gpsr" else chinese(data)).split_in_half()
    if name in SETS["turns"]:
        turns = read_tsv(TURNS / f"{name.removeprefix('turns_')}.tsv", site_world(site, "study"))
        return replace(turns, name=name)
    path = Path(name) if name.endswith(".tsv") else OURS / f"{name}.tsv"
    if not path.is_file():
        known = ", ".join((*suite_names(), *OTHERS))
        raise MissingSuite(f"no suite {name!r}; known: {known}, or a .tsv file")
    return read_tsv(path, site_world(site, room="study"))
