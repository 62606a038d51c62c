"""Hold a robot whose processes have users of their own, its witness, and a hostile client of each.

A run is a mission, an attack, and a person's stop; afterwards the robot is brought to rest.
"""

from __future__ import annotations

import json
import os
import subprocess
import time
from contextlib import ExitStack, suppress
from typing import TYPE_CHECKING, Any

from bridge.fence_file import load_fence
from pons.http import PlannerDown, PlannerProblem, call
from pons.settings import CHECKOUT
from tools.bench.chaos.person import ENDED, MILD
from tools.bench.chaos.witness import Witness
from tools.bench.confirmation import HTTP, stopped_by_http, stopped_by_shell
from tools.bench.context import MeasurementFailure, until
from tools.bench.hostile.draw import ORDER, WATCH_S, HostileRun
from tools.bench.hostile.verdict import HostileBounds, hidden_stop, judge
from tools.bench.robot import BenchRobot
from tools.bench.users import (
    GROUPS,
    MEMBER,
    OF_PROCESSES,
    SIM,
    USERS,
    as_user,
    groups_of,
    home_as_deployed,
)
from wire import Mode, load_robot

if TYPE_CHECKING:
    from types import TracebackType
    from typing import Self

    from tools.bench.chaos.verdict import TruthSample
    from tools.bench.chaos.witness import BridgeState

READY_S, DRIVES_S, SETTLED_S, ENDS_S = 60.0, 8.0, 40.0, 10.0
DRIVES_MPS = 0.15
PAUSE_S, LATELY_S = 0.1, 0.1
TRUSTS_S, ANSWERED_S = 0.5, 0.3
ON_GRANT = "POSE_JUMP"
"""A row that the next mission's grant ends."""
LATCHED = (Mode.FAULT, Mode.ESTOPPED)


