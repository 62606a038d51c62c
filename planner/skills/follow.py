"""Follow a person at a distance.

Precondition: somebody is in sight, or was found by the step before. Law: the robot sets off after
nobody whom it saw for less than half a second; the way is laid anew as the person walks, twice a
second at most, each time to a point short of them; the bridge's limits and gates hold as on any
leg. Out of sight, the robot goes to as far short of where it saw them last and looks round; while
its eyes see nothing at all it stands. Verdict: lost when nobody was seen for ``LOST_S``, told and
standing; failed when no way leads to them, try after try; done when the time is over: the one
that was said, else 300 s. Budget: 300 s, and the bridge's grant.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.catalogue import message, say
from planner.language.formatting import definite
from planner.language.object_names import name_object
from planner.plan import MAX_FOLLOW_S, Code
from planner.skills.actions import (
    DriveLeg,
    Fail,
    Finish,
    Observe,
    Retry,
    Scene,
    SkillAction,
)
from planner.skills.find import unknown
from planner.skills.look_around import leg_to, look_round, spin
from planner.skills.object_matching import apart_m, away_m, bearing, lasting, one_of, turn_to
from planner.skills.search import short_of
from planner.skills.skill_state import FollowPersonState, FollowStage
from planner.skills.viewpoints import HERE, Viewpoint

if TYPE_CHECKING:
    from planner.perception.snapshot import Thing
    from planner.skills.perception import WantedObject
    from wire import Pose2

KEEP_M = 1.2
SLACK_M = 0.3
"""Nearer to where it should be than this the robot stands."""
NEW_S = 1.5
"""What was seen longer ago is not in sight."""
SAME_M = 2.0
"""Nobody walks farther between two looks; who is seen beyond is somebody else."""
FACE_RAD = 0.35
LOST_S = 25.0
GAZE_LOOKS, GAZE_S = 10, 8.0
FIRST_LOOKS = 3
SHUT_LOOKS = 15
"""Pictures to watch, standing, where the way is shut, before the next try: 3 s of them."""
MOST_SHUT = 5
"""Ways to somebody in sight that may be shut, one after the other, on one spot."""
MOVED_M = 0.5
"""Beyond, the robot stands elsewhere, and ways are counted anew."""


def follow(scene: Scene[FollowPersonState]) -> SkillAction:
    """Return the next leg after the person, or a gaze, or how it ended."""
    wanted = one_of(scene)
    if wanted is None:
        return unknown(scene)
    if scene.pose is None:
        return Retry()
    if not scene.spent_s <= (scene.step.seconds or MAX_FOLLOW_S):
        return _finish(scene)
    if scene.sight.blind is not None:  # where the person is now nobody knows: nothing moves
        return Observe(1, state=scene.state, then=scene.state, watch=True)
    person = _in_sight(scene, wanted)
    if person is None:
        return _search_lost(scene, scene.pose, wanted)
    at = (round(person.x_m, 2), round(person.y_m, 2), 0.9)
    stage = FollowStage.SHUT if scene.state.stage is FollowStage.SHUT else FollowStage.AFTER
    state = scene.state.but(at=at, seen_s=round(scene.spent_s, 1), stage=stage, views=(), spot=None,
                            spots=(), turned=None, label=person.label)  # fmt: skip
    if state.shut_at is not None and away_m(scene.pose, state.shut_at) > MOVED_M:
        state = state.but(shut_at=None, shut_ways=0)
    return _keep_up(scene.pose, at, state)


def _in_sight(scene: Scene[FollowPersonState], wanted: WantedObject) -> Thing | None:
    """Return the one who is followed, where they are in sight: nearest to where they were.

    Who is begun with was seen for a while; on the way one picture shows where they are now.
    """
    seen, pose, at = _find_in_sight(scene, wanted), scene.pose, scene.state.at
    if at is not None:
        seen = [t for t in seen if apart_m(t, at) <= _reach_m(scene)]
        return min(seen, key=lambda t: apart_m(t, at), default=None)
    if pose is None:
        return None
    return min(filter(lasting, seen), key=lambda t: away_m(pose, (t.x_m, t.y_m)), default=None)


def _find_in_sight(scene: Scene[FollowPersonState], wanted: WantedObject) -> list[Thing]:
    """Return the persons seen just now, surely or not."""
    since_s = scene.now_s - NEW_S
    return [t for t in scene.sight.things if t.label == wanted.label and t.seen_s >= since_s]


def _reach_m(scene: Scene[FollowPersonState]) -> float:
    """Return how far the person may have come since they were seen last [m]."""
    return SAME_M + max(0.0, scene.spent_s - scene.state.seen_s)


def _keep_up(
    pose: Pose2, at: tuple[float, float, float], state: FollowPersonState
) -> DriveLeg | Observe | Fail:
    """Go after who is in sight, face them, or stand and watch."""
    if away_m(pose, at[:2]) > KEEP_M + SLACK_M:
        return _go_after(pose, at, state)
    state = state.but(stage=FollowStage.AFTER, shut_at=None, shut_ways=0)
    if abs(turn_to(pose, at[:2])) > FACE_RAD:
        return _watch(spin(pose, bearing(pose, at[:2]), state), state)
    return Observe(GAZE_LOOKS, GAZE_S, state=state, then=state, watch=True)


def _go_after(
    pose: Pose2, at: tuple[float, float, float], state: FollowPersonState
) -> DriveLeg | Observe | Fail:
    """Go to a point short of them; where the way was shut watch a while first, not for ever."""
    if state.shut_ways >= MOST_SHUT:
        said = message(Code.NO_ROUTE, place=definite(name_object(state.label or "person")))
        return Fail(Code.NO_ROUTE, "no_route", said)
    if state.stage is FollowStage.SHUT:
        then = state.but(stage=FollowStage.AFTER)
        return Observe(SHUT_LOOKS, GAZE_S, state=state, then=then, watch=True)
    goal, heading = short_of(pose, at[:2], KEEP_M)
    shut = state.but(
        stage=FollowStage.SHUT, shut_at=(pose.x_m, pose.y_m), shut_ways=state.shut_ways + 1
    )
    return _watch(leg_to(pose, goal, heading, state, shut), state)


def _watch(leg: DriveLeg, state: FollowPersonState) -> DriveLeg:
    """Bound a leg after somebody by the step's own time: it is laid anew as they walk."""
    return replace(leg, state=state, watch=True, limit_s=None, limit_m=None)


