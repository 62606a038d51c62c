"""Goals of the planner driven by a small stand-in for Nav2, under the real bridge and physics.

The planner, the goals' dialogue (of the package pons_ros2) and the bridge's core are the real ones;
Nav2 is tests.ros2.small_nav2, which is not Nav2.
"""

from __future__ import annotations

import json
from types import SimpleNamespace as Made
from typing import Any

import pytest

from lockstep.world import STAND_IN_ROBOT
from planner.plan import Code, GoalState
from ros2.pons_ros2.pons_ros2.goals import Nav2Dialogue, read_order
from tests.known import known
from tests.ros2.small_nav2 import SmallNav2
from tools.lockstep import GoalHandle, LockstepWorld
from wire import Mode, Nav2State, Pose2, Waypoints, decode, distance, encode, keys
from wire.keys import Party
from wire.ros2_config import Nav2Config, Ros2Config

pytestmark = pytest.mark.nightly(keep=4)


ROS2 = Ros2Config(node="tcp/127.0.0.1:7448", nav2=Nav2Config())
ROBOT = STAND_IN_ROBOT.model_copy(update={"ros2": ROS2})
BY_THE_DOOR = Pose2(1.5, 2.0, 1.5)
LIMIT_S = 60.0


class Nav2World(LockstepWorld):
    """Let a Nav2 stand-in take its turn after the planner's."""

    graph: Graph | None = None

    def tick(self) -> None:
        super().tick()
        if self.graph is not None:
            self.graph.turn(self)


class Graph:
    """Carry topics between the dialogue of goals and the stand-in."""

    def __init__(
        self, world: LockstepWorld, nav2: SmallNav2, trouble: tuple[str, str] | None = None
    ) -> None:
        self.nav2, self.lives = nav2, True
        port = world.bus.port(Party.ROS2)
        self.goals = Nav2Dialogue(world.now_s)
        self.goals.trouble = trouble
        self._orders = port.subscriber(keys.NAV2_GOAL)
        self._says = port.publisher(keys.NAV2_STATE)
        self._statuses: list[Any] = []

    def turn(self, world: LockstepWorld) -> None:
        if world.bus.tick % 2 or not self.lives:
            return
        now_s, here = world.now_s, world.truth
        order = self._orders.newest()
        if order is not None:
            self.goals.take(read_order(encode(order).decode()), now_s)
        pose = self.goals.due(now_s)
        if pose is not None:
            self.nav2.hear(pose, now_s, (here.x_m, here.y_m))
        twist = self.nav2.turn(now_s, here.x_m, here.y_m, here.yaw_rad)
        if self.nav2.statuses != self._statuses:
            self._statuses = list(self.nav2.statuses)
            self.goals.hear_status(self.nav2.status_array(), now_s)
        if twist is not None and world.bus.tick % 5 == 0:
            said = Made(linear=Made(x=twist[0], y=0.0), angular=Made(z=twist[1]))
            self.goals.hear_twist(said, 0.0, now_s)
        if world.bus.tick % 4 == 0:
            said_state = json.dumps(self.goals.state("ros2-1", now_s)).encode()
            state = decode(keys.NAV2_STATE, said_state)
            assert isinstance(state, Nav2State)
            self._says.put(state)


def world_of(nav2: SmallNav2, trouble: tuple[str, str] | None = None) -> tuple[Nav2World, Graph]:
    world = Nav2World(robot=ROBOT, seed=3, start=BY_THE_DOOR)
    graph = world.graph = Graph(world, nav2, trouble)
    world.run(0.5)
    return world, graph


def through_the_door() -> SmallNav2:
    return SmallNav2(via=[(1.5, 3.4)])


def ended(goal: GoalHandle) -> bool:
    return goal.has_ended


def reason_of(goal: GoalHandle) -> str | None:
    plan = known(goal.record.plan)
    return known(plan.steps)[-1].reason


def is_state(goal: GoalHandle, state: GoalState) -> bool:
    return goal.state is state


def drives(world: LockstepWorld) -> bool:
    return world.status.mode is Mode.ACTIVE and abs(world.twist.v_mps) > 0.15


def off(nav2: SmallNav2) -> tuple[Nav2World, Graph, GoalHandle]:
    world, graph = world_of(nav2)
    goal = world.say("go to the living room")
    world.run_until(drives, LIMIT_S)
    return world, graph, goal


def test_nav2_brings_the_robot_there_through_the_bridge_and_no_waypoint_is_sent() -> None:
    world, graph = world_of(through_the_door())
    sent: list[Any] = []
    tap = world.bus.port(Party.BRIDGE).subscriber(keys.WAYPOINTS)
    goal = world.say("go to the living room")
    world.run_until(lambda _: ended(goal), LIMIT_S)
    sent += tap.drain().items
    assert goal.state is GoalState.SUCCEEDED, world.describe()
    assert world.room == "living_room"
    assert world.contacts == 0
    assert [one for one in sent if isinstance(one, Waypoints)] == []
    assert len(graph.nav2.goals) == 1
    limits = world.scene.robot.limits
    assert max(status.sent.v_mps for status in world.statuses) <= limits.max_speed_mps + 1e-6
    assert known(world.status.owner).kind == "external"


