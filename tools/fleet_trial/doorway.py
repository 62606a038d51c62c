"""Send three whole robots through one door at once, in lockstep, and count contacts and deadlocks.

Each robot has a world of its own (simulator, bridge, planner) on one clock; in each the other two
are bodies of their true size that stand, tick by tick, where they truly are. So each sees, keeps
right of and may hit the others; a contact is counted and does not push the other one away.
``python -m tools.fleet_trial.doorway --drives 50`` goes on where it stopped, with ``--file``.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
from math import hypot, inf
from pathlib import Path
from typing import Any

from lockstep.driven_world import DrivenWorld
from lockstep.scene import folder_of
from planner.plan import GoToPose
from sim.site import load_home
from sim.site.spec import Object
from wire import Pose2

SITE, LIMIT_S = "home", 180.0
OTHERS = ("other_0", "other_1")
OUT = (Pose2(1.4, 2.0, 1.57), (6.0, 4.7))
IN_HALLWAY = (Pose2(5.2, 4.75, 3.14), (1.2, 1.9))
IN_LIVING_ROOM = (Pose2(3.6, 7.0, -1.57), (3.5, 3.4))
IN_DOOR = (Pose2(2.0, 4.0, 1.57), (6.0, 4.7))
MEETINGS = {
    "three": (OUT, IN_HALLWAY, IN_LIVING_ROOM),
    "both_ways": (OUT, IN_HALLWAY),
    "same_way": (IN_HALLWAY, IN_LIVING_ROOM),
    "in_the_door": (IN_DOOR, IN_HALLWAY),
}
"""Where each begins and ends: out of the kitchen, and into it, through its only door."""


def drive(seed: int, meeting: str = "three") -> dict[str, Any]:
    """Return what came of one meeting."""
    chance = random.Random(seed)
    robots = MEETINGS[meeting]
    worlds = [_make_world(seed + index, start, chance) for index, (start, _) in enumerate(robots)]
    map_id = worlds[0].scene.site.map_id
    radius_m = worlds[0].scene.robot.base.radius_m
    _make_ready(worlds)
    begins = [round(100 * chance.uniform(0.0, 4.0)) for _ in worlds]
    goals: list[Any] = [None] * len(worlds)
    least_m, began = inf, worlds[0].tick_count
    for tick in range(round(100 * LIMIT_S)):
        for index, (world, (_, (x_m, y_m))) in enumerate(zip(worlds, robots, strict=True)):
            if tick == begins[index]:
                goals[index] = world.go(GoToPose(map_id=map_id, x_m=x_m, y_m=y_m))
        at_rest = [goal is not None and goal.has_ended for goal in goals]
        least_m = min(least_m, _turn_all(worlds, at_rest) - 2 * radius_m)
        if all(goal is not None and goal.has_ended for goal in goals):
            break
    states = [goal.state.value for goal in goals]
    return {
        "seed": seed,
        "meeting": meeting,
        "states": states,
        "reasons": [goal.record.reason for goal in goals],
        "contacts": sum(world.contacts for world in worlds),
        "least_gap_m": round(least_m, 3),
        "seconds": (worlds[0].tick_count - began) / 100,
        "deadlock": any(state != "succeeded" for state in states),
    }


def _make_world(seed: int, start: Pose2, chance: random.Random) -> DrivenWorld:
    home = load_home(folder_of(SITE))
    body = {"class": "plant", "size": (0.6, 0.6, 1.0)}  # round, as the robot is
    added = {
        name: Object.model_validate({**body, "at": (9.0 + index, 3.0)})
        for index, name in enumerate(OTHERS)
    }
    home = home.model_copy(update={"objects": {**home.objects, **added}})
    near = Pose2(
        start.x_m + chance.uniform(-0.2, 0.2), start.y_m + chance.uniform(-0.1, 0.1), start.yaw_rad
    )
    return DrivenWorld(site=SITE, home=home, seed=seed, start=near, ready=False)


def _make_ready(worlds: list[DrivenWorld]) -> None:
    """Arm all, side by side, as ``make_ready`` does for one."""
    for world in worlds:
        world.make_ready()
    latest = max(world.tick_count for world in worlds)
    for world in worlds:
        world.run((latest - world.tick_count) / 100)
    _turn_all(worlds, [False] * len(worlds))


def _turn_all(worlds: list[DrivenWorld], at_rest: list[bool]) -> float:
    """Let one tick pass for all; return the least distance between two middles [m].

    For one whose goal has ended, and that stands, time stops: the others still see and may hit it.
    """
    poses = [world.truth for world in worlds]
    for index, world in enumerate(worlds):
        if at_rest[index] and world.standing:
            continue
        rest = [pose for other, pose in enumerate(poses) if other != index]
        for name, pose in zip(OTHERS, rest, strict=False):
            world.sim.place_thing(name, pose)
        world.tick()
    return min(
        hypot(one.x_m - other.x_m, one.y_m - other.y_m)
        for index, one in enumerate(poses)
        for other in poses[index + 1 :]
    )


def main() -> int:
    """Drive so often, and print each and their sum."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--meeting", choices=MEETINGS, default="three")
    parser.add_argument("--first", type=int, default=0, help="the first drive's seed, by 1000")
    parser.add_argument("--drives", type=int, default=50)
    parser.add_argument("--file", type=Path, help="results are kept here, and not taken again")
    given = parser.parse_args()
    rows: list[dict[str, Any]] = []
    if given.file is not None and given.file.exists():
        rows = [json.loads(line) for line in given.file.read_text("utf-8").splitlines()]
    for seed in range(len(rows), given.drives):
        rows.append(drive(1000 * (given.first + seed), given.meeting))
        print(rows[-1], flush=True)
        if given.file is not None:
            with given.file.open("a", encoding="utf-8") as kept:
                kept.write(json.dumps(rows[-1]) + "\n")
    contacts, stuck = sum(row["contacts"] for row in rows), sum(row["deadlock"] for row in rows)
    print(f"{len(rows)} drives: contacts {contacts}, not all through {stuck}")
    return 0 if contacts + stuck == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
