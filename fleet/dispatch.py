"""Give waiting missions their robots, the oldest first; one that none may take ends, told why.

What a mission waits for is found anew in each round and told by code; nothing of it is kept.
"""

from __future__ import annotations

import asyncio
import json
import logging
import time
from collections import Counter
from contextlib import suppress
from typing import TYPE_CHECKING

from fleet import workflow
from fleet.choice import BARRED, FAR, LOAD_M, Abilities, assign, steps_of
from fleet.errors import FleetError, tell
from fleet.house import HouseRules
from fleet.prospect import Prospect, look_ahead
from fleet.records import CANCELLED, REFUSED, WAITING, MissionRow, RobotRow, cause_of

if TYPE_CHECKING:
    from fleet.store import FleetStore
    from fleet.watch import RobotWatch

log = logging.getLogger(__name__)

DISPATCH_S = 2.0
FRESH_S = 20.0
"""A look ahead counts for so long: robots that are free stand still."""
ROUND_S_AN_ORDER, JUDGED_AT_ONCE = 1e-4, 50
"""Orders between two turns of all else that this process does."""
MOST_LOOKS = 100
"""Orders that are looked at ahead in one round; the next round goes on behind them."""


class Dispatcher:
    """Hold what is known of the robots, and choose."""

    def __init__(
        self, store: FleetStore, watches: dict[str, RobotWatch], rows: dict[str, RobotRow]
    ) -> None:
        self._store, self._watches, self._rows = store, watches, rows
        self.work = asyncio.Event()
        self.rules = HouseRules()
        self._abilities = Abilities({})
        self._why: dict[str, str] = {}
        self._instead: dict[str, list[str]] = {}
        self._next_why: dict[str, str] = {}
        self._next_instead: dict[str, list[str]] = {}
        """Of the round that is being made: till its end people are told the former one's."""
        self._ahead: dict[tuple[str, str], tuple[float, Prospect]] = {}
        self._looks = 0

    async def run(self) -> None:
        """Choose whenever there is work, until cancelled. Raises SQLAlchemyError."""
        while True:
            with suppress(TimeoutError):
                await asyncio.wait_for(self.work.wait(), DISPATCH_S)
            self.work.clear()
            count = await self._give_robots()
            # Where thousands wait, others get as much of the processor as a round takes.
            await asyncio.sleep(ROUND_S_AN_ORDER * count)

    def waits_for(self, mission: MissionRow) -> str | None:
        """Return what a waiting mission waits for, by code."""
        if mission.state != WAITING or mission.question:
            return None
        answering = [name for name in self._candidates(mission) if self._watches[name].is_ready]
        return self._why.get(mission.id, "being_chosen" if answering else "nobody_answers")

    def instead_of(self, mission: MissionRow) -> list[str]:
        """Return the robots that are free and could take what waits for others."""
        return self._instead.get(mission.id, []) if mission.state == WAITING else []

    async def _give_robots(self) -> int:
        """Make one round, and return how many orders were waiting."""
        waiting = await asyncio.to_thread(self._store.waiting)
        self._next_why, self._next_instead, self._looks = {}, {}, 0
        if waiting:
            await self._choose(waiting)
        self._why, self._instead = self._next_why, self._next_instead
        return len(waiting)

    async def _choose(self, waiting: list[MissionRow]) -> None:
        choice = await self._look_round()
        self._abilities.forget_but([mission.id for mission in waiting])
        oldest_s = time.monotonic() - FRESH_S
        self._ahead = {pair: seen for pair, seen in self._ahead.items() if seen[0] > oldest_s}
        batch: list[tuple[MissionRow, dict[str, Prospect]]] = []
        for number, mission in enumerate(waiting):
            if number % JUDGED_AT_ONCE == JUDGED_AT_ONCE - 1:
                await asyncio.sleep(0)
            may = await self._judge(mission, choice)
            if mission.is_urgent:
                turns = sorted(may, key=lambda name: (name not in choice.free, self._turn(name)))
                for robot in turns[:1]:
                    await self._claim(mission, robot, frozenset())
                continue
            if may and len(batch) == len(choice.free):
                may = self._wait(mission, "robots_busy")
            if not may or self._looks >= MOST_LOOKS:
                continue
            if ways := await self._look_ahead(mission, may, choice):
                batch.append((mission, ways))
        await self._assign(batch, choice, waiting)

    async def _look_round(self) -> _Round:
        """Read how robots and house stand now."""
        store = self._store

        def read() -> tuple[list[RobotRow], HouseRules, set[str], set[str], set[str]]:
            held, lows = store.missions_at_robots(), store.lows()
            return store.robots(), store.rules(), set(held), set(lows), store.rooms_held()

        rows, self.rules, held, lows, taken = await asyncio.to_thread(read)
        self._rows.update({row.name: row for row in rows})
        cards = {name: row.capabilities for name, row in self._rows.items()}
        if self._abilities.cards != cards:
            self._abilities = Abilities(cards)
        return _Round(self._abilities, self._watches, self.rules, held, lows, taken)

    async def _judge(self, mission: MissionRow, choice: _Round) -> list[str]:
        """Return the free robots that may take a mission; where none may, why is kept or told."""
        may, late_s = self._candidates(mission), self.rules.late_min * 60.0
        if cause_of(mission) == "standing_order" and mission.created_unix_s < time.time() - late_s:
            return await self._end(mission, CANCELLED, "too_late")
        if not may:
            return await self._end(mission, CANCELLED, "stopped_first")
        able = choice.abilities.able(mission, may)
        if not able:
            return await self._end(mission, REFUSED, "nobody_can")
        if mission.is_urgent:  # it may mean a stop, so that no rule holds it back
            return [name for name in able if self._watches[name].is_ready]
        if mission.way in ("any", "nearest"):
            homes = choice.abilities.homes(mission, able, self.rules)
            if len(homes) > 1:
                return await self._ask_home(mission, homes)
            able = [name for name in able if name not in choice.lows]
        if not able:
            return self._wait(mission, "robots_low")
        if choice.is_spent and not steps_of(mission):
            able = [name for name in able if self._watches[name].usage.get("model", "") is None]
            if not able:
                return self._wait(mission, "budget_spent")
        ready = [name for name in able if self._watches[name].is_ready]
        free = [name for name in ready if name in choice.free]
        if not free and ready:
            others = [name for name in choice.free if name not in choice.lows]
            self._next_instead[mission.id] = choice.abilities.able(mission, others)
        return free or self._wait(mission, "robots_busy" if ready else "nobody_answers")

    async def _look_ahead(
        self, mission: MissionRow, may: list[str], choice: _Round
    ) -> dict[str, Prospect]:
        """Return who may begin now, with what it would do; where none may, why is kept."""
        is_held_back = self.rules.is_quiet(time.time()) and not _may_disturb(mission)
        if not (is_held_back or self.rules.rooms or (mission.way == "nearest" and len(may) > 1)):
            return {name: Prospect(0.0, moves=True, rooms=frozenset()) for name in may}
        found = dict(zip(may, await asyncio.gather(
            *(self._prospect(mission, name, choice) for name in may)), strict=True))  # fmt: skip
        if is_held_back and any(each.moves for each in found.values()):
            self._wait(mission, "quiet_hours")
            return {}
        open_to = {name: each for name, each in found.items()
                   if not choice.rooms_wanted(name, each) & choice.rooms_closed(name)}  # fmt: skip
        if not open_to:
            self._wait(mission, "room_taken")
        return open_to

    async def _prospect(self, mission: MissionRow, robot: str, choice: _Round) -> Prospect:
        known = self._ahead.get((mission.id, robot))
        if known is None:
            self._looks += 1
            card = choice.abilities.cards[robot]
            seen = await look_ahead(mission, self._watches[robot], card)
            known = self._ahead[mission.id, robot] = (time.monotonic(), seen)
        return known[1]

    async def _assign(
        self,
        batch: list[tuple[MissionRow, dict[str, Prospect]]],
        choice: _Round,
        waiting: list[MissionRow],
    ) -> None:
        """Claim robots for the oldest orders so that the sum of their ways is least."""
        named = Counter(each.names for each in waiting)
        load = {robot: named[json.dumps([robot])] for robot in choice.free}
        turns = sorted(choice.free, key=self._turn)
        robots = [name for name in turns if any(name in ways for _, ways in batch)]

        def cost(mission: MissionRow, ways: dict[str, Prospect], robot: str) -> float:
            if robot not in ways:
                return BARRED
            way_m = min(ways[robot].length_m, FAR) if mission.way == "nearest" else 0.0
            return float(way_m + LOAD_M * load[robot] + 1e-3 * turns.index(robot))

        costs = [[cost(each, ways, robot) for robot in robots] for each, ways in batch]
        pairs = await asyncio.to_thread(assign, costs)  # the first time it loads a large library
        for row, at in pairs:
            mission, ways = batch[row]
            wanted = choice.rooms_wanted(robots[at], ways[robots[at]])
            if not await self._claim(mission, robots[at], wanted):
                self._wait(mission, "room_taken" if wanted else "robots_busy")
        for row in {*range(len(batch))} - {row for row, _ in pairs}:
            self._wait(batch[row][0], "robots_busy")
        if pairs and len(waiting) > len(pairs):
            self.work.set()  # who is behind them may go at once

    def _turn(self, robot: str) -> tuple[int, str]:
        return self._rows[robot].used_seq, robot

    async def _claim(self, mission: MissionRow, robot: str, wanted: frozenset[str]) -> bool:
        claimed = await asyncio.to_thread(self._store.claim, mission, robot, wanted)
        if claimed is not None:
            await workflow.begin(claimed)
        return claimed is not None

    async def _end(self, mission: MissionRow, state: str, reason: str) -> list[str]:
        await asyncio.to_thread(self._store.end, mission.id, state, reason)
        return []

    def _wait(self, mission: MissionRow, reason: str) -> list[str]:
        self._next_why[mission.id] = reason
        return []

    async def _ask_home(self, mission: MissionRow, homes: dict[str, list[str]]) -> list[str]:
        """Ask people which home is meant; the mission waits for their answer."""
        if mission.question is None:
            options = [{"text": {"en": name, "zh": name}, "robots": who}
                       for name, who in sorted(homes.items())]  # fmt: skip
            text = tell("which_home", {"known": ", ".join(sorted(homes))})
            asked = {"kind": "which_home", "text": text, "options": options}
            question = json.dumps(asked, ensure_ascii=False)
            await asyncio.to_thread(self._store.change_waiting, mission.id, question=question)
        return []

    def _candidates(self, mission: MissionRow) -> list[str]:
        """Return who may go: an order of before a robot's stop moves it no more."""
        return [
            name
            for name in mission.candidates or tuple(self._rows)
            if name in self._rows
            and name in self._watches
            and mission.seq > self._rows[name].stopped_seq
        ]


