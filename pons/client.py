"""Drive the robot from a Python program: ``from pons import Robot``.

Synchronous, over the HTTP API. It may do what its token may, and no more: what is said goes through
the same queue, guard and questions as a person's words. docs/python.md shows a whole program.
"""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import httpx

from pons.settings import LaunchSettings, load

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import TracebackType

SOURCE = "python"
POLL_S = 0.2
TIMEOUT_S = 5.0
AUTHORITY = Path("tls") / "ca.crt"
ENDED = frozenset({"succeeded", "failed", "refused", "cancelled"})
ASKS = frozenset({"needs_clarification", "awaiting_confirmation"})


class RobotError(Exception):
    """The planner refused. ``code`` is stable; ``en`` and ``zh`` are for people."""

    def __init__(self, code: str, en: str, zh: str = "", status: int = 0) -> None:
        super().__init__(f"{code}: {en}")
        self.code, self.en, self.zh, self.status = code, en, zh or en, status


class RobotUnreachable(RobotError):
    """No answer came: nothing is known of whether the robot acted."""

    def __init__(self, what: str) -> None:
        super().__init__("planner_down", f"{what}. Is `pons up` running?", f"没有应答：{what}")


@dataclass(frozen=True, slots=True)
class GoalReport:
    """Show one order: its state, and what the robot says of it."""

    id: str
    text: str
    state: str
    """queued, planning, needs_clarification, awaiting_confirmation, running, paused, succeeded,
    failed, refused or cancelled."""
    code: str | None
    """Why it ended, or waits; stable."""
    en: str
    """What is told of it: the answer, the question, or how it ended."""
    zh: str
    options: tuple[str, ...] = ()
    """Answers that a question offers."""
    steps: tuple[str, ...] = ()
    """The kinds of its steps."""

    @property
    def has_ended(self) -> bool:
        """Return whether it is over."""
        return self.state in ENDED

    @property
    def asks(self) -> bool:
        """Return whether it waits for a person's word."""
        return self.state in ASKS

    @property
    def ok(self) -> bool:
        """Return whether it succeeded."""
        return self.state == "succeeded"


@dataclass(frozen=True, slots=True)
class PlaceReport:
    """Show a room or place that an order may name."""

    id: str
    en: str
    zh: str
    x_m: float
    y_m: float
    """In ``map``."""


@dataclass(frozen=True, slots=True)
class RobotStatus:
    """Show where the robot is and what the bridge does."""

    mode: str | None
    """None: the planner hears no bridge."""
    room: str | None
    x_m: float | None
    y_m: float | None
    yaw_rad: float | None
    """In ``map``."""
    battery: float | None
    """0 to 1."""
    faults: tuple[str, ...] = ()
    """The bridge's rows that are up, by name."""


