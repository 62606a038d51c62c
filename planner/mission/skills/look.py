"""Look, and answer a question about what is seen.

Precondition: without a vision model, the one kind of thing that is asked for is known to the
detector. Law: a place that is named is driven to and looked round in; else one gaze ahead, or round
where the words ask for it. With a vision model its words are the answer: they may repeat what
stands written in the picture, so they describe and never command. Without one the answer is what
the detector saw, by kind, colour and number; where one is set and does not answer, why is told,
too. Verdict: looked. Budget: one leg and one turn about.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.mission.skills.act import Act, Cannot, Done, Gaze, Inquire, Later, Scene
from planner.mission.skills.around import LOOKS, look_round
from planner.mission.skills.asked import asked_for, unknown_kind
from planner.mission.skills.notes import Notes
from planner.mission.skills.rooms import HERE, Spot, room_at
from planner.mission.skills.search import begin, spots, within
from planner.mission.skills.seen import apart, confirmed, fits, mentioned
from planner.mission.skills.tell import counted, listed, room_name, unknown_name
from planner.mission.skills.unanswered import why_silent
from planner.plan import Bilingual, Code
from planner.vision.labels import named

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
    if not scene.eyes.model:
        name = unknown_kind(question, scene.facts, scene.language, scene.eyes.classes)
        if name is not None:
            said = unknown_name(name, scene.eyes.classes)
            return Cannot(Code.OBJECT_UNKNOWN, "object_unknown", said)
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
    said, silent = _seen(scene, question), why_silent(scene.answer)
    if silent is not None:
        said = Bilingual(en=f"{said.en} {silent.en}", zh=f"{said.zh}{silent.zh}")
    return Done({"rooms": notes.rooms}, Code.SEEN, said, read)


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


def _seen(scene: Scene, question: str) -> Bilingual:
    """Say what was seen during this step; where one thing is asked for, whether it was."""
    inside = within(scene)
    since_s = scene.now_s - scene.spent_s
    things = apart(t for t in confirmed(scene.sight, None, since_s) if inside(t))
    place = room_name(scene.facts, scene.step.place)
    en, zh = (f" in the {place.en}", f"在{place.zh}") if place is not None else ("", "")
    asked = mentioned(asked_for(question, scene.facts), scene.eyes.classes)
    if asked is not None:
        fitting = [t for t in things if fits(t, asked)]
        if not fitting:
            name = named(asked.label, asked.color)
            return Bilingual(en=f"No, I see no {name.en}{en}.", zh=f"没有，{zh}没有看到{name.zh}。")
        what = counted(len(fitting), asked.label, asked.color)
        return Bilingual(en=f"Yes, I see {what.en}{en}.", zh=f"有，{zh}看到 {what.zh}。")
    if not things:
        return Bilingual(en=f"I see nothing that I know{en}.", zh=f"{zh}没有看到我认识的东西。")
    what = listed(things)
    return Bilingual(en=f"I see {what.en}{en}.", zh=f"{zh}看到 {what.zh}。")
