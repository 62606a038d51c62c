"""The camera is listened to while somebody wants its pictures, else for a glance at a time."""

from __future__ import annotations

import asyncio

import pytest

from planner.perception import VisionFailure
from planner.perception.frame_source import (
    FROZEN_AFTER,
    PASSING_HZ,
    RESTING_HZ,
    RESTS_AFTER_S,
    SHOWN_S,
    STANDING_HZ,
)
from tests.planner.perception.watching import World


async def test_looks_are_rare_until_somebody_needs_them() -> None:
    world = World()
    for speed_mps, rate_hz in ((0.0, STANDING_HZ), (0.3, PASSING_HZ)):
        world.speed_mps = speed_mps
        await world.film(1.0)
        before, drawn = len(world.detector.looks), world.drawn
        await world.film(10.0)
        assert 8 * rate_hz <= len(world.detector.looks) - before <= 10 * rate_hz + 1
        assert world.drawn - drawn <= 2 * 10 * rate_hz  # it listened for a glance only
    assert all(deep for _, deep in world.detector.looks)
    world.eyes.attend("goal", True)
    before = len(world.detector.looks)
    await world.film(2.0)
    world.eyes.attend("goal", False)
    assert len(world.detector.looks) - before == pytest.approx(20, abs=2)
    assert await world.eyes.show() is world.eyes.picture
    await world.film(2 * SHOWN_S)  # a page looked, and went
    more = 20 + 10 * SHOWN_S + PASSING_HZ * SHOWN_S
    assert len(world.detector.looks) - before == pytest.approx(more, abs=4)


async def test_eyes_of_a_robot_that_stands_rest_until_it_moves_or_somebody_needs_them() -> None:
    world = World()
    world.speed_mps = 0.0
    await world.film(RESTS_AFTER_S + 1 / STANDING_HZ)
    before = len(world.detector.looks)
    await world.film(1 / RESTING_HZ + 1)
    assert len(world.detector.looks) - before == 1
    world.speed_mps = 0.3
    await world.film(2.0)
    world.speed_mps = 0.0
    await world.film(10.0)
    assert len(world.detector.looks) - before >= 1 + 2 * PASSING_HZ - 1 + 10 * STANDING_HZ - 1
    await world.film(RESTS_AFTER_S + 1 / STANDING_HZ)
    before = len(world.detector.looks)
    world.eyes.attend("goal", True)
    await world.film(1.0)
    assert len(world.detector.looks) - before >= 8


async def test_the_camera_may_rest_while_nobody_wants_pictures() -> None:
    world = World()
    eyes = world.blindfold()
    await world.film(3.0)  # nobody asked for any
    assert (world.seq, eyes.picture, world.camera.heard) == (30, None, False)
    assert eyes.sight.blind == "no_detector"  # and not that the camera is silent
    asked = asyncio.create_task(eyes.show())
    await asyncio.sleep(0)
    assert not asked.done()
    assert world.camera.heard
    await world.film(0.1)
    shown = await asyncio.wait_for(asked, 1.0)
    assert shown is not None
    assert (shown.color.header.seq, shown.depth is not None) == (31, True)
    again = await eyes.show()
    assert again is shown  # at once
    await world.film(SHOWN_S - 0.2)
    assert world.camera.heard
    await world.film(0.4)
    assert not world.camera.heard
    assert (eyes.picture, eyes.sight.blind) == (None, "no_detector")
    eyes.attend("mission", True)  # a question to a vision model
    await world.turn()
    assert world.camera.heard
    assert eyes.sight.blind == "no_detector"
    for _ in range(15):  # the camera is gone: now somebody looked
        await world.turn()
    assert eyes.sight.blind == "camera_silent"
    assert await eyes.fresh() is None  # and nobody waits again
    eyes.attend("mission", False)
    await world.turn()
    assert (world.camera.heard, eyes.sight.blind) == (False, "no_detector")


async def test_a_camera_that_was_silent_or_stuck_begins_anew_for_who_looks_again() -> None:
    world = World()
    eyes = world.blindfold()
    eyes.attend("mission", True)
    await world.film(0.1 * FROZEN_AFTER, data=b"\xff\xd8the same")
    assert eyes.sight.blind == "no_detector"
    for _ in range(2):  # the second time its first picture is enough: it is the same again
        eyes.attend("mission", True)
        await world.film(0.3, data=b"\xff\xd8the same")
        assert eyes.sight.blind == "camera_frozen"
        eyes.attend("mission", False)
        await world.film(1.0)
        assert eyes.sight.blind == "no_detector"
    eyes.attend("mission", True)
    await world.film(0.3)
    assert eyes.sight.blind == "no_detector"  # it moves again


async def test_a_camera_that_is_stuck_is_found_out_by_glances() -> None:
    world = World()
    await world.film((FROZEN_AFTER + 2) / STANDING_HZ, data=b"\xff\xd8the same")
    assert world.eyes.sight.blind == "camera_frozen"
    assert len(world.detector.looks) <= FROZEN_AFTER
    await world.film(1.0)
    assert world.eyes.sight.blind is None


@pytest.mark.parametrize(
    ("code", "rests"), [("model_broken", True), ("no_detector", True), ("detector_down", False)]
)
async def test_a_model_that_is_refused_wants_no_pictures(code: str, rests: bool) -> None:
    world = World()
    world.detector.failure = VisionFailure(code)
    await world.film(2.0)
    drawn = world.drawn
    await world.film(2.0)
    assert (world.drawn == drawn) == rests
    assert world.eyes.sight.blind == code
