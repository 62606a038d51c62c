"""Let two and three real troubles come at once while the robot moves; judge every tick by hand.

All troubles here are real inputs. Which rows are up is read from the decision; what must follow
from them is the table by hand.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import combinations
from random import Random

import pytest

from tests.bridge.core import oracle
from tests.bridge.core.reached import reached
from tests.bridge.core.scripted import World
from tests.bridge.core.windows import bad_bytes
from wire import STILL, Action, Mode


def driven(**values: object) -> Callable[[World], None]:
    """Return a trouble of the drive."""

    def begin(world: World) -> None:
        for name, value in values.items():
            setattr(world.drive, name, value)

    return begin


def sensed(**values: object) -> Callable[[World], None]:
    """Return a trouble of the world around."""

    def begin(world: World) -> None:
        for name, value in values.items():
            setattr(world, name, value)

    return begin


def silent(world: World) -> None:
    assert world.planner is not None
    world.planner.silent = True


def spent(world: World) -> None:
    world.state.grants = replace(world.state.grants, metres=0.02)


def gap(world: World) -> None:
    world.tick(0.12)


TROUBLES: dict[str, Callable[[World], None]] = {
    "planner silent": silent,
    "lidar silent": sensed(lidar_silent=True),
    "lidar blind": sensed(lidar_blind=True),
    "drive silent": sensed(drive_silent=True),
    "drive deaf": driven(deaf=True),
    "drive reborn": driven(boot_id="d7"),
    "wheels held": driven(runs_on=True, speeds=(0.0, 0.0)),
    "runs away": driven(runs_on=True, speeds=(9.0, 9.0)),
    "lost": sensed(localization_silent=True),
    "gyro wrong": sensed(gyro_off_radps=0.5),
    "battery": driven(battery=0.05),
    "current": driven(current_a=40.0),
    "nonsense": lambda world: bad_bytes(world, 6),
    "spent": spent,
    "gap": gap,
    "pressed": driven(estop_pressed=True),
}


TAKES_TORQUE = {Action.STOP1, Action.FAST1, Action.CUT0}


def watch(world: World, troubles: tuple[str, ...], seconds: float) -> None:
    """Begin all troubles and hold every tick to the laws."""
    for name in troubles:
        TROUBLES[name](world)
    end_s = world.now_s + seconds
    hardest = 0
    while world.now_s < end_s:
        before = world.state
        decision = world.tick()
        after = decision.state
        oracle.check_output(before, decision)
        sure = oracle.worst(set(after.rows), before.source)
        if oracle.ORDER.index(sure) >= oracle.ORDER.index(Action.HOLD2):
            assert after.mode not in oracle.MOVING, (troubles, sure)
        if after.stopping is not None and before.stopping is not None and after.mode is before.mode:
            worse = oracle.ORDER.index(after.stopping.action)
            assert worse >= hardest or before.mode is not Mode.STOPPING
            hardest = worse
        if before.mode in {Mode.ESTOPPED, Mode.FAULT}:
            assert after.mode in {Mode.ESTOPPED, Mode.FAULT}
        if before.mode is Mode.DISARMED:
            assert after.mode in {Mode.DISARMED, Mode.ESTOPPED}
        if "ESTOP.0" in after.rows:
            assert after.mode is Mode.ESTOPPED
        if after.mode is Mode.STOPPING and sure in TAKES_TORQUE:
            assert after.stopping is not None
            assert after.stopping.action in TAKES_TORQUE


@pytest.mark.parametrize("start", ["active", "teleop"])
@pytest.mark.parametrize("first", TROUBLES)
def test_two_troubles_at_once(start: str, first: str) -> None:
    names = list(TROUBLES)
    for second in names[names.index(first) :: 3 if start == "active" else 7]:
        watch(reached(start), (first, second), 0.45)


@pytest.mark.parametrize("seed", range(8))
def test_three_troubles_at_once_end_standing_or_held(seed: int) -> None:
    chance = Random(seed)
    world = reached(chance.choice(["active", "turning", "active_external", "teleop"]))
    watch(world, chance.choice(list(combinations(TROUBLES, 3))), 1.6)
    if world.mode not in oracle.MOVING:
        assert world.sent == STILL
