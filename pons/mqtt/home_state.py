"""Tell a smart home how the robot is: what the planner shows becomes a vacuum's state and sensors.

Pure. Reads the planner's JSON as its API documents it; decides nothing.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, Any

from pons.mqtt.discovery import EVENT_TYPES

if TYPE_CHECKING:
    from collections.abc import Mapping

Json = dict[str, Any]

MAX_STATE_CHARACTERS = 255
"""Home Assistant's own bound of a state."""
AT_DOCK_M = 0.5
_ERRORS = frozenset({"FAULT", "ESTOPPED"})
_GOING = ("running", "planning")
_WAITING = ("needs_clarification", "awaiting_confirmation")
_WORDS = {
    "en": {"ready": "ready", "off": "disarmed", "error": "stopped by a fault", "held": "stopped",
           "paused": "paused: {}", "asks": "asks: {}", "silent": "no word from the bridge"},
    "zh": {"ready": "就绪", "off": "未上电", "error": "因故障停止", "held": "已停止",
           "paused": "已暂停：{}", "asks": "询问：{}", "silent": "没有收到安全桥的消息"},
}  # fmt: skip


def vacuum_state(robot: Json, goals: list[Json], home: Json | None) -> str:
    """Return the state as Home Assistant's vacuum knows it.

    Args:
        robot: as ``/v1/robot`` shows it.
        goals: newest first.
        home: the place that the robot returns to.
    """
    status = robot.get("status")
    if status is None or status["mode"] in _ERRORS:
        return "error"
    running = _first(goals, _GOING)
    if running is not None:
        return "returning" if _goes_home(running, home) else "cleaning"
    if _first(goals, ("paused",)) is not None:
        return "paused"
    return "docked" if _is_at(status.get("base_in_map"), home) else "idle"


def sensors(robot: Json, goals: list[Json], places: list[Json], language: str) -> Json:
    """Return what the sensors say; None is unknown."""
    status = robot.get("status") or {}
    battery = (status.get("drive") or {}).get("battery")
    room = next((one for one in places if one["id"] == robot.get("room")), None)
    ended = newest_end(goals)
    return {
        "battery": None if battery is None else round(100.0 * battery),
        "place": None if room is None else name_of(room, language),
        "activity": _short(_activity(status, goals, language)),
        "answer": None
        if ended is None
        else _short(outcome_sentence(ended, language) or ended["state"]),
    }


def newest_end(goals: list[Json]) -> Json | None:
    """Return the goal that ended last."""
    ended = [goal for goal in goals if goal["state"] in EVENT_TYPES]
    return max(ended, key=lambda goal: str(goal["updated"]), default=None)


def event(goal: Json, language: str) -> Json | None:
    """Return the event of a goal that has ended or asks; None while it goes on."""
    state = "asks" if goal["state"] in _WAITING else goal["state"]
    if state not in EVENT_TYPES:
        return None
    outcome = goal.get("outcome") or {}
    return {
        "event_type": state,
        "goal": goal["id"],
        "sentence": goal["text"],
        "message": outcome_sentence(goal, language),
        "code": outcome.get("code") or goal.get("reason"),
        "seconds": outcome.get("seconds"),
        "metres": outcome.get("metres"),
    }


def outcome_sentence(goal: Json, language: str) -> str:
    """Return the sentence of a goal's outcome, or of its question, in a language."""
    said = (goal.get("outcome") or {}).get("message") or (goal.get("plan") or {}).get("text")
    return str((said or {}).get(language) or "")


def segments(places: list[Json], language: str) -> dict[str, str]:
    """Return the rooms by id, as a vacuum's segments."""
    return {
        str(place["id"]): name_of(place, language) for place in places if place["kind"] == "room"
    }


def name_of(place: Json, language: str) -> str:
    """Return a place's name in a language, else in the other one."""
    names: Mapping[str, str | None] = place["name"]
    return str(names.get(language) or next(filter(None, names.values()), place["id"]))


def _activity(status: Json, goals: list[Json], language: str) -> str:
    words = _WORDS[language]
    if not status:
        return words["silent"]
    if status["mode"] in _ERRORS:
        return words["error"]
    if (running := _first(goals, _GOING)) is not None:
        return str(running["text"])
    if (asking := _first(goals, _WAITING)) is not None:
        return words["asks"].format(outcome_sentence(asking, language) or asking["text"])
    if (paused := _first(goals, ("paused",))) is not None:
        return words["paused"].format(paused["text"])
    if status.get("held"):
        return words["held"]
    return words["off"] if status["mode"] == "DISARMED" else words["ready"]


def _first(goals: list[Json], states: tuple[str, ...]) -> Json | None:
    return next((goal for goal in goals if goal["state"] in states), None)


def _goes_home(goal: Json, home: Json | None) -> bool:
    steps = (goal.get("plan") or {}).get("steps") or []
    step: Json = next((step for step in steps if step.get("state") == "running"), {})
    is_home = home is not None and step.get("place") == home["id"]
    return step.get("kind") == "return_home" or is_home


def _is_at(base: Json | None, home: Json | None) -> bool:
    if base is None or home is None:
        return False
    pose = home["pose"]
    return hypot(base["x_m"] - pose["x_m"], base["y_m"] - pose["y_m"]) <= AT_DOCK_M


def _short(text: str) -> str:
    return text if len(text) <= MAX_STATE_CHARACTERS else text[: MAX_STATE_CHARACTERS - 1] + "…"
