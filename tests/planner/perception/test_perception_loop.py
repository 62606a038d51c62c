"""The eyes look at the newest picture only, say why they are blind, and remember over a restart."""

from __future__ import annotations

import asyncio
import logging
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from planner.perception import Detection, PointRefusal, Sight, VisionFailure
from planner.perception.frame_source import (
    EARLY_S,
    FROZEN_AFTER,
    IDLE_POLL_S,
    OLDEST_S,
    PASSING_HZ,
    POLL_S,
    REST_S,
    RESTING_HZ,
    RESTS_AFTER_S,
    SHOWN_S,
    STANDING_HZ,
    Attention,
)
from planner.perception.perception_loop import Sightseer
from planner.perception.pose_buffer import KEPT
from tests.planner.perception.scenes import box_of, image, view
from tests.planner.perception.watching import CUP, MAP_ID, World
from wire import DecodeFailure, Localization, Pose2


async def test_what_is_in_the_picture_comes_onto_the_map() -> None:
    world = World()
    world.eyes.attend("test", True)
    await world.film(0.5)
    (cup,) = world.eyes.sight.things
    assert (cup.id, cup.label, cup.color, cup.room) == ("cup_1", "cup", "red", cup.room)
    assert cup.x_m == pytest.approx(2.54, abs=0.05)
    assert cup.y_m == pytest.approx(1.5, abs=0.02)
    look = world.eyes.sight.look
    assert look is not None
    assert look.here == ("cup_1",)
    assert look.base_in_map == Pose2(1.0, 1.5, 0.0)
    assert world.eyes.looked_picture is not None
    assert world.eyes.looked_picture.color.header.seq == look.seq
    assert world.told[-1] is world.eyes.sight
    assert world.eyes.version == 1
    assert world.eyes.classes == ("cup", "tv")
    assert world.eyes.lag_s == pytest.approx(0.05)


async def test_what_a_look_did_not_look_for_is_not_missed() -> None:
    """A thing that the open-vocabulary model saw stays while nobody has that model look."""
    world = World()
    world.detector.classes = ("Cup", "Umbrella Stand")
    world.detector.open_classes = ("Umbrella Stand",)
    stand = replace(CUP, label="Umbrella Stand", box=(20.0, 60.0, 90.0, 200.0))
    world.detector.found = (CUP, stand)
    assert world.eyes.open_classes == ("umbrella_stand",)
    world.eyes.attend("test", True, wide=True)
    await world.film(1.0)
    assert {thing.label for thing in world.eyes.sight.things} == {"cup", "umbrella_stand"}
    assert all(world.detector.wide)
    world.detector.found = ()
    world.eyes.attend("test", True)
    before = len(world.detector.wide)
    await world.film(4.0)
    assert not any(world.detector.wide[before + 1 :])
    assert [thing.label for thing in world.eyes.sight.things] == ["umbrella_stand"]
    world.eyes.attend("test", True, wide=True)
    await world.film(4.0)
    assert world.eyes.sight.things == ()


async def test_a_slow_detector_skips_frames_and_the_newest_is_next() -> None:
    world = World()
    world.eyes.attend("test", True)
    world.detector.slow = asyncio.Event()
    await world.film(1.0)
    assert [seq for seq, _ in world.detector.looks] == [1]
    world.detector.slow.set()
    await world.turn()
    await world.turn()
    assert [seq for seq, _ in world.detector.looks] == [1]  # the tenth lies there too long
    await world.film(0.1)
    assert [seq for seq, _ in world.detector.looks] == [1, 11]
    assert sum(world.eyes.skip_counts.values()) == 9


@pytest.mark.parametrize(
    ("shot", "blind", "reason"),
    [
        ({"age_s": OLDEST_S + 0.2}, "camera_silent", "stale"),
        ({"data": b"\xff\xd8the same"}, "camera_frozen", "frozen"),
        ({"depth": False}, None, None),
        ({"age_s": -5.0}, None, None),  # a stamp of the future makes nothing younger, or older
        ({"age_s": 500.0}, None, None),  # another host's clock: only our own age counts
    ],
)
async def test_pictures_are_judged_before_they_are_thought_upon(
    shot: dict[str, Any], blind: str | None, reason: str | None
) -> None:
    world = World()
    world.eyes.attend("test", True)
    await world.film(3.0, **shot)
    assert world.eyes.sight.blind == blind
    assert (reason is None) == (len(world.detector.looks) > 20)
    if reason is not None:
        assert world.eyes.skip_counts[reason] > 20
        assert len(world.detector.looks) <= 1, "what is shown again is of then"
        await world.film(0.5)
        assert world.eyes.sight.blind is None  # and it sees again


