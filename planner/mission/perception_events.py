"""Take what the eyes say into the running step: gazes end, legs after what moves are laid anew.

Levels, not events: only the newest sight counts, and a lost one loses nothing. A picture counts for
a gaze when it was taken after the robot stood. Nothing moves by a sight alone: what follows from it
is the skill's next act, carried out like any other. A leg that is driven to see ends, standing,
while nothing is seen: it would lead blindly.
"""

from __future__ import annotations

from dataclasses import replace
from math import hypot

from planner.language.catalogue import message
from planner.mission.bridge_status import standing
from planner.mission.effects import KeepPicture
from planner.mission.legs import ask_route
from planner.mission.queue import settle_walk
from planner.mission.skills import Act, Answer, Cannot, Drive, Gaze, Way, act_of
from planner.mission.skills.object_matching import confirmed, fresh
from planner.mission.state import Walk
from planner.mission.step_execution import carry_out, go_on, scene_of
from planner.mission.step_failure import fail_step
from planner.mission.transaction import Turn
from planner.perception.snapshot import Sight
from planner.plan import Code, same
from wire import wrap

SETTLE_S = 0.15
"""A picture taken so soon after the robot came to stand may be smeared, and its pose late."""
ASK_S = 0.5
"""A skill is asked again because of what is seen no more often."""
SAME_M, SAME_RAD = 0.25, 0.15
"""A goal that moved by less is the same."""
SEEN_S = 1.0
LOOKING = frozenset({"find", "count", "look", "follow", "go_to_object"})
"""Steps in which nothing is driven but to see, or up to what is seen."""
MORE = 2
"""Where something was seen and is not sure, a gaze takes so many times its looks."""


def on_sight(turn: Turn, sight: Sight, classes: tuple[str, ...]) -> None:
    """Take the newest word of the eyes."""
    eyes = turn.book.eyes
    if classes and classes != eyes.classes:
        turn.set(eyes=replace(eyes, classes=classes))
    turn.set(sight=sight)
    walk = turn.book.walk
    if walk is None or turn.running is None or stand_while_blind(turn):
        return
    if walk.kind == "gaze" and _counts(walk, sight):
        look = sight.look
        seq = look.seq if look is not None else -1
        walk = turn.walk(gazed=walk.gazed + 1, look_seq=seq) or walk
        if _enough(turn, walk, sight):
            _gazed(turn, walk)
            return
    if _ask_again(turn, walk, sight):
        _asked_again(turn, walk)


def stand_while_blind(turn: Turn) -> bool:
    """Give up a leg for the eyes' sake while they see nothing, and wait for them; say if so."""
    mission, walk = turn.running, turn.book.walk
    if turn.book.sight.blind is None or mission is None or mission.now is None or walk is None:
        return False
    to_see = walk.watch or walk.wanted is not None or mission.now.kind in LOOKING
    if walk.kind != "drive" or walk.goal is None or not to_see:
        return False
    settled = settle_walk(turn)
    if settled is not None:
        carry_out(turn, settled, Gaze(1, notes=walk.notes, then=walk.notes, watch=walk.watch))
    return True


def on_told(turn: Turn, mission_id: str, ticket: int, answer: Answer) -> None:
    """Take the answer about the picture, if somebody still waits for it."""
    mission, walk = turn.running, turn.book.walk
    if mission is None or walk is None or mission.id != mission_id:
        return
    if walk.kind == "inquire" and walk.ticket == ticket:
        go_on(turn, walk.then, answer=answer)


def on_standing(turn: Turn, walk: Walk) -> None:
    """Let pictures count once the robot stands; end a gaze whose time is over."""
    status = turn.book.status
    if walk.kind == "gaze" and walk.gaze_s is None and status is not None and standing(status):
        turn.walk(gaze_s=turn.now_s + SETTLE_S)
    end_gaze_if_due(turn)


def end_gaze_if_due(turn: Turn) -> None:
    """End a gaze, or the wait for an answer, whose time is over; without any picture it fails."""
    walk = turn.book.walk
    if walk is None or walk.gaze_until_s is None or turn.now_s < walk.gaze_until_s:
        return
    if walk.kind == "inquire":
        go_on(turn, walk.then, answer=Answer(failure="timed_out"))
    elif walk.gazed > 0:
        _gazed(turn, walk)
    else:
        why = turn.book.sight.blind or "camera_silent"
        said = message(Code.BLIND, why=same(why))
        fail_step(turn, Cannot(Code.BLIND, why, said))


