"""Render where things stand for a model, as data and within a bound of tokens.

What is not known is left out. Recent goals give way first, the oldest of them before the others;
then what waits in the queue.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from planner.brain.prompt_template import as_json
from planner.brain.prompt_tokens import count_tokens
from planner.brain.situation import MAX_RECENT

if TYPE_CHECKING:
    from planner.brain.situation import RecentGoal, Situation


def tell_situation(situation: Situation, budget_tokens: int) -> dict[str, Any]:
    """Return ``now`` and ``recent`` for the person's message; each is left out where empty."""
    recent = [_tell_goal(goal) for goal in situation.recent[:MAX_RECENT]]
    queue = list(situation.queue)
    while True:
        told = {"now": _tell_now(situation, queue), "recent": recent}
        if count_tokens(as_json(told)) <= budget_tokens or not (recent or queue):
            return {name: each for name, each in told.items() if each}
        (recent or queue).pop()


def _tell_now(situation: Situation, queue: list[str]) -> dict[str, Any]:
    waiting = len(situation.queue) + situation.more - len(queue)
    facts: dict[str, Any] = {
        "time": situation.time,
        "battery": None if situation.battery is None else f"{100.0 * situation.battery:.0f} %",
        "room": situation.room,
        "at": situation.place,
        "heading_deg": None if situation.heading_deg is None else round(situation.heading_deg),
        "running": situation.running,
        "step": situation.step,
        "queue": queue,
        "more_in_queue": waiting or None,
        "question": situation.question
        and {"order": situation.question.order, "asked": situation.question.asked},
    }
    return {name: fact for name, fact in facts.items() if fact not in (None, [])}


def _tell_goal(goal: RecentGoal) -> dict[str, Any]:
    told: dict[str, Any] = {"order": goal.order, "outcome": goal.outcome}
    if goal.told:
        told["told"] = goal.told
    return {**told, "minutes_ago": goal.minutes}
