"""Two whole robots that meet in a door one robot wide both come through it, and touch nothing."""

from __future__ import annotations

import pytest

from tools.fleet_trial.doorway import LIMIT_S, drive

pytestmark = pytest.mark.nightly


@pytest.mark.slow
@pytest.mark.timeout(900)
def test_one_out_of_the_kitchen_and_one_into_it_both_arrive() -> None:
    came = drive(402_000, "both_ways")
    assert came["states"] == ["succeeded", "succeeded"]
    assert (came["contacts"], came["deadlock"]) == (0, False)
    assert came["seconds"] < LIMIT_S
