"""Have a vision model point at a thing unknown to the detector, and a person agree to the point.

Law: a sign in the picture can move the point (docs/adr/0023), so where a model pointed is driven to
only upon the plain yes of a person who was told where it is, in words made of figures and the map's
own names. A plain no ends the step; what is neither is asked once more, and then counts as no. The
point is on the map: while nobody answers, it stays where it is, wherever the robot goes meanwhile.
"""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

from planner.language.catalogue import join, say
from planner.language.sentence import parse
from planner.plan import Bilingual, Code
from planner.skills.actions import (
    AskImage,
    Fail,
    Observe,
    Question,
    Scene,
    SkillAction,
)
from planner.skills.image_errors import not_pointed
from planner.skills.look_around import LOOKS
from planner.skills.object_matching import away_m, turn_to
from planner.skills.result_text import room_name
from planner.skills.skill_state import GoToObjectState, Point3, PointingStage

if TYPE_CHECKING:
    from wire import Pose2

_SIDES = (
    (pi / 8, "ahead", "ahead"),
    (3 * pi / 8, "ahead_left", "ahead_right"),
    (5 * pi / 8, "left", "right"),
    (7 * pi / 8, "behind_left", "behind_right"),
)
"""Up to this angle from the heading [rad]: what is said to the left, and to the right."""
_BEHIND = "behind"
_DECLINED = say("look.declined")


def agree_on_point(scene: Scene[GoToObjectState], pose: Pose2) -> SkillAction | Point3:
    """Return the point once a person has said yes to it; until then, the next act towards it."""
    state, words, answer = scene.state, scene.step.object or "", scene.answer
    if state.pointed is not None:
        return _take_answer(scene, pose, state.pointed)
    if state.pointing is PointingStage.LOOK:
        return Observe(LOOKS, then=state.but(pointing=PointingStage.POINT))
    if state.pointing is PointingStage.POINT:
        return AskImage(words, point=True, then=state.but(pointing=PointingStage.ANSWER))
    if answer is None:  # interrupted before the answer was used
        return AskImage(words, point=True, then=state)
    if answer.at is None:
        return not_pointed(words, answer)
    proposed = state.but(pointed=answer.at, pointing=PointingStage.PROPOSED)
    return Question(_proposal(scene, pose, answer.at), proposed)


def _take_answer(scene: Scene[GoToObjectState], pose: Pose2, at: Point3) -> SkillAction | Point3:
    """Return the point where a person agreed to it; else ask, or end the step."""
    state, answer = scene.state, scene.step.answer
    if answer is None:  # interrupted before anybody answered
        again = state.pointing is PointingStage.AGAIN
        return Question(_proposal(scene, pose, at, again=again), state)
    yes = parse(answer).consent
    if yes is True:
        return at
    if yes is None and state.pointing is PointingStage.PROPOSED:
        return Question(
            _proposal(scene, pose, at, again=True), state.but(pointing=PointingStage.AGAIN)
        )
    return Fail(Code.POINT_REFUSED, "point_declined", _DECLINED)


def _proposal(
    scene: Scene[GoToObjectState], pose: Pose2, at: Point3, *, again: bool = False
) -> Bilingual:
    """Ask whether to drive to a point: how far it is, on which side, and in which room."""
    words, far_m, side = scene.step.object or "", away_m(pose, at[:2]), _side(turn_to(pose, at[:2]))
    room = room_name(scene.facts, scene.facts.room_at(*at[:2]))
    asked = (
        say("look.point_in", words=words, far_m=far_m, side=side, room=room)
        if room is not None
        else say("look.point", words=words, far_m=far_m, side=side)
    )
    return join((say("question.yes_or_no"), asked), "joint.none") if again else asked


def _side(turn_rad: float) -> Bilingual:
    """Say where something is as seen from the robot, by the turn that faces it."""
    found = next((row for row in _SIDES if abs(turn_rad) <= row[0]), None)
    side = (found[1] if turn_rad > 0.0 else found[2]) if found is not None else _BEHIND
    return say(f"side.{side}")
