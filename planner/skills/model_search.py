"""Look for a kind that no detector here knows: one picture a direction, shown to a vision model.

Precondition: a vision model, and a detector whose looks say that a picture is new. Law: what the
model answers is figures (there or not, how many a third of the picture, how surely), and none of
them says where to drive: rooms, spots and directions follow from the map and from where the robot
stood when it began, and a yes can but end the tour (docs/adr/0063). The figures are told to people
beside what is known (``read``); the acts of a later thought see that it was found or not, no more.
Budget: as for ``find``, the pictures of one search, and the goal's own calls; what it has cost and
may cost stands in the step's record before the first picture goes out, and after each. Verdict: a
no needs every direction of every spot; a model that did not answer has not said no.
"""

from __future__ import annotations

from dataclasses import replace
from math import hypot
from typing import TYPE_CHECKING, Any, TypeVar

from planner.brain.model_error_codes import REASONS
from planner.language.catalogue import join, list_names, message, say
from planner.plan import JUDGED, Bilingual, Code, PictureBill, say_same
from planner.skills import search
from planner.skills.actions import (
    AskImage,
    DriveLeg,
    Fail,
    Finish,
    Observe,
    Question,
    Scene,
    SkillAction,
)
from planner.skills.conditions import HOLDS, with_answer
from planner.skills.image_errors import reason_of
from planner.skills.longer_search import offer_more, takes_else, tell_else, tell_looked
from planner.skills.look_around import look_round
from planner.skills.result_text import NOWHERE, room_name
from planner.skills.search_bounds import bound_pictures
from planner.skills.skill_state import DirectionSeen, ModelSearchState
from planner.skills.viewpoints import HERE, Viewpoint
from wire import Pose2, wrap

if TYPE_CHECKING:
    from planner.skills.perception import ImageAnswer

Seeking = TypeVar("Seeking", bound=ModelSearchState)
BELIEVED = 0.5
"""What a model is less sure of is told as a perhaps, and neither ends a search nor counts."""
LOOKS = 1
"""A picture that is new and was taken standing."""
MOST_FAILURES = 2
"""Pictures in a row without an answer, after which the search ends."""
HOPELESS = frozenset(
    {"out_of_budget", "pictures_offhost", "no_pictures", "no_vision_model", "resting", "bad_key"}
    | {"unknown_model", "redirect", "refused_address", "unreachable"}
)
"""Failures that the next picture would meet, too."""
NOT_SENT = frozenset({"out_of_budget", "pictures_offhost", "resting", "bad_picture"}) | {
    "picture_too_large", "camera_silent", "no_vision_model",
}  # fmt: skip
MOVED_M, TURNED_RAD = 0.25, 0.25
"""Elsewhere than so the robot shows another picture than the one that is to be asked about."""


def seek(scene: Scene[Seeking], pose: Pose2, *, all_of_it: bool) -> SkillAction | Seeking:
    """Return the next act of a search, or its state once it is over.

    Args:
        scene: of a ``find`` or a ``count``.
        pose: the robot's.
        all_of_it: a yes does not end it: how many there are is asked.
    """
    scene = search.begin(scene, pose, None, first=not all_of_it)
    if scene.answer is not None and scene.state.asking:
        scene = replace(scene.but(_take_in(scene, pose, scene.answer)), answer=None)
    state = scene.state
    if state.silent is not None or (seen_surely(state) and not all_of_it):
        return state
    if state.asking and not _stands_there(state, pose):  # paused, and driven or turned meanwhile
        state = state.but(asking=False, views=state.views[:-1])
        scene = scene.but(state)
    if search.find_spent_budget(scene) is not None or state.shown >= bound_pictures(scene):
        return state
    if state.asking:
        words = scene.step.object or ""
        return AskImage(words, seek=True, bill=bill(scene), state=state, then=state)
    return _look_on(scene, pose)


def _look_on(scene: Scene[Seeking], pose: Pose2) -> SkillAction | Seeking:
    """Return the way or the turn to the next direction, or a gaze in it."""
    next_ = look_round(scene, pose, _spots(scene, pose), None)
    if isinstance(next_, Observe) and isinstance(next_.then, ModelSearchState):
        stood = (round(pose.x_m, 3), round(pose.y_m, 3), round(pose.yaw_rad, 3))
        then = next_.then.but(asking=True, stood=stood)
        return replace(next_, looks=LOOKS, state=scene.state, then=then, bill=bill(scene))
    if isinstance(next_, DriveLeg):
        act = search.keep_in_bounds(scene, pose, next_)
        return replace(act, bill=bill(scene)) if isinstance(act, DriveLeg) else act
    return next_


