"""Render where things stand for a model, as data and within a bound of tokens.

What is not known is left out. Recent goals and memories give way first, the oldest of whichever are
more; then what waits in the queue.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from planner.brain.prompt_template import as_json
from planner.brain.prompt_tokens import count_tokens
from planner.brain.situation import MAX_RECENT

if TYPE_CHECKING:
    from planner.brain.situation import RecentGoal, RememberedItem, Situation

MAX_REMEMBERED = 20
_HOUR_MIN, _DAY_MIN = 60, 1440


def tell_situation(situation: Situation, budget_tokens: int) -> dict[str, Any]:
    """Return ``now``, ``recent`` and ``remembered``; each is left out where empty."""
    recent = [_tell_goal(goal) for goal in situation.recent[:MAX_RECENT]]
    named = (each for each in situation.remembered if each.fits or _is_person(each))
    items = list(named)[:MAX_REMEMBERED]
    queue = list(situation.queue)
    while True:
        told = {
            "now": _tell_now(situation, queue),
            "recent": recent,
            "remembered": _tell_remembered(items),
        }
        fits = count_tokens(as_json(told)) <= budget_tokens
        if fits or not (recent or items or queue):
            return {name: each for name, each in told.items() if each}
        (items if len(items) > 2 * len(recent) else recent or items or queue).pop()


def _is_person(item: RememberedItem) -> bool:
    """Tell whether a memory is of somebody: an order leans on people without a name for them."""
    return not item.said and item.what.split()[-1:] == ["person"]


def _tell_remembered(items: list[RememberedItem]) -> dict[str, Any]:
    """Return what was seen, by place, and apart from it what people said; each with its age."""
    seen: dict[str, list[str]] = {}
    told = [f"{item.what} {_age(item.minutes)}" for item in items if item.said]
    for item in (each for each in items if not each.said):
        seen.setdefault(item.place or "elsewhere", []).append(f"{item.what} {_age(item.minutes)}")
    return {name: each for name, each in (("seen", seen), ("told", told)) if each}


def _age(minutes: int) -> str:
    if minutes < _HOUR_MIN:
        return f"{minutes}min"
    return f"{minutes // _HOUR_MIN}h" if minutes < _DAY_MIN else f"{minutes // _DAY_MIN}d"


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
        "thinking_about": list(situation.thinking),
        "paused": list(situation.paused),
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
