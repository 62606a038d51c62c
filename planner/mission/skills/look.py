"""Look, and answer a question about what is seen.

Precondition: without a vision model, the one kind of thing that is asked for is known to the
detector. Law: a place that is named is driven to and looked round in; else one gaze ahead, or round
where the words ask for it. With a vision model its words are the answer: they may repeat what
stands written in the picture, so they describe and never command. Without one the answer is what
the detector saw, by kind, colour, number and neighbour (answering.py); where one is set and does
not answer, why is told, too. Verdict: looked. Budget: one leg and one turn about.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.mission.skills.act import Act, Cannot, Done, Gaze, Inquire, Later, Scene
from planner.mission.skills.answering import answer
from planner.mission.skills.around import LOOKS, look_round
from planner.mission.skills.asked import unknown_kind
from planner.mission.skills.notes import Notes
from planner.mission.skills.rooms import HERE, Spot, room_at
from planner.mission.skills.search import begin, spots
from planner.mission.skills.tell import unknown_name
from planner.mission.skills.unanswered import why_silent
from planner.plan import Bilingual, Code

if TYPE_CHECKING:
    from wire import Pose2

_ROUND = re.compile(
    r"\b(?:look|turn)(?:s|ing)? (?:all )?a?round\b|\b(?:all around|everywhere|surroundings)\b"
    r"|\baround(?: (?:you|me|us|here|there|the (?:room|house|home|place|flat)))?[ ?.!]*$"
    r"|环顾|环境|四处|到处|(?:^|[你您我看察在有 ，])的?(?:四周|周围)"
)
"""To look about; "a round table" and "around the table" are things to look at."""
GAZED, ASKED = 1, 2


def looks_round(question: str) -> bool:
    """Tell whether a question asks to look about, and not ahead alone."""
    return _ROUND.search(question.casefold()) is not None


def look(scene: Scene) -> Act:
    """Return the next look, or the answer."""
    pose, question = scene.pose, scene.step.text or ""
    unknown = _unknown(scene, question) if scene.notes.here is None else None
    if unknown is not None:
        return unknown
    if pose is None:
        return Later()
    scene = begin(scene, pose, None)
    notes = scene.notes
    if notes.stage < GAZED and not _model_alone(scene):
        next_ = _next(scene, pose, question)
        if not isinstance(next_, Notes):
            return next_
        notes = next_.but(stage=GAZED)
    if scene.eyes.model and notes.stage < ASKED:
        return Inquire(question, then=notes.but(stage=ASKED))
    read = scene.answer.text if scene.answer is not None else None
    said, silent = answer(scene, question), why_silent(scene.answer)
    if silent is not None:
        said = Bilingual(en=f"{said.en} {silent.en}", zh=f"{said.zh}{silent.zh}")
    return Done({"rooms": notes.rooms}, Code.SEEN, said, read)


def _unknown(scene: Scene, question: str) -> Cannot | None:
    """Refuse, where no vision model is set, a question about a kind that these eyes don't know."""
    eyes = scene.eyes
    if eyes.model:
        return None
    name = unknown_kind(question, scene.facts, scene.language, eyes.classes)
    if name is None:
        return None
    return Cannot(Code.OBJECT_UNKNOWN, "object_unknown", unknown_name(name, eyes.classes))


def _model_alone(scene: Scene) -> bool:
    """Tell whether nothing but the model can say what is ahead: no gaze would ever end."""
    alone = scene.eyes.model and scene.sight.blind == "no_detector"
    return alone and scene.step.place is None


def _next(scene: Scene, pose: Pose2, question: str) -> Act | Notes:
    """Return the next leg or gaze, or the notes when enough was looked at."""
    if scene.step.place is not None:
        return look_round(scene, pose, spots(scene, pose)[:1], None)
    if not looks_round(question):
        return Gaze(LOOKS + 1, then=scene.notes.but(stage=GAZED))
    at = scene.notes.here or (pose.x_m, pose.y_m)
    return look_round(scene, pose, (Spot(HERE, room_at(scene.facts, at), at),), None)
