"""Give orders while everything is killed and cut, by a plan drawn from a seed; then have it judged.

What was accepted and what was done is appended to files in the folder: a trial that was broken off
goes on from there, and the break is one fault more.
"""

from __future__ import annotations

import asyncio
import json
import os
import random
import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import httpx

from tools.fleet_trial.verdict import ENDED, TrialVerdict, judge

if TYPE_CHECKING:
    from tools.fleet_trial.house import House, LinkRobot
    from tools.fleet_trial.wires import Cut

Fault = Literal["service", "robot", "cut", "postgres", "answer"]
CALM_S, AT_LAST_S = 60.0, 240.0
TELL_S = 10.0
PLACES = ("kitchen", "sofa", "living room")
FIRST = 100_001
"""The sentences end with a number, which begins here."""


@dataclass(frozen=True, slots=True)
class Weather:
    """Say how much of what is to come, and in how long a time."""

    missions: int
    span_s: float
    faults: dict[Fault, int]
    cuts_s: tuple[float, ...]
    seed: int = 1


@dataclass(slots=True)
class Storm:
    """Hold one trial while it runs."""

    house: House
    weather: Weather
    accepted: dict[int, list[str]] = field(default_factory=dict)
    accept_s: list[float] = field(default_factory=list)
    done: dict[str, int] = field(default_factory=dict)
    _locks: dict[str, asyncio.Lock] = field(default_factory=dict)
    _hurt: dict[str, float] = field(default_factory=dict)

    async def run(self) -> tuple[TrialVerdict, TrialVerdict, float]:
        """Return the verdict after 60 s of calm, the last one, and how long that took [s]."""
        self._recall()
        began_s = time.monotonic()
        people = asyncio.create_task(self._resume_paused())
        telling = asyncio.create_task(self._tell(began_s))
        chance = random.Random(self.weather.seed + len(self.accepted))
        try:
            async with asyncio.TaskGroup() as group:
                group.create_task(self._give_all(group, chance))
                for kind, count in self.weather.faults.items():
                    group.create_task(
                        self._break_all(group, kind, count, random.Random(chance.random()))
                    )
            calm_s = time.monotonic()
            await self._await_ends(calm_s + CALM_S)
            after_calm = await self._judge()
            await self._await_ends(calm_s + AT_LAST_S)
            return after_calm, await self._judge(), time.monotonic() - calm_s
        finally:
            people.cancel()
            telling.cancel()
            await asyncio.gather(people, telling, return_exceptions=True)

    async def _judge(self) -> TrialVerdict:
        return await asyncio.to_thread(judge, self.accepted, self.house.homes, self.house.database)

    # Orders ---------------------------------------------------------------------------------------

    async def _give_all(self, group: asyncio.TaskGroup, chance: random.Random) -> None:
        gap_s = self.weather.span_s / self.weather.missions
        for number in range(FIRST, FIRST + self.weather.missions):
            if number not in self.accepted:
                group.create_task(self._give(number, chance.random()))
                await asyncio.sleep(gap_s * chance.uniform(0.5, 1.5))

    async def _give(self, number: int, luck: float) -> None:
        """Ask until it is accepted, as a client does: by one key."""
        to: Any = "any" if luck < 0.7 else "nearest"
        if luck > 0.75:
            to = [self.house.homes[number % len(self.house.homes)].name]
        order = {"text": f"go to the {PLACES[number % len(PLACES)]} and say {number}", "to": to}
        while True:
            asked_s = time.monotonic()
            try:
                answer = await self.house.client.post(
                    "/v1/missions", json=order, headers={"idempotency-key": f"order-{number}"}
                )
            except httpx.HTTPError:
                await asyncio.sleep(0.5)
                continue
            if answer.status_code == 202:
                break
            await asyncio.sleep(0.5)
        self.accept_s.append(time.monotonic() - asked_s)
        ids = [mission["id"] for mission in answer.json()["missions"]]
        self.accepted[number] = ids
        self._note("accepted", number=number, ids=ids)

    # Faults ---------------------------------------------------------------------------------------

    async def _break_all(
        self, group: asyncio.TaskGroup, kind: Fault, count: int, chance: random.Random
    ) -> None:
        times = sorted(chance.uniform(0.02, 1.0) * self.weather.span_s for _ in range(count))
        if kind == "cut":  # the long ones first, so that they end with the others
            times = [at_s * 0.6 for at_s in times]
        began_s = time.monotonic()
        for index, at_s in enumerate(times):
            if index < self.done.get(kind, 0):
                continue
            await asyncio.sleep(max(0.0, began_s + at_s - time.monotonic()))
            group.create_task(self._break(kind, index, chance))

    async def _break(self, kind: Fault, index: int, chance: random.Random) -> None:
        robot = chance.choice(self.house.robots)
        lock = robot.home.name if kind == "robot" else kind
        if kind in ("service", "robot", "postgres"):
            async with self._locks.setdefault(lock, asyncio.Lock()):
                await self._kill(kind, robot, chance)
        elif kind == "cut":
            cuts = sorted(self.weather.cuts_s, reverse=True)
            seconds, how = cuts[index * len(cuts) // self.weather.faults["cut"]], _hows(index)
            whole = [each for each in self.house.robots if not each.wire.is_cut]
            await chance.choice(whole).wire.cut(how, seconds)
        else:
            robot.wire.answers_to_lose += 1
        self.done[kind] = self.done.get(kind, 0) + 1
        self._note("fault", kind=kind)

    async def _kill(self, kind: Fault, robot: LinkRobot, chance: random.Random) -> None:
        if kind == "service":
            self.house.kill_service()
            await self.house.start_service()
        elif kind == "robot":
            robot.kill()
            await asyncio.sleep(chance.uniform(0.0, 4.0))
            robot.start()
            self._hurt[robot.home.name] = time.monotonic()
        elif self.house.postgres is not None:
            self.house.postgres.kill()
            await asyncio.sleep(chance.uniform(0.0, 3.0))
            await asyncio.to_thread(self.house.postgres.start)

    async def _resume_paused(self) -> None:
        """Be the owner who finds a robot that was killed, and resumes what it left paused."""
        while True:
            await asyncio.sleep(1.0)
            for robot in self.house.robots:
                since_s = self._hurt.get(robot.home.name)
                if since_s is None:
                    continue
                if not await robot.resume_paused() and time.monotonic() - since_s > 10.0:
                    self._hurt.pop(robot.home.name, None)

    # The end --------------------------------------------------------------------------------------

    async def _await_ends(self, end_s: float) -> None:
        while await self._count_open() and time.monotonic() < end_s:  # noqa: ASYNC110  # a service's
            await asyncio.sleep(1.0)

    async def _count_open(self) -> int:
        """Return how many the fleet calls open; -1 where it does not answer."""
        try:
            shown = await self.house.client.get("/v1/missions", params={"limit": 200})
            return sum(mission["state"] not in ENDED for mission in shown.json()["missions"])
        except (httpx.HTTPError, ValueError, KeyError):
            return -1

    async def _tell(self, began_s: float) -> None:
        while True:
            open_ = await self._count_open()
            faults = ", ".join(f"{kind} {count}" for kind, count in self.done.items())
            print(f"{time.monotonic() - began_s:6.0f} s  accepted {len(self.accepted)}"
                  f"/{self.weather.missions}, open {open_}, done: {faults or '-'};"
                  f" load {os.getloadavg()[0]:.1f}", flush=True)  # fmt: skip
            await asyncio.sleep(TELL_S)

    # What is kept ---------------------------------------------------------------------------------

    def _note(self, what: str, **more: Any) -> None:
        with (self.house.folder / "storm.jsonl").open("a", encoding="utf-8") as file:
            file.write(json.dumps({"what": what, **more}) + "\n")

    def _recall(self) -> None:
        file = self.house.folder / "storm.jsonl"
        if not file.exists():
            return
        for line in file.read_text("utf-8").splitlines():
            row = json.loads(line)
            if row["what"] == "accepted":
                self.accepted[row["number"]] = row["ids"]
            else:
                self.done[row["kind"]] = self.done.get(row["kind"], 0) + 1
        self._hurt = dict.fromkeys((home.name for home in self.house.homes), time.monotonic())


def _hows(index: int) -> Cut:
    return "held" if index % 2 else "refused"