class RobotClient:
    """Be ``pons.Robot``: talk to the planner of this ``$PONS_HOME``, or to the one at ``url``."""

    def __init__(
        self,
        url: str | None = None,
        *,
        token: str | None = None,
        authority: Path | None = None,
        client: httpx.Client | None = None,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        """Open a connection; nothing is asked yet.

        Args:
            url: of the planner, as http://127.0.0.1:8420; that of this home unless given.
            token: a person's; ``PONS_OPERATOR_TOKEN`` unless given.
            authority: the certificate to judge an https planner by; that of this home unless given.
            client: an open client to use in place of one of ours.
            clock: of waiting [s], monotonic.
            sleep: passes the time [s] between two looks.
        """
        self._clock, self._sleep = clock, sleep
        settings = load(forgiving=True)
        base = url or settings.url
        token = os.environ.get("PONS_OPERATOR_TOKEN") if token is None else token
        headers = {"Authorization": f"Bearer {token}"} if token else {}
        self._client = client or httpx.Client(
            base_url=base, headers=headers, timeout=TIMEOUT_S, verify=_trust(settings, authority)
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the connection. The robot goes on."""
        self._client.close()

    def say(self, text: str, *, replace: bool = False, confirm: bool = False) -> GoalReport:
        """Give an order in words and return it, usually still in planning.

        Args:
            text: as a person says it, in English or Chinese; "stop" stops.
            replace: end the running goal once this one is understood.
            confirm: wait for a yes between plan and first step.

        Raises:
            RobotError: refused at the door, with a stable code.
        """
        body = {"text": text, "source": SOURCE, "replace": replace, "confirm": confirm}
        return _goal(self._ask("POST", "/v1/goals", body))

    def order(self, text: str, *, limit_s: float = 600.0) -> GoalReport:
        """Give an order, and return it when it has ended or asks; raises as ``say`` does."""
        return self.wait(self.say(text), limit_s=limit_s)

    def wait(self, goal: GoalReport | str, *, limit_s: float = 600.0) -> GoalReport:
        """Return a goal when it has ended, asks something, or the time [s] is up.

        Raises:
            RobotError: there is no such goal, or nobody answers.
        """
        until_s = self._clock() + limit_s
        while True:
            now = self.goal(goal)
            if now.has_ended or now.asks or self._clock() >= until_s:
                return now
            self._sleep(POLL_S)

    def goal(self, goal: GoalReport | str) -> GoalReport:
        """Return a goal as it is now."""
        return _goal(self._ask("GET", f"/v1/goals/{_id(goal)}"))

    def answer(self, goal: GoalReport | str, text: str) -> GoalReport:
        """Answer the question of a goal: one of its ``options``, a yes or no, or words."""
        body = {"text": text, "source": SOURCE}
        return _goal(self._ask("POST", f"/v1/goals/{_id(goal)}/answer", body))

    def cancel(self, goal: GoalReport | str) -> GoalReport:
        """End a goal; the robot stands."""
        return _goal(self._ask("POST", f"/v1/goals/{_id(goal)}/cancel", {}))

    def stop(self) -> bool:
        """Stop now, and hold until a person acts; return whether the bridge has confirmed it."""
        return bool(self._ask("POST", "/v1/stop", {"source": SOURCE})["confirmed"])

    def status(self) -> RobotStatus:
        """Return where the robot is and what the bridge does."""
        told = self._ask("GET", "/v1/robot")
        status = told["status"] or {}
        pose = status.get("base_in_map") or {}
        return RobotStatus(
            mode=status.get("mode"),
            room=told["room"],
            x_m=pose.get("x_m"),
            y_m=pose.get("y_m"),
            yaw_rad=pose.get("yaw_rad"),
            battery=(status.get("drive") or {}).get("battery"),
            faults=tuple(row["row"] for row in status.get("rows") or ()),
        )

    def places(self) -> tuple[PlaceReport, ...]:
        """Return the rooms and places that an order may name."""
        told = self._ask("GET", "/v1/places")["places"]
        return tuple(
            PlaceReport(
                p["id"], p["name"]["en"], p["name"]["zh"], p["pose"]["x_m"], p["pose"]["y_m"]
            )
            for p in told
        )

    def _ask(self, method: str, path: str, body: dict[str, Any] | None = None) -> Any:
        try:
            answer = self._client.request(method, path, json=body)
        except httpx.HTTPError as trouble:
            raise RobotUnreachable(f"{path}: {type(trouble).__name__}: {trouble}") from None
        try:
            told = answer.json()
        except ValueError:
            raise RobotUnreachable(f"{path}: an answer that is no JSON") from None
        if answer.is_success:
            return told
        said = told.get("message") or {}
        code, detail = str(told.get("code", "refused")), str(told.get("detail", ""))
        en, zh = str(said.get("en", detail)), str(said.get("zh", ""))
        raise RobotError(code, en, zh, answer.status_code)


def _trust(settings: LaunchSettings, authority: Path | None) -> Any:
    """Return what judges a planner's certificate: this home's own authority, where it has one."""
    import ssl

    file = authority or settings.authority or settings.home / AUTHORITY
    return ssl.create_default_context(cafile=str(file)) if file.is_file() else True


def _id(goal: GoalReport | str) -> str:
    return goal.id if isinstance(goal, GoalReport) else goal


def _goal(told: dict[str, Any]) -> GoalReport:
    plan, outcome = told.get("plan") or {}, told.get("outcome") or {}
    said = outcome.get("message") or plan.get("text") or {}
    return GoalReport(
        id=told["id"],
        text=told["text"],
        state=told["state"],
        code=outcome.get("code") or plan.get("code"),
        en=said.get("en", ""),
        zh=said.get("zh", ""),
        options=tuple(each["text"] for each in plan.get("options") or ()),
        steps=tuple(each["kind"] for each in plan.get("steps") or ()),
    )
