"""Play one episode on a living robot and tell what came of it."""

from __future__ import annotations

import os
import threading
import time
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

from pons.http import PlannerDown, PlannerProblem
from tools.bench.chaos.draw import OWNER_OF, Episode, FaultKind
from tools.bench.chaos.faults import NEEDS_MOUNTS, break_house, processes_of, sockets
from tools.bench.chaos.person import Bystander, StopTold, say_stop
from tools.bench.chaos.verdict import contacts, has_moved, judge_stop, said_twice
from tools.bench.context import MeasurementFailure, line, until

if TYPE_CHECKING:
    from collections.abc import Callable

    from tools.bench.chaos.house import House
    from tools.bench.chaos.witness import Witness

WATCH_S = 2.0
"""So long after stop and mending nobody acts: what moves then moves unasked."""
SOCKET_S = 15.0


class Play:
    """Be one episode under way."""

    def __init__(self, house: House, witness: Witness, episode: Episode) -> None:
        self.house, self.witness, self.episode = house, witness, episode
        self.person = Bystander(house, witness)
        self.began_s = time.monotonic()
        self.told: dict[str, Any] = {**episode.record(), "words": [], "evidence": {}}
        self.stopping = StopTold()

    def run(self) -> dict[str, Any]:
        """Play it; whatever happens, everything is mended, and told."""
        told, episode = self.told, self.episode
        told["goals"] = [goal_id := self.person.give(episode.mission)]
        over_s = self._break_things()
        acts_s = self._watch(over_s)
        ready_s = self.person.make_ready()
        told["ready"] = ready_s is not None
        told["ready_s"] = None if episode.stop or ready_s is None else ready_s - over_s
        told["went_on"] = self._bring_back(goal_id) if told["ready"] else "not ready"
        told["last"] = self._last_order() if told["ready"] else "not ready"
        told["sockets"] = self._sockets()
        self._judge(acts_s)
        told["load"] = os.getloadavg()[0]
        told["took_s"] = time.monotonic() - self.began_s
        if told["unrecovered"] or told["lost"] or told["said_twice"] or told["stop_broken"]:
            told["evidence"] = {
                "bridge": self.witness.describe(),
                "missing": self.house.missing(),
                "logs": self.house.logs(self.began_s),
            }
        return told

    def _break_things(self) -> float:
        """Break and mend by the clock, with the stop beside it; return when all was mended."""
        began_s, episode = time.monotonic(), self.episode
        stopper: threading.Thread | None = None
        with ExitStack() as everything:
            due: list[tuple[float, Callable[[], object]]] = []
            for fault in episode.faults:
                stack = everything.enter_context(ExitStack())

                def begin(fault: Any = fault, stack: ExitStack = stack) -> None:
                    if fault.kind in NEEDS_MOUNTS and not self.house.mounts:
                        self.told["words"].append(f"{fault.name}: skipped, no mounts here")
                        return
                    word = stack.enter_context(break_house(self.house, fault))
                    if word:
                        self.told["words"].append(f"{fault.name}: {word}")

                due += [(fault.at_s, begin), (fault.at_s + fault.for_s, stack.close)]
            if episode.stop is not None:
                stopper = threading.Thread(
                    target=say_stop, args=(self.house, episode.stop.way, self.stopping)
                )
                due.append((episode.stop.at_s, stopper.start))
            for at_s, act in sorted(due, key=lambda entry: entry[0]):
                time.sleep(max(0.0, began_s + at_s - time.monotonic()))
                act()
            over_s = time.monotonic()
        if stopper is not None:
            stopper.join()
        return over_s

    def _watch(self, over_s: float) -> float:
        """Do nothing for a while after a stop; return when a person acts."""
        if self.episode.stop is not None:
            until_s = max(over_s, self.stopping.confirmed_s or over_s) + WATCH_S
            time.sleep(max(0.0, until_s - time.monotonic()))
        return time.monotonic()

    def _bring_back(self, goal_id: str) -> str:
        """Let the mission go on where the episode says so, then bring the robot to rest."""
        word = "cancelled"
        if self.episode.goes_on and self.person.settle(goal_id):
            word = self.person.go_on(goal_id)
        return word if self.person.settle(None) else f"not at rest: {self.witness.describe()}"

    def _last_order(self) -> str:
        """Give the last order; return nothing where it succeeded and the robot moved."""
        from_s = time.monotonic()
        status, said = self.person.order(self.episode.last)
        if status != 0:
            return line(f"{self.episode.last}: rc {status}: {said}")
        if _turns(self.episode.last) and not has_moved(self.witness.trace(from_s)):
            return line(f"{self.episode.last}: it did not move: {said}")
        return ""

    def _sockets(self) -> list[str]:
        """Wait for removed sockets; where one stays away a person ends its process by hand."""
        gone = [f.target for f in self.episode.faults if f.kind is FaultKind.SOCKET]
        try:
            until(lambda: all(sockets(self.house.home, name) for name in gone), SOCKET_S, "sockets")
        except MeasurementFailure:
            gone = [name for name in gone if not sockets(self.house.home, name)]
            for name in gone:
                for process in processes_of(self.house, OWNER_OF[name]):
                    process.terminate()
            return gone
        return []

    def _judge(self, acts_s: float) -> None:
        """Put every verdict into what is told."""
        told, trace = self.told, self.witness.trace(self.began_s)
        told["contacts"] = contacts(trace)
        told["said_twice"] = said_twice(self.witness.sayings_since(self.began_s), self.episode.says)
        told["said"] = len(self.witness.sayings_since(self.began_s))
        told["lost"], told["states"] = self._goals()
        unrecovered = [told["last"], *(f"{name}.sock is gone" for name in told["sockets"])]
        told["unrecovered"] = [word for word in unrecovered if word]
        told["stop_broken"] = ""
        confirmed_s = self.stopping.confirmed_s
        if self.episode.stop is None:
            return
        told["stop_trouble"] = self.stopping.trouble
        told["confirmed_s"] = confirmed_s and confirmed_s - self.stopping.said_s
        if confirmed_s is None:
            return
        stopped = judge_stop(trace, confirmed_s, acts_s)
        told["stopped"] = {"moving": stopped.moving, "stood_s": stopped.stood_s}
        if stopped.is_broken:
            told["stop_broken"] = stopped.again or f"stood after {stopped.stood_s} s"
            told["trace"] = [
                (round(s.at_s - confirmed_s, 2), s.boot[-4:], s.v_mps, s.w_radps)
                for s in trace
                if confirmed_s - 1.0 <= s.at_s < acts_s
            ][::5]

    def _goals(self) -> tuple[list[str], dict[str, str]]:
        """Return which accepted goals are not told of any more, and what became of the others."""
        states, lost = {}, []
        for goal_id in self.told["goals"]:
            try:
                goal = self.person.goal(goal_id)
                states[goal_id] = f"{goal['state']} {goal.get('reason') or ''}".strip()
            except PlannerProblem as refused:
                lost.append(f"{goal_id}: {line(refused)}")
            except PlannerDown as trouble:  # an episode without recovery; the journal tells
                states[goal_id] = line(trouble)
        return lost, states


def _turns(order: str) -> bool:
    return "turn" in order or "转" in order
