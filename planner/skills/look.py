"""Look, and answer a question about what is seen.

Precondition: without a vision model, the one kind of thing that is asked for is known to the
detector. Law: a place that is named is driven to and looked round in; else one gaze ahead, or round
where the words ask for it. The answer is what the detector saw, by kind, colour, number and
neighbour (scene_answers.py). What a vision model read in the pictures of all these directions makes
one answer with it (``reading``): its words may repeat what stands written there, so they describe
and never command. Where a model is set and does not answer, why is told. Verdict: looked; a place
to which there was no way was not. Where branches hang on it, its answer is a yes, a no, or that it
can't be told (conditions.py). Budget: one leg and one turn about.
"""

from __future__ import annotations

import re
from dataclasses import replace
from math import pi
from typing import TYPE_CHECKING

from planner.language.catalogue import CATALOGUE, build, join, list_names, message, raw, say
from planner.language.folding import has_chinese, is_chinese
from planner.language.formatting import definite
from planner.language.questions import looks_round
from planner.plan import JUDGED, Bilingual, Code, Language, say_same
from planner.skills.actions import (
    AskImage,
    Fail,
    Finish,
    Observe,
    Retry,
    Scene,
    SkillAction,
)
from planner.skills.conditions import agree, with_answer
from planner.skills.image_errors import why_silent
from planner.skills.look_around import LOOKS, look_round
from planner.skills.scene_answers import SceneAnswer, answer, tell_unknown
from planner.skills.search import begin, spots
from planner.skills.skill_state import LookStage, LookState
from planner.skills.viewpoints import HERE, Viewpoint
from wire import Pose2, wrap

if TYPE_CHECKING:
    from planner.skills.perception import ImageAnswer


NO_DETECTOR = say("look.no_detector")
"""Who has none has not seen that nothing is there."""


def look(scene: Scene[LookState]) -> SkillAction:
    """Return the next look, or the answer."""
    pose, question = scene.pose, scene.step.text or ""
    unknown = tell_unknown(scene, question) if scene.state.here is None else None
    if unknown is not None:
        return Fail(Code.OBJECT_UNKNOWN, "object_unknown", unknown)
    if pose is None:
        return Retry()
    scene = begin(scene, pose, None)
    state = scene.state
    if state.stage is LookStage.GAZING and not _model_alone(scene):
        next_ = _next(scene, pose, question)
        if not isinstance(next_, LookState):
            return next_
        if scene.step.place is not None and not next_.faced:
            return _never_there(scene)
        state = next_.but(stage=LookStage.GAZED)
    if scene.eyes.model and state.stage is not LookStage.ASKED:
        views = tuple(map(direction, state.faced))
        now = _facing(state, pose)
        return AskImage(question, views=views, now=now, then=state.but(stage=LookStage.ASKED))
    return _finish(scene.but(state), pose, question)


def _finish(scene: Scene[LookState], pose: Pose2, question: str) -> Finish:
    """Tell the sights, and a model's reading or why there is none."""
    state, views = scene.state, scene.eyes.views
    partly = len(state.faced) > 1 and not goes_round(state.faced, views)
    told = SceneAnswer(NO_DETECTOR) if _model_alone(scene) else answer(scene, question)
    silent, read = why_silent(scene.answer), None
    names = list_directions(tuple(map(direction, state.faced)))
    gap = (say("look.only_looked", names=names),) if partly else ()
    said = join((told.said, *gap, *((silent,) if silent is not None else ())))
    if scene.answer is not None and scene.answer.text is not None:
        alone = _alone(scene.answer, state, pose)
        only = gap if alone is None else (say("look.only_looked", names=alone),)
        read = join((reading(scene.answer.text, scene.answer.seen, told), *only))
    ended = Finish({"rooms": state.rooms}, Code.SEEN, said, read)
    if scene.step.role not in JUDGED:
        return ended
    holds = agree(told.yes, scene.answer.seen if scene.answer is not None else None)
    return with_answer(ended, None if partly and holds is False else holds)


def _facing(state: LookState, pose: Pose2) -> Bilingual:
    """Name the direction that the robot faces, from how it stood when it looked first."""
    return direction(wrap(pose.yaw_rad - state.ahead) if state.ahead is not None else 0.0)


def _never_there(scene: Scene[LookState]) -> Fail:
    """Tell that nothing was looked at: an unseen thing there is no proof of absence."""
    target = scene.facts.targets.get(scene.step.place or "")
    name = target.name if target is not None else say_same("?")
    return Fail(Code.NO_ROUTE, "no_route", message(Code.NO_ROUTE, place=definite(name)))


def _model_alone(scene: Scene[LookState]) -> bool:
    """Return whether only the model can name the things ahead: no gaze would ever end."""
    alone = scene.eyes.model and scene.sight.blind == "no_detector"
    return alone and scene.step.place is None


