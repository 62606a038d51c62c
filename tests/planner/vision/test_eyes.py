"""The eyes look at the newest picture only, say why they are blind, and remember over a restart."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Coroutine
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from planner.vision import Detection, LookResult, PointRefused, Sight, Thing, VisionFailure
from planner.vision.eyes import IDLE_HZ, REST_S, SHOWN_S, Means, Sightseer
from planner.vision.pictures import FROZEN_AFTER, OLDEST_S, Pictures
from planner.vision.poses import Poses
from planner.vision.seeing import Scenery
from planner.vision.store import FILE, ThingStore
from tests.planner.vision.scenes import CAMERA, box_of, image, two_room, view
from wire import Image, Localization, Odometry, Pose2, Rejected, Twist2

MAP_ID = two_room().map_id
BOX, DEPTH_M = box_of(view(1.0, 1.5), 2.5, 1.5, 0.3, 0.1)
CUP = Detection("Cup", 0.9, BOX, "red", DEPTH_M, 0.01)


@dataclass
class FakeCamera:
    """Hand out what a test put in."""

    colors: list[Image | Rejected] = field(default_factory=list)
    depths: list[Image | Rejected] = field(default_factory=list)

    def color(self) -> Image | Rejected | None:
        newest, self.colors = self.colors[-1:], []
        return newest[0] if newest else None

    def depth(self) -> Image | Rejected | None:
        newest, self.depths = self.depths[-1:], []
        return newest[0] if newest else None


@dataclass
class FakeDetector:
    """Find what a test says, when it says so."""

    classes: tuple[str, ...] = ("Cup", "tvmonitor", "")
    found: tuple[Detection, ...] = (CUP,)
    failure: VisionFailure | None = None
    skipped: str | None = None
    slow: asyncio.Event | None = None
    looks: list[tuple[int, bool]] = field(default_factory=list)
    depth_m: float | None = 1.0

    async def look(self, color: Image, depth: Image | None) -> LookResult:
        self.looks.append((color.header.seq, depth is not None))
        if self.slow is not None:
            await self.slow.wait()
        if self.failure is not None:
            raise self.failure
        return LookResult(self.found, 320, 240, 0.03, self.skipped)

    async def depth_at(self, depth: Image, u_px: float, v_px: float) -> float | None:
        if self.failure is not None:
            raise self.failure
        return self.depth_m


class World:
    """Be a robot that stands at (1.0, 1.5), its camera, its clock."""

    def __init__(self, home: Path | None = None, **camera: Any) -> None:
        self.now_s = 1_000.0
        self.camera, self.detector, self.seq = FakeCamera(), FakeDetector(), 0
        self.poses = Poses(MAP_ID)
        store = None if home is None else ThingStore(home / FILE, MAP_ID, wall=lambda: self.now_s)
        self.means = Means(
            Scenery(two_room(), CAMERA.model_copy(update=camera)), self.camera, self.detector,
            self.poses, store, rate_hz=10.0,
        )  # fmt: skip
        self.eyes = Sightseer(self.means, clock=lambda: self.now_s)
        self.told: list[Sight] = []
        self.eyes.listen(self.told.append)

    def shoot(self, age_s: float = 0.05, data: bytes | None = None, *, depth: bool = True) -> None:
        """Let a picture arrive that was taken a while ago."""
        self.seq += 1
        stamp_s = self.now_s - age_s
        self.camera.colors.append(image(self.seq, stamp_s, data))
        if depth:
            self.camera.depths.append(image(self.seq, stamp_s, b"\x89PNG"))
        here = Pose2(1.0, 1.5, 0.0)
        self.poses.odometry(Odometry(odom_id="o", seq=self.seq, stamp_s=self.now_s,
                                     base_in_odom=here, twist=Twist2(0.0, 0.0),
                                     yaw_rate_radps=None))  # fmt: skip
        self.poses.localization(Localization(odom_id="o", seq=self.seq, stamp_s=self.now_s,
                                             odom_in_map=Pose2(0.0, 0.0, 0.0), quality=0.9,
                                             map_id=MAP_ID))  # fmt: skip

    async def turn(self, step_s: float = 0.1) -> None:
        self.eyes.turn()
        for _ in range(4):  # a look, its end, what follows from it
            await asyncio.sleep(0)
        self.now_s += step_s

    async def film(self, seconds: float, hz: float = 10.0, **shot: Any) -> None:
        for _ in range(round(seconds * hz)):
            self.shoot(**shot)
            await self.turn(1.0 / hz)


def play(story: Coroutine[Any, Any, None]) -> None:
    asyncio.run(story)


def test_what_is_in_the_picture_comes_onto_the_map() -> None:
    async def story() -> None:
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
        assert world.told[-1] is world.eyes.sight
        assert world.eyes.version == 1
        assert world.eyes.classes == ("cup", "tv")
        assert world.eyes.lag_s == pytest.approx(0.05)

    play(story())


def test_looks_are_rare_until_somebody_needs_them() -> None:
    async def story() -> None:
        world = World()
        await world.film(5.0)
        assert len(world.detector.looks) == pytest.approx(5.0 * IDLE_HZ, abs=1)
        world.eyes.attend("goal", True)
        await world.film(2.0)
        world.eyes.attend("goal", False)
        assert len(world.detector.looks) == pytest.approx(30, abs=2)
        assert world.eyes.show() is world.eyes.picture
        await world.film(2 * SHOWN_S)  # a page looked, and went
        assert len(world.detector.looks) == pytest.approx(30 + 10 * SHOWN_S + 2 * SHOWN_S, abs=4)
        assert world.eyes.skipped["rate"] > 30

    play(story())


def test_a_slow_detector_skips_frames_and_the_newest_is_next() -> None:
    async def story() -> None:
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
        assert sum(world.eyes.skipped.values()) == 9

    play(story())


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
def test_pictures_are_judged_before_they_are_thought_upon(
    shot: dict[str, Any], blind: str | None, reason: str | None
) -> None:
    async def story() -> None:
        world = World()
        world.eyes.attend("test", True)
        await world.film(3.0, **shot)
        assert world.eyes.sight.blind == blind
        assert (reason is None) == (len(world.detector.looks) > 20)
        if reason is not None:
            assert world.eyes.skipped[reason] > 20
            assert len(world.detector.looks) <= FROZEN_AFTER
            await world.film(0.5)
            assert world.eyes.sight.blind is None  # and it sees again

    play(story())


def test_a_camera_that_vanishes_or_was_never_there_is_said() -> None:
    async def story() -> None:
        world = World()
        await world.film(1.0)
        assert world.eyes.sight.blind is None
        for _ in range(15):
            await world.turn()
        assert world.eyes.sight.blind == "camera_silent"
        assert len(world.eyes.sight.things) == 1  # what was seen is still known
        world.camera.colors.append(Rejected("invalid", "camera/color: x"))
        await world.turn()
        assert world.eyes.skipped["malformed"] == 1
        none = World(kind="none")
        await none.eyes.start()
        assert (none.eyes.sight.blind, none.eyes.classes) == ("no_camera", ())
        await none.eyes.close()
        undetected = replace(world.means, detector=None)
        assert Sightseer(undetected).sight.blind == "no_detector"

    play(story())


@pytest.mark.parametrize(
    ("code", "blind"),
    [("no_detector", "no_detector"), ("detector_timed_out", "detector_down")],
)
def test_a_detector_that_is_down_is_asked_again_later(code: str, blind: str) -> None:
    async def story() -> None:
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

    play(story())


def test_skipped_pictures_and_lost_poses_teach_nothing() -> None:
    async def story() -> None:
        world = World()
        world.eyes.attend("test", True)
        world.detector.skipped = "picture_truncated"
        await world.film(1.0)
        assert world.eyes.sight.look is None
        assert world.eyes.skipped["picture_truncated"] > 0
        world.detector.skipped = None
        world.poses.localization(
            Localization(odom_id="o", seq=1, stamp_s=world.now_s, quality=0.0, map_id=MAP_ID,
                         odom_in_map=Pose2(0.0, 0.0, 0.0))
        )  # fmt: skip
        world.poses._odom_id = "lost"
        world.camera.colors.append(image(99, world.now_s))
        await world.turn(0.04)
        await world.turn(0.04)
        look = world.eyes.sight.look
        assert look is not None
        assert (look.base_in_map, look.here, world.eyes.sight.things) == (None, ("",), ())
        assert world.eyes.counts["without_pose"] == 1

    play(story())


def test_an_error_of_ours_ends_one_look_and_no_more(caplog: pytest.LogCaptureFixture) -> None:
    async def story() -> None:
        world = World()
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

    with caplog.at_level(logging.CRITICAL + 1):
        play(story())


def test_a_pixel_leads_to_the_floor_by_its_own_picture(tmp_path: Path) -> None:
    async def story() -> None:
        world = World()
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
        with pytest.raises(PointRefused, match="point_no_pose"):
            await world.eyes.spot(replace(picture, color=image(1, 0.0), taken_s=1.0), 500, 900)
        world.detector.failure = VisionFailure("detector_down")
        with pytest.raises(PointRefused, match="point_no_depth"):
            await world.eyes.spot(picture, 500, 900)

    play(story())


def test_what_was_seen_outlives_the_process(tmp_path: Path) -> None:
    async def story() -> None:
        world = World(tmp_path)
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

    play(story())


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (b"{", "objects_unreadable"),
        (b"\xff\x00", "objects_unreadable"),
        (b'{"map_id": "0000000000000000", "things": []}', "objects_of_another_map"),
        (b'{"map_id": "%s", "things": [1]}' % MAP_ID.encode(), "objects_unreadable"),
    ],
)
def test_a_file_that_is_not_ours_is_said_and_left(
    text: bytes, said: str, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / FILE).write_bytes(text)
    assert ThingStore.in_home(tmp_path, MAP_ID).load(1.0) == ()
    assert said in caplog.text


def test_a_clock_set_back_makes_nothing_younger_than_now(tmp_path: Path) -> None:
    thing = Thing("cup_1", "cup", "red", 1.0, 2.0, 0.5, 0.05, 0.9, 100.0, 90.0, 3, None)
    assert ThingStore(tmp_path / FILE, MAP_ID, wall=lambda: 9_000.0).save((thing,), 100.0)
    for wall_s, seen_s in ((8_000.0, 50.0), (9_010.0, 40.0), (9e9, 50.0 - 365 * 86_400)):
        (back,) = ThingStore(tmp_path / FILE, MAP_ID, wall=partial(float, wall_s)).load(50.0)
        assert back.seen_s == pytest.approx(seen_s)
        assert back.first_s <= back.seen_s
    blocked = ThingStore(tmp_path / FILE / "below", MAP_ID)
    assert not blocked.save((thing,), 100.0)


def test_colour_waits_a_moment_for_its_depth() -> None:
    camera = FakeCamera()
    pictures = Pictures(camera)
    camera.colors, camera.depths = [image(1, 1.0)], [image(0, 0.9, b"d")]
    pictures.poll(1.0, busy=False)
    assert pictures.ready(1.0) is None
    camera.depths = [image(1, 1.0, b"d")]
    pictures.poll(1.02, busy=False)
    ready = pictures.ready(1.02)
    assert ready is not None
    assert ready.depth is not None
    assert pictures.ready(1.02) is None  # once
    camera.colors = [image(2, 1.1)]
    pictures.poll(1.1, busy=False)
    assert pictures.newest is not None
    assert pictures.newest.color.header.seq == 1  # the newest that is whole
    late = pictures.ready(1.14)
    assert late is not None
    assert late.depth is None
