"""List the states of a page while the robot asks something: each changes a real snapshot."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from types import MappingProxyType
from typing import Any

Frame = dict[str, Any]
State = Callable[[Frame], None]

QUESTION = "I know no place called “garage”. Shall I do one of these?"
QUESTIONS = {"en-US": QUESTION, "zh-CN": "我不知道“车库”在哪里。要我做下面的一件吗？"}
_LONG = "Shall I go through every room of the house, look for the red cup, and come back here? "
_STILL = {"v_mps": 0.0, "w_radps": 0.0}


def _words(en: str, zh: str = "") -> dict[str, str]:
    return {"en": en, "zh": zh or en}


def goal(name: str, state: str, **more: Any) -> dict[str, Any]:
    """Return a goal as the planner sends it."""
    at = "2026-01-01T00:00:00Z"
    return {
        "id": name, "text": f"go to the {name}", "by": "cli", "stopped_by": None, "answers": [],
        "language": "en", "state": state, "reason": None, "plan": None, "outcome": None,
        "brain": None, "position": None, "created": at, "updated": at, **more,
    }  # fmt: skip


def _asks(name: str, said: dict[str, str], *options: str, **more: Any) -> dict[str, Any]:
    offers = [{"text": f"go to the {each}", "label": _words(each, f"去{each}")} for each in options]
    plan = {"kind": "clarify", "steps": [], "code": "unknown_place", "text": said,
            "options": offers}  # fmt: skip
    outcome: dict[str, Any] = {"code": "unknown_place", "message": said, "asked": None,
                               "reached": None, "metres": None, "seconds": None,
                               "limited_by": []}  # fmt: skip
    record = {"plan": plan, "outcome": outcome, "updated": "2026-01-02T00:00:00Z", **more}
    return goal(name, "needs_clarification", **record)


def asked(frame: Frame) -> Frame:
    """Return the frame of a calm robot that asks one thing."""
    frame = deepcopy(frame)
    status = frame["robot"]["status"]
    status.update(mode="HOLD", held=None, rows=[], waiting_for=[], blocked=False, measured=_STILL)
    frame["robot"].update(localizer="tracking", localizer_trouble=None)
    frame["goals"] = [
        _asks("garage", _words(*QUESTIONS.values()), "kitchen", "hall", "bedroom"),
        goal("bathroom", "succeeded"),
    ]
    return frame


def _status(**changes: Any) -> State:
    return lambda frame: frame["robot"]["status"].update(changes)


def _row(row: str, action: str) -> State:
    up = {"row": row, "action": action, "for_s": 3.0, "evidence": "", "binding": True}
    return _status(rows=[up])


def _moves(v_mps: float, w_radps: float) -> State:
    return _status(mode="ACTIVE", measured={"v_mps": v_mps, "w_radps": w_radps})


def _lost(localizer: str, *guesses: float) -> State:
    def change(frame: Frame) -> None:
        pose = {"x_m": 1.0, "y_m": 1.0, "yaw_rad": 0.0}
        candidates = [{"pose": pose, "score": score} for score in guesses]
        frame["robot"].update(localizer=localizer)
        frame["robot"]["match"] = {"score": 0.2, "candidates": candidates}

    return change


def _age(age_s: float | None) -> State:
    return lambda frame: frame["robot"]["ages_s"].update(status=age_s)


def _unheard(frame: Frame) -> None:
    frame["robot"]["status"] = None
    frame["robot"]["ages_s"]["status"] = None


def _with(*more: dict[str, Any]) -> State:
    return lambda frame: frame["goals"].extend(more)


def _both(*changes: State) -> State:
    def change(frame: Frame) -> None:
        for each in changes:
            each(frame)

    return change


def _stopped(frame: Frame) -> None:
    held = {"reason": "stop", "id": "page-1"}
    paused = goal("hall", "paused", reason="stop", stopped_by="page")
    _both(_status(held=held), _with(paused))(frame)


def _confirms(frame: Frame) -> None:
    whole = frame["goals"][0]
    whole["state"] = "awaiting_confirmation"
    whole["plan"] = {"kind": "plan", "steps": [_step(n) for n in range(12)], "code": None,
                     "text": None, "options": []}  # fmt: skip


def _step(number: int) -> dict[str, Any]:
    return {"kind": "go_to", "place": f"room {number}", "places": [], "state": "pending",
            "depth": 0}  # fmt: skip


def _long(frame: Frame) -> None:
    frame["goals"][0] = _asks("garage", _words(_LONG * 8), *(f"room {n}" for n in range(9)))


STATES: MappingProxyType[str, State] = MappingProxyType(
    {
        "calm": _status(),
        "starting": _status(mode="SELFTEST", waiting_for=["lidar", "drive_echo"]),
        "stopped": _stopped,
        "restarted": _status(held={"reason": "planner_restarted", "id": "p"}),
        "disarmed": _status(mode="DISARMED"),
        "driving": _both(_moves(0.3, 0.1), _with(goal("kitchen", "running"))),
        "turning": _moves(0.0, 0.6),
        "by hand": _status(mode="TELEOP", held={"reason": "teleop", "id": "t"}),
        "stopping": _status(mode="STOPPING"),
        "protective stop": _both(_status(mode="ESTOPPED"), _row("ESTOP", "STOP1")),
        "fault": _status(mode="FAULT", held={"reason": "fault", "id": "runaway"},
                         waiting_for=["runaway"]),
        "low battery": _row("BATTERY", "CAP"),
        "empty battery": _row("BATTERY", "HOLD2"),
        "lost": _lost("lost"),
        "searching": _lost("searching", 0.6, 0.5),
        "lidar stale": _row("LIDAR_STALE", "HOLD2"),
        "blocked": _status(mode="ACTIVE", blocked=True),
        "robot silent": _age(9.0),
        "robot unheard": _unheard,
        "many wait": _with(*(goal(f"q{n}", "queued", position=n) for n in range(12))),
        "many paused": _with(*(goal(f"p{n}", "paused", reason="stop") for n in range(9))),
        "several ask": _with(_asks("q", _words("Which one?"), updated="2026-01-01T00:00:09Z")),
        "wants a yes": _confirms,
        "asks at length": _long,
        "stopped, low, lost": _both(_stopped, _row("BATTERY", "CAP"), _lost("lost")),
    }
)  # fmt: skip
