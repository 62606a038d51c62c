"""Hold robots, missions and stops as the fleet's rows say, and as its API shows them. Pure."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, fields
from datetime import UTC, datetime
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from fleet.errors import WORDS, tell

if TYPE_CHECKING:
    from collections.abc import Mapping

    import sqlalchemy as sa


WAITING, OFFERED, AT_ROBOT, ASKING, UNKNOWN = "waiting", "offered", "at_robot", "asking", "unknown"
SUCCEEDED, FAILED, REFUSED, CANCELLED, GIVEN_UP = (
    "succeeded", "failed", "refused", "cancelled", "given_up",
)  # fmt: skip
ENDED = frozenset({SUCCEEDED, FAILED, REFUSED, CANCELLED, GIVEN_UP})
PAUSED = "paused"
GOAL_ENDED = frozenset({SUCCEEDED, FAILED, REFUSED, CANCELLED})
"""States of a goal at a robot that end it; the mission then ends in the same."""
STANDING, CHARGE = "st-", "ch-"
"""What an order's id begins with that no person gave: a standing order's run, a way to charge."""
_CAUSES = {STANDING: "standing_order", CHARGE: "low_battery"}
_ASKS = frozenset({"needs_clarification", "awaiting_confirmation"})


@dataclass(frozen=True, slots=True)
class RobotRow:
    """Hold a robot that was added, with the certificate it is known by."""

    name: str
    url: str
    robot_id: str
    pin_kind: str
    pin_sha256: str
    pin_pem: str
    card: str
    cursor: int = 0
    stopped_seq: int = 0
    used_seq: int = 0
    added_unix_s: float = 0.0

    @property
    def capabilities(self) -> dict[str, Any]:
        """Return the card as the robot gave it; all that ask are given the same object."""
        return _read_card(self.card)


@lru_cache(maxsize=1024)
def _read_card(text: str) -> dict[str, Any]:
    read: dict[str, Any] = json.loads(text)
    return read


@dataclass(frozen=True, slots=True)
class MissionRow:
    """Hold a mission: one order to one robot."""

    seq: int
    id: str
    order_id: str
    text: str
    body: str
    way: str
    names: str
    is_urgent: bool
    state: str
    reason: str | None
    robot: str | None
    is_sent: bool
    wish: str | None
    goal_id: str | None
    goal_state: str | None
    question: str | None
    outcome: str | None
    unknown_since_unix_s: float | None
    attempt: int
    created_unix_s: float
    updated_unix_s: float
    change: int

    @property
    def candidates(self) -> tuple[str, ...]:
        """Return the names of those that may go; empty: all."""
        return tuple(json.loads(self.names))

    @property
    def is_over(self) -> bool:
        """Return whether it has ended for people."""
        return self.state in ENDED


def robot_row(row: sa.RowMapping) -> RobotRow:
    """Return a robot of its row."""
    return RobotRow(**{field.name: row[field.name] for field in fields(RobotRow)})


def mission_row(row: sa.RowMapping) -> MissionRow:
    """Return a mission of its row."""
    return MissionRow(**{field.name: row[field.name] for field in fields(MissionRow)})


def show_mission(mission: MissionRow) -> dict[str, Any]:
    """Return a mission as the API shows it."""
    shown: dict[str, Any] = {
        name: asdict(mission)[name]
        for name in ("id", "order_id", "text", "way", "state", "reason", "robot", "goal_id",
                     "goal_state", "wish", "unknown_since_unix_s", "created_unix_s",
                     "updated_unix_s")
    }  # fmt: skip
    shown["names"], shown["cause"] = list(mission.candidates), cause_of(mission)
    for name in ("question", "outcome"):
        text = getattr(mission, name)
        shown[name] = json.loads(text) if text else None
    if mission.state == WAITING and shown["question"]:  # the fleet itself asks
        shown["state"], shown["reason"] = ASKING, shown["question"]["kind"]
    shown["message"] = _message(mission, shown["outcome"])
    return shown


def cause_of(mission: MissionRow) -> str:
    """Return why there is a mission: ``person``, ``standing_order`` or ``low_battery``."""
    return _CAUSES.get(mission.order_id[:3], "person")


def _message(mission: MissionRow, outcome: dict[str, Any] | None) -> dict[str, str] | None:
    if mission.state == UNKNOWN and mission.unknown_since_unix_s is not None:
        since = datetime.fromtimestamp(mission.unknown_since_unix_s, UTC).astimezone()
        clock = f"{since:%H:%M}"
        who = mission.robot
        return {
            "en": f"unknown since {clock}: {who} tells nothing of it; it may go on by itself",
            "zh": f"{clock} 起情况不明：{who} 没有告知它的情况；它可能仍在执行",
        }
    if mission.goal_state == PAUSED and not mission.is_over:
        return tell("paused_there", {"name": mission.robot})
    if outcome and isinstance(outcome.get("message"), dict) and mission.state != GIVEN_UP:
        told: dict[str, str] = outcome["message"]
        return told
    return tell(mission.reason) if mission.reason in WORDS else None


def state_of(goal: Mapping[str, Any]) -> str:
    """Return where a mission stands by its goal at the robot; an ended one is told apart."""
    return ASKING if question_of(goal) is not None else AT_ROBOT


def question_of(goal: Mapping[str, Any]) -> dict[str, Any] | None:
    """Return what a goal asks of people now, in both languages, with its options."""
    plan = goal.get("plan") or {}
    if goal.get("state") in _ASKS:
        return {"text": plan.get("text"), "kind": goal["state"], "options": plan.get("options", [])}
    for step in plan.get("steps") or ():
        if step.get("kind") == "ask" and step.get("state") == "running":
            text = step.get("text")
            return {"text": {"en": text, "zh": text}, "kind": "ask", "options": []}
    return None


def values_of_goal(mission: MissionRow, goal: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a goal tells of its mission. One that people ended keeps its state."""
    asked, outcome = question_of(goal), goal.get("outcome")
    values: dict[str, Any] = {
        "goal_state": goal["state"],
        "question": json.dumps(asked, ensure_ascii=False) if asked else None,
        "outcome": json.dumps(outcome, ensure_ascii=False) if outcome else None,
    }
    if not mission.is_over:
        is_last = goal["state"] in GOAL_ENDED
        state = mission.state if is_last else state_of(goal)
        values |= {"state": state, "reason": goal.get("reason"), "unknown_since_unix_s": None}
    return values
