"""A page's stick moves the robot, and every way of losing it ends as the bridge's ramp."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random

import pytest

from planner.robot_service import LinkedRobot
from tests.tools.lockstep.conftest import Ready
from tools.lockstep import TICK_S, LockstepWorld
from tools.lockstep.page_hand import PageHand
from wire import Mode, Pose2

START = Pose2(1.0, 1.5, 0.0)
"""In the two-room site's kitchen, with metres of floor around it."""
LOST_S = 0.31
STANDING_MPS, STANDING_RADPS = 0.005, 0.01


@dataclass
class Pages:
    """Be a world with a planner's robot and any number of pages."""

    world: LockstepWorld
    robot: LinkedRobot
    hands: list[PageHand]

    @classmethod
    def of(cls, world: LockstepWorld, *ways: int) -> Pages:
        robot = LinkedRobot(world.planner.link, world.scene.robot)
        hands = [
            PageHand(world, robot, f"page-{number}", way) for number, way in enumerate(ways, 1)
        ]
        return cls(world, robot, hands)

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds / TICK_S)):
            self.tick()

    def tick(self) -> None:
        for hand in self.hands:
            hand.tick()
        self.world.tick()

    def told(self) -> tuple[float, float]:
        """Return the speeds at the rim and of turning that the bridge sends now."""
        sent = self.world.status.sent
        return abs(sent.v_mps), abs(sent.w_radps)

    def ended_s(self, limit_s: float = 3.0) -> float:
        """Return how long it takes until zero is sent."""
        for count in range(round(limit_s / TICK_S)):
            v_mps, w_radps = self.told()
            if v_mps <= STANDING_MPS and w_radps <= STANDING_RADPS:
                return count * TICK_S
            self.tick()
        raise AssertionError(self.world.describe())

    def left_s(self, limit_s: float = 1.0) -> float:
        """Return how long the robot is still steered."""
        for count in range(round(limit_s / TICK_S)):
            if self.world.status.mode is not Mode.TELEOP:
                return count * TICK_S
            self.tick()
        raise AssertionError(self.world.describe())


@pytest.fixture
def pages(ready: Ready) -> Callable[..., Pages]:
    return lambda *ways, seed=1: Pages.of(ready(seed=seed, start=START), *(ways or (2,)))


def driving(pages: Pages, forward: float = 0.6, left: float = 0.0, for_s: float = 0.8) -> PageHand:
    hand = pages.hands[0]
    pages.run(0.5)
    hand.held, hand.forward, hand.left = True, forward, left
    pages.run(for_s)
    assert pages.world.status.mode is Mode.TELEOP, pages.world.describe()
    return hand


def ramp_s(pages: Pages) -> float:
    """Return how long the bridge's own ramp takes from now, by robot.toml's numbers [s]."""
    robot = pages.world.scene.robot
    v_mps, w_radps = pages.told()
    rim_mps = v_mps + w_radps * robot.base.wheel_separation_m / 2.0
    limits = robot.limits
    return rim_mps / limits.max_decel_mps2 + limits.max_decel_mps2 / limits.stop_jerk_mps3


WAYS_OUT: dict[str, Callable[[PageHand], None]] = {
    "released": PageHand.let_go,
    "closed": PageHand.close,
    "lost": lambda hand: setattr(hand, "lost", True),
}


@pytest.mark.parametrize("way_out", WAYS_OUT)
def test_however_a_hand_ends_the_robot_stands_by_the_bridges_ramp(
    pages: Callable[..., Pages], way_out: str
) -> None:
    for seed in range(3):
        chance = Random(seed)
        driven = pages(chance.randrange(1, 8))
        forward, left = chance.uniform(-1.0, 1.0), chance.uniform(-1.0, 1.0)
        hand = driving(driven, forward, left, chance.uniform(0.4, 1.0))
        WAYS_OUT[way_out](hand)
        assert driven.left_s() <= LOST_S
        assert driven.ended_s() <= ramp_s(driven) + 0.3
        assert driven.world.contacts == 0


def test_a_hand_that_takes_over_pauses_the_goal_and_its_person_may_resume(
    pages: Callable[..., Pages],
) -> None:
    driven = pages()
    goal = driven.world.say("go to the living room")
    driven.run(2.0)
    assert driven.world.status.mode is Mode.ACTIVE
    hand = driving(driven, forward=0.2)
    assert (goal.state, goal.record.reason) == ("paused", "teleop")
    hand.let_go()
    driven.run(1.0)
    driven.world.resume(goal)
    driven.world.run_until(lambda _: goal.has_ended, 90.0)
    assert goal.state == "succeeded"


def test_two_hands_are_no_mixture_and_the_second_ends_nothing(pages: Callable[..., Pages]) -> None:
    driven = pages(2, 5)
    driving(driven, forward=0.3)
    first, second = driven.hands
    second.held, second.forward, second.left = True, -1.0, 1.0
    driven.run(0.5)
    assert second.hand.code == "hand_taken"
    assert driven.robot.driver == {"id": "page-1", "name": "page-1"}
    second.let_go()
    driven.run(0.5)
    assert driven.world.status.mode is Mode.TELEOP
    assert driven.told()[1] <= 1e-6, "the second one's turn is not in it"
    first.let_go()
    driven.run(0.5)
    assert driven.robot.driver is None
    second.held = True
    driven.run(0.3)
    assert driven.robot.driver == {"id": "page-2", "name": "page-2"}


def test_a_stick_that_lies_pressed_when_its_page_opens_moves_nothing(
    pages: Callable[..., Pages],
) -> None:
    driven = pages()
    hand = driven.hands[0]
    hand.held, hand.forward = True, 1.0
    driven.run(1.0)
    assert driven.world.status.mode is Mode.HOLD
    assert driven.world.standing


def test_frames_that_a_network_kept_back_move_nothing(pages: Callable[..., Pages]) -> None:
    driven = pages()
    hand = driving(driven)
    hand.lost = True
    driven.run(1.0)
    assert driven.world.status.mode is Mode.HOLD
    hand.lost = False  # it all comes now, the stick held as before
    driven.run(0.5)
    assert driven.world.status.mode is Mode.HOLD
    assert driven.world.standing