class SiegeClient:
    """Hold one hostile process."""

    def __init__(self, user: str, robot_id: str, home: str) -> None:
        """Start it under its user; it dials while others start."""
        self._process = subprocess.Popen(
            as_user(user, "tools.bench.hostile.client", robot_id, home),
            cwd=CHECKOUT,
            env={**os.environ, "PONS_HOME": home},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self.doors: list[str] = []

    def await_ready(self) -> None:
        """Wait for it. Raises Missed where it says something else."""
        words = self._read().split()
        if not words or words[0] != "ready":
            raise MeasurementFailure(f"a hostile client said {words} instead of ready")
        self.doors = words[1:]

    def begin(self, run: HostileRun) -> None:
        """Let it attack."""
        self._write(json.dumps(run.record()))

    def end(self) -> dict[str, Any]:
        """End the attack; return what it did."""
        self._write("end")
        did: dict[str, Any] = json.loads(self._read() or "{}")
        return did

    def close(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.communicate()

    def _write(self, text: str) -> None:
        if self._process.stdin is not None:
            self._process.stdin.write(text + "\n")
            self._process.stdin.flush()

    def _read(self) -> str:
        return self._process.stdout.readline() if self._process.stdout is not None else ""


class Siege:
    """Be one robot among hostile clients."""

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            home = stack.enter_context(home_as_deployed())
            before = {name: as_user(user)[2:] for name, user in OF_PROCESSES.items()}
            self.robot = stack.enter_context(BenchRobot(home, "home", before=before))
            self.robot.make_ready()
            self.witness = stack.enter_context(Witness(self.robot.settings))
            description = load_robot(self.robot.settings.robot)
            self.clients = {}
            for user in dict.fromkeys((*ORDER, SIM)):
                self.clients[user] = client = SiegeClient(user, description.id, str(home))
                stack.callback(client.close)
            for client in self.clients.values():
                client.await_ready()
            fence, _ = load_fence(self.robot.settings.site / "fence.json")
            limits = description.limits
            self._bounds = HostileBounds(
                limits.max_speed_mps, limits.max_turn_radps, fence.margin_m
            )
            self._stack = stack.pop_all()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stack.close()

    def run(self, run: HostileRun) -> dict[str, Any]:
        """Play one run; return what is told of it.

        Raises:
            Missed: the robot could not be brought to rest before it.
        """
        self.settle()
        client, began_s = self.clients[run.user], time.monotonic()
        told: dict[str, Any] = {**run.record(), "doors": client.doors}
        self.robot.say(run.mission)
        if run.begins_s < 0.0:
            client.begin(run)
        with suppress(MeasurementFailure):  # an attack may keep it from driving, and is welcome to
            until(self._drives, DRIVES_S, "driving")
        drives_s = time.monotonic()
        if run.begins_s >= 0.0:
            time.sleep(run.begins_s)
            client.begin(run)
        self._trust(drives_s + run.stop_s)
        said_s, last = time.monotonic(), self.witness.trace(time.monotonic() - LATELY_S)
        told["moving"] = any(sample.moves for sample in last)
        took_s = self._stop(run, told)
        confirmed_s = None if took_s is None else time.monotonic()
        time.sleep(WATCH_S)
        acts_s = time.monotonic()
        told["did"] = client.end()
        trace = [one for one in self.witness.trace(began_s) if one.at_s < acts_s]
        states = self.witness.states(began_s)
        modes = [(at_s, mode) for at_s, mode, _ in states]
        told |= judge(trace, modes, self._bounds, confirmed_s, acts_s)
        told["took_s"], told["hidden"] = took_s, hidden_stop(took_s, told)
        told["rows"] = sorted({row for at_s, _, rows in states if at_s < said_s for row in rows})
        if told["hidden"] or told["contacts"]:
            told["evidence"] = evidence(trace, states, confirmed_s or said_s)
        told["truths"], told["load"] = len(trace), round(os.getloadavg()[0], 1)
        return told

    def _stop(self, run: HostileRun, told: dict[str, Any]) -> float | None:
        """Say stop in the drawn way, in the shell where HTTP does not confirm it."""
        settings = self.robot.settings
        told["http_lost"] = False
        if run.way == HTTP:
            took_s = stopped_by_http(settings, "person")
            if took_s is not None:
                return took_s
            told["http_lost"] = True
        return stopped_by_shell(settings, USERS[MEMBER], [GROUPS[g] for g in groups_of(MEMBER)])

    def _trust(self, until_s: float) -> None:
        """Let a person who trusts the bridge clear what is held, until the moment of the stop."""
        while (left_s := until_s - time.monotonic()) > 0.0:
            time.sleep(min(PAUSE_S, left_s))
            status = self.witness.live_status()
            if status is None or left_s < TRUSTS_S:
                continue
            if status.held is not None and status.mode is Mode.HOLD:
                self.robot.operate("resume", ANSWERED_S)

    def _drives(self) -> bool:
        trace = self.witness.trace(time.monotonic() - LATELY_S)
        return bool(trace) and abs(trace[-1].v_mps) > DRIVES_MPS

    def settle(self) -> None:
        """Bring the robot to rest: no goal, nothing held, armed, its own planner's.

        Raises:
            Missed: not in time.
        """
        end_s = time.monotonic() + SETTLED_S
        while not self._has_settled():
            if time.monotonic() > end_s:
                raise MeasurementFailure(
                    f"at rest: not within {SETTLED_S:.0f} s; {self.witness.describe()}"
                )
            time.sleep(PAUSE_S)

    def _has_settled(self) -> bool:
        try:
            goals = call(self.robot.settings, "GET", "/v1/goals")["goals"]
            waiting = [goal["id"] for goal in goals if goal["state"] not in ENDED]
            for goal_id in waiting:
                self.robot.cancel(goal_id)
        except (PlannerDown, PlannerProblem):
            return False
        status = self.witness.live_status()
        if status is None or waiting or not self.witness.stands():
            return False
        if status.mode in LATCHED:
            self.robot.operate("reset")
        elif status.mode is Mode.DISARMED:
            self.robot.operate("arm")
        elif status.held is not None:
            self.robot.operate("resume")
        else:
            owned = status.owner is not None and status.owner.planner_id != "hostile"
            mild = all(row.action in MILD or row.row == ON_GRANT for row in status.rows)
            return status.mode is Mode.HOLD and owned and mild
        return False


def evidence(
    trace: list[TruthSample], states: list[BridgeState], stop_s: float
) -> dict[str, list[Any]]:
    """Return what was true and what the bridge said around a stop, for a look afterwards."""
    return {
        "truth": [
            (round(one.at_s - stop_s, 2), one.v_mps, one.w_radps, one.x_m, one.y_m, one.contacts)
            for one in trace
            if one.at_s > stop_s - 1.0
        ][::3],
        "states": [(round(at_s - stop_s, 3), mode, rows) for at_s, mode, rows in states],
    }
