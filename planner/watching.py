"""Count for those who watch many robots over months: what ended how, how long, at what cost.

Hears the mission's events as a page does and is told each model call that was settled; costs a
dictionary's look-up an event. Counters begin at zero with the process, as Prometheus has it.
"""

from __future__ import annotations

from collections import OrderedDict
from typing import TYPE_CHECKING, Any

from prometheus_client import CollectorRegistry, Counter, Histogram

from planner.plan.goal import ENDED

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.mission.event_hub import Message

FIRST_WAYPOINT_S = (0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0, 60.0)
MODEL_CALL_S = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 15.0, 30.0, 60.0)
GOAL_S = (1.0, 5.0, 15.0, 30.0, 60.0, 120.0, 300.0, 900.0, 3600.0)
MOST_GOALS = 256
"""Goals whose state is kept; more are never open at once."""
_ENDED = frozenset(state.value for state in ENDED)


class PlannerFigures:
    """Hold the counters and histograms of one planner."""

    def __init__(self, clock: Callable[[], float]) -> None:
        """Begin at zero.

        Args:
            clock: monotonic [s].
        """
        self.registry = made = CollectorRegistry()
        self._clock = clock
        self._known: OrderedDict[str, str] = OrderedDict()
        self._planned_s: OrderedDict[str, float] = OrderedDict()
        self._goals = Counter(
            "pons_goals_ended", "Goals that ended", ["state", "code"], registry=made
        )
        self._goal_s = Histogram(
            "pons_goal_seconds", "From a goal's first step to its end", ["state"],
            buckets=GOAL_S, registry=made,
        )  # fmt: skip
        self._first = Histogram(
            "pons_first_waypoint_seconds", "From a goal's acceptance to its first waypoint",
            buckets=FIRST_WAYPOINT_S, registry=made,
        )  # fmt: skip
        self._from_plan = Histogram(
            "pons_plan_to_first_waypoint_seconds", "From a plan in force to its first waypoint",
            buckets=FIRST_WAYPOINT_S, registry=made,
        )  # fmt: skip
        self._rows = Counter(
            "pons_fault_rows", "Rows of the fault table that came up", ["row"], registry=made
        )
        self._refusals = Counter(
            "pons_bridge_events", "What the bridge told, by code", ["code"], registry=made
        )
        self._call_s = Histogram(
            "pons_model_call_seconds", "Of one call to a model", buckets=MODEL_CALL_S,
            registry=made,
        )  # fmt: skip
        self._tokens = Counter(
            "pons_model_tokens", "Tokens that models were sent and replied", ["way"],
            registry=made,
        )  # fmt: skip

    def offer(self, message: Message) -> None:
        """Count an event of the mission; see ``planner.mission.event_hub.HubListener``."""
        event = message[1]
        kind = event["type"]
        if kind == "goal":
            self._goal(event["goal"])
        elif kind == "first_waypoint":
            self._first.observe(event["seconds"])
            planned_s = self._planned_s.pop(event["goal"], None)
            if planned_s is not None:
                self._from_plan.observe(self._clock() - planned_s)
        elif kind == "bridge":
            self._bridge(event["event"])

    def close(self) -> None:
        """Hear no more: what was counted stays readable."""

    def model_call(
        self, _goal_id: str, seconds: float, prompt_tokens: int, reply_tokens: int
    ) -> None:
        """Count a call that was settled."""
        self._call_s.observe(seconds)
        self._tokens.labels("prompt").inc(prompt_tokens)
        self._tokens.labels("reply").inc(reply_tokens)

    def _goal(self, goal: dict[str, Any]) -> None:
        """Count an end once, however often the ended goal is told again."""
        goal_id, state = goal["id"], goal["state"]
        before = self._known.pop(goal_id, None)
        self._known[goal_id] = state
        _drop_oldest(self._known)
        if state == "running" and before != "running":
            self._planned_s[goal_id] = self._clock()
            _drop_oldest(self._planned_s)
        if state not in _ENDED or before in _ENDED:
            return
        self._planned_s.pop(goal_id, None)
        outcome = goal.get("outcome") or {}
        self._goals.labels(state, outcome.get("code") or "none").inc()
        if (seconds := outcome.get("seconds")) is not None:
            self._goal_s.labels(state).observe(seconds)

    def _bridge(self, event: dict[str, Any]) -> None:
        self._refusals.labels(event["code"]).inc()
        if event["code"] == "row_up":  # its detail is ROW.NUMBER and evidence
            self._rows.labels(event["detail"].partition(" ")[0].partition(".")[0]).inc()


def _drop_oldest(kept: OrderedDict[str, Any]) -> None:
    while len(kept) > MOST_GOALS:
        kept.popitem(last=False)
