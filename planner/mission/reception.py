"""Receive a person's sentence: decide once, before any brain, its role for the missions.

The one door for text, voice, page, command line and the lockstep harness: whoever feeds the
missions asks :func:`receive` and does what it says, a stop first of all. Pure; only
:class:`Repeats`, which it reads, is changed by whoever took a request in. Here is also found the
goal that a person means who names none: to answer, to end, to pause, to go on with it.

Laws: an order to stop is never refused, is never a repetition and takes no room. The same key and
request are the same goal, however full it has become; the same key with another request is refused.
At most ``MAX_OPEN`` goals are open, but for what is said to the planner itself.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from planner.language.commands import CancelCommand as TakeBack
from planner.language.commands import Replace
from planner.language.commands import ResumeCommand as GoOn
from planner.language.utterance import Utterance
from planner.mission.allowed_commands import refusal
from planner.mission.bridge_status import at_rest
from planner.mission.errors import IdempotencyConflict, QueueFull, ReservedKey
from planner.mission.events import Cancel, Reply
from planner.mission.follow_up import (
    Lean,
    denied_goal,
    denies_way,
    lean_of,
)
from planner.mission.journal import MAX_KEYS
from planner.mission.open_questions import WAITS, asks_freely, has_room, takes_yes
from planner.mission.state import (
    RESERVED_KEYS,
    GoalKey,
    MissionState,
    goal_to_end,
    newest_paused,
)
from planner.plan import ChangedOrder, GoalState

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.mission.errors import MissionError
    from planner.mission.events import Command, Submitted

OLD_STATUS_S = 1.0
"""A status older than this says nothing of whether the robot moves now."""


class Repeats:
    """Remember the newest keys of requests and the goals they made, as many as the journal does."""

    def __init__(self, kept: Iterable[GoalKey] = ()) -> None:
        """Begin with the journal's keys, oldest first."""
        self.recall(kept)

    def recall(self, kept: Iterable[GoalKey]) -> None:
        """Take up the journal's keys, oldest first."""
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
    """Hold the decision on a sentence."""

    given: Submitted
    stops: bool = False
    """The bridge is told to stop before anything else."""
    takes_back: str | None = None
    """The goal that it ends."""
    refused: MissionError | None = None
    """Why it is not taken in: QueueFull, IdempotencyConflict or ReservedKey."""
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
    leaning: Lean | None = None,
    key: str | None = None,
    repeats: Repeats | None = None,
) -> Reception:
    """Return the decision on a sentence that came now.

    Args:
        book: where everything stands.
        said: the sentence as it was read.
        given: the goal that it would be, without marks.
        now_s: on the clock of the book.
        leaning: how it leans, where it was said as an answer: it answers nothing then.
        key: the Idempotency-Key of the request.
        repeats: the requests that came before.
    """
    full = not has_room(book)
    if said.orders_stop:
        stop = replace(given, stop=True, rest=said.behind_stop)
        if stop.rest and not full:
            stop = _doubtful(book, replace(stop, changed=ChangedOrder(words=stop.rest)))
        return Reception(stop, stops=True)
    may_answer = leaning is None and not (given.confirm or given.replace)
    asking = goals_answered_by(book, said) if may_answer else ()
    now_unix_s, intent = now_s + book.wall_offset_s, said.intent
    lean = leaning if asking or leaning is not None else lean_of(book, said, now_unix_s)
    changed = lean.changed if lean is not None else None
    if not asking and _may_stop(book, said, now_s, lean):
        order = changed.words if changed is not None else said.text
        denies = denied_goal(book, order, now_unix_s)
        denied = replace(given, stop=full, denies=denies, changed=changed)
        return Reception(denied if full else _doubtful(book, denied), stops=True)
    if key is not None and key.startswith(RESERVED_KEYS):
        return Reception(given, refused=ReservedKey(key))
    body, before = _body_of(given), repeats.find(key) if repeats is not None else None
    if before is not None and before.body != body:
        return Reception(given, refused=IdempotencyConflict(before.key, before.goal))
    if before is not None:
        return Reception(given, repeats=before.goal)
    local = bool(asking) or not (intent is None or lean is not None)
    marked = replace(
        given,
        replace=given.replace or (lean is not None and lean.replaces),
        first=lean is not None and lean.first,
        resumes=isinstance(intent, GoOn) and not asking,
        asking=asking,
        local=local,
        changed=changed,
    )
    if full and not local:
        open_goals = sum(not m.has_ended for m in book.missions.values())
        return Reception(marked, refused=QueueFull(open_goals))
    request = GoalKey(key, body, given.id) if key is not None else None
    ends = goal_to_end(book) if lean is not None and lean.ends else None
    return Reception(marked, takes_back=ends, request=request)


def _doubtful(book: MissionState, given: Submitted) -> Submitted:
    """Mark a sentence that stops the robot and is thought about then: it drives after a yes."""
    given = replace(given, stop=False, doubtful_stop=True, confirm=True, replace=False)
    return replace(given, interrupts=goal_to_pause(book))


