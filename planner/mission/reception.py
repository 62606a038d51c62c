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

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from planner.bridge_client.bridge_status import at_rest
from planner.language.commands import CancelCommand as TakeBack
from planner.language.commands import Replace
from planner.language.commands import ResumeCommand as GoOn
from planner.language.readers import AT_THE_DOOR, readings, stop
from planner.language.reading import AnswerReading, ChangeReading, HaltReading
from planner.language.sentence import SaidSentence
from planner.mission import agents
from planner.mission.awaited_word import TAKES_YES, AwaitedWord, awaits, list_waiting, wait_of
from planner.mission.errors import IdempotencyConflict, PersonMissing, QueueFull, ReservedKey
from planner.mission.events import Cancel, Reply
from planner.mission.follow_up import denied_goal, denies_way, lean_of
from planner.mission.open_questions import count_open, has_room
from planner.mission.request_keys import Repeats, body_of, request_of
from planner.mission.state import RESERVED_KEYS, GoalKey, MissionState, goal_to_end, newest_paused
from planner.mission.transitions import refusal
from planner.plan import ChangedOrder, GoalState

if TYPE_CHECKING:
    from planner.mission.errors import MissionError
    from planner.mission.events import Command, Submitted

OLD_STATUS_S = 1.0
"""A status older than this says nothing of whether the robot moves now."""


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
    said: SaidSentence,
    given: Submitted,
    now_s: float,
    *,
    leaning: ChangeReading | None = None,
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
    if agents.is_agents(given.source):
        return _receive_agent(book, said, given, now_s, key, repeats)
    full, may_answer = not has_room(book), not (given.confirm or given.replace)
    goals = _AtHand(book, now_s, leaning, may_answer=leaning is None and may_answer)
    reading = next(readings(said, goals, AT_THE_DOOR), None)
    if isinstance(reading, HaltReading):
        halted = _mark_denied(book, goals, said, given) if reading.is_doubtful else given
        return Reception(_halt(book, halted, reading, full=full), stops=True)
    if (known := _find_known(given, key, repeats)) is not None:
        return known
    asking = reading.goals if isinstance(reading, AnswerReading) else ()
    lean = reading if isinstance(reading, ChangeReading) else leaning
    local = bool(asking) or not (said.intent is None or lean is not None)
    marked = replace(
        given,
        replace=given.replace or (lean is not None and lean.replaces),
        first=lean is not None and lean.first,
        resumes=isinstance(said.intent, GoOn) and not asking,
        asking=asking,
        local=local,
        changed=lean.changed if lean is not None else None,
    )
    if full and not local:
        return Reception(marked, refused=QueueFull(count_open(book)))
    ends = goal_to_end(book) if lean is not None and lean.ends else None
    return Reception(marked, takes_back=ends, request=request_of(given, key))


def _receive_agent(
    book: MissionState, said: SaidSentence, given: Submitted, now_s: float,
    key: str | None, repeats: Repeats | None,
) -> Reception:  # fmt: skip
    """Return the decision on an agent's sentence: a stop alone, or an order that leans on no other.

    It answers no question and takes nothing back, and nothing that a stop is said with is done.
    """
    if stop(said, _AtHand(book, now_s)) is not None:
        return Reception(replace(given, stop=True), stops=True)
    return receive_points(book, given, key, repeats)


def receive_points(
    book: MissionState, given: Submitted, key: str | None, repeats: Repeats | None
) -> Reception:
    """Return the decision on a goal of which no words are read: it may be given by steps."""
    by_agent = agents.is_agents(given.source)
    if by_agent and given.replace:
        return Reception(given, refused=PersonMissing())
    if (known := _find_known(given, key, repeats)) is not None:
        return known
    if not has_room(book) or (by_agent and not agents.has_room(book)):
        return Reception(given, refused=QueueFull(count_open(book)))
    return Reception(given, request=request_of(given, key))