class _Round:
    """Hold how things stand as one round of choosing begins."""

    def __init__(
        self,
        abilities: Abilities,
        watches: dict[str, RobotWatch],
        rules: HouseRules,
        held: set[str],
        lows: set[str],
        taken: set[str],
    ) -> None:
        self.abilities, self.rules, self.lows, self._taken = abilities, rules, lows, taken
        cards = abilities.cards
        self.free = [name for name, watch in watches.items()
                     if watch.is_ready and name not in held and name in cards]  # fmt: skip
        self.is_spent = rules.is_spent((each.usage for each in watches.values()), time.time())
        self._stands = {name: self._key(name, str(watch.told.get("room")))
                        for name, watch in watches.items() if name in cards}  # fmt: skip

    def rooms_wanted(self, robot: str, ahead: Prospect) -> frozenset[str]:
        """Return the rooms for one robot that a mission needs; a way that is not known, all."""
        rooms = self.rules.rooms if ahead.moves else ()
        return frozenset(self._key(robot, room) for room in rooms
                         if ahead.rooms is None or room in ahead.rooms)  # fmt: skip

    def rooms_closed(self, robot: str) -> frozenset[str]:
        """Return the rooms that others are bound for, or stand in as they told last."""
        return frozenset(
            {*self._taken, *(at for name, at in self._stands.items() if name != robot)}
        )

    def _key(self, robot: str, room: str) -> str:
        return f"{self.rules.home_of(self.abilities.cards[robot])[0]}/{room}"


def robots_meant(question: str, text: str) -> list[str]:
    """Return the robots of the home that an answer names.

    Raises:
        FleetError: ``which_home``: it names none, or several.
    """
    options, said = json.loads(question)["options"], text.casefold().strip(" .。!！")
    named = [each for each in options if each["text"]["en"].casefold() == said]
    named = named or [each for each in options if said in map(str.casefold, each["robots"])]
    if len(named) != 1:
        raise FleetError("which_home", known=", ".join(each["text"]["en"] for each in options))
    return list(named[0]["robots"])


def _may_disturb(mission: MissionRow) -> bool:
    """Return whether a mission may move in quiet hours: one that asks for a yes, or to charge."""
    is_confirmed = bool(json.loads(mission.body).get("confirm"))
    return mission.is_urgent or is_confirmed or cause_of(mission) == "low_battery"