def _gazed(turn: Turn, walk: Walk) -> None:
    """Go on after a gaze; the picture of a look's direction is kept for a model to be shown."""
    mission, then = turn.running, walk.then
    looks = mission is not None and mission.now is not None and mission.now.kind == "look"
    if mission is not None and looks and then is not None and then.faced and turn.book.eyes.model:
        turn.emit(KeepPicture(mission.id, len(then.faced) - 1, walk.look_seq))
    go_on(turn, then, gazed_s=walk.gaze_s)


def _counts(walk: Walk, sight: Sight) -> bool:
    look = sight.look
    if look is None or sight.blind is not None or look.seq == walk.look_seq:
        return False
    return walk.gaze_s is not None and look.taken_s >= walk.gaze_s


def _enough(turn: Turn, walk: Walk, sight: Sight) -> bool:
    """Tell whether a gaze has seen enough: what is wanted, or as many pictures as it was to."""
    since_s = walk.gaze_s if walk.gaze_s is not None else turn.now_s
    if walk.wanted is None:
        return walk.gazed >= walk.looks
    if confirmed(sight, walk.wanted, since_s):
        return True
    unsure = bool(fresh(sight, walk.wanted, since_s))
    return walk.gazed >= walk.looks * (MORE if unsure else 1)


def _ask_again(turn: Turn, walk: Walk, sight: Sight) -> bool:
    """Tell whether the skill is to be asked because of what is seen now."""
    if walk.asked_s is None or turn.now_s - walk.asked_s < ASK_S or walk.ticket is not None:
        return False
    if walk.route_when_standing:  # its way was lost: no new one before it stands
        return False
    if walk.watch:
        return True
    if walk.kind != "drive" or walk.wanted is None:
        return False
    return bool(confirmed(sight, walk.wanted, turn.now_s - SEEN_S))


def _asked_again(turn: Turn, walk: Walk) -> None:
    """Ask the skill in the middle of its act, and do what is new in its answer."""
    mission = turn.running
    if mission is None:
        return
    turn.walk(asked_s=turn.now_s)
    act = act_of(scene_of(turn, mission))
    if _same(walk, act):
        if isinstance(act, (Drive, Gaze)) and walk.watch:
            turn.walk(notes=act.notes, then=act.then)
    elif isinstance(act, Drive) and walk.kind == "drive" and _one_way(walk, act):
        _lay_anew(turn, act)
    else:
        settled = settle_walk(turn)
        if settled is not None:
            carry_out(turn, settled, act)


def _same(walk: Walk, act: Act) -> bool:
    """Tell whether what is asked for is what is being done."""
    if isinstance(act, Gaze):
        return walk.kind == "gaze"
    goal = walk.goal
    if (
        not isinstance(act, Drive)
        or walk.kind != "drive"
        or goal is None
        or act.way is not walk.way
    ):
        return False
    turned = abs(wrap(act.goal.yaw_rad - goal.yaw_rad))
    if act.way is Way.SPIN:
        return turned <= SAME_RAD
    apart_m = hypot(act.goal.x_m - goal.x_m, act.goal.y_m - goal.y_m)
    return apart_m <= SAME_M


def _one_way(walk: Walk, act: Drive) -> bool:
    return walk.watch and walk.way is Way.ROUTE and act.way is Way.ROUTE


def _lay_anew(turn: Turn, act: Drive) -> None:
    """Aim the leg at a goal that has moved; the old horizon streams until the new way is there."""
    walk = turn.book.walk
    if walk is None:
        return
    turn.walk(
        goal=act.goal,
        heading=act.heading,
        notes=act.notes,
        then=act.then,
        otherwise=act.otherwise,
        limit_s=_more(walk.moving_s, act.limit_s),
        limit_m=_more(walk.metres, act.limit_m),
    )
    ask_route(turn, detour=False)


def _more(spent: float, limit: float | None) -> float | None:
    """Return the bound of a leg that goes on, of which so much was spent before it was laid."""
    return spent + limit if limit is not None else None
