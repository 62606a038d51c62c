"""Be the person beside the robot: say stop, bring it back, resume its goal, give a last order."""

from __future__ import annotations

import subprocess
import time
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pons.http import PlannerDown, PlannerProblem, call
from tools.bench.context import line
from wire import Action, Mode

if TYPE_CHECKING:
    from tools.bench.chaos.house import House
    from tools.bench.chaos.witness import Witness
    from wire import Status

STEADY_S = 1.0
"""So long it must be ready to be called so: a loss shows within half a second."""
READY_S, SETTLED_S, MISSION_S, LAST_S, STOP_S = 60.0, 30.0, 75.0, 110.0, 20.0
PAUSE_S = 0.2
ENDED = frozenset({"succeeded", "failed", "refused", "cancelled"})
MILD = (Action.NONE, Action.CAP)
TROUBLE = (PlannerDown, PlannerProblem)


@dataclass
class StopTold:
    """Tell of a stop: when it was first said, and when the bridge had confirmed it."""

    said_s: float = 0.0
    confirmed_s: float | None = None
    trouble: str = ""


def say_stop(house: House, way: str, told: StopTold) -> None:
    """Say stop until it is confirmed; after one try over HTTP in the shell."""
    told.said_s = time.monotonic()
    if way == "http":
        try:
            answer = call(house.settings, "POST", "/v1/stop", {"source": "chaos"}, timeout_s=3.0)
            if answer.get("confirmed"):
                told.confirmed_s = time.monotonic()
                return
            told.trouble = "not confirmed over HTTP"
        except TROUBLE as trouble:
            told.trouble = line(trouble)
    while told.confirmed_s is None and time.monotonic() < told.said_s + STOP_S:
        _stop_in_shell(house, told)


def _stop_in_shell(house: House, told: StopTold) -> None:
    process = house.pons("stop")
    lines = []
    try:
        if process.stdout is not None:
            for text in process.stdout:  # its word counts from when it stands there
                lines.append(text.strip())
                if "bridge confirmed" in text:
                    told.confirmed_s = time.monotonic()
        process.wait(10.0)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    if told.confirmed_s is None:
        told.trouble = line(lines[-1] if lines else "pons stop said nothing")


class Bystander:
    """Do what the robot's answers ask for, and nothing else."""

    def __init__(self, house: House, witness: Witness) -> None:
        self._house, self._witness = house, witness

    def give(self, text: str, limit_s: float = 10.0) -> str:
        """Give a goal; return its id. Raises PlannerDown, PlannerProblem."""
        end_s = time.monotonic() + limit_s
        while True:
            try:
                return str(self._house.ask("POST", "/v1/goals", {"text": text})["id"])
            except PlannerDown:
                if time.monotonic() > end_s:
                    raise
                time.sleep(PAUSE_S)

    def goal(self, goal_id: str) -> dict[str, Any]:
        """Return a goal's record. Raises PlannerDown, PlannerProblem."""
        record: dict[str, Any] = self._house.ask("GET", f"/v1/goals/{goal_id}")
        return record

    def make_ready(self) -> float | None:
        """Arm and reset as asked for, until all lives, the planner is ready and the drive powered.

        Holds and goals are left as they are. Returns the moment from which it was so; None where it
        never was.
        """
        since_s: float | None = None
        end_s = time.monotonic() + READY_S
        while time.monotonic() < end_s:
            now_s = time.monotonic()
            since_s = (since_s or now_s) if self._ready() else None
            if since_s is not None and time.monotonic() - since_s >= STEADY_S:
                return since_s
            time.sleep(PAUSE_S)
        return None

    def settle(self, goes_on: str | None) -> bool:
        """Bring it to rest: no goal but the one that may go on, nothing held, standing, ready."""
        return self._until(lambda: self._has_settled(goes_on), SETTLED_S)

    def go_on(self, goal_id: str) -> str:
        """Resume a goal as often as it asks for it; return how it ended, or what it still is."""
        state = "unknown"

        def is_over() -> bool:
            nonlocal state
            self._ready()
            with suppress(*TROUBLE):
                goal = self.goal(goal_id)
                state = f"{goal['state']} {goal.get('reason') or ''}".strip()
                if goal["state"] in ENDED:
                    return True
                if goal["state"] == "paused" or goal.get("reason") == "held":
                    self._house.ask("POST", f"/v1/goals/{goal_id}/resume", {})
            return False

        self._until(is_over, MISSION_S)
        return state

    def order(self, text: str) -> tuple[int | None, str]:
        """Say the last order in the shell; return exit status and words."""
        return self._house.shell("say", text, limit_s=LAST_S)

    def _until(self, done: Any, limit_s: float) -> bool:
        end_s = time.monotonic() + limit_s
        while time.monotonic() < end_s:
            if done():
                return True
            time.sleep(PAUSE_S)
        return False

    def _power(self) -> Status | None:
        """Do what a latched or unpowered bridge asks for; return its status where it speaks."""
        status = self._witness.live_status()
        if status is not None and status.mode in (Mode.FAULT, Mode.ESTOPPED):
            self._try("reset")
        elif status is not None and status.mode is Mode.DISARMED:
            self._try("arm")
        return status

    def _ready(self) -> bool:
        status = self._power()
        powered = status is not None and status.mode in (Mode.HOLD, Mode.ACTIVE, Mode.STOPPING)
        if not powered or not self._house.ready():
            return False
        missing = self._house.missing()
        if missing == ["voice"]:  # it is started again by whoever speaks next
            with suppress(*TROUBLE):
                self._house.speak()
        return not missing

    def _has_settled(self, goes_on: str | None) -> bool:
        if not self._ready():
            return False
        try:
            goals = self._house.ask("GET", "/v1/goals")["goals"]
            open_ = [g["id"] for g in goals if g["state"] not in ENDED and g["id"] != goes_on]
            for goal_id in open_:
                self._house.ask("POST", f"/v1/goals/{goal_id}/cancel", {})
        except TROUBLE:
            return False
        status = self._witness.live_status()
        if open_ or status is None or not all(row.action in MILD for row in status.rows):
            return False
        if goes_on is not None:
            return True
        if status.held is not None:
            self._try("resume")
            return False
        rests = status.mode is Mode.HOLD and status.owner is not None
        return rests and self._witness.stands()

    def _try(self, verb: str) -> None:
        with suppress(*TROUBLE):
            self._house.ask("POST", f"/v1/{verb}", {})
