"""Stand until somebody or something is seen, a word is said, or a time has come.

Law: nothing moves; what was seen before the wait began does not end it. Of a person or a thing:
pictures some time apart must show it; seen in vain for the time set, the step fails as ``unmet``.
Of a word: a person is asked for it and the robot is free meanwhile; another word is told and asked
for again, within the time set for answers. Of a time: it is the next HH:MM, no more than twelve
hours ahead; one that comes while the goal is paused has come. Budget: the seconds asked for, 600 at
most; of a time the twelve hours.
"""

from __future__ import annotations

from planner.language.catalogue import message, say
from planner.language.folding import fold_words
from planner.language.object_names import tell_words
from planner.language.sentence import parse
from planner.plan import Code
from planner.skills.actions import (
    Fail,
    Finish,
    Observe,
    Question,
    Scene,
    SkillAction,
    Stand,
)
from planner.skills.conditions import seconds_until
from planner.skills.find import unknown
from planner.skills.object_matching import fits, fresh, lasting, wanted_of
from planner.skills.result_text import name_one
from planner.skills.skill_state import WaitForState

SEEN_S = 1.5
"""What was seen longer ago is not in sight."""
GAZE_S = 12.0
"""Without any picture for so long the robot is blind."""


def wait_for(scene: Scene[WaitForState]) -> SkillAction:
    """Return the next wait, or how it ended."""
    step = scene.step
    if step.time is not None:
        return _for_time(scene, step.time)
    if step.word is not None:
        return _for_word(scene, step.word)
    return _for_sight(scene)


def _for_time(scene: Scene[WaitForState], time: str) -> SkillAction:
    due_s = scene.state.until_unix_s
    if due_s is None:
        ahead_s = seconds_until(time, scene.unix_s + scene.local_offset_s)
        if ahead_s is None:
            return Fail(Code.TIME_PAST, Code.TIME_PAST.value, message(Code.TIME_PAST, time=time))
        due_s = scene.unix_s + ahead_s
    left_s = due_s - scene.unix_s
    if left_s <= 0.0:
        return Finish({}, Code.DONE, say("wait_for.time", time=time))
    return Stand(left_s, scene.state.but(until_unix_s=due_s))


def _for_word(scene: Scene[WaitForState], word: str) -> SkillAction:
    answer = scene.step.answer
    if answer is None:
        return Question(say("wait_for.ask", word=word))
    if is_said(word, answer) or parse(answer).consent is True:
        return Finish()
    again = scene.state.but(asked=scene.state.asked + 1)
    return Question(say("wait_for.ask", word=word), again)


def is_said(word: str, answer: str) -> bool:
    """Tell whether an answer holds the word that is waited for."""
    said, wanted = fold_words(answer), fold_words(word)
    if not wanted.isascii():
        return wanted.replace(" ", "") in said.replace(" ", "")
    return f" {wanted} " in f" {said.translate(_MARKS)} "


_MARKS = str.maketrans(dict.fromkeys(".,!?;:\"'“”‘’", " "))


def _for_sight(scene: Scene[WaitForState]) -> SkillAction:
    wanted = wanted_of(scene)
    if wanted is None:
        return unknown(scene)
    since_s = max(scene.now_s - SEEN_S, scene.now_s - scene.spent_s)
    seen = [t for t in fresh(scene.sight, wanted, since_s) if fits(t, wanted) and lasting(t)]
    if seen and scene.sight.blind is None:
        thing = seen[0]
        what = name_one(thing.label, thing.color)
        return Finish({}, Code.SEEN, say("wait_for.seen", what=what))
    limit_s = scene.step.seconds or 0.0
    if not scene.spent_s <= limit_s:
        what = tell_words(scene.step.object or "")
        said = say("wait_for.unseen", what=what, seconds=f"{limit_s:.0f}")
        return Fail(Code.UNMET, Code.UNMET.value, said)
    return Observe(1, GAZE_S, state=scene.state, then=scene.state)
