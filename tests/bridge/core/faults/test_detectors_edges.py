"""Bring every stage of every row to the edge of its window in time by real inputs, tick by tick.

Until trouble has lasted for the window no tick shows the row, and the first or second tick beyond
it does. Nothing is forced here; times of what came last are read from the state.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import radians

import pytest

from bridge.core import ArrivedAt
from bridge.core.geometry.fence import Zone, build_fence
from tests.bridge.core import oracle
from tests.bridge.core.external_brain import drive_for
from tests.bridge.core.fake_planner import MAP_ID, PERIOD_S
from tests.bridge.core.reached import reached
from tests.bridge.core.scripted import World, config
from tests.bridge.core.windows import raised
from wire import RobotDescription
from wire.lidar_config import LidarConfig

Do = Callable[[World], object]
SQUARE = ((-5.5, -5.5), (5.5, -5.5), (5.5, 5.5), (-5.5, 5.5))


@dataclass(frozen=True)
class Edge:
    """Tell how trouble begins, since when it lasts, and for how long that may be."""

    stage: str
    window_s: float
    begin: Do
    since: Callable[[World], float | None] | None = None
    """When what came last came; None counts from the first tick of trouble."""
    keep: Do = lambda _: None
    start: str = "active"


def silent_planner(world: World) -> None:
    world.brain.silent = True


def stale_use(world: World) -> None:
    world.brain.used = world.shown.seq
    world.run(0.1)


def no_horizon(world: World) -> None:
    world.brain.next_horizon_s = 1e9


def blind(world: World) -> None:
    """Cover the lidar just before a scan comes."""
    world.lidar_blind = True
    while world.ticks % 10 != 2:
        world.tick()


def hide(world: World) -> None:
    """Hide a quarter ahead just before a scan comes; the lidar reaches the room's corners."""
    world.core = config(RobotDescription(lidar=LidarConfig(range_max_m=12.0)))
    world.hidden_rad = (0.0, radians(46))
    while world.ticks % 10 != 2:
        world.tick()


def set_drive(**values: object) -> Do:
    def begin(world: World) -> None:
        for name, value in values.items():
            setattr(world.drive, name, value)

    return begin


def set_world(**values: object) -> Do:
    def begin(world: World) -> None:
        for name, value in values.items():
            setattr(world, name, value)

    return begin


def flood(world: World) -> None:
    world.extra = replace(world.extra, arrived=(ArrivedAt("cmd/hello", 100),))


def keep_stick(world: World) -> None:
    if world.ticks % 5 == 0:
        world.teleop(0.3, held=True)


def echo(world: World) -> float | None:
    return world.state.ownership.echo_s


def scanned(world: World) -> float | None:
    return world.state.lidar.received_s


def driven(world: World) -> float | None:
    return world.state.drive.received_s


def located(world: World) -> float | None:
    return world.state.pose.received_s


def spoken(world: World) -> float | None:
    return None if world.state.external is None else world.state.external.sent_s


EDGES = (
    Edge("BRAIN_LATE.0", 0.15, silent_planner, echo),
    Edge("BRAIN_LOST.0", 0.3, silent_planner, echo),
    Edge("BRAIN_GONE.0", 5.0, silent_planner, echo),
    Edge("BRAIN_STALE.0", 1.0, stale_use, lambda world: world.state.ownership.used_s),
    Edge("CMD_STALE.0", 0.5, no_horizon, lambda world: world.state.leg.sent_s),
    Edge(
        "CMD_STALE.1",
        0.25,
        lambda world: drive_for(world, 0.05),
        spoken,
        start="active_external",
    ),
    Edge("CMD_FLOOD.0", 1.0, lambda _: None, None, flood),
    Edge("LIDAR_STALE.0", 0.25, set_world(lidar_silent=True), scanned),
    Edge("LIDAR_STALE.1", 5.25, set_world(lidar_silent=True), scanned),
    Edge("NO_RANGE.0", 5.25, set_world(lidar_silent=True), scanned),
    Edge("NO_RANGE.1", 5.25, set_world(lidar_silent=True), scanned),
    Edge("LIDAR_BLIND.0", 0.3, blind),
    Edge("LIDAR_BLIND.1", 5.0, blind),
    Edge("LIDAR_SECTOR.0", 0.2, hide),
    Edge("LIDAR_SECTOR.1", 0.2, hide, None, keep_stick, "teleop"),
    Edge("POSE_LOST.0", 0.3, set_world(localization_silent=True), located),
    Edge("POSE_LOST.1", 0.3, set_world(localization_silent=True), located, keep_stick, "teleop"),
    Edge("STUCK.0", 1.0, set_drive(runs_on=True, speeds=(0.0, 0.0))),
    Edge("RUNAWAY.0", 0.1, set_drive(runs_on=True, speeds=(9.0, 9.0))),
    Edge("RUNAWAY.1", 0.25, set_drive(runs_on=True, speeds=(9.0, 9.0))),
    Edge("YAW_DISAGREE.0", 0.5, set_world(gyro_off_radps=0.35)),
    Edge("YAW_DISAGREE.0", 0.74, set_world(gyro_silent=True)),
    Edge("ENC_STALE.0", 0.08, set_world(drive_silent=True), driven),
    Edge("ENC_STALE.1", 0.25, set_world(drive_silent=True), driven),
    Edge("DRIVER_NACK.0", 0.1, set_drive(deaf=True)),
    Edge("DRIVER_NACK.1", 0.5, set_drive(deaf=True)),
    Edge("DRIVE_FOREIGN.0", 0.0, set_drive(deaf=True, echo_seq=10**6)),
    Edge("DRIVE_REBOOT.0", 0.0, set_drive(boot_id="d1", angles=(0.0, 0.0))),
    Edge("OVERCURRENT.0", 0.1, set_drive(current_a=31.0)),
    Edge("BATTERY.0", 2.0, set_drive(battery=0.15)),
    Edge("BATTERY.1", 2.0, set_drive(battery=0.05)),
    Edge("ESTOP.0", 0.0, set_drive(estop_pressed=True)),
)