def _search_lost(scene: Scene[FollowPersonState], pose: Pose2, wanted: WantedObject) -> SkillAction:
    """Go to as far short of where the person was seen last, look round there, then give up.

    Who may just have come into sight is watched until that is sure, or over.
    """
    state, at = scene.state, scene.state.at
    if state.stage is FollowStage.SHUT:
        state = state.but(stage=FollowStage.AFTER)
    gone_s = scene.spent_s - state.seen_s
    if gone_s > LOST_S:
        return _give_up(gone_s, seen=at is not None)
    if at is None and _find_in_sight(scene, wanted):
        return Observe(FIRST_LOOKS, state=scene.state, then=scene.state, watch=True)
    if at is None and state.stage is not FollowStage.ROUND:  # nobody yet: they may well stand ahead
        return Observe(
            FIRST_LOOKS, state=state, then=state.but(stage=FollowStage.ROUND), watch=True
        )
    if at is not None and state.stage is not FollowStage.ROUND:
        then = state.but(stage=FollowStage.ROUND)
        if away_m(pose, at[:2]) <= KEEP_M + SLACK_M:  # they may stand there yet, unseen
            return _look_about(scene.but(then), pose, gone_s)
        goal, heading = short_of(pose, at[:2], KEEP_M)
        return replace(leg_to(pose, goal, heading, then, then), state=state, watch=True)
    return _look_about(scene, pose, gone_s)


def _look_about(scene: Scene[FollowPersonState], pose: Pose2, gone_s: float) -> SkillAction:
    at = (pose.x_m, pose.y_m)
    act = look_round(scene, pose, (Viewpoint(HERE, scene.facts.room_at(*at), at),), None)
    if isinstance(act, FollowPersonState):
        return _give_up(gone_s, seen=scene.state.at is not None)
    return replace(act, state=scene.state, watch=True)


def _give_up(gone_s: float, *, seen: bool) -> Fail:
    seconds = f"{gone_s:.0f}"
    lost = message(Code.LOST_PERSON, seconds=seconds)
    said = lost if seen else say("step_failure.nobody_to_follow", seconds=seconds)
    return Fail(Code.LOST_PERSON, "lost_person", said)


def _finish(scene: Scene[FollowPersonState]) -> Finish:
    said = message(Code.FOLLOWED, seconds=f"{scene.spent_s:.0f}", metres=f"{scene.spent_m:.1f}")
    return Finish({}, Code.FOLLOWED, said)
