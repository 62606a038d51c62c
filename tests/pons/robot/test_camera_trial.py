"""The hand at the left is seen left, the covered lens goes dark; else what is wrong is named."""

from __future__ import annotations

from collections.abc import Callable

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from pons.robot.camera_trial import LOOKS, try_camera
from pons.robot.trial_parties import TrialRefusal
from pons.robot.trial_run import watch_camera
from pons.robot.trial_words import PROMPTS, REFUSALS
from sensors.camera.shot import CameraShot
from tests.sensors.camera.films import network_camera
from wire import CameraConfig, RobotDescription

WIDTH, HEIGHT = 160, 120
ASKED = ["camera_clear", "camera_left", "camera_cover"]
CONFIG = CameraConfig(kind="uvc", device="/dev/video0")
Picture = NDArray[np.uint8]


def shot(color: Picture) -> CameraShot:
    return CameraShot(np.ascontiguousarray(color), 200.0, (WIDTH / 2, HEIGHT / 2))


class Scene:
    """Be a room before a camera, and a person with a hand."""

    def __init__(
        self,
        *,
        hand_at: float = -0.5,
        gain: float = 1.0,
        light: float = 1.0,
        through_lid: float = 0.05,
        moved: bool = False,
    ) -> None:
        """Draw a room.

        Args:
            hand_at: -1 at the picture's left edge, 1 at its right one.
            gain: of the exposure once the hand is there, for cameras choose it themselves.
            light: of the room.
            through_lid: share of the light that a covering hand lets through.
            moved: the robot is turned meanwhile.
        """
        random = np.random.default_rng(7)
        room = cv2.resize(random.integers(40, 220, (9, 12)).astype(np.float32), (WIDTH, HEIGHT))
        self._room, self._random = room * light, random
        self._hand_at, self._gain, self._through, self._moved = hand_at, gain, through_lid, moved
        self.asked: list[str] = []

    def ask(self, code: str) -> None:
        self.asked.append(code)

    def draw(self, _: int = 0) -> Picture:
        made = self._room.copy()
        asked = self.asked[-1] if self.asked else ""
        if asked == "camera_left":
            if self._moved:
                made = np.roll(made, 40, axis=1)
            middle = round((self._hand_at + 1.0) / 2.0 * WIDTH)
            made[30:90, max(0, middle - 15) : max(0, middle + 15)] = 250.0
            made *= self._gain
        if asked == "camera_cover":
            made = cv2.GaussianBlur(made, (51, 51), 0.0) * self._through
        made = made + self._random.normal(0.0, 2.0, made.shape)
        return np.repeat(np.clip(made, 0, 255).astype(np.uint8)[:, :, None], 3, axis=2)

    def look(self) -> list[CameraShot]:
        return [shot(self.draw()) for _ in range(LOOKS)]


@given(st.floats(-0.9, -0.25), st.floats(0.8, 1.2), st.floats(0.0, 0.4))
def test_a_camera_that_hangs_as_described_passes(
    hand_at: float, gain: float, through_lid: float
) -> None:
    scene = Scene(hand_at=hand_at, gain=gain, through_lid=through_lid)
    assert f"{WIDTH} x {HEIGHT}" in try_camera(CONFIG, scene.look, scene.ask)
    assert scene.asked == ASKED
    assert set(ASKED) <= set(PROMPTS)


def refused(scene: Scene, look: Callable[[], list[CameraShot]] | None = None) -> TrialRefusal:
    with pytest.raises(TrialRefusal) as refusal:
        try_camera(CONFIG, look or scene.look, scene.ask)
    assert refusal.value.code in REFUSALS
    return refusal.value


@given(st.floats(-0.9, -0.25))
def test_a_camera_that_hangs_upside_down_is_named(hand_at: float) -> None:
    scene = Scene(hand_at=hand_at)
    turned = refused(scene, lambda: [shot(each.color[::-1, ::-1]) for each in scene.look()])
    assert turned.code == "camera_turned"
    assert "upside_down is False" in turned.detail
    assert refused(Scene(hand_at=-hand_at)).code == "camera_turned"


def test_the_picture_of_another_camera_is_named() -> None:
    assert refused(Scene(hand_at=-3.0)).code == "camera_nothing", "no hand comes into it"


def test_a_lens_that_is_not_covered_changes_nothing() -> None:
    scene = Scene()

    def look() -> list[CameraShot]:
        if scene.asked[-1] == "camera_cover":
            scene.asked.append("")
        return scene.look()

    assert refused(scene, look).code == "camera_uncovered"


@pytest.mark.parametrize(
    ("scene", "code"),
    [
        (Scene(light=0.03), "camera_dark"),
        (Scene(hand_at=0.0), "camera_nothing"),
        (Scene(moved=True), "camera_nothing"),
    ],
)
def test_what_shows_nothing_is_said(scene: Scene, code: str) -> None:
    assert refused(scene).code == code


class Beside(Scene):
    """Be the person of the trial, too; what is asked for is done at once."""

    def __init__(self) -> None:
        super().__init__()
        self.told: list[tuple[str, str]] = []

    def has_answered(self) -> bool:
        return True

    def tell(self, step: str, seen: str = "") -> None:
        self.told.append((step, seen))

    def require_watch(self) -> None:
        """Go on."""


def robot_with(url: str) -> RobotDescription:
    camera = CameraConfig(kind="stream", url=url, rate_hz=10.0)
    return RobotDescription.model_construct(camera=camera, ros2=RobotDescription().ros2)


@pytest.mark.nightly
@pytest.mark.e2e
def test_a_network_camera_is_tried_through_its_own_reader() -> None:
    person = Beside()
    with network_camera(show=person.draw) as port:
        robot = robot_with(f"http://127.0.0.1:{port}/video.mjpg")
        seen = watch_camera(robot, person, "+2°, +88°")
    assert seen.startswith(f"{WIDTH} x {HEIGHT}, -5")
    assert person.told == [(ASKED[0], "+2°, +88°"), (ASKED[1], ""), (ASKED[2], "")]


@pytest.mark.nightly
@pytest.mark.e2e
def test_a_camera_that_is_not_there_is_named_by_its_own_code() -> None:
    with pytest.raises(TrialRefusal) as refusal:
        watch_camera(robot_with("file:///nowhere/rooms.avi"), Beside(), "")
    assert refusal.value.code == "camera_unread"
    assert refusal.value.detail.startswith("camera_missing")
