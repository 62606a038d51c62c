"""Hold the offline brain against orders that others wrote, where that data is at hand.

The judge reads category, expectation and the names in the sentence; no brain's parser. The half
that was held out while the grammar was written is printed apart (`pytest -s`).
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from pathlib import Path

import pytest

from planner.brain import OfflineBrain
from pons.evals.score import score
from pons.evals.suites import HELD_OUT, TUNED, Suite
from tools.evals.outside import DATA, chinese, gpsr

needs_data = pytest.mark.skipif(
    not DATA.is_dir(),
    reason=f"the orders of others are not here: no {DATA.name} beside the checkout",
)


@needs_data
@pytest.mark.parametrize(("make", "count"), [(gpsr, 700), (chinese, 60)])
def test_outcomes_are_allowed_and_no_motion_is_wrong(
    make: Callable[[Path], Suite], count: int
) -> None:
    suite = make(DATA)
    verdicts = asyncio.run(score(suite, OfflineBrain()))
    for split in (TUNED, HELD_OUT):
        half = [verdict for verdict in verdicts if verdict.case.split == split]
        print(f"{suite.name}, {split}: {sum(v.right for v in half)} of {len(half)}")
    assert len(verdicts) == count
    assert [(verdict.case.text, verdict.wrong) for verdict in verdicts if verdict.wrong] == []
    assert sum(verdict.right for verdict in verdicts) >= 0.95 * len(verdicts)
