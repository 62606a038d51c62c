"""What people hear aloud of all that is told, and what breaks it off."""

from __future__ import annotations

from itertools import count
from types import SimpleNamespace
from typing import Any

from planner.plan import Language
from planner.spoken_replies import SpokenReplies


class SpeechSink:
    """Write down what is said and when it is broken off."""

    def __init__(self) -> None:
        self.told: list[str] = []

    def say(self, text: str, language: Language) -> None:
        self.told.append(f"{language.value}: {text}")

    def hush(self) -> None:
        self.told.append("-")


SEQ = count(1)


def replies() -> tuple[SpeechSink, SpokenReplies]:
    mouth = SpeechSink()
    return mouth, SpokenReplies(mouth)


def goal(state: str, en: str = "", *, language: str = "en", plan: str = "") -> dict[str, Any]:
    words = {"en": en, "zh": f"{en}。"}
    told = {"message": words} if en else None
    asked = {"text": {"en": plan, "zh": f"{plan}。"}} if plan else None
    made = {"id": "g1", "state": state, "language": language, "outcome": told, "plan": asked}
    return {"type": "goal", "goal": made}


def say(text: str, language: str = "en") -> dict[str, Any]:
    return {"type": "say", "goal": "g1", "text": text, "language": language}


def status(held: object) -> dict[str, Any]:
    return {"type": "status", "status": SimpleNamespace(held=held)}


def hear(*events: dict[str, Any]) -> list[str]:
    mouth, spoken = replies()
    for event in events:
        spoken.offer((next(SEQ), event))
    return mouth.told


def test_words_questions_and_ends_are_said_in_the_goals_language() -> None:
    assert hear(say("你好", "zh")) == ["zh: 你好"]
    assert hear(goal("needs_clarification", plan="Which room?")) == ["en: Which room?"]
    assert hear(goal("succeeded", "Arrived: kitchen.", language="zh")) == [
        "zh: Arrived: kitchen.。"
    ]


def test_a_state_is_told_once_and_progress_not_at_all() -> None:
    told = hear(
        goal("running"), goal("running"), goal("failed", "The way is blocked."),
        goal("failed", "The way is blocked."), {"type": "progress", "left_m": 3.0},
        {"type": "gap", "missed": 3},
    )  # fmt: skip
    assert told == ["en: The way is blocked."]


def test_an_end_that_repeats_what_was_said_is_not_said_twice() -> None:
    assert hear(say("Dinner is ready."), goal("succeeded", "Dinner is ready.")) == [
        "en: Dinner is ready."
    ]
    for language, told in (("en", "I said “dinner”."), ("zh", "我说了“dinner”")):
        heard = hear(say("dinner", language), goal("succeeded", told, language=language))
        assert heard == [f"{language}: dinner"]
    assert len(hear(say("dinner"), goal("succeeded", "Arrived: kitchen. I said “dinner”."))) == 2


def test_a_stop_and_a_goal_that_was_ended_break_off_before_anything_new_is_said() -> None:
    assert hear(status(None), status("stop"), status("stop"), goal("succeeded", "Stopped.")) == [
        "-",
        "en: Stopped.",
    ]
    assert hear(goal("running"), goal("cancelled", "Cancelled.")) == ["-", "en: Cancelled."]


def test_goals_without_end_take_no_memory_without_end() -> None:
    mouth, spoken = replies()
    for number in range(1000):
        event = goal("succeeded", "Done.")
        event["goal"]["id"] = f"g{number}"
        spoken.offer((next(SEQ), event))
    assert len(mouth.told) == 1000
    assert len(spoken._states) <= 64