async def test_a_camera_that_vanishes_or_was_never_there_is_said() -> None:
    world = World()
    world.eyes.attend("test", True)
    await world.film(1.0)
    assert world.eyes.sight.blind is None
    for _ in range(15):
        await world.turn()
    assert world.eyes.sight.blind == "camera_silent"
    assert len(world.eyes.sight.things) == 1  # what was seen is still known
    world.camera.colors.append(DecodeFailure("invalid", "camera/color: x"))
    await world.turn()
    assert world.eyes.skip_counts["malformed"] == 1
    none = World(kind="none")
    await none.eyes.start()
    assert (none.eyes.sight.blind, none.eyes.classes) == ("no_camera", ())
    await none.eyes.close()
    undetected = replace(world.means, detector=None)
    assert Sightseer(undetected).sight.blind == "no_detector"
    nothing_there = replace(world.means, has_model=False)
    assert Sightseer(nothing_there).sight.blind == "no_detector"


@pytest.mark.parametrize(
    ("code", "blind"),
    [
        ("no_detector", "no_detector"),
        ("detector_timed_out", "detector_down"),
        ("model_broken", "model_broken"),  # refused while the planner runs
    ],
)
async def test_a_detector_that_is_down_is_asked_again_later(code: str, blind: str) -> None:
    world = World()
    world.eyes.attend("test", True)
    world.detector.failure = VisionFailure(code)
    await world.film(3 * REST_S)
    assert world.eyes.sight.blind == blind
    assert len(world.detector.looks) <= 4
    world.detector.failure = None
    await world.film(2 * REST_S)
    assert world.eyes.sight.blind is None
    assert world.eyes.counts[code] >= 3


async def test_skipped_pictures_and_lost_poses_teach_nothing() -> None:
    world = World()
    world.eyes.attend("test", True)
    world.detector.skipped = "detector_failed"
    await world.film(1.0)
    assert world.eyes.sight.blind == "detector_down"
    world.detector.skipped = "picture_truncated"
    await world.film(1.0)
    assert (world.eyes.sight.look, world.eyes.sight.blind) == (None, "camera_unusable")
    assert world.eyes.skip_counts["picture_truncated"] > 0
    world.detector.skipped = None
    world.poses.localization(
        Localization(odom_id="o", seq=1, stamp_s=world.now_s, quality=0.0, map_id=MAP_ID,
                     odom_in_map=Pose2(0.0, 0.0, 0.0))
    )  # fmt: skip
    world.poses._odom_id = "lost"
    world.camera.colors.append(image(99, world.now_s))
    await world.turn(0.06)
    await world.turn(0.06)
    look = world.eyes.sight.look
    assert look is not None
    assert world.eyes.sight.blind is None
    assert (look.base_in_map, look.here, world.eyes.sight.things) == (None, ("",), ())
    assert world.eyes.counts["without_pose"] == 1


async def test_a_thing_is_placed_on_the_floor_where_depth_measures_nothing() -> None:
    world = World()
    world.eyes.attend("test", True)
    world.detector.depth_lost = "depth_empty"
    box, _ = box_of(view(1.0, 1.5), 2.5, 1.5, 0.1, 0.2)
    world.detector.found = (Detection("chair", 0.9, box),)
    await world.film(1.0)
    assert world.eyes.sight.blind is None
    assert world.eyes.skip_counts["depth_empty"] > 3
    (chair,) = world.eyes.sight.things
    assert chair.x_m == pytest.approx(2.5, abs=0.6)
    assert chair.y_m == pytest.approx(1.5, abs=0.05)


async def test_an_error_of_ours_ends_one_look_and_no_more(caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.CRITICAL + 1)
    world = World()
    world.eyes.attend("test", True)
    broken = [True]

    def told(sight: Sight) -> None:
        if sight.things and broken:
            raise RuntimeError("whoever listens is broken")

    world.eyes.listen(told)
    await world.film(1.0)
    assert world.eyes.counts["look_broken"] >= 1
    broken.clear()
    await world.film(2.0)
    assert world.eyes.counts["looks"] > 2