@pytest.mark.parametrize("edge", EDGES, ids=lambda edge: f"{edge.stage}-{edge.window_s:g}")
def test_a_row_rises_at_the_edge_of_its_window(edge: Edge) -> None:
    world = reached(edge.start)
    edge.begin(world)
    begun_s = world.now_s + PERIOD_S  # the first tick that can see it
    while not raised(world, edge.stage):
        edge.keep(world)
        world.tick()
        since_s = begun_s - PERIOD_S if edge.since is None else edge.since(world)
        assert since_s is not None
        lasted_s = world.now_s - since_s
        if raised(world, edge.stage):
            assert lasted_s >= edge.window_s - 1e-6, "not before the window is over"
        else:
            assert lasted_s <= edge.window_s + 2 * PERIOD_S - 1e-6, "and soon when it is"


@pytest.mark.parametrize(("metres", "expected"), [(0.02, True), (-0.02, False)])
def test_a_zone_begins_where_the_robot_must_slow_down_for_it(metres: float, expected: bool) -> None:
    world = reached("active")
    limits, late_s = world.core.robot.limits, world.core.robot.drive.late_s
    reaction_s = 0.1 + late_s + limits.max_decel_mps2 / (2 * limits.stop_jerk_mps3)
    fast = limits.max_speed_mps
    slowing_m = fast * reaction_s + (fast * fast - 0.2 * 0.2) / (2 * limits.max_decel_mps2)
    edge_m = world.here.x_m + world.sent.v_mps * PERIOD_S + slowing_m - metres
    zone = Zone(((edge_m, -1.0), (edge_m + 2.0, -1.0), (edge_m + 2.0, 1.0), (edge_m, 1.0)), 0.2)
    world.core = replace(world.core, fence=build_fence(MAP_ID, (SQUARE,), zones=(zone,)))
    world.tick()
    assert raised(world, "SPEED_ZONE.0") is expected


def test_a_real_drive_without_rights_is_slow_from_the_first_tick() -> None:
    robot = RobotDescription()
    robot = robot.model_copy(update={"drive": robot.drive.model_copy(update={"kind": "pons_mcu"})})
    assert not robot.drive.virtual
    for granted in (True, False):
        world = World(core=config(robot), real_time=granted)
        world.tick()
        assert raised(world, "NOT_RT.0") is not granted


BY_VALUE = {
    "LOOP_LATE.0", "LOOP_LATE.1", "LOOP_LATE.2", "POSE_JUMP.0", "POSE_JUMP.1", "HAND_BUDGET.0",
    "STUCK.1", "CMD_BAD.0", "BUDGET.0", "DEAD_MAN.0", "DEAD_MAN.1",
}  # fmt: skip
"""Stages without a window in time; the tables of their detectors have their edges."""


def test_every_stage_has_its_edges() -> None:
    assert {edge.stage for edge in EDGES} | {"SPEED_ZONE.0", "NOT_RT.0"} | BY_VALUE == set(
        oracle.TABLE
    )