def _body_of(given: Submitted) -> str:
    """Return the fingerprint of a request, as it came."""
    asked = [given.text, given.language.value, given.confirm, given.replace]
    fields = json.dumps(asked, ensure_ascii=True)
    return hashlib.sha256(fields.encode()).hexdigest()[:32]


@dataclass(frozen=True, slots=True)
class AnswerReception:
    """Hold the decision on words that came as the answer to one goal's question."""

    refused: MissionError | None = None
    """The goal takes no answer now."""
    stops: bool = False
    """The bridge is told to stop before anything else."""
    command: Command | None = None
    """What the words do to the goal; after a stop, where its state still allows it."""
    sentence: str | None = None
    """What is then taken in as a goal of its own, beside the question."""
    lean: Lean | None = None
    """What that goal makes of the order that was asked about; it answers no question then."""


def receive_answer(
    book: MissionState, said: Utterance, goal_id: str, now_s: float
) -> AnswerReception:
    """Return the decision on words that came as the answer to a goal.

    What is said to the planner itself ("where are you", "hold on") is done beside the question,
    which stays open: but for a plain no, which answers the goal that it names and no other, no
    sentence that needs no proof is ever taken as the answer.
    """
    intent = said.intent
    ends = Cancel(goal_id) if isinstance(intent, Replace) else None
    if said.orders_stop:
        rest = said.text if said.behind_stop else None
        return AnswerReception(stops=True, command=ends, sentence=rest)
    lean = lean_of(book, said, now_s + book.wall_offset_s)
    if said.consent is None and _may_stop(book, said, now_s, lean):
        return AnswerReception(stops=True, command=ends)
    if (error := refusal(book, Reply(goal_id, said.text))) is not None:
        return AnswerReception(refused=error)
    if isinstance(intent, TakeBack):
        return AnswerReception(command=Cancel(goal_id))
    if lean is not None and lean.corrects:  # "no, the study": in place of what is asked
        lean = replace(lean, ends=False, first=False, replaces=False)  # what it ends has ended
        return AnswerReception(command=Cancel(goal_id), sentence=said.text, lean=lean)
    own_question = takes_yes(book.missions[goal_id])  # "go on" may be its answer
    declines = said.consent is False and (own_question or asks_freely(book.missions[goal_id]))
    if (said.stays_put and not declines) or (isinstance(intent, GoOn) and not own_question):
        return AnswerReception(sentence=said.text)
    return AnswerReception(command=Reply(goal_id, said.text))


def hears_stop(book: MissionState, said: Utterance, now_s: float) -> bool:
    """Return whether these words would stop the robot now, with any other meaning besides."""
    if said.orders_stop:
        return True
    return _may_stop(book, said, now_s, lean_of(book, said, now_s + book.wall_offset_s))


def _may_stop(book: MissionState, said: Utterance, now_s: float, lean: Lean | None) -> bool:
    """Return whether words that may mean a stop are to be taken for one now.

    卧室别进去 leaves one room out of the round that runs, and the rest of it goes on.
    """
    if not is_active(book, now_s) or (lean is not None and lean.keeps_round):
        return False
    leans = lean is not None and bool(lean.changed.steps)
    may_mean = said.may_mean_stop and not leans
    return may_mean or denies_way(book, said.text, now_s + book.wall_offset_s)


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


def goals_answered_by(book: MissionState, said: Utterance) -> tuple[str, ...]:
    """Return the goals whose question a sentence may answer; one alone is beyond doubt.

    None unless it is a plain yes or no and one of them takes it. A question that takes neither (a
    brain's about the order, which offers no or several orders) counts where it is no older than the
    newest of these: it may be meant, too.
    """
    if said.consent is None:
        return ()
    intent = said.intent
    if not (intent is None or (isinstance(intent, GoOn) and goal_to_resume(book) is None)):
        return ()  # "go on" is a yes where there is nothing else to go on with
    waiting = [m for m in book.missions.values() if m.state in WAITS]
    taking = {m.id: m.updated_unix_s for m in waiting if takes_yes(m)}
    if not taking:  # "Do you mean the kitchen?" of a model: it reads the word itself
        alone = len(waiting) == 1 and intent is None
        return tuple(m.id for m in waiting if alone and asks_freely(m))
    newest_unix_s = max(taking.values())
    return tuple(m.id for m in waiting if m.id in taking or m.updated_unix_s >= newest_unix_s)


def goal_to_pause(book: MissionState, asking: str | None = None) -> str | None:
    """Return the goal that a person wants paused."""
    if book.running is not None:
        return book.running
    thinking = [
        m for m in book.missions.values() if m.state is GoalState.PLANNING and m.id != asking
    ]
    return max(thinking, key=lambda m: m.order).id if thinking else None


def goal_to_resume(book: MissionState, asking: str | None = None) -> str | None:
    """Return the goal that was paused last, else the first that is kept waiting."""
    paused = newest_paused(book, asking)
    return paused or next((i for i in book.queue if book.missions[i].held), None)
