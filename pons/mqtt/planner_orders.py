"""Carry a smart home's orders to the planner, as sentences and acts that the page has too.

Blocks on HTTP: run beside the loop. A stop does not pass here (``direct_halt``).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pons.http import call
from pons.mqtt.direct_halt import SOURCE
from pons.mqtt.home_state import name_of

if TYPE_CHECKING:
    from pons.mqtt.orders import HomeOrder
    from pons.settings import LaunchSettings

Json = dict[str, Any]

_SENTENCES = {
    "en": {"home": "go home", "locate": 'say "I am here"', "rooms": "patrol {}", "and": ", "},
    "zh": {"home": "回家", "locate": "说我在这里", "rooms": "巡逻{}", "and": "、"},
}


def sentence_of(order: HomeOrder, places: list[Json], language: str) -> str:
    """Return what a person would say for an order; of a start, to go through all rooms."""
    if order.kind == "sentence":
        return order.text
    words = _SENTENCES[language]
    if order.kind in ("home", "locate"):
        return words[order.kind]
    names = {one["id"]: name_of(one, language) for one in places if one["kind"] == "room"}
    chosen = [names[room] for room in order.rooms] if order.rooms else list(names.values())
    return words["rooms"].format(words["and"].join(chosen))


def give(settings: LaunchSettings, order: HomeOrder, places: list[Json], language: str) -> None:
    """Give an order to the planner.

    Raises:
        PlannerDown, PlannerProblem: as ``pons.http.call``.
    """
    if order.kind == "pause":
        goal = _newest(settings, "running")
        if goal is not None:
            call(settings, "POST", f"/v1/goals/{goal}/pause", {})
        return
    if order.kind == "start" and (goal := _newest(settings, "paused")) is not None:
        call(settings, "POST", f"/v1/goals/{goal}/resume", {"source": SOURCE})
        return
    body: Json = {"text": sentence_of(order, places, language), "source": SOURCE}
    if order.kind in ("home", "rooms"):
        body["replace"] = True  # a vacuum that is sent home ends its round
    call(settings, "POST", "/v1/goals", body)


def _newest(settings: LaunchSettings, state: str) -> str | None:
    goals: list[Json] = call(settings, "GET", "/v1/goals")["goals"]
    found = [goal for goal in goals if goal["state"] == state]
    return str(max(found, key=lambda goal: str(goal["created"]))["id"]) if found else None
