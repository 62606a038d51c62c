"""Live, die and live again on a journal: ``python -m tools.bench.journal_life FOLDER SEED KILLS``.

Each life is a forked process with the planner's real missions, runner and SQLite journal; only the
robot is on paper, and outlives it in shared memory. A life ends by SIGKILL at a random one of its
writes, or up to 3 ms after it, in the midst of a commit. Prints what came of it as JSON.
"""

from __future__ import annotations

import asyncio
import json
import logging
import os
import signal
import sys
import threading
import time
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import count
from math import hypot
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING, Any

import sqlalchemy as sa

from planner.brain import ScriptedBrain, ThinkRequest, ThinkResult
from planner.bridge_client import Link
from planner.mission import BadState, Clocks, JournalSync, MissionJournal, Missions
from planner.mission.event_hub import Hub
from planner.navigation import RoutePoint, RouteRequest, RouteResult
from planner.plan import ENDED, Ask, GoalState, MoveStraight, Say, StepPlan, Turn
from planner.site import Site
from tools.bench.minimal_sim import MinimalBody, PaperBridge
from tools.lockstep.scene import SITES
from wire import OpRequest, RobotDescription

if TYPE_CHECKING:
    from collections.abc import Callable

log = logging.getLogger(__name__)

SITE = "two_room"
LIFE_S = 30.0
LATE_S = 0.003
PLANS = {
    "turn about": (Say(text="one"), Turn(angle_rad=2.5), Say(text="two")),
    "drive up": (MoveStraight(distance_m=0.6), Ask(question="three?"), Say(text="four")),
    "drive off": (Say(text="five"), MoveStraight(distance_m=-0.4), Turn(angle_rad=-1.0)),
}
TURNED_RAD, GONE_M = 1.5, 0.2
OFF = 0.3
"""Rounding of three legs and three interruptions; a leg done twice is 0.4 m or 1 rad."""


class ByText(ScriptedBrain):
    """Plan by what was said, however often it is asked."""

    async def think(self, request: ThinkRequest, hear: object = None) -> ThinkResult:
        """Return the plan of a sentence."""
        del hear
        return ThinkResult(
            plan=StepPlan(steps=PLANS[request.text]), brain=self.tag, by_grammar=True
        )


class StraightFlight:
    """Route in straight lines."""

    async def route(self, request: RouteRequest) -> RouteResult:
        """Return the line from start to goal."""
        a, b = request.start, request.goal
        length_m = hypot(b.x_m - a.x_m, b.y_m - a.y_m)
        steps = max(1, round(length_m / 0.1))
        points = tuple(
            RoutePoint(
                a.x_m + (b.x_m - a.x_m) * i / steps, a.y_m + (b.y_m - a.y_m) * i / steps, 0.5
            )
            for i in range(steps + 1)
        )
        return RouteResult(points, length_m, 0.0, False, 0.0)


@dataclass
class Diary:
    """Write what the world saw; lines survive any death."""

    path: Path
    life: int
    legs: set[tuple[str, int]] = field(default_factory=set)
    acted: bool = False

    def note(self, *words: object) -> None:
        """Write one line in one system call."""
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps([self.life, *words]) + "\n")

    def leg(self, mission: str, leg: int) -> None:
        """Note the beginning of a leg, once in a life."""
        if (mission, leg) not in self.legs:
            self.legs.add((mission, leg))
            self.note("leg", mission, leg, self.acted)

    def lines(self) -> list[list[Any]]:
        """Return all that was written in all lives."""
        if not self.path.exists():
            return []
        return [json.loads(line) for line in self.path.read_text("utf-8").splitlines()]


def die_at(write: int | None, late_s: float | None, body: MinimalBody) -> None:
    """Count this process's writes, and end it at one of them."""

    def wrote(*_: object, **__: object) -> None:
        body.writes += 1
        if body.writes != write:
            return
        if late_s is None:
            os.kill(os.getpid(), signal.SIGKILL)
        killer = threading.Timer(late_s or 0.0, os.kill, (os.getpid(), signal.SIGKILL))
        killer.daemon = True
        killer.start()

    def statement(_c: object, _u: object, text: str, *_: object) -> None:
        if text.startswith(("INSERT", "UPDATE", "CREATE")):
            wrote()

    sa.event.listen(sa.engine.Engine, "before_cursor_execute", statement)
    sa.event.listen(sa.engine.Engine, "commit", wrote)


def live(folder: Path, life: int, body: MinimalBody) -> int:
    """Be one planner and one person until every goal has ended."""
    diary = Diary(folder / "diary", life)
    whole = Hub.publish

    def publish(self: Hub, event: dict[str, Any]) -> None:
        if event["type"] == "say":
            diary.note("say", event["goal"], event["text"])
        whole(self, event)

    Hub.publish = publish  # type: ignore[method-assign]  # the very moment at which it is said
    asyncio.run(_live(folder, life, body, diary))
    return 0


