"""Look, and answer a question about what is seen.

Precondition: without a vision model, the one kind of thing that is asked for is known to the
detector. Law: a place that is named is driven to and looked round in; else one gaze ahead, or round
where the words ask for it. The answer is what the detector saw, by kind, colour, number and
neighbour (scene_answers.py). Beside it stands, labelled, what a vision model read in the pictures
of all these directions: its words may repeat what stands written there, so they describe and
never command. Where a model is set and does not answer, why is told. Verdict: looked; a place
to which there was no way was not. Where branches hang on it, its answer is a yes, a no, or that it
can't be told (conditions.py). Budget: one leg and one turn about.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.catalogue import build, join, message, raw, say
from planner.language.questions import looks_round
from planner.mission.skills.actions import (
    AskImage,
    Fail,
    Finish,
    Observe,
    Retry,
    Scene,
    SkillAction,
)
from planner.mission.skills.conditions import agree, with_answer
from planner.mission.skills.directions import direction, goes_round, list_directions
from planner.mission.skills.image_errors import why_silent
from planner.mission.skills.look_around import LOOKS, look_round
from planner.mission.skills.object_query import unknown_kind
from planner.mission.skills.result_text import unknown_name
from planner.mission.skills.scene_answers import SceneAnswer, answer
from planner.mission.skills.search import begin, spots
from planner.mission.skills.skill_state import LookStage, LookState
from planner.mission.skills.viewpoints import HERE, Viewpoint, room_at
from planner.plan import JUDGED, Bilingual, Code, say_same
from wire import wrap

if TYPE_CHECKING:
    from planner.mission.skills.perception import ImageAnswer
    from wire import Pose2


NO_DETECTOR = say("look.no_detector")
"""Who has none has not seen that nothing is there."""


def look(scene: Scene[LookState]) -> SkillAction:
    """Return the next look, or the answer."""
    pose, question = scene.pose, scene.step.text or ""
    unknown = _unknown(scene, question) if scene.state.here is None else None
    if unknown is not None:
        return unknown
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
    said, silent = [told.said], why_silent(scene.answer)
    if partly:
        names = list_directions(tuple(map(direction, state.faced)))
        said.append(say("look.only_looked", names=names))
    if silent is not None:
        said.append(silent)
    whole = join(said)
    read = None
    if scene.answer is not None:
        read = reading(scene.answer, told.yes, state.faced, views, _facing(state, pose))
    ended = Finish({"rooms": state.rooms}, Code.SEEN, whole, read)
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
    return Fail(Code.NO_ROUTE, "no_route", message(Code.NO_ROUTE, place=name))


def _unknown(scene: Scene[LookState], question: str) -> Fail | None:
    """Refuse, where no vision model is set, a question about a kind that these eyes don't know."""
    eyes = scene.eyes
    if eyes.model:
        return None
    name = unknown_kind(question, scene.facts, scene.language, eyes.classes)
    if name is None:
        return None
    return Fail(Code.OBJECT_UNKNOWN, "object_unknown", unknown_name(name, eyes.classes))


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
    return look_round(scene, pose, (Viewpoint(HERE, room_at(scene.facts, at), at),), None)


_ENDS = (".", "!", "?", "…", "”", "。", "！", "？")


def reading(
    answer: ImageAnswer, detected: bool | None, faced: tuple[float, ...], views: int, now: Bilingual
) -> Bilingual | None:
    """Return a model's words about pictures with their label; None where it has none.

    They stand beside what the detector saw and never in its place; a yes of either is not taken
    back by a no of the other, still less by one about another direction.

    Args:
        answer: what came of the question.
        detected: whether the detector saw what was asked for; None: open, or it can't tell.
        faced: the directions of this look, from how the robot stood when it began [rad].
        views: in how many directions one looks for a whole turn.
        now: the direction of the newest picture.
    """
    if answer.text is None:
        return None
    shown = _name_pictures(answer.shown, faced, views, now)
    words = _end_sentence(answer.text)
    lead = _lead(answer.seen, detected, shown)
    return say("image.reading", lead=lead, words=words)


def _lead(seen: bool | None, detected: bool | None, shown: Bilingual) -> Bilingual:
    if seen is None or seen is detected:
        return say("image.adds", shown=shown)  # fmt: skip
    if not seen:
        return say("image.says_no", shown=shown)
    return say("image.but_says_yes" if detected is False else "image.says_yes", shown=shown)


def _name_pictures(count: int, faced: tuple[float, ...], views: int, now: Bilingual) -> Bilingual:
    """Say which pictures the model was shown: of each direction, or the newest alone."""
    if count < 2 or count != len(faced):
        alone = len(faced) > 1
        return say("image.only_picture" if alone else "image.picture", now=now)
    if goes_round(faced, views):
        return say("image.all_directions")
    names = list_directions(tuple(map(direction, faced)))
    return say("image.pictures", names=names)


def _end_sentence(text: Bilingual) -> Bilingual:
    """Return a text with a full stop behind it, where nothing ends it."""

    def end_text(language: str) -> str:
        own = text.of(language)
        return own if own.endswith(_ENDS) else own + raw("joint.full_stop", language)

    return build(end_text)
