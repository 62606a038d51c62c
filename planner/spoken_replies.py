"""Choose what people should hear aloud of all that is told to listeners: words, questions, ends.

Knows the events of missions and a speaker; not how sound is made. What starts to hold the robot,
and a goal that a person ends, break a sentence off: a robot that was stopped is silent first.
"""

from __future__ import annotations

from collections import OrderedDict
from typing import TYPE_CHECKING, Any

from planner.language.catalogue import say
from planner.plan import GoalState, Language

if TYPE_CHECKING:
    from planner.mission.event_hub import Message
    from planner.voice import SpeechSink

MAX_GOALS = 64
"""Goals whose last state is remembered."""
_ENDED = frozenset({GoalState.SUCCEEDED, GoalState.FAILED, GoalState.REFUSED, GoalState.CANCELLED})


class SpokenReplies:
    """Listen to the missions' events and speak."""

    def __init__(self, mouth: SpeechSink) -> None:
        self._mouth = mouth
        self._states: OrderedDict[str, str] = OrderedDict()
        self._said: OrderedDict[str, str] = OrderedDict()
        self._held = False

    def offer(self, message: Message) -> None:
        """Take the newest event."""
        _, event = message
        match event.get("type"):
            case "say":
                self._note(self._said, str(event["goal"]), str(event["text"]))
                self._mouth.say(str(event["text"]), Language(event["language"]))
            case "goal":
                self._hear_goal(event["goal"])
            case "status":
                held = event["status"].held is not None
                if held and not self._held:
                    self._mouth.hush()
                self._held = held

    def close(self) -> None:
        """Hear no more."""

    def _hear_goal(self, goal: dict[str, Any]) -> None:
        goal_id, state = str(goal["id"]), str(goal["state"])
        if self._states.get(goal_id) == state:
            return
        self._note(self._states, goal_id, state)
        if state == GoalState.CANCELLED:
            self._mouth.hush()
        words, language = self._words(goal), Language(goal["language"])
        if words and not self._repeats(goal_id, words, language):
            self._mouth.say(words, language)

    def _repeats(self, goal_id: str, words: str, language: Language) -> bool:
        """Return whether an end tells of nothing but the words that were heard already."""
        heard = self._said.get(goal_id)
        return heard is not None and words in (heard, say("account.said", text=heard).of(language))

    def _words(self, goal: dict[str, Any]) -> str:
        """Return the sentence that a goal's new state is told in; empty for none."""
        language, outcome, plan = goal["language"], goal.get("outcome"), goal.get("plan")
        state = goal["state"]
        if state in _ENDED and outcome:
            return str(outcome["message"][language])
        asks = state in (GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION)
        if asks and outcome:
            return str(outcome["message"][language])
        if asks and plan and plan.get("text"):
            return str(plan["text"][language])
        return ""

    def _note(self, book: OrderedDict[str, str], goal_id: str, value: str) -> None:
        book[goal_id] = value
        book.move_to_end(goal_id)
        while len(book) > MAX_GOALS:
            book.popitem(last=False)