def _find_known(given: Submitted, key: str | None, repeats: Repeats | None) -> Reception | None:
    """Return the decision on a request whose key was used before, or that no person may use."""
    if key is not None and key.startswith(RESERVED_KEYS):
        return Reception(given, refused=ReservedKey(key))
    before = repeats.find(key) if repeats is not None else None
    if before is None:
        return None
    if before.body != body_of(given):
        return Reception(given, refused=IdempotencyConflict(before.key, before.goal))
    return Reception(given, repeats=before.goal)


def _halt(book: MissionState, given: Submitted, reading: HaltReading, *, full: bool) -> Submitted:
    """Mark a sentence that stops the robot; what else is in it drives after a yes."""
    stopped = replace(given, stop=True)
    if not reading.is_doubtful:
        stopped = replace(stopped, rest=reading.rest)
        if not reading.rest:
            return stopped
        if not full:
            stopped = replace(stopped, changed=ChangedOrder(words=reading.rest))
    if full:
        return stopped
    doubtful = replace(stopped, stop=False, doubtful_stop=True, confirm=True, replace=False)
    return replace(doubtful, interrupts=goal_to_pause(book))


def _mark_denied(
    book: MissionState, goals: _AtHand, said: SaidSentence, given: Submitted
) -> Submitted:
    """Return a sentence that may mean a stop, with the goal on whose way it says not to go."""
    lean = goals.change_of(said)
    changed = lean.changed if lean is not None else None
    order = changed.words if changed is not None else said.text
    denies = denied_goal(book, order, goals.now_unix_s)
    return replace(given, denies=denies, changed=changed)


class _AtHand:
    """Say what stands in the book besides a sentence; each is worked out once."""

    def __init__(
        self,
        book: MissionState,
        now_s: float,
        leaning: ChangeReading | None = None,
        *,
        may_answer: bool = False,
    ) -> None:
        self._book, self._now_s, self._leaning = book, now_s, leaning
        self._may_answer = may_answer
        self.now_unix_s = now_s + book.wall_offset_s
        self._changes: dict[SaidSentence, ChangeReading | None] = {}

    def asked_by(self, said: SaidSentence) -> tuple[str, ...]:
        return goals_answered_by(self._book, said) if self._may_answer else ()

    def change_of(self, said: SaidSentence) -> ChangeReading | None:
        if self._leaning is None and said not in self._changes:
            self._changes[said] = lean_of(self._book, said, self.now_unix_s)
        return self._leaning or self._changes[said]

    def may_stop(self, said: SaidSentence) -> bool:
        """Return whether words that may mean a stop are to be taken for one now.

        卧室别进去 leaves one room out of the round that runs, and the rest of it goes on.
        """
        if not is_active(self._book, self._now_s):
            return False
        lean = self.change_of(said)
        if lean is not None and lean.keeps_round:
            return False
        leans = lean is not None and bool(lean.changed.steps)
        may_mean = said.may_mean_stop and not leans
        return may_mean or denies_way(self._book, said.text, self.now_unix_s)


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
    lean: ChangeReading | None = None
    """What that goal makes of the order that was asked about; it answers no question then."""


def receive_answer(
    book: MissionState, said: SaidSentence, goal_id: str, now_s: float,
    by: str = "api", source: str = "api",
) -> AnswerReception:  # fmt: skip
    """Return the decision on words that came as the answer to a goal.

    What is said to the planner itself ("where are you", "hold on") is done beside the question,
    which stays open: but for a plain no, which answers the goal that it names and no other, no
    sentence that needs no proof is ever taken as the answer.
    """
    if agents.is_agents(source):
        return _receive_agents_answer(book, said, Reply(goal_id, said.text, by), now_s, source)
    intent = said.intent
    ends = Cancel(goal_id) if isinstance(intent, Replace) else None
    if said.orders_stop:
        rest = said.text if said.behind_stop else None
        return AnswerReception(stops=True, command=ends, sentence=rest)
    goals = _AtHand(book, now_s)
    if said.consent is None and goals.may_stop(said):
        return AnswerReception(stops=True, command=ends)
    if (error := refusal(book, Reply(goal_id, said.text))) is not None:
        return AnswerReception(refused=error)
    if isinstance(intent, TakeBack):
        return AnswerReception(command=Cancel(goal_id))
    lean = goals.change_of(said)
    if lean is not None and lean.corrects:  # "no, the study": in place of what is asked
        lean = replace(lean, ends=False, first=False, replaces=False)  # what it ends has ended
        return AnswerReception(command=Cancel(goal_id), sentence=said.text, lean=lean)
    waits = wait_of(book.missions[goal_id])
    own_question = waits in TAKES_YES  # "go on" may be its answer
    declines = said.consent is False and (own_question or waits is AwaitedWord.FREELY)
    if (said.stays_put and not declines) or (isinstance(intent, GoOn) and not own_question):
        return AnswerReception(sentence=said.text)
    return AnswerReception(command=Reply(goal_id, said.text, by))


