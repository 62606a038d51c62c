"""Bring the scripted world into every mode by a real run. What moves, moves when it is returned."""

from __future__ import annotations

from functools import cache

from bridge.core import Inbox
from bridge.core.state import draft
from bridge.core.tick_context import TickContext
from tests.bridge.core.external_brain import drive_for, external_world
from tests.bridge.core.fake_planner import PERIOD_S
from tests.bridge.core.scripted import World
from wire import Mode


def boot() -> World:
    return World()


def selftest() -> World:
    world = World()
    world.run(0.3)
    return world


def disarmed() -> World:
    return World().ready()


def hold() -> World:
    world = reached("disarmed").arm()
    world.run(0.5)
    return world


def hold_granted() -> World:
    world = reached("disarmed").arm()
    world.brain.mission = "m1"
    world.run(0.5)
    return world


def active() -> World:
    return reached("disarmed").arm().drive_to((5.0, 0.0))


def turning() -> World:
    world = reached("disarmed").arm()
    world.brain.mission, world.brain.goal_m = "m1", (-4.0, 0.0)
    world.until(Mode.ACTIVE)
    world.run(0.6)
    return world


def active_external() -> World:
    world = external_world()
    drive_for(world, 1.0)
    return world


def teleop() -> World:
    world = reached("disarmed").arm()
    world.teleop(0.0, held=False)
    world.tick()
    for _ in range(12):
        world.teleop(0.4, 0.2, held=True)
        world.run(0.05)
    return world


def stopping_by_row() -> World:
    world = reached("active")
    world.lidar_silent = True
    world.until(Mode.STOPPING, 1.0)
    return world


def stopping_by_person() -> World:
    world = reached("active")
    world.stop()
    world.tick()
    return world


def stopping_to_disarm() -> World:
    world = reached("teleop")
    world.op("disarm")
    world.tick()
    return world


def stopping_hardest() -> World:
    world = reached("active")
    world.drive_silent = True
    world.until(Mode.STOPPING, 1.0)
    world.run(0.2)
    world.drive_silent = False
    return world


def estopped_moving() -> World:
    world = reached("active")
    world.op("estop")
    world.tick()
    return world


def estopped() -> World:
    world = reached("estopped_moving")
    world.run(3.0)
    return world


def fault() -> World:
    world = reached("active")
    world.drive.runs_on = True
    world.stop()
    world.until(Mode.FAULT, 2.0)
    world.drive.runs_on = False
    world.run(1.0)
    return world


STARTS = {
    "boot": (boot, Mode.BOOT, ""),
    "selftest": (selftest, Mode.SELFTEST, ""),
    "disarmed": (disarmed, Mode.DISARMED, ""),
    "hold": (hold, Mode.HOLD, ""),
    "hold_granted": (hold_granted, Mode.HOLD, "W"),
    "active": (active, Mode.ACTIVE, "W"),
    "turning": (turning, Mode.ACTIVE, "W"),
    "active_external": (active_external, Mode.ACTIVE, "X"),
    "teleop": (teleop, Mode.TELEOP, "T"),
    "stopping_by_row": (stopping_by_row, Mode.STOPPING, "W"),
    "stopping_by_person": (stopping_by_person, Mode.STOPPING, "W"),
    "stopping_to_disarm": (stopping_to_disarm, Mode.STOPPING, "T"),
    "stopping_hardest": (stopping_hardest, Mode.STOPPING, "W"),
    "estopped_moving": (estopped_moving, Mode.ESTOPPED, ""),
    "estopped": (estopped, Mode.ESTOPPED, ""),
    "fault": (fault, Mode.FAULT, ""),
}
"""Name: how, the mode, and whose rows bind in it."""
MOVES = {
    "active", "turning", "active_external", "teleop", "stopping_by_row", "stopping_by_person",
    "stopping_to_disarm", "stopping_hardest", "estopped_moving",
}  # fmt: skip


@cache
def _reached(name: str) -> World:
    make, mode, _ = STARTS[name]
    world = make()
    assert world.mode is mode, f"{name} is in {world.mode}"
    return world


def reached(name: str) -> World:
    """Return a world of one's own in the mode."""
    return _reached(name).fork()


def tick_of(world: World) -> TickContext:
    """Return the next tick of a world, in which nothing has come."""
    return TickContext(world.core, draft(world.state), Inbox(), world.now_s, PERIOD_S)


def at(start: str = "active") -> TickContext:
    """Return the next tick of a world that reached a mode."""
    return tick_of(reached(start))
