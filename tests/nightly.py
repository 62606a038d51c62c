"""Of what is marked nightly the gate runs a sample, drawn by the run's seed; a night runs all.

Owns the mark ``nightly(keep=0)`` and the option ``--gate``.
"""

from __future__ import annotations

import random

import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
    """Let a run be the gate's."""
    parser.addoption(
        "--gate", action="store_true", help="of what is marked nightly, run as many as it keeps"
    )


class Sampled:
    """Take from a run of the gate what it leaves to the night."""

    def __init__(self, config: pytest.Config) -> None:
        # What failed is run again, whichever draw it is.
        self._samples = config.getoption("gate") and not config.getoption("lf", default=False)
        self._config = config

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """Deselect it, of what -m and -k chose. Processes of xdist share a seed, and so a draw."""
        if not self._samples:
            return
        left = left_to_the_night(items, self._config.getoption("randomly_seed", default=0))
        self._config.hook.pytest_deselected(items=[item for item in items if item in left])
        items[:] = [item for item in items if item not in left]


def left_to_the_night(items: list[pytest.Item], seed: object) -> set[pytest.Item]:
    """Return what the gate leaves out under this seed.

    Marked is a function with its cases, or a module with its tests: of these so many are kept.
    """
    marked: dict[str, tuple[int, list[pytest.Item]]] = {}
    for item in items:
        if mark := item.get_closest_marker("nightly"):
            name = item.nodeid.split("[" if mark in item.own_markers else "::")[0]
            marked.setdefault(name, (mark.kwargs.get("keep", 0), []))[1].append(item)
    left = set[pytest.Item]()
    for name, (keep, its) in marked.items():
        its.sort(key=lambda item: item.nodeid)
        random.Random(f"{seed} {name}").shuffle(its)
        left.update(its[keep:])
    return left