def test_a_stop_cancels_at_nav2_and_no_twist_of_it_moves_the_robot_until_resumed() -> None:
    world, graph, goal = off(through_the_door())
    world.stop()
    world.run_until(lambda w: w.standing and w.status.held is not None, 3.0)
    before = world.truth
    world.run(3.0)
    assert distance(world.truth, before) < 0.02
    assert is_state(goal, GoalState.PAUSED)
    assert len(graph.nav2.goals) == 2, "where the robot stood, in the goal's place"
    assert not graph.nav2.executes
    world.resume(goal)
    world.run_until(lambda _: ended(goal), LIMIT_S)
    assert goal.state is GoalState.SUCCEEDED, world.describe()
    assert world.contacts == 0


def test_nav2_that_lies_is_not_believed() -> None:
    world, graph = world_of(SmallNav2(via=[(1.5, 3.4)], lies=True, stuck=False))
    goal = world.say("go to the living room")
    world.run_until(lambda _: ended(goal), 4 * LIMIT_S)
    assert goal.state is GoalState.FAILED
    assert reason_of(goal) == "nav2_not_there"
    assert world.contacts == 0
    assert len(graph.nav2.goals) > 2


@pytest.mark.parametrize(
    ("nav2", "reason"),
    [
        (SmallNav2(deaf=True), "nav2_no_answer"),
        (SmallNav2(gives_up=True), "nav2_aborted"),
        (SmallNav2(stuck=True), "nav2_no_progress"),
    ],
    ids=["deaf", "gives up", "stuck"],
)
def test_what_nav2_does_not_do_is_told_by_its_code(nav2: SmallNav2, reason: str) -> None:
    world, _ = world_of(nav2)
    goal = world.say("go to the living room")
    world.run_until(lambda _: ended(goal), 10 * LIMIT_S)
    assert goal.state is GoalState.FAILED
    record = goal.record
    assert reason_of(goal) == reason
    assert known(record.outcome).code is Code.NOT_REACHED
    assert world.contacts == 0


def test_a_velocity_of_another_type_is_told_and_moves_nothing() -> None:
    world, _ = world_of(SmallNav2(), ("ros2_cmd_vel_type", "/cmd_vel_nav is a String"))
    before = world.truth
    goal = world.say("go to the living room")
    world.run_until(lambda _: ended(goal), 2 * LIMIT_S)
    assert reason_of(goal) == "nav2_no_velocity"
    assert distance(world.truth, before) < 1e-3


def test_somebody_elses_cancel_is_told_and_tried_again() -> None:
    world, graph, goal = off(through_the_door())
    graph.nav2.cancel()
    world.run_until(lambda _: len(graph.nav2.goals) > 1, 5.0)
    world.run_until(lambda _: ended(goal), LIMIT_S)
    assert goal.state is GoalState.SUCCEEDED, world.describe()


def test_a_planner_that_dies_leaves_a_robot_that_stands_and_a_nav2_that_was_called_off() -> None:
    world, graph, _ = off(through_the_door())
    world.kill_planner()
    world.run_until(lambda w: w.standing, 2.0)
    world.run(1.5)
    assert world.standing
    assert not graph.nav2.executes or graph.nav2.goals[-1][:2] != graph.nav2.goals[0][:2]


def test_nav2_that_dies_in_mid_drive_leaves_a_robot_that_stands() -> None:
    world, graph, goal = off(through_the_door())
    graph.lives = False
    world.run_until(lambda w: w.standing, 1.5)
    world.run_until(lambda _: ended(goal), LIMIT_S)
    assert world.standing
    assert reason_of(goal) == "nav2_not_heard"


def test_twists_that_nobody_asked_for_move_nothing() -> None:
    """Somebody else gives Nav2 a goal: its twists come, and no leg of the missions is wanted."""
    world, graph = world_of(SmallNav2())
    graph.nav2.goals.append((1.5, 3.4, 1.5))
    graph.nav2.statuses.append((1, 2, 1))
    before = world.truth
    world.run(5.0)
    assert graph.nav2.executes
    assert distance(world.truth, before) < 1e-3


def test_what_stands_in_the_way_stops_it_though_nav2_does_not_see_it() -> None:
    world, graph = world_of(SmallNav2())  # straight into the wall between the rooms
    goal = world.say("go to the living room")
    world.run_until(lambda _: ended(goal) or goal.state is GoalState.PAUSED, 5 * LIMIT_S)
    assert world.contacts == 0
    assert goal.state is not GoalState.SUCCEEDED or world.room == "living_room"
    assert graph.nav2.goals


def test_a_turn_is_a_goal_where_it_stands_and_an_exploration_is_none() -> None:
    world, _ = world_of(SmallNav2())
    before = world.truth
    goal = world.say("turn left 90 degrees")
    world.run_until(lambda _: ended(goal), LIMIT_S)
    assert goal.state is GoalState.SUCCEEDED, world.describe()
    turned = world.truth.yaw_rad - before.yaw_rad
    assert turned == pytest.approx(1.57, abs=0.4)
