"""Make way for one as wide as a robot that comes, while there is room to turn.

Laws. Who stands 0.06 m before another one turns at 0.3 rad/s and sees half of it; so two that meet
in a door or a hallway decide two metres before. Both search the same: who has the shorter way aside
goes, the other stands and climbs the ladder of recovery; so does one that can be passed already.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from planner.mission.activity import Manoeuvre, RoutePurpose
from planner.mission.legs import ask_route
from planner.mission.recovery import LADDER, Recovery, begin_ladder, note_obstruction
from planner.navigation.obstruction import Obstruction
from planner.navigation.route import is_wide
from planner.skills import Way
from wire import Pose2

if TYPE_CHECKING:
    from planner.mission.events import Oncoming
    from planner.mission.transaction import Transaction

NEAR_M = 2.2
"""Along the way: nearer than this it is decided."""
AGAIN_S = 3.0
"""A meeting is decided anew after so long: the other one may have chosen otherwise."""
GIVE_WAY = next(rung for rung in LADDER if rung.recovery is Recovery.GIVE_WAY)


def make_way(turn: Transaction, event: Oncoming) -> None:
    """Have a way aside searched before who comes is there."""
    mission, leg, status = turn.running, turn.driving, turn.book.status
    if mission is None or leg is None or (mission.id, leg.leg) != (event.id, event.leg):
        return
    pose = status.base_in_map if status is not None else None
    busy = leg.manoeuvre is not None or leg.ticket is not None or leg.route_when_standing
    if busy or pose is None or leg.act.way is not Way.ROUTE or not is_wide(event.radius_m):
        return
    if not (event.far_m <= NEAR_M and turn.now_s - leg.doubts.made_way_s >= AGAIN_S):
        return
    turn.change(doubts=replace(leg.doubts, made_way_s=turn.now_s))
    now_unix_s = turn.now_s + turn.book.wall_offset_s
    side = Obstruction(event.seen_m, event.seen_m)
    record = begin_ladder(mission.recovery, (pose.x_m, pose.y_m))
    record = note_obstruction(record, side, now_unix_s, moves=True, radius_m=event.radius_m)
    turn.put(mission, recovery=record.model_copy(update={"rung": LADDER.index(GIVE_WAY)}))
    until_s = turn.now_s + GIVE_WAY.seconds
    goal = Pose2(*event.seen_m, 0.0)
    own = Manoeuvre(GIVE_WAY, goal, Way.ASIDE, until_s, leg.metres, is_early=True)
    turn.change(manoeuvre=own)
    ask_route(turn, RoutePurpose.DETOUR)