def _spots(scene: Scene[Seeking], pose: Pose2) -> tuple[Viewpoint, ...]:
    """Return one spot a room: each picture costs, and a model sees farther than a detector."""
    return tuple(s for s in search.spots(scene, pose) if s.key == HERE or s.key.endswith("/0"))


def _stands_there(state: ModelSearchState, pose: Pose2) -> bool:
    if state.stood is None:
        return False
    x_m, y_m, yaw_rad = state.stood
    near = hypot(pose.x_m - x_m, pose.y_m - y_m) <= MOVED_M
    return near and abs(wrap(pose.yaw_rad - yaw_rad)) <= TURNED_RAD


def _take_in(scene: Scene[Seeking], pose: Pose2, answer: ImageAnswer) -> Seeking:
    """Return the state with the answer about the direction that was gazed in."""
    state = scene.state
    sent = answer.failure not in NOT_SENT
    state = state.but(
        asking=False,
        shown=state.shown + sent,
        tokens=state.tokens + (answer.cost.tokens if answer.cost is not None else 0),
        money=state.money + (answer.cost.money if answer.cost is not None else 0.0),
    )
    if answer.counts is None:
        failed, code = state.failed + 1, answer.failure or "unavailable"
        ends = code in HOPELESS or failed >= MOST_FAILURES
        return state.but(
            failed=failed, unanswered=state.unanswered + 1, silent=code if ends else None
        )
    left, middle, right = answer.counts
    seen = DirectionSeen(
        room=scene.facts.room_at(pose.x_m, pose.y_m),
        spot=state.spot or HERE,
        view=state.views[-1] if state.views else 0,
        left=left,
        middle=middle,
        right=right,
        sure=answer.sure,
    )
    return state.but(failed=0, seen=(*state.seen, seen))


def seen_surely(state: ModelSearchState) -> tuple[DirectionSeen, ...]:
    """Return the directions in which the model says that it is there, and believes it."""
    return tuple(seen for seen in state.seen if seen.count and seen.sure >= BELIEVED)


def _perhaps(state: ModelSearchState) -> bool:
    """Tell whether the model was unsure of a direction, yes or no."""
    return any(seen.sure < BELIEVED for seen in state.seen)


def bill(scene: Scene[Any]) -> PictureBill:
    """Return what the search has cost, and may cost at most."""
    state, pictures, most = scene.state, scene.eyes.pictures, bound_pictures(scene)
    money = pictures.currency is not None
    return PictureBill(
        pictures=state.shown,
        pictures_most=most,
        tokens=state.tokens,
        tokens_most=most * pictures.each.tokens,
        money=round(state.money, 6) if money else None,
        money_most=round(most * pictures.each.money, 6) if money else None,
        currency=pictures.currency if money else None,
    )


# What it comes to -------------------------------------------------------------------------------


def tell_found(scene: Scene[Any]) -> Finish | Fail | Question:
    """Return the end of a ``find``: that the model saw it, or why nobody can say so."""
    state = scene.state
    seen = seen_surely(state)
    figures: dict[str, Any] = {"rooms": state.rooms, "bill": bill(scene)}
    if seen:
        ended = Finish(figures, Code.FOUND, _tell_pictures(scene), _read_found(scene, seen[-1]))
        return with_answer(ended, True) if scene.step.role in JUDGED else ended
    looked = join((say("seek.none"), _tell_pictures(scene), *_why_not_all(scene)))
    said = message(Code.NOT_FOUND, thing=say_same(scene.step.object or ""), looked=looked)
    if state.silent is not None and not state.seen:  # nothing was looked at: no room is empty
        code = Code.OUT_OF_BUDGET if state.silent == "out_of_budget" else Code.MODEL_UNAVAILABLE
        said = join((say("seek.not_begun", words=scene.step.object or ""), *_why_not_all(scene)))
        return Fail(code, state.silent, said, {"bill": bill(scene)})
    asked = offer_more(scene, said) if _answered_all(scene) else None
    if asked is not None:
        return asked
    if scene.step.role in JUDGED:
        no = _looked_at_all(scene) or (_answered_all(scene) and takes_else(scene))
        figures[HOLDS] = False if no else None
        said = tell_else(scene, said) if no else said
    return Fail(Code.NOT_FOUND, state.silent or "not_found", said, figures)


