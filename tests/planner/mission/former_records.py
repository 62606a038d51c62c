"""Hold goals' records as programs wrote them that kept one record, ``notes``, for every skill.

Each was written by such a program; what they had in common stands once.
"""

from __future__ import annotations

import json
from typing import Any

YOUNGER = (
    *("recoveries", "depth", "role", "times", "round", "began_unix_s", "holds", "earlier"),
    *("word", "time", "after", "before", "span", "deeds", "bill"),
    *("look", "stops", "side", "map_id", "x_m", "y_m", "yaw_rad", "tool", "arguments"),
)
"""Fields of a step that these programs did not know."""

_ASKED = (
    "angle_rad",
    "distance_m",
    "kind",
    "object",
    "place",
    "places",
    "seconds",
    "text",
    "x",
    "y",
)
"""What of a step they wrote down as tried."""

_STEP: dict[str, Any] = {
    "place": None, "places": [], "object": None, "text": None, "seconds": None, "angle_rad": None,
    "distance_m": None, "state": "running", "reached": None, "residual_m": None,
    "residual_rad": None, "moved_m": None, "turned_rad": None, "visited": None, "x": None,
    "y": None, "found": None, "count": None, "rooms": [], "code": None, "said": None, "read": None,
    "answer": None, "left_m": None, "left_rad": None, "left_s": None, "reason": None,
}  # fmt: skip
_NOTES: dict[str, Any] = {
    "stage": 0, "spot": None, "views": [], "turned": None, "spots": [], "rooms": [],
    "missed": None, "shut": [], "broke": False, "here": None, "ahead": None, "faced": [],
    "order": [], "aim": None, "tried": [], "at": None, "pointed": None, "sure": None,
    "label": None, "color": None, "stand": 0, "again": 0, "heard": None, "seen_s": 0.0,
}  # fmt: skip
_GOAL: dict[str, Any] = {
    "id": "g1", "order": 1, "text": "text g1", "language": "en", "state": "running",
    "reason": None, "replies": [], "questions": [], "source": "api", "outcome": None,
    "brain": None, "confirm": False, "replace": False, "first": False, "doubtful_stop": False,
    "given_under_hold": None, "held": False, "kept": False, "map_id": "", "step": 0, "part": 0,
    "began_at": None, "done": 0.0, "step_m": 0.0, "replans": 0, "decides": 0, "failure": None,
    "leg": 0, "accepted_at": [0.0, 0.0, 0.0], "speed_share": 1.0, "metres": 0.0, "limited": {},
    "created_unix_s": 100.19999999999999,
}  # fmt: skip
_ROUND = {"here": [0.0, 0.0], "order": ["hall", "kitchen"]}
_HALL_SEEN = {**_ROUND, "spot": "kitchen/0", "spots": ["here"], "rooms": ["hall"]}
_DOCK = {"kind": "go_to", "place": "dock", "state": "pending"}


def _there(room: str, x_m: float, yaw_rad: float, left_rad: float | None = 0.0) -> dict[str, Any]:
    """Return what a step noted that has reached a pose."""
    reached = {"place": None, "room": room, "x_m": x_m, "y_m": 0.0, "yaw_rad": yaw_rad}
    return {"reached": reached, "residual_m": 0.0, "residual_rad": left_rad}


def _asks(en: str, zh: str) -> dict[str, Any]:
    """Return the state and outcome of a goal that asks this."""
    unsaid = dict.fromkeys(("asked", "reached", "metres", "seconds"))
    told: dict[str, Any] = {
        "code": "asked",
        "message": {"en": en, "zh": zh},
        **unsaid,
        "limited_by": [],
    }
    return {"state": "needs_clarification", "reason": "asked", "outcome": told}


def _row(notes: dict[str, Any], *steps: dict[str, Any], **goal: Any) -> str:
    """Return the row of a goal as it was written."""
    whole = [{**_STEP, **step} for step in steps]
    plan = {"kind": "plan", "steps": whole, "code": None, "text": None, "options": []}
    tried = [json.dumps([{name: step[name] for name in _ASKED} for step in whole])]
    return json.dumps({**_GOAL, "plan": plan, "notes": {**_NOTES, **notes}, "tried": tried, **goal})


