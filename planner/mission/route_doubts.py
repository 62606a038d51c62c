"""Doubt the way of the running leg where the route search remembers something in it, or who comes.

Laws. A doubt never stops a leg: where no better way is found, the old one goes on, the bridge
judges it, and recovery begins where the bridge holds the robot. A way round is searched for once a
second at most, and taken a bounded number of times in a leg, so that nothing is circled. A doubt
has to last, since what moves is known to move only after half a second. Pure: told times, knows no
clock.

Way is made for one as wide as a robot while there is room to turn. Who stands 0.06 m before another
one turns at 0.3 rad/s and sees half of it; so two that meet in a door or a hallway decide two
metres before. Both search the same: who has the shorter way aside goes, the other stands and climbs
the ladder of recovery; so does one that can be passed already.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from planner.mission.activity import Driving, LegRoutes, Manoeuvre, RouteDoubt, RoutePurpose
from planner.mission.events import ClosingIn, Oncoming, Routed, RouteDoubted
from planner.mission.legs import ask_route, new_leg
from planner.mission.recovery import LADDER, Recovery, begin_ladder, note_obstruction
from planner.navigation.obstruction import Obstruction
from planner.navigation.route import is_wide
from planner.skills import Way
from wire import Pose2

if TYPE_CHECKING:
    from planner.mission.state import Mission, MissionState
    from planner.mission.transaction import Transaction


DOUBTED, KEPT, KEPT_SHORTER, BENT, RIGHT = (
    "route_doubted",
    "route_kept",
    "route_kept_shorter",
    "route_bent",
    "route_keeps_right",
)
_TAKEN = (BENT, RIGHT)
"""A way was taken because of it: it is told as long as that is driven."""
SETTLE_S = 0.5
"""By then somebody who walks is known to walk, and closes no way."""
PERIOD_S = 1.0
LASTS_S = 1.0
"""A doubt that nothing has renewed for so long is over: five scans saw the way open."""
SLOWED = "obstacle"
"""The bridge's name for its obstacle gate. What it slows for is near, and left to recovery: a lidar
that sees things everywhere must end in standing, not in turning from one way to the next."""
SMALL_BEND_M = 2.0
"""A way that is at most so much longer is taken at once."""
PATIENCE_S = 3.0
"""Before a longer one is taken: most people have gone on by then, and the robot drives on."""
SHORT_M = 0.2
"""A way round that ends farther from its goal than this leads elsewhere."""
MEETING_S = 2.0
"""Somebody who was not seen to come for so long, and then comes, is met anew."""
MET_SHARE, PASSED_M = 0.5, 1.0
"""Of the way to somebody who comes, what the robot drives until they meet, at most: it slows down
on the right. So far beyond they have passed."""
MEETING_SHARE = 0.5
"""Of the planned speeds, near another robot that closes in."""
MAX_BENDS = 12
"""In one leg. After that the ladder of recovery alone finds other ways."""


def on_way_news(turn: Transaction, event: RouteDoubted | Oncoming | ClosingIn) -> None:
    """Take what is seen on the way of the leg that is streamed; of any other leg it is old."""
    mission, leg = turn.running, turn.driving
    if mission is None or leg is None or (mission.id, leg.leg) != (event.id, event.leg):
        return
    if isinstance(event, ClosingIn):  # whatever the leg is driven for
        turn.change(doubts=replace(leg.doubts, closed_in_s=turn.now_s))
    elif leg.act.way is not Way.ROUTE or leg.manoeuvre is not None:
        return
    elif isinstance(event, RouteDoubted):
        _doubt(turn, leg, event)
    elif not _make_way(turn, mission, leg, event):
        _keep_right(turn, leg, event)


def _doubt(turn: Transaction, leg: LegRoutes, event: RouteDoubted) -> None:
    """Note that the leg's way is closed ahead; have another searched, where that is due."""
    doubt, now_s = leg.doubts.newest, turn.now_s
    lasts = doubt is not None and doubt.leg == event.leg and doubt.code not in _TAKEN
    if doubt is None or not lasts or not now_s - doubt.seen_s <= LASTS_S:
        doubt = RouteDoubt(event.leg, event.at_m, now_s, now_s, DOUBTED)
    doubts = replace(leg.doubts, newest=replace(doubt, at_m=event.at_m, seen_s=now_s))
    turn.change(doubts=doubts)
    if not _may_search(turn, leg):
        return
    if now_s - doubt.since_s >= SETTLE_S and now_s - doubts.searched_s >= PERIOD_S:
        turn.change(doubts=replace(doubts, searched_s=now_s))
        ask_route(turn, RoutePurpose.DOUBT)


