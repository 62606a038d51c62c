"""Keep the questions that steps of any kind ask: hand on the answer, or end what nobody answers.

The robot stands and is free for other goals meanwhile; who waits behind the asking goal waits on.
What an answer means is for the skill that asked to say. A plain yes or no that is said as a goal is
the answer where one question alone can be meant: a wrong guess would move the robot.
"""

from __future__ import annotations

from planner.mission.queue import clear_hold, enqueue, finish, note_step, release_answered
from planner.mission.records import Book, Mission
from planner.mission.skills.consent import consents
from planner.mission.turn import Turn
from planner.mission.verdict import ended, moves
from planner.plan import Bilingual, Code, GoalState, Outcome, StepState, message, same

MAX_ANSWER = 2000
_WAITS = frozenset({GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION})


def asks(mission: Mission) -> bool:
    """Tell whether a goal waits for the answer to a question of one of its own steps."""
    step = mission.now
    return (
        mission.state is GoalState.NEEDS_CLARIFICATION
        and step is not None
        and step.state is StepState.RUNNING
    )


def take_answer(turn: Turn, mission: Mission, text: str) -> None:
    """Write the answer into its step, and go on in it first of all who wait."""
    if consents(text) is True or not drives_next(mission):
        clear_hold(turn, mission)  # the plan was accepted before, and a person lets it go on
    mission = note_step(turn, mission, answer=text[:MAX_ANSWER])
    release_answered(turn)
    enqueue(turn, turn.put(mission, outcome=None), first=True)


def drives_next(mission: Mission) -> bool:
    """Return whether anything moves after the current question and before the next thought."""
    for step in mission.steps[mission.step + 1 :]:
        if step.kind in ("ask", "decide"):
            return False
        if moves(step):
            return True
    return False


def meant(book: Book, text: str) -> tuple[str, ...]:
    """Return the goals whose question a sentence may answer; one alone is beyond doubt.

    None unless it is a plain yes or no and a step asks. A question of any other kind (about the
    order, for a yes to a plan) counts where it is no older than the step's: it may be meant, too.
    """
    asking = [m for m in book.missions.values() if asks(m)]
    if not asking or consents(text) is None:
        return ()
    asked_unix_s = max(m.updated_unix_s for m in asking)
    waiting = (m for m in book.missions.values() if m.state in _WAITS)
    return tuple(m.id for m in waiting if asks(m) or m.updated_unix_s >= asked_unix_s)


def take_sentence(turn: Turn, mission: Mission, asking: tuple[str, ...]) -> None:
    """End a goal whose words answer the one question that is meant; of several, take none."""
    names = [f"“{turn.book.missions[asked].text[:60]}”" for asked in asking]
    en, zh = ", ".join(names), "、".join(names)
    if len(asking) > 1:
        said = Bilingual(
            en=f"More than one goal waits for you: {en}. I take this for none of them.",
            zh=f"有不止一个任务在等待您：{zh}。这句话没有用于其中任何一个。",
        )
        outcome = Outcome(code=Code.AMBIGUOUS, message=said)
        turn.put(mission, state=GoalState.REFUSED, reason=Code.AMBIGUOUS.value, outcome=outcome)
        return
    said = Bilingual(en=f"Taken as the answer for {en}.", zh=f"已作为{zh}的回答。")
    outcome = Outcome(code=Code.ANSWERED, message=said)
    turn.put(mission, state=GoalState.SUCCEEDED, outcome=outcome)
    asked = turn.put(turn.book.missions[asking[0]], given_under_hold=mission.given_under_hold)
    take_answer(turn, asked, mission.text)


def end_unanswered(turn: Turn) -> None:
    """End every goal whose question nobody answered in time; the robot stays where it is."""
    for mission_id, since_s in turn.book.asked_s.items():
        mission, limit_s = turn.mission(mission_id), turn.book.rules.answer_s
        waits = mission is not None and asks(mission)
        if waits and not turn.now_s - since_s > limit_s:
            continue
        left = {i: s for i, s in turn.book.asked_s.items() if i != mission_id}
        turn.set(asked_s=left)
        if mission is not None and waits:
            _unanswered(turn, mission, limit_s)


def _unanswered(turn: Turn, mission: Mission, limit_s: float) -> None:
    asked = mission.outcome.message if mission.outcome is not None else same("")
    said = message(Code.NO_ANSWER, text=asked, seconds=f"{limit_s:.0f}")
    now_unix_s = turn.now_s + turn.book.wall_offset_s
    outcome = ended(turn.book.facts, mission, None, turn.book.status, now_unix_s,
                    code=Code.NO_ANSWER, said=said)  # fmt: skip
    finish(turn, mission, GoalState.FAILED, outcome, Code.NO_ANSWER.value)