def _receive_agents_answer(
    book: MissionState, said: SaidSentence, reply: Reply, now_s: float, source: str
) -> AnswerReception:
    """Return the decision on an agent's answer: a stop, or what its own goal asks the giver."""
    halts = said.consent is None and _AtHand(book, now_s).may_stop(said)
    if said.orders_stop or halts:
        return AnswerReception(stops=True)
    refused = agents.refuse_answer(book, reply, source, declines=said.consent is False)
    if refused is not None:
        return AnswerReception(refused=refused)
    takes_back = isinstance(said.intent, TakeBack)
    return AnswerReception(command=Cancel(reply.id) if takes_back else reply)


def hears_stop(book: MissionState, said: SaidSentence, now_s: float) -> bool:
    """Return whether these words would stop the robot now, with any other meaning besides."""
    return stop(said, _AtHand(book, now_s)) is not None


def awaits_answer(book: MissionState) -> bool:
    """Return whether a question waits for a yes or no."""
    return any(wait_of(mission) in TAKES_YES for mission in list_waiting(book))


def is_active(book: MissionState, now_s: float) -> bool:
    """Return whether anything moves, is about to move, or waits; in doubt it does."""
    if book.running is not None or book.queue or book.goals_in(GoalState.PLANNING):
        return True
    status = book.status
    if status is None:
        return False  # no bridge was ever heard, so nothing of ours can move
    return not now_s - book.status_s <= OLD_STATUS_S or not at_rest(status)


def goals_answered_by(book: MissionState, said: SaidSentence) -> tuple[str, ...]:
    """Return the goals whose question a sentence may answer; one alone is beyond doubt.

    None unless it is the word that one waits for, or a plain yes or no and one of them takes it. A
    brain's question that offers no order takes neither, and counts where it is no older than the
    newest of these: it may be meant, too.
    """
    if (awaited := tuple(m.id for m in book.missions.values() if awaits(m, said.text))) or (
        said.consent is None
    ):
        return awaited
    intent = said.intent
    if not (intent is None or (isinstance(intent, GoOn) and goal_to_resume(book) is None)):
        return ()  # "go on" is a yes where there is nothing else to go on with
    waiting = list_waiting(book)
    taking = {m.id: m.updated_unix_s for m in waiting if wait_of(m) in TAKES_YES}
    if not taking:  # "Do you mean the kitchen?" of a model: it reads the word itself
        alone = len(waiting) == 1 and intent is None
        choices = (m.id for m in waiting if wait_of(m) is AwaitedWord.CHOICE)
        freely = (m.id for m in waiting if alone and wait_of(m) is AwaitedWord.FREELY)
        return (*choices, *freely)
    newest_unix_s = max(taking.values())
    return tuple(m.id for m in waiting if m.id in taking or m.updated_unix_s >= newest_unix_s)


def goal_to_pause(book: MissionState, asking: str | None = None) -> str | None:
    """Return the goal that a person wants paused."""
    if book.running is not None:
        return book.running
    thinking = book.goals_in(GoalState.PLANNING, besides=asking)
    return thinking[-1].id if thinking else None


def goal_to_resume(book: MissionState, asking: str | None = None) -> str | None:
    """Return the goal that was paused last, else the first that is kept waiting."""
    paused = newest_paused(book, asking)
    return paused or next((i for i in book.queue if book.missions[i].held), None)
