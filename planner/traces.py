"""Tell a collector of OpenTelemetry how each goal went: one trace a goal.

Written when a goal has ended, from the events that pages hear and the calls that were settled, each
span with the times at which they came: nothing is opened while a goal is carried out, and without a
collector's address, or without the SDK (extra ``traces``), nothing listens at all.
"""

from __future__ import annotations

import logging
import os
from collections import OrderedDict
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from planner.plan.goal import ENDED

if TYPE_CHECKING:
    from collections.abc import Callable

    from opentelemetry.trace import Tracer

    from planner.mission.event_hub import Message

log = logging.getLogger(__name__)

VARIABLE = "OTEL_EXPORTER_OTLP_ENDPOINT"
"""OpenTelemetry's own name for a collector's address."""
MOST_GOALS = 64
MOST_SPANS = 200
"""Of one goal; a patrol of hours drives more legs than anybody reads."""
_ENDED = frozenset(state.value for state in ENDED)
_NAMES = {"queued": "queue", "planning": "reading", "paused": "pause", "running": "drive",
          "needs_clarification": "question", "awaiting_confirmation": "confirmation"}  # fmt: skip
"""Of the spans in which a goal is in a state."""
_NS = 1_000_000_000


@dataclass(frozen=True, slots=True)
class TracedSpan:
    """Hold one part of a goal, in UNIX time [ns]."""

    name: str
    began_ns: int
    ended_ns: int
    told: dict[str, str | int | float] = field(default_factory=dict)


@dataclass(slots=True)
class TracedGoal:
    """Collect the parts of a goal that is under way."""

    began_ns: int
    state: str
    since_ns: int
    steps: dict[int, tuple[str, int]] = field(default_factory=dict)
    """Of the steps that run: their kind, and since when."""
    route_ns: int = 0
    """Since when a running goal waits for its first waypoint."""
    spans: list[TracedSpan] = field(default_factory=list)

    def add(self, name: str, began_ns: int, ended_ns: int, **told: str | float) -> None:
        """Add a part, while there is room."""
        if len(self.spans) < MOST_SPANS:
            self.spans.append(TracedSpan(name, began_ns, max(began_ns, ended_ns), told))


class GoalTraces:
    """Hear the mission's events, and hand each ended goal on."""

    def __init__(
        self,
        now_ns: Callable[[], int],
        export: Callable[[dict[str, Any], TracedGoal, int], None],
    ) -> None:
        """Begin with nothing.

        Args:
            now_ns: UNIX time.
            export: takes an ended goal, its parts and when it ended; must not wait.
        """
        self._now_ns, self._export = now_ns, export
        self._goals: OrderedDict[str, TracedGoal] = OrderedDict()

    def offer(self, message: Message) -> None:
        """Note an event; see ``planner.mission.event_hub.HubListener``."""
        event, now_ns = message[1], self._now_ns()
        if event["type"] == "goal":
            self._goal(event["goal"], now_ns)
        elif event["type"] == "first_waypoint" and (made := self._goals.get(event["goal"])):
            made.add("route", made.route_ns or made.since_ns, now_ns)

    def close(self) -> None:
        """Hear no more; what is under way is not told."""
        self._goals.clear()

    def model_call(self, goal_id: str, seconds: float, prompt: int, reply: int) -> None:
        """Note a call to a model that was settled for a goal."""
        if (made := self._goals.get(goal_id)) is not None:
            now_ns = self._now_ns()
            began_ns = now_ns - round(seconds * _NS)
            made.add("model call", began_ns, now_ns, prompt_tokens=prompt, reply_tokens=reply)

    def _goal(self, goal: dict[str, Any], now_ns: int) -> None:
        made = self._goals.get(goal["id"])
        if made is None:
            if goal["state"] in _ENDED and not goal.get("plan"):
                return
            made = self._goals[goal["id"]] = TracedGoal(now_ns, goal["state"], now_ns)
            while len(self._goals) > MOST_GOALS:
                self._goals.popitem(last=False)
        _note_steps(made, (goal.get("plan") or {}).get("steps") or (), now_ns)
        if goal["state"] == made.state and made.state not in _ENDED:
            return
        if (name := _NAMES.get(made.state)) is not None:
            made.add(name, made.since_ns, now_ns)
        if goal["state"] == "running":
            made.route_ns = now_ns
        made.state, made.since_ns = goal["state"], now_ns
        if made.state in _ENDED:
            del self._goals[goal["id"]]
            self._export(goal, made, now_ns)


def _note_steps(made: TracedGoal, steps: Any, now_ns: int) -> None:
    """Begin a span for each step that runs, and end those that run no more."""
    for number, step in enumerate(steps, 1):
        if step.get("state") == "running":
            made.steps.setdefault(number, (step["kind"], now_ns))
        elif (begun := made.steps.pop(number, None)) is not None:
            made.add(f"step {begun[0]}", begun[1], now_ns, state=str(step.get("state")))


def export_to(tracer: Tracer) -> Callable[[dict[str, Any], TracedGoal, int], None]:
    """Return what makes spans of a goal; of its words nothing is told, they stay on the robot."""
    from opentelemetry import trace

    def export(goal: dict[str, Any], made: TracedGoal, ended_ns: int) -> None:
        outcome = goal.get("outcome") or {}
        told = {"pons.goal": goal["id"], "pons.state": goal["state"], "pons.by": goal.get("by", ""),
                "pons.code": outcome.get("code") or ""}  # fmt: skip
        root = tracer.start_span("goal", start_time=made.began_ns, attributes=told)
        parent = trace.set_span_in_context(root)
        for part in made.spans:
            attributes = {f"pons.{name}": value for name, value in part.told.items()}
            span = tracer.start_span(part.name, parent, start_time=part.began_ns,
                                     attributes=attributes)  # fmt: skip
            span.end(part.ended_ns)
        root.end(ended_ns)

    return export


def traces_of(robot_id: str, now_ns: Callable[[], int]) -> GoalTraces | None:
    """Return what tells a collector; None where the environment names none, or no SDK is here."""
    if not os.environ.get(VARIABLE):
        return None
    try:
        from opentelemetry.exporter.otlp.proto.http.trace_exporter import OTLPSpanExporter
        from opentelemetry.sdk.resources import Resource
        from opentelemetry.sdk.trace import TracerProvider
        from opentelemetry.sdk.trace.export import BatchSpanProcessor
    except ModuleNotFoundError:
        log.warning("no_traces: %s is set; install the SDK: pip install 'pons-robot[traces]'",
                    VARIABLE)  # fmt: skip
        return None
    resource = Resource.create({"service.name": "pons", "service.instance.id": robot_id})
    provider = TracerProvider(resource=resource)
    provider.add_span_processor(BatchSpanProcessor(OTLPSpanExporter()))
    return GoalTraces(now_ns, export_to(provider.get_tracer("pons")))