async def _live(folder: Path, life: int, body: MinimalBody, diary: Diary) -> None:
    bridge = PaperBridge.of(body, diary.leg)
    robot, numbers = RobotDescription(), count(1)
    missions = Missions(
        site=Site.load(SITES / SITE),
        robot=robot,
        link=Link(bridge, robot, clock=bridge.now_s),
        router=StraightFlight(),
        brain=ByText(["-"]),
        disk=JournalSync(MissionJournal.in_home(folder)),
        planner_id=f"planner-{life}",
        clocks=Clocks(bridge.now_s, time.time, lambda: f"g{life}-{next(numbers)}"),
    )
    await missions.start()
    before = (body.x_m, body.y_m, body.yaw_rad)
    await asyncio.sleep(0.03)
    if life > 0 and before != (body.x_m, body.y_m, body.yaw_rad):
        diary.note("unasked")
    acts = (OpRequest(id=f"a{life}-{i}", source="bench") for i in count())
    diary.acted = True
    given = [await _give(missions, text, diary, next(acts)) for text in PLANS]
    while any(missions.goal(i).state not in ENDED for i in given):
        for goal in reversed(missions.goals()):
            held = goal.state is GoalState.QUEUED and goal.reason == "held"
            with suppress(BadState):  # it went on while we asked for another
                if goal.state is GoalState.PAUSED or held:
                    await missions.resume(goal.id, act=next(acts))
                elif goal.state is GoalState.NEEDS_CLARIFICATION:
                    await missions.answer(goal.id, "yes", act=next(acts))
        await asyncio.sleep(0.005)
    await missions.close()


async def _give(missions: Missions, text: str, diary: Diary, act: OpRequest) -> str:
    """Give a goal as a client does that asks again after every silence."""
    goal = await missions.submit(text, idempotency_key=f"key of {text}", act=act)
    diary.note("accepted", text, goal.id)
    return goal.id


def fork(life: Callable[[], int], limit_s: float = LIFE_S) -> int:
    """Run a life in a process of its own; return its wait status, or -1 if it never ended."""
    pid = os.fork()
    if pid == 0:
        try:
            os._exit(life())
        except Exception:
            log.exception("a life failed")
        finally:
            os._exit(70)  # a child never returns into its parent's work
    end_s = time.monotonic() + limit_s
    while time.monotonic() < end_s:
        done, status = os.waitpid(pid, os.WNOHANG)
        if done:
            return status
        time.sleep(0.002)
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    return -1


def story(folder: Path, random: Random, writes: int, most: int) -> dict[str, Any]:
    """Kill a planner ``most`` times at random writes, let the last live to its end, and judge."""
    body, killed, crashed = MinimalBody(), 0, []
    for life in range(most + 1):
        at = random.randint(1, writes) if life < most else None
        late_s = random.choice((None, random.uniform(0.0, LATE_S)))
        body.writes = 0

        def run(life: int = life, at: int | None = at, late_s: float | None = late_s) -> int:
            die_at(at, late_s, body)
            return live(folder, life, body)

        status = fork(run)
        if status != -1 and os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGKILL:
            killed += 1
        elif status != 0:
            crashed.append(f"life {life}, killed at {at} of {body.writes}: status {status}")
        elif life < most:
            break  # it was done before that write
    return {"kills": killed, "crashed": crashed, "writes": body.writes,
            **judge(Diary(folder / "diary", -1).lines(), folder, body)}  # fmt: skip


def judge(lines: list[list[Any]], folder: Path, body: MinimalBody) -> dict[str, Any]:
    """Count accepted goals that are lost and side effects that came twice."""
    kept = {m.id: m for m in MissionJournal.in_home(folder).load().missions}
    accepted = {line[3] for line in lines if line[1] == "accepted"}
    lost = [i for i in accepted if i not in kept or kept[i].state is not GoalState.SUCCEEDED]
    said = [tuple(line[2:]) for line in lines if line[1] == "say"]
    legs = [tuple(line[2:4]) for line in lines if line[1] == "leg"]
    off = (abs(body.turned_rad - TURNED_RAD) > OFF) + (abs(body.gone_m - GONE_M) > OFF)
    return {
        "accepted": len(accepted),
        "lost": len(lost),
        "said_twice": len(said) - len(set(said)),
        "goals_twice": max(0, len(kept) - len(PLANS)),
        "legs_twice": len(legs) - len(set(legs)),
        "unasked": sum(line[1] == "unasked" for line in lines)
        + sum(line[1] == "leg" and not line[4] for line in lines),
        "way_twice": off,
        "off": [round(body.turned_rad - TURNED_RAD, 3), round(body.gone_m - GONE_M, 3)],
    }


def main(arguments: list[str]) -> int:
    """Tell stories until so many kills have struck."""
    folder, seed, kills = Path(arguments[0]), int(arguments[1]), int(arguments[2])
    random, told = Random(seed), []
    (folder / "dry").mkdir()
    whole = story(folder / "dry", random, 1, 0)
    told.append(whole)
    while sum(one["kills"] for one in told) < kills and len(told) <= 3 * kills:
        here = folder / str(len(told))
        here.mkdir()
        told.append(story(here, random, whole["writes"], 2))
    print(json.dumps(told))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
