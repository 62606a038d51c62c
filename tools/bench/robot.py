"""Run the real processes in a home folder of their own, watch them as a judge, end them all.

Every child dies with this process: ``processes.parent_death`` binds it to its parent, and leaving
the context ends whole process groups.
"""

from __future__ import annotations

import json
import re
import secrets
import time
from contextlib import ExitStack
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from pons.http import PlannerDown, PlannerProblem, call
from pons.robot_processes import BODY, NOTHING, PATIENCE_S, ProcessGone, RobotProcesses, free_port
from pons.settings import CHECKOUT, LaunchSettings
from sim import PERIODS
from tools.bench.context import MeasurementFailure, until
from wire import VIRTUAL_KEY, Mode, OpKind, SimTruth, Status, load_robot, signed_request
from wire.keys import OPS, SIM_TRUTH, STATUS, Party
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from types import TracebackType
    from typing import Self

TAPPED = "tools.bench.tick_probe"
"""The real bridge with a stopwatch at its edges."""
EVERYTHING = (*BODY, "planner")
CAMERA = "sim.camera"
"""Asked for beside everything where something is to be seen."""
SLOW = 0.95
"""A simulator below this share of real time makes a run invalid."""


class BenchRobot:
    """Be one running robot."""

    def __init__(
        self,
        home: Path,
        site: str,
        *,
        tapped: bool = False,
        only: tuple[str, ...] = EVERYTHING,
        limits: Mapping[str, float] = MappingProxyType({}),
        before: Mapping[str, Sequence[str]] = NOTHING,
    ) -> None:
        """Describe it; entering the context starts it.

        Args:
            home: an empty folder; becomes its ``$PONS_HOME``.
            site: name of one of the checkout's sites.
            tapped: run the bridge with a stopwatch; ``tap`` reads it after the end.
            only: which processes to start.
            limits: keys of robot.toml that are to have other values than the checkout's.
            before: of each process that is to be another user's, the words that make it so.
        """
        self.settings = LaunchSettings(
            home,
            write_description(home, limits),
            CHECKOUT / "sites" / site,
            "127.0.0.1",
            free_port(),
        )
        modules = {"bridge": TAPPED} if tapped else {}
        self._processes = RobotProcesses(self.settings, only, modules=modules, before=before)
        self.children = self._processes.children
        self._truths_seen: list[SimTruth] = []
        self._stack = ExitStack()

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            stack.enter_context(self._processes)
            description = load_robot(self.settings.robot)
            judge = open_session(Party.JUDGE, description.id, self.settings.home)
            stack.callback(judge.close)
            operator = open_session(Party.OPERATOR, description.id, self.settings.home)
            stack.callback(operator.close)
            self._statuses, self._truths = judge.subscriber(STATUS), judge.subscriber(SIM_TRUTH)
            self._asks = {key.path: operator.publisher(key) for key in OPS}
            self._status: Status | None = None
            self._stack = stack.pop_all()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stack.close()

    @property
    def status(self) -> Status | None:
        """Return the newest status; every look also notes how far the simulator is."""
        self._status = self._statuses.newest() or self._status
        for truth in self._truths.drain().items:
            if isinstance(truth, SimTruth):
                self._truths_seen = [*self._truths_seen[:1], truth]
        return self._status

    @property
    def speed(self) -> float:
        """Return simulated over real time since ``forget``; zero where nothing was heard."""
        if len(self._truths_seen) < 2:
            return 0.0
        first, last = self._truths_seen
        real_s = last.stamp_s - first.stamp_s
        simulated_s = (last.seq - first.seq) * PERIODS.truth_ticks * PERIODS.tick_s
        return simulated_s / real_s if real_s > 0.0 else 0.0

    def forget(self) -> None:
        """Begin to judge the simulator anew."""
        self.status  # noqa: B018  # drains what came before
        self._truths_seen = []

    def pid(self, name: str) -> int:
        """Return a child's process id.

        Raises:
            Missed: it does not run.
        """
        try:
            return self._processes.pid(name)
        except ProcessGone as gone:
            raise MeasurementFailure(str(gone)) from None

    def make_ready(self, limit_s: float = 60.0) -> None:
        """Wait until planner and bridge are ready, then arm.

        Raises:
            Missed: they were not in time; the message holds the end of each log.
        """
        try:
            if "planner" in self.children:
                self.await_planner(limit_s)
            until(lambda: self._is_mode(Mode.DISARMED, Mode.HOLD), limit_s, "self test", 0.02)
            until(self._try_to_arm, limit_s, "arming", 0.2)
        except MeasurementFailure as missed:
            told = f"{missed}; {self.describe()}\n{self._processes.logs()}"
            raise MeasurementFailure(told) from None

    def await_planner(self, limit_s: float = 60.0) -> None:
        """Wait until the planner is ready. Raises Missed."""
        until(self._answers, limit_s, "the planner's /readyz", 0.05)

    def say(self, text: str) -> str:
        """Give a goal over HTTP and return its id."""
        goal: dict[str, Any] = call(self.settings, "POST", "/v1/goals", {"text": text})
        return str(goal["id"])

    def cancel(self, goal_id: str) -> None:
        """End a goal over HTTP; one that has ended already is no error."""
        try:
            call(self.settings, "POST", f"/v1/goals/{goal_id}/cancel", {})
        except PlannerProblem as refused:
            if refused.code != "bad_state":
                raise

    def goal(self, goal_id: str) -> dict[str, Any]:
        """Return a goal's record."""
        record: dict[str, Any] = call(self.settings, "GET", f"/v1/goals/{goal_id}")
        return record

    def operate(self, kind: OpKind, limit_s: float = 2.0) -> bool:
        """Make an operator's request over this robot's own session; return the verdict."""
        until(lambda: self.status is not None, limit_s, "a status")
        status = self.status
        if status is None:
            return False
        request_id = f"bench-{secrets.token_hex(6)}"
        request = signed_request(VIRTUAL_KEY, kind, status, "bench", request_id)
        end_s = time.monotonic() + limit_s
        while time.monotonic() < end_s:
            self._asks[f"op/{kind}"].put(request)
            time.sleep(0.02)
            newest = self.status
            for answer in newest.answers if newest else ():
                if answer.id == request_id:
                    return answer.accepted
        return False

    def end_bridge(self) -> dict[str, Any]:
        """End the tapped bridge and return what it noted."""
        self.children["bridge"].stop(PATIENCE_S)
        return read_tap(self.settings.home)

    def describe(self) -> str:
        """Say in a line what the bridge said last."""
        status = self._status
        if status is None:
            return "the bridge said nothing"
        rows = ", ".join(row.row for row in status.rows)
        lacks = ", ".join(status.waiting_for)
        return f"{status.mode.value}, held {status.held}, rows {rows or '-'}, lacks {lacks or '-'}"

    def _answers(self) -> bool:
        self.pid("planner")
        try:
            call(self.settings, "GET", "/readyz", timeout_s=1.0)
        except (PlannerDown, PlannerProblem):
            return False
        return True

    def _is_mode(self, *modes: Mode) -> bool:
        self.pid("bridge")
        status = self.status
        return status is not None and status.mode in modes

    def _try_to_arm(self) -> bool:
        """Ask once and look; the verdict may be a no for a moment longer."""
        if not self._is_mode(Mode.HOLD):
            self.operate("arm")
        return self._is_mode(Mode.HOLD)


def read_tap(home: Path) -> dict[str, Any]:
    """Return what the tapped bridge of a home noted by its end."""
    noted: dict[str, Any] = json.loads((home / "tap.json").read_text("utf-8"))
    return noted


def write_description(home: Path, limits: Mapping[str, float]) -> Path:
    """Write the checkout's robot.toml into a folder, some values changed; return its path."""
    text = (CHECKOUT / "robot.toml").read_text("utf-8")
    for key, value in limits.items():
        text, found = re.subn(rf"(?m)^{key} = \S+", f"{key} = {value}", text)
        if found != 1:
            raise MeasurementFailure(f"robot.toml has {found} lines that set {key!r}, expected 1")
    made = home / "robot.toml"
    made.write_text(text, "utf-8")
    return made
