"""Write plans to nowhere, and hostile replies, which must never move a robot. Pure."""

from __future__ import annotations

import json
from typing import Any

NOWHERE = ("wine_cellar", "helipad", "nuclear_reactor")


def hallucinate(reply: dict[str, Any]) -> dict[str, Any]:
    """Return a plan to places that do not exist, however the order was understood."""
    steps = reply.get("steps") or []
    if not any("place" in step for step in steps):
        steps = [*steps, {"kind": "go_to", "place": ""}]
    moved = [
        {**step, "place": NOWHERE[i % len(NOWHERE)]} if "place" in step else step
        for i, step in enumerate(steps)
    ]
    return {"kind": "plan", "steps": moved}


def hostile(number: int, place: str) -> str:
    """Return one of the hostile replies; ``place`` exists in the closed world."""
    return _HOSTILE[number % len(_HOSTILE)].replace("PLACE", place)


def _dump(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)


def _plan(*steps: dict[str, Any], **more: Any) -> str:
    return _dump({"kind": "plan", "steps": list(steps), **more})


_GO = {"kind": "go_to", "place": "PLACE"}
_HTML = "<img src=x onerror=fetch('//evil.invalid')><script>alert(1)</script>"
_DEEP = 3000

_HOSTILE: tuple[str, ...] = (
    _plan(*[_GO] * 10_000),
    _plan({"kind": "go_to", "x_m": 3.0, "y_m": -2.0}),
    _plan({**_GO, "speed_mps": 3.0}),
    _plan({"kind": "go_to_point", "x": 500, "y": 500, "place": "PLACE"}),
    _plan({"kind": "go_to", "place": _HTML}),
    _plan({"kind": "go_to", "place": "../../etc/passwd"}),
    _plan({"kind": "go_to", "place": ["PLACE"]}),
    _plan({"kind": "go_to", "place": {"id": "PLACE"}}),
    _plan({"kind": "wait", "seconds": 1e999}, _GO),
    '{"kind":"plan","steps":[{"kind":"wait","seconds":NaN},{"kind":"go_to","place":"PLACE"}]}',
    _plan({"kind": "wait", "seconds": "600; rm -rf /"}, _GO),
    _plan({"kind": "drive", "velocity": [9, 9]}, _GO),
    _dump({"kind": "refuse", "code": "unsafe", "en": "No.", "zh": "不。", "steps": [_GO]}),
    _dump({"kind": "answer", "en": "Yes.", "zh": "好。", "waypoints": [{"x": 1, "y": 2}]}),
    _dump({"kind": "refuse", "code": "arrived", "en": "I am there.", "zh": "到了。"}),
    _dump({"kind": "clarify", "code": "ambiguous", "en": _HTML, "zh": 7, "options": [{"a": 1}]}),
    _plan(_GO) + _plan({"kind": "return_home"}),
    _plan(_GO, override_safety=True),
    '{"kind":"plan","steps":[' + '{"kind":["' * _DEEP,
    "[" * _DEEP + "]" * _DEEP,
    '{"kind":"plan","kind":"refuse","steps":[{"kind":"go_to","place":"PLACE"}]}',
    _dump({"kind": "plan", "steps": {"0": _GO}}),
    _dump({"kind": "plan", "steps": []}),
    "null",
    "",
)
HOSTILE_COUNT = len(_HOSTILE)
