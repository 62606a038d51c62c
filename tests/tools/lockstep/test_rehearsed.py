"""What is rehearsed is what is driven: metres within 5 %, seconds within 15 %."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from tests.tools.lockstep.rehearsals import drive, rehearse, simulate
from tools.lockstep import LockstepWorld

METRES, SECONDS = 0.05, 0.15


@pytest.mark.parametrize(
    "order",
    ["go to the living room", "go to the sofa, wait 2 seconds, then go home",
     "go forward 0.5 metres", "turn left 200 degrees, then go to the kitchen"],
)  # fmt: skip
def test_a_drive_takes_what_its_rehearsal_told(
    ready: Callable[..., LockstepWorld], order: str
) -> None:
    world = ready(seed=1)
    told = rehearse(world, order)
    assert told.is_whole
    tried = simulate(world, order)
    ended, way_m, took_s = drive(world, order)
    assert ended == "succeeded", world.describe()
    assert told.length_m == pytest.approx(way_m, rel=METRES)
    assert told.seconds == pytest.approx(took_s, rel=SECONDS)
    assert [step.outcome for step in tried.steps] == ["succeeded"] * len(tried.steps)
    assert tried.length_m == pytest.approx(way_m, rel=METRES)
    assert tried.seconds == pytest.approx(took_s, rel=SECONDS)
    assert tried.contacts == world.contacts == 0


def test_a_rehearsal_moves_nothing_and_leaves_no_goal(ready: Callable[..., LockstepWorld]) -> None:
    world = ready(seed=1)
    told = rehearse(world, "go to the living room")
    assert told.narrowest_m == pytest.approx(1.0, abs=0.06), "the door between the rooms"
    world.run(0.5)
    assert world.standing
    assert not world.planner.book.missions


def test_a_way_without_room_is_shut_as_the_drive_would_find(
    ready: Callable[..., LockstepWorld],
) -> None:
    world = ready(seed=1)
    told = rehearse(world, "go forward 9 metres")
    assert (told.steps[0].does, told.steps[0].code) == ("shut", "no_room")
    assert drive(world, "go forward 9 metres")[0] == "failed"