FIND = _row(
    {**_HALL_SEEN, "views": [0], "turned": 1},
    {"kind": "find", "object": "red cup", **_there("kitchen", 3.975, 1.0472)},
    part=14, done=3.975, step_s=13.45, step_m=3.975, leg=7, metres=3.975,
    limited={"max_speed": 158}, updated_unix_s=113.64999999999922,
)  # fmt: skip
COUNT = _row(
    {**_HALL_SEEN, "views": [0, 1, 2, 3, 4]},
    {"kind": "count", "object": "cups", **_there("kitchen", 3.975, -2.0944)},
    part=21, done=3.975, step_s=16.6, step_m=3.975, leg=11, metres=3.975,
    limited={"max_speed": 158}, updated_unix_s=116.79999999999905,
)  # fmt: skip
LOOK = _row(
    {**_ROUND, "spot": "here", "views": [0, 1, 2, 3, 4], "turned": 5, "ahead": 0.0,
     "faced": [0.0, 1.047, 2.094, 3.142, -2.094]},
    {"kind": "look", "text": "look around: is there a cup?", **_there("hall", 0.0, -1.0472)},
    part=10, step_s=4.05, leg=5, updated_unix_s=104.24999999999976,
)  # fmt: skip
FOLLOW = _row(
    {"stage": -1, "here": [0.0, 0.0], "at": [3.0, 0.0, 0.9], "label": "person", "stand": 3,
     "seen_s": 6.9},
    {"kind": "follow", "object": "me"},
    part=2, step_s=6.9, updated_unix_s=109.19999999999948,
)  # fmt: skip
APPROACH = _row(
    {"stage": 11, "at": [5.0, 0.0, 0.8], "label": "cup", "color": "red"},
    {"kind": "go_to_object", "object": "red cup", **_there("kitchen", 4.125, 0.0)},
    part=1, done=4.125, step_s=8.25, step_m=4.125, leg=1, metres=4.125,
    limited={"max_speed": 164}, created_unix_s=101.19999999999993,
    updated_unix_s=109.44999999999946,
)  # fmt: skip
LOOK_ANEW = _row(
    {"spot": "hall/0", "spots": ["here"], "rooms": ["kitchen"], "here": [4.125, 0.0],
     "order": ["kitchen", "hall"], "label": "cup", "color": "red", "again": 1},
    {"kind": "go_to_object", "object": "red cup", **_there("hall", 0.025, 0.0, None)},
    part=14, done=8.225, step_s=22.4, step_m=8.225, leg=7, metres=8.225,
    limited={"max_speed": 327}, created_unix_s=101.19999999999993,
    updated_unix_s=123.59999999999866,
)  # fmt: skip
POINTED = _row(
    {"stage": 4, "pointed": [4.0, 0.5, 0.4]},
    {"kind": "go_to_object", "object": "guitar"},
    _DOCK,
    **_asks("“guitar”: the vision model points 4.0 m away, straight ahead (in the kitchen). "
            "Shall I drive there?",
            "“guitar”：视觉模型指向正前方 4.0 米处（kitchen）。要我开过去吗？"),
    part=2, step_s=0.8, updated_unix_s=100.99999999999994,
)  # fmt: skip
ASKED_AGAIN = _row(
    {"stage": 2, "heard": "perhaps"},
    {"kind": "ask", "text": "Shall I go?"},
    _DOCK,
    **_asks("You said “perhaps”. Shall I drive to “dock”? Please answer yes or no.",
            "您说了“perhaps”。要我去“充电桩”吗？请回答“是”或“不”。"),
    step_s=0.0, updated_unix_s=101.19999999999993,
)  # fmt: skip
DRIVE = _row(
    {},
    {"kind": "go_to", "place": "kitchen"},
    state="paused", reason="operator", done=1.5, step_s=3.0, step_m=1.5, leg=1, metres=1.5,
    tried=['[{"kind": "go_to", "place": "kitchen"}]'], limited={"max_speed": 60},
    created_unix_s=100.25, updated_unix_s=103.25,
)  # fmt: skip
"""A goal paused on its way, whose skill remembered nothing."""
