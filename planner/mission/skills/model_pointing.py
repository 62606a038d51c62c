"""Have a vision model point at what the detector does not know, and a person say yes to the point.

Law: a sign in the picture can move the point (docs/adr/0023), so where a model pointed is driven to
only upon the plain yes of a person who was told where it is, in words made of figures and the map's
own names. A plain no ends the step; what is neither is asked once more, and then counts as no. The
point is on the map: while nobody answers, it stays where it is, wherever the robot goes meanwhile.
"""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

from planner.language.yes_no import consents
from planner.mission.skills.actions import AskImage, Fail, Observe, Question, Scene, SkillAction
from planner.mission.skills.image_errors import not_pointed
from planner.mission.skills.look_around import LOOKS
from planner.mission.skills.object_matching import away_m, turn_to
from planner.mission.skills.result_text import room_name
from planner.mission.skills.viewpoints import room_at
from planner.plan import Bilingual, Code

if TYPE_CHECKING:
    from wire import Pose2

At = tuple[float, float, float]
"""x, y, height [m] in ``map``."""
POINT, ANSWER, PROPOSED, AGAIN = 2, 3, 4, 5
_SIDES = (
    (pi / 8, ("straight ahead", "正前方"), ("straight ahead", "正前方")),
    (3 * pi / 8, ("ahead on the left", "左前方"), ("ahead on the right", "右前方")),
    (5 * pi / 8, ("on the left", "左侧"), ("on the right", "右侧")),
    (7 * pi / 8, ("behind on the left", "左后方"), ("behind on the right", "右后方")),
)
"""Up to this angle from the heading [rad]: what is said to the left, and to the right."""
_BEHIND = ("behind me", "正后方")
_DECLINED = Bilingual(
    en="You did not say yes, so I do not drive there.", zh="您没有同意，所以我不开过去。"
)


def agreed(scene: Scene, pose: Pose2) -> SkillAction | At:
    """Return the point once a person has said yes to it; until then, what is to be done for it."""
    notes, words, answer = scene.notes, scene.step.object or "", scene.answer
    if notes.pointed is not None:
        return _answered(scene, pose, notes.pointed)
    if notes.stage == 0:
        return Observe(LOOKS, then=notes.but(stage=POINT))
    if notes.stage == POINT:
        return AskImage(words, point=True, then=notes.but(stage=ANSWER))
    if answer is None:  # interrupted before the answer was used
        return AskImage(words, point=True, then=notes)
    if answer.at is None:
        return not_pointed(words, answer)
    proposed = notes.but(pointed=answer.at, stage=PROPOSED)
    return Question(_proposal(scene, pose, answer.at), proposed)


def _answered(scene: Scene, pose: Pose2, at: At) -> SkillAction | At:
    """Return the point where a person agreed to it; else ask, or end the step."""
    notes, answer = scene.notes, scene.step.answer
    if answer is None:  # interrupted before anybody answered
        again = notes.stage == AGAIN
        return Question(_proposal(scene, pose, at, again=again), notes)
    yes = consents(answer)
    if yes is True:
        return at
    if yes is None and notes.stage == PROPOSED:
        return Question(_proposal(scene, pose, at, again=True), notes.but(stage=AGAIN))
    return Fail(Code.POINT_REFUSED, "point_declined", _DECLINED)


def _proposal(scene: Scene, pose: Pose2, at: At, *, again: bool = False) -> Bilingual:
    """Ask whether to drive to a point: how far it is, on which side, and in which room."""
    words, far_m, side = scene.step.object or "", away_m(pose, at[:2]), _side(turn_to(pose, at[:2]))
    room = room_name(scene.facts, room_at(scene.facts, at[:2]))
    en = f"“{words}”: the vision model points {far_m:.1f} m away, {side.en}"
    zh = f"“{words}”：视觉模型指向{side.zh} {far_m:.1f} 米处"
    if room is not None:
        en, zh = f"{en} (in the {room.en})", f"{zh}（{room.zh}）"
    en, zh = f"{en}. Shall I drive there?", f"{zh}。要我开过去吗？"
    if again:
        en, zh = f"Please answer yes or no. {en}", f"请回答“是”或“不”。{zh}"
    return Bilingual(en=en, zh=zh)


def _side(turn_rad: float) -> Bilingual:
    """Say where something is as seen from the robot, by the turn that faces it."""
    found = next((row for row in _SIDES if abs(turn_rad) <= row[0]), None)
    en, zh = (found[1] if turn_rad > 0.0 else found[2]) if found is not None else _BEHIND
    return Bilingual(en=en, zh=zh)
