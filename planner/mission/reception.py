"""Receive a person's sentence: decide once, before any brain, what it is to the missions.

The one door for text, voice, page, command line and the lockstep harness: whoever feeds the
missions asks :func:`receive` and does what it says, a stop first of all. Pure; only
:class:`Repeats`, which it reads, is changed by whoever took a request in.

Laws: an order to stop is never refused, is never a repetition and takes no room. The same key and
request are the same goal, however full it has become; the same key with another request is refused.
At most ``MAX_OPEN`` goals are open, but for what is said to the planner itself.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from planner.language.commands import Cancel as TakeBack
from planner.language.commands import Replace
from planner.language.commands import Resume as GoOn
from planner.mission.allowed_commands import refusal
from planner.mission.answer_timeouts import has_room
from planner.mission.answered_question import meant
from planner.mission.bridge_status import at_rest
from planner.mission.errors import IdempotencyConflict, QueueFull
from planner.mission.events import Cancel, Reply
from planner.mission.goal_reference import goal_to_end
from planner.mission.journal import MAX_KEYS, GoalKey
from planner.mission.open_questions import takes_yes
from planner.plan import GoalState

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.language.utterance import Utterance
    from planner.mission.errors import MissionError
    from planner.mission.events import Command, Submitted
    from planner.mission.state import MissionState

OLD_STATUS_S = 1.0
"""A status older than this says nothing of whether the robot moves now."""


class Repeats:
    """Remember the newest keys of requests and the goals they made, as many as the journal does."""

    def __init__(self, kept: Iterable[GoalKey] = ()) -> None:
        """Begin with what the journal kept, oldest first."""
        self._keys = {each.key: each for each in kept}

    def find(self, key: str | None) -> GoalKey | None:
        """Return the request that came with a key before, or None; without a key none is known."""
        return self._keys.get(key) if key is not None else None

    def remember(self, request: GoalKey | None) -> None:
        """Remember a request that was taken in; one without a key is never known again."""
        if request is None:
            return
        if len(self._keys) >= MAX_KEYS:
            self._keys.pop(next(iter(self._keys)))
        self._keys[request.key] = request

    def forget(self, request: GoalKey | None) -> None:
        """Let a request come anew: it was not taken."""
        if request is not None:
            self._keys.pop(request.key, None)


@dataclass(frozen=True, slots=True)
class Reception:
    """Say what is to be done with a sentence."""

    given: Submitted
    stops: bool = False
    """The bridge is told to stop before anything else."""
    takes_back: str | None = None
    """The goal that it ends."""
    refused: MissionError | None = None
    """Why it is not taken in: QueueFull or IdempotencyConflict."""
    repeats: str | None = None
    """The goal that this very request made before: it is shown, and nothing is done."""
    request: GoalKey | None = None
    """What is remembered with the goal, where the request has a key."""


def receive(
    book: MissionState,
    said: Utterance,
    given: Submitted,
    now_s: float,
    *,
    answers: bool = True,
    key: str | None = None,
    repeats: Repeats | None = None,
) -> Reception:
    """Return what is to be done with a sentence that came now.

    Args:
        book: where everything stands.
        said: the sentence as it was read.
        given: the goal that it would be, without marks.
        now_s: on the clock of the book.
        answers: it may answer a question.
        key: the Idempotency-Key of the request.
        repeats: the requests that came before.
    """
    if said.orders_stop:
        return Reception(replace(given, stop=True), stops=True)
    intent, full = said.intent, not has_room(book)
    may_answer = answers and not (given.confirm or given.replace)
    asking = meant(book, said) if may_answer else ()
    if said.may_mean_stop and not asking and is_active(book, now_s):
        marked = replace(given, stop=full, doubtful_stop=not full, confirm=True, replace=False)
        return Reception(marked, stops=True)
    body = _body_of(given)
    before = repeats.find(key) if repeats is not None else None
    if before is not None and before.body != body:
        return Reception(given, refused=IdempotencyConflict(before.key, before.goal))
    if before is not None:
        return Reception(given, repeats=before.goal)
    replaces = isinstance(intent, Replace)
    first = isinstance(intent, Replace) and intent.now
    local = bool(asking) or (intent is not None and not replaces)
    marked = replace(
        given,
        replace=given.replace if not replaces else not first,
        first=first,
        resumes=isinstance(intent, GoOn) and not asking,
        asking=asking,
        local=local,
    )
    if full and not local:
        return Reception(
            marked, refused=QueueFull(sum(not m.ended for m in book.missions.values()))
        )
    request = GoalKey(key, body, given.id) if key is not None else None
    takes_back = goal_to_end(book) if first else None
    return Reception(marked, takes_back=takes_back, request=request)


def _body_of(given: Submitted) -> str:
    """Return the fingerprint of a request, as it came."""
    asked = [given.text, given.language.value, given.confirm, given.replace]
    fields = json.dumps(asked, ensure_ascii=True)
    return hashlib.sha256(fields.encode()).hexdigest()[:32]


@dataclass(frozen=True, slots=True)
class AnswerReception:
    """Say what is to be done with words that came as the answer to one goal's question."""

    refused: MissionError | None = None
    """The goal takes no answer now."""
    stops: bool = False
    """The bridge is told to stop before anything else."""
    command: Command | None = None
    """What the words do to the goal; after a stop, where its state still allows it."""
    sentence: str | None = None
    """What is then taken in as a goal of its own, beside the question."""
    answers: bool = True
    """That goal may answer a question."""


def receive_answer(
    book: MissionState, said: Utterance, goal_id: str, now_s: float
) -> AnswerReception:
    """Return what is to be done with words that came as the answer to a goal.

    What is said to the planner itself ("where are you", "hold on") is done beside the question,
    which stays open: no sentence that needs no proof is ever taken as the answer.
    """
    intent = said.intent
    if said.orders_stop or (said.consent is None and hears_stop(book, said, now_s)):
        ends = Cancel(goal_id) if isinstance(intent, Replace) else None
        return AnswerReception(stops=True, command=ends)
    if (error := refusal(book, Reply(goal_id, said.text))) is not None:
        return AnswerReception(refused=error)
    if isinstance(intent, TakeBack):
        return AnswerReception(command=Cancel(goal_id))
    own_question = takes_yes(book.missions[goal_id])  # "go on" may be its answer
    if said.stays_put or (isinstance(intent, GoOn) and not own_question):
        return AnswerReception(sentence=said.text)
    if isinstance(intent, Replace):
        return AnswerReception(command=Cancel(goal_id), sentence=intent.rest, answers=False)
    return AnswerReception(command=Reply(goal_id, said.text))


def hears_stop(book: MissionState, said: Utterance, now_s: float) -> bool:
    """Return whether these words would stop the robot now, whatever else they may mean."""
    return said.orders_stop or (said.may_mean_stop and is_active(book, now_s))


def awaits_answer(book: MissionState) -> bool:
    """Return whether a question waits for a yes or no."""
    return any(takes_yes(mission) for mission in book.missions.values())


def is_active(book: MissionState, now_s: float) -> bool:
    """Return whether anything moves, is about to move, or waits; in doubt it does."""
    thinking = any(m.state is GoalState.PLANNING for m in book.missions.values())
    if book.running is not None or book.queue or thinking:
        return True
    status = book.status
    if status is None:
        return False  # no bridge was ever heard, so nothing of ours can move
    return not now_s - book.status_s <= OLD_STATUS_S or not at_rest(status)