def tell_count(scene: Scene[Any]) -> Finish | Fail | Question:
    """Return the end of a ``count``: how many the model saw, room by room.

    None seen in a part of what was to be looked at is no number.
    """
    state = scene.state
    if state.silent is not None and not state.seen:
        return tell_found(scene)
    low, high = count_between(state.seen, scene.eyes.views)
    parts = []
    for room in dict.fromkeys(seen.room for seen in seen_surely(state)):
        here = [seen for seen in state.seen if seen.room == room]
        name = room_name(scene.facts, room) or say("seek.elsewhere")
        parts.append(say("seek.in_room", count=_number(*count_between(here, scene.eyes.views)),
                         room=name))  # fmt: skip
    words, number = scene.step.object or "", _number(low, high)
    read = (
        say("seek.counts_in", words=words, number=number, parts=list_names(parts, "joint.and"))
        if len(parts) > 1
        else say("seek.counts", words=words, number=number)
    )
    known = high > 0 or _looked_at_all(scene)
    if not known:
        read = say("seek.counts_none", words=words)
    if _perhaps(state):
        read = join((read, say("seek.unsure")))
    said = join((_tell_pictures(scene), *_why_not_all(scene)))
    asked = offer_more(scene, join((said, read))) if _answered_all(scene) else None
    figures = {"count": low if known else None, "rooms": state.rooms, "bill": bill(scene)}
    return asked or Finish(figures, Code.COUNTED, said, read)


def count_between(
    seen: list[DirectionSeen] | tuple[DirectionSeen, ...], views: int
) -> tuple[int, int]:
    """Return the fewest and the most things that these pictures can show.

    Neighbouring pictures overlap a little: what one has on its left may be what the next one to the
    left has on its right.
    """
    believed = {(s.spot, s.view): s for s in seen if s.count and s.sure >= BELIEVED}
    most = sum(each.count for each in believed.values())
    twice = 0
    for (spot, view), each in believed.items():
        beside = believed.get((spot, (view + 1) % views))
        if beside is not None and beside is not each:
            twice += min(each.left, beside.right)
    return most - twice, most


def _number(low: int, high: int) -> Bilingual:
    return say_same(str(low)) if low == high else say("seek.between", low=low, high=high)


def _read_found(scene: Scene[Any], seen: DirectionSeen) -> Bilingual:
    """Say what the model says of the picture that it found the thing in: for people alone."""
    sides = [part for part in ("left", "middle", "right") if getattr(seen, part)]
    where = list_names([say(f"seek.{side}") for side in sides], "joint.and")
    figures: dict[str, Any] = {
        "words": scene.step.object or "",
        "where": where,
        "count": seen.count,
        "sure": round(100 * seen.sure),
    }
    room = room_name(scene.facts, seen.room)
    return say("seek.found_in", room=room, **figures) if room else say("seek.found", **figures)


def _tell_pictures(scene: Scene[Any]) -> Bilingual:
    """Say how many pictures the model was shown, and from which rooms; the bill has the cost."""
    state, count = scene.state, scene.state.shown
    names = [
        n for r in dict.fromkeys(s.room for s in state.seen) if (n := room_name(scene.facts, r))
    ]
    shown = "seek.shown_one" if count == 1 else "seek.shown"
    told = [
        say(f"{shown}_of", rooms=list_names(names, "joint.and"), count=count)
        if names
        else say(shown, count=count)
    ]
    return join(told)


def _answered_all(scene: Scene[Any]) -> bool:
    """Tell whether the model said of each picture whether it is there, and was sure."""
    state = scene.state
    return state.silent is None and not state.unanswered and not _perhaps(state)


def _looked_at_all(scene: Scene[Any]) -> bool:
    return _answered_all(scene) and not search.ran_out(scene)


def _why_not_all(scene: Scene[Any]) -> list[Bilingual]:
    """Say why not every direction was looked in, and what is doubtful."""
    state, told = scene.state, []
    if state.silent is not None:
        told.append(reason_of(state.silent) or REASONS["unavailable"])
    elif state.shown >= bound_pictures(scene):
        told.append(say("seek.bound", most=bound_pictures(scene)))
    elif state.unanswered:
        told.append(say("seek.missed", count=state.unanswered))
    if state.seen and (search.list_unseen(scene) or search.ran_out(scene)):
        where = tell_looked(scene, rooms=False)
        told += [where] if where != NOWHERE else []
    if _perhaps(state) and not seen_surely(state):
        told.append(say("seek.unsure"))
    return told