def _keep_right(turn: Transaction, leg: LegRoutes, event: Oncoming) -> None:
    """Have a way on the right searched for somebody who comes, once for each meeting."""
    before, now_s = leg.doubts, turn.now_s
    keeps_right = before.newest is not None and (
        (before.newest.leg, before.newest.code) == (leg.leg, RIGHT)
    )
    is_known = keeps_right and now_s - before.met_s <= MEETING_S
    doubts = replace(before, met_s=now_s)
    turn.change(doubts=doubts)
    if is_known or now_s - before.right_searched_s < PERIOD_S or not _may_search(turn, leg):
        return
    newest = RouteDoubt(event.leg, event.at_m, now_s, now_s, DOUBTED)
    turn.change(doubts=replace(doubts, newest=newest, right_searched_s=now_s))
    reach_m = MET_SHARE * event.far_m + PASSED_M
    ask_route(turn, RoutePurpose.KEEP_RIGHT, keep_right_m=reach_m)


def meeting_share(book: MissionState) -> float:
    """Return the share of the planned speeds at which another robot that closes in is met.

    The bridge keeps the room to stop before what stands. Of two that drive towards each other each
    uses up the room of the other one, which at half the speed is a quarter.
    """
    leg = book.activity
    meets = isinstance(leg, Driving) and book.status_s - leg.doubts.closed_in_s <= LASTS_S
    return MEETING_SHARE if meets else 1.0


def take_doubted(turn: Transaction, mission: Mission, leg: Driving, routed: Routed) -> None:
    """Take the way that was searched because of a doubt, or keep the leg's own."""
    doubt, right = leg.doubts.newest, leg.purpose is RoutePurpose.KEEP_RIGHT
    if doubt is None or leg.leg is None:
        return
    whole = routed.failure is None and routed.short_m <= SHORT_M
    if right and not whole:
        return
    small = leg.left_m is not None and routed.length_m - leg.left_m <= SMALL_BEND_M
    if whole and (small or turn.now_s - doubt.since_s >= PATIENCE_S):
        new_leg(turn, mission)
        taken = turn.driving or leg
        code = RIGHT if right else BENT
        bent = replace(doubt, leg=taken.leg or doubt.leg, code=code)
        turn.change(doubts=replace(leg.doubts, newest=bent, bends=leg.doubts.bends + 1))
    else:
        kept = replace(doubt, code=KEPT_SHORTER if whole else KEPT)
        turn.change(doubts=replace(leg.doubts, newest=kept))


def standing_doubt(book: MissionState) -> RouteDoubt | None:
    """Return the doubt of the leg that is streamed: while it lasts, or as long as the bent way."""
    leg = book.activity
    doubt = leg.doubts.newest if isinstance(leg, Driving) else None
    if not isinstance(leg, Driving) or doubt is None or doubt.leg != leg.leg:
        return None
    lasts = doubt.code in _TAKEN or book.status_s - doubt.seen_s <= LASTS_S
    return doubt if lasts else None


def _may_search(turn: Transaction, leg: LegRoutes) -> bool:
    """Tell whether nothing else looks after the leg now."""
    status = turn.book.status
    return (
        leg.ticket is None
        and not leg.route_when_standing
        and leg.doubts.bends < MAX_BENDS
        and status is not None
        and status.base_in_map is not None
        and not (status.blocked or status.limits.by == SLOWED)
    )


NEAR_M = 2.2
"""Along the way: nearer than this it is decided."""
AGAIN_S = 3.0
"""A meeting is decided anew after so long: the other one may have chosen otherwise."""
GIVE_WAY = next(rung for rung in LADDER if rung.recovery is Recovery.GIVE_WAY)


def _make_way(turn: Transaction, mission: Mission, leg: Driving, event: Oncoming) -> bool:
    """Have a way aside searched before who comes is there; say if that was decided."""
    pose, busy = turn.book.pose, leg.ticket is not None or leg.route_when_standing
    if busy or pose is None or not is_wide(event.radius_m):
        return False
    if not (event.far_m <= NEAR_M and turn.now_s - leg.doubts.made_way_s >= AGAIN_S):
        return False
    turn.change(doubts=replace(leg.doubts, made_way_s=turn.now_s))
    side = Obstruction(event.seen_m, event.seen_m)
    record = begin_ladder(mission.recovery, (pose.x_m, pose.y_m))
    record = note_obstruction(record, side, turn.now_unix_s, moves=True, radius_m=event.radius_m)
    turn.put(mission, recovery=record.model_copy(update={"rung": LADDER.index(GIVE_WAY)}))
    until_s = turn.now_s + GIVE_WAY.seconds
    goal = Pose2(*event.seen_m, 0.0)
    own = Manoeuvre(GIVE_WAY, goal, Way.ASIDE, until_s, leg.metres, is_early=True)
    turn.change(manoeuvre=own)
    ask_route(turn, RoutePurpose.DETOUR)
    return True