async def test_a_pixel_leads_to_the_floor_by_its_own_picture(tmp_path: Path) -> None:
    world = World()
    world.eyes.attend("test", True)
    await world.film(0.6)
    picture = world.eyes.picture
    assert picture is not None
    assert picture.depth is not None
    floor = await world.eyes.spot(picture, 500, 900)
    assert floor.x_m == pytest.approx(2.0, abs=0.3)
    assert floor.y_m == pytest.approx(1.5, abs=0.05)
    world.detector.depth_m = None
    assert (await world.eyes.spot(picture, 500, 900)).z_m == 0.0
    await world.film(20.0, hz=5.0)  # longer than poses are kept: a model thinks slowly
    assert (await world.eyes.spot(picture, 500, 900)).z_m == 0.0
    with pytest.raises(PointRefusal, match="point_no_pose"):
        await world.eyes.spot(replace(picture, color=image(1, 0.0), taken_s=1.0), 500, 900)
    world.detector.failure = VisionFailure("detector_down")
    with pytest.raises(PointRefusal, match="point_no_depth"):
        await world.eyes.spot(picture, 500, 900)


async def test_a_page_that_looks_on_takes_no_picture_from_who_thinks() -> None:
    world = World()
    world.eyes.attend("test", True)
    await world.film(0.6)
    thought_upon = world.eyes.picture
    assert thought_upon is not None
    for _ in range(KEPT + 8):
        await world.eyes.show()
        await world.film(0.5)
    assert (await world.eyes.spot(thought_upon, 500, 900)).z_m is not None


async def test_what_was_seen_outlives_the_process(tmp_path: Path) -> None:
    world = World(tmp_path)
    world.eyes.attend("test", True)
    await world.eyes.start()
    await world.film(1.0)
    await world.eyes.close()
    assert len(world.eyes.sight.things) == 1
    later = World(tmp_path)
    later.now_s = 1_060.0
    await later.eyes.start()
    (cup,) = later.eyes.sight.things
    assert cup.id == "cup_1"
    assert 1_060.0 - cup.seen_s == pytest.approx(60.0, abs=2.0)
    assert later.eyes.forget("cup_1")[0].id == "cup_1"
    assert later.told[-1].things == ()
    await later.eyes.close()
    assert World(tmp_path).means.store.load(0.0) == ()  # type: ignore[union-attr]


async def test_eyes_that_end_are_opened_again_and_it_is_told(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr("planner.perception.perception_loop.FIRST_PAUSE_S", 0.001)
    caplog.set_level(logging.CRITICAL + 1)
    world = World()
    color = world.camera.color
    world.camera.color = lambda: 1 / 0  # type: ignore[method-assign, assignment, return-value]
    ended = asyncio.Event()
    world.eyes.listen(lambda _: ended.set() if world.eyes.counts["eyes_ended"] == 3 else None)
    await world.eyes.start()
    await ended.wait()
    assert world.told[-1].blind == "detector_down"
    world.camera.color = color  # type: ignore[method-assign]
    world.eyes.attend("test", True)
    while world.eyes.sight.look is None:
        world.shoot()
        await asyncio.sleep(0.02)
    assert world.told[-1].blind is None
    await world.eyes.close()


@pytest.mark.parametrize(
    ("wanted", "moving", "after_s"), [(True, False, 0.2), (False, True, 0.5), (False, False, 2.0)]
)
def test_a_look_is_due_by_who_wants_it_and_by_the_robots_motion(
    wanted: bool, moving: bool, after_s: float
) -> None:
    attention = Attention(5.0, 30.0)
    attention.attend("goal", wanted)
    assert attention.due(10.0, moving=moving), "none has begun yet"
    attention.began(10.0)
    assert not attention.due(10.0 + after_s - EARLY_S - 0.01, moving=moving)
    assert attention.due(10.0 + after_s - EARLY_S + 0.001, moving=moving)
    attention.rest(20.0)
    assert not attention.due(20.0 + REST_S - 0.01, moving=moving)
    assert attention.due(20.0 + REST_S, moving=moving)


def test_pictures_are_wanted_while_somebody_needs_waits_or_looks_on() -> None:
    attention = Attention(5.0, 10.0)
    assert attention.listens(10.0, glance=True)
    assert not attention.listens(10.0, glance=False)
    with attention.waiting():
        assert attention.listens(10.0, glance=False)
    assert not attention.listens(10.0, glance=False), "who waited is gone"
    for who in ("goal", "page"):
        attention.attend(who, True)
    attention.attend("goal", False)
    assert attention.listens(10.0, glance=False)
    attention.attend("page", False)
    assert attention.poll_s(10.0) == IDLE_POLL_S
    attention.note_shown(10.0)
    assert attention.listens(10.0 + SHOWN_S, glance=False)
    assert attention.poll_s(10.0) == POLL_S
    assert not attention.listens(10.0 + SHOWN_S + 0.01, glance=False)


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