def _next(scene: Scene[LookState], pose: Pose2, question: str) -> SkillAction | LookState:
    """Return the next leg or gaze, or the state when enough was looked at.

    Each gaze notes its direction as the robot stands then, wherever it was to turn.
    """
    if not scene.state.faced and scene.state.turned is None:
        scene = scene.but(scene.state.but(ahead=pose.yaw_rad))
    next_ = _look_next(scene, pose, question)
    if not isinstance(next_, Observe) or not isinstance(then := next_.then, LookState):
        return next_
    ahead = then.ahead if then.ahead is not None else pose.yaw_rad
    faced = (*then.faced, round(wrap(pose.yaw_rad - ahead), 3))
    return replace(next_, then=then.but(faced=faced))


def _look_next(scene: Scene[LookState], pose: Pose2, question: str) -> SkillAction | LookState:
    if scene.step.place is not None:
        return look_round(scene, pose, spots(scene, pose)[:1], None)
    if not looks_round(question):
        return Observe(LOOKS + 1, then=scene.state.but(stage=LookStage.GAZED))
    at = scene.state.here or (pose.x_m, pose.y_m)
    return look_round(scene, pose, (Viewpoint(HERE, scene.facts.room_at(*at), at),), None)


_ENDS = ".!?…。！？"


def reading(text: Bilingual, seen: bool | None, told: SceneAnswer) -> Bilingual:
    """Return the whole answer of two eyes, in one or two sentences.

    Where they agree it is one sentence; where they differ, the surer one comes first, and a yes of
    the detector is never taken back. What the detector can't judge the model's words alone answer.

    Args:
        text: what a vision model wrote about the pictures.
        seen: whether it says that what was asked for is there.
        told: what the detector saw.
    """
    return build(lambda language: _merge(text.of(language), seen, told, language))


def _merge(text: str, seen: bool | None, told: SceneAnswer, language: str) -> str:
    """Return the answer in one language; a model's words in another one are left out."""
    said, words, judges = (
        told.said.of(language),
        _end_sentence(text, language),
        told.yes is not None,
    )
    if not _is_spoken(text, language):
        if judges or told.lists or seen is None:
            return said
        return raw("image.yes" if seen else "image.no", language)
    if not judges:
        words = words[:1].upper() + words[1:]
    if told.lists:
        return raw("joint.sentence", language).join((said, words))
    if not judges:
        return words
    words = _drop_answer(words, language)
    more = raw("image.more" if words else "joint.full_stop", language).format(words=words)
    if seen is None or seen is told.yes:
        return raw("image.agrees", language).format(said=said.rstrip(_ENDS), more=more)
    return raw("image.less_sure" if told.yes else "image.not_sure", language).format(
        said=said, more=more
    )


def _drop_answer(words: str, language: str) -> str:
    """Return words without the yes or no before them, which the answer has said already."""
    lead, *rest = re.split(r"[,，.。:：;；]\s*", words, maxsplit=1)
    answers = CATALOGUE.synonyms("image.answers", language)
    return "".join(rest) if lead.casefold() in answers else words


def _is_spoken(text: str, language: str) -> bool:
    """Return whether a model's words are of this language, by their script."""
    if language == Language.ZH:
        return has_chinese(text) or not any(map(str.isalpha, text))
    return not is_chinese(text)


def _end_sentence(text: str, language: str) -> str:
    return text if text.endswith((*_ENDS, "”")) else text + raw("joint.full_stop", language)


def _alone(answer: ImageAnswer, state: LookState, pose: Pose2) -> Bilingual | None:
    """Name the one direction that a model was shown; None where it was shown all of this look."""
    faced = state.faced
    if len(faced) < 2 or answer.shown == len(faced):
        return None
    return _facing(state, pose)


AHEAD = say("direction.ahead")
_NAMES = (
    AHEAD,
    say("direction.ahead_on_left"),
    say("direction.left"),
    say("direction.behind_on_left"),
    say("direction.behind"),
    say("direction.behind_on_right"),
    say("direction.right"),
    say("direction.ahead_on_right"),
)
"""Counter-clockwise, an eighth of a turn each."""
SLACK_RAD = 0.3
"""Two neighbours may be so much farther apart: the bridge reaches a heading within 0.1."""


def direction(left_rad: float) -> Bilingual:
    """Name a direction by its angle to the left of ahead."""
    return _NAMES[round(wrap(left_rad) * len(_NAMES) / (2.0 * pi)) % len(_NAMES)]


def goes_round(faced: tuple[float, ...], views: int) -> bool:
    """Tell whether these directions leave no gap in a whole turn of so many views."""
    if not faced:
        return False
    at = sorted(angle % (2.0 * pi) for angle in faced)
    gaps = [after - before for before, after in zip(at, (*at[1:], at[0] + 2.0 * pi), strict=True)]
    return max(gaps) <= 2.0 * pi / views + SLACK_RAD


def list_directions(names: tuple[Bilingual, ...]) -> Bilingual:
    """Return names as a list, each once: ``ahead, left and behind``."""
    once = tuple(dict.fromkeys(names))
    return list_names(once, "joint.and")
