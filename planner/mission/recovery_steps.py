"""Climb the recovery ladder while the running leg is blocked, and take the routes that come of it.

The table and its bounds stand in ``recovery``. Only a leg by route recovers: a straight way and a
spin go on or end. Every rung is written into the step's record before it is carried out, so that a
person sees what is tried, and the journal holds it.
"""

from __future__ import annotations

from dataclasses import replace
from math import cos, sin

from planner.mission.account import place_name
from planner.mission.activity import Driving, Manoeuvre
from planner.mission.bridge_status import standing
from planner.mission.events import Routed, Surveyed
from planner.mission.exploration import take_better_viewpoint, take_viewpoint
from planner.mission.legs import ask_route, detour_failed, new_leg, take_short
from planner.mission.obstruction_text import tell_obstruction
from planner.mission.occupied_goal import give_up_goal, look_for_room, wait_beside
from planner.mission.queue import note_step
from planner.mission.recovery import (
    LADDER,
    MAX_TOLD,
    PASSING_S,
    LadderRung,
    Recovery,
    begin_ladder,
    can_give_way,
    is_same,
    note_obstruction,
    note_open,
    rung_of,
    wait_s,
)
from planner.mission.route_doubts import take_doubted
from planner.mission.skills import Fail, Way
from planner.mission.state import Mission
from planner.mission.step_failure import fail_step
from planner.mission.transaction import Transaction
from planner.plan import Code
from wire import Pose2, Status, wrap

SHORT_M = 0.05
"""A straight way that ends so near to its goal is whole."""
MOVED_M = 0.2
"""A route that ends farther from its goal than this ends elsewhere."""
OCCUPIED = "goal_occupied"
"""The route search's code where something not on the map leaves no floor beside the goal."""
MAX_APPROACHES = 2
TRANSIENT = frozenset({"route_timed_out", "route_worker_died", "route_worker_unavailable"})
MAX_ROUTES = 5
RETRY_S = 1.0


# The lidar's word --------------------------------------------------------------------------------


def on_survey(turn: Transaction, survey: Surveyed) -> None:
    """Remember what stands in the way now, and forget what no longer does."""
    mission, leg = turn.running, turn.driving
    if mission is None or leg is None:
        return
    seen, record = survey.obstruction, mission.recovery
    now_unix_s = turn.now_s + turn.book.wall_offset_s
    for way in record.shut:
        if any(way.obstruction == gone for gone in survey.opened):
            record = note_open(record, way)
    if seen is not None and turn.book.status is not None and turn.book.status.blocked:
        held = record.newest
        known = held is not None and is_same(held.obstruction, seen)
        # Once a second is enough: each of these is written to the journal.
        if held is None or not known or now_unix_s - held.seen_unix_s >= 1.0:
            offset_s = survey.local_offset_s
            record = note_obstruction(record, seen, now_unix_s, offset_s, moves=survey.moves)
    if record is not mission.recovery:
        turn.put(mission, recovery=record)


# The ladder --------------------------------------------------------------------------------------


def recover(turn: Transaction, leg: Driving, status: Status) -> None:
    """Do what the next rung says, for a leg that is blocked now.

    A gate that opens for a moment, so that the robot creeps, starts no wait anew.
    """
    mission, pose = turn.running, status.base_in_map
    if mission is None or pose is None:
        return
    record = begin_ladder(mission.recovery, _xy(pose))
    if record is not mission.recovery:
        mission = turn.put(mission, recovery=record)
        turn.change(rung_since_s=None)
    since_s = _begin_rung(turn)
    rung = rung_of(record)
    if leg.occupied_since_s is not None:
        look_for_room(turn, mission, leg)
    elif rung.recovery is not Recovery.WAIT:
        _do_rung(turn, rung, pose)
    elif turn.now_s - since_s >= wait_s(record):
        next_rung(turn)


def note_unblocked(turn: Transaction) -> None:
    """Note that nothing holds the leg now: what stood on its goal has left."""
    turn.change(occupied_since_s=None)


def next_rung(turn: Transaction) -> None:
    """Put the foot on the next rung; it begins once the robot is held."""
    mission = turn.running
    if mission is not None:
        record = mission.recovery
        turn.put(mission, recovery=record.model_copy(update={"rung": record.rung + 1}))
        turn.change(rung_since_s=None)


def _begin_rung(turn: Transaction) -> float:
    """Return since when the rung is in hand; where it begins now, tell so."""
    mission, leg = turn.running, turn.driving
    if leg is not None and leg.rung_since_s is not None:
        return leg.rung_since_s
    turn.change(rung_since_s=turn.now_s)
    if mission is not None and mission.current_step is not None:
        name = rung_of(mission.recovery).recovery.value
        told = (*mission.current_step.recoveries, name)
        note_step(turn, mission, recoveries=told[-MAX_TOLD:])
    return turn.now_s


def _climb_on(turn: Transaction) -> None:
    """Begin the next rung at once, for a leg that streams nothing and so is never called blocked.

    A wait ends with a new search; the last one, before giving up, would wait for nothing.
    """
    next_rung(turn)
    mission, status = turn.running, turn.book.status
    pose = status.base_in_map if status is not None else None
    if mission is None:
        return
    if pose is None:
        turn.change(retry_s=turn.now_s + RETRY_S)
        return
    rung = rung_of(mission.recovery)
    _begin_rung(turn)
    if rung.recovery is not Recovery.WAIT:
        _do_rung(turn, rung, pose)
    elif rung is LADDER[-2]:
        _do_rung(turn, LADDER[-1], pose)
    else:
        turn.change(retry_s=turn.now_s + rung.seconds)


def _do_rung(turn: Transaction, rung: LadderRung, pose: Pose2) -> None:
    mission, leg = turn.running, turn.driving
    if mission is None or leg is None:
        return
    match rung.recovery:
        case Recovery.REROUTE | Recovery.OTHER_WAY:
            ask_route(turn, detour=True)
        case Recovery.GIVE_WAY:
            _give_way(turn, mission, leg, rung)
        case Recovery.LOOK:
            _turn_to_look(turn, leg, rung, 0, pose.yaw_rad)
        case Recovery.BACK_OFF:
            back = Pose2(
                pose.x_m - rung.metres * cos(pose.yaw_rad),
                pose.y_m - rung.metres * sin(pose.yaw_rad),
                pose.yaw_rad,
            )
            _manoeuvre(turn, leg, rung, back, Way.STRAIGHT)
        case _:
            fail_step(turn, _way_shut(turn, mission))


def _give_way(turn: Transaction, mission: Mission, leg: Driving, rung: LadderRung) -> None:
    """Stand aside for somebody who walked up; a thing that never moved is not given way to."""
    record = mission.recovery
    if not can_give_way(record) or record.newest is None:
        next_rung(turn)
        return
    update = {"given_way": record.given_way + 1}
    turn.put(mission, recovery=record.model_copy(update=update))
    _manoeuvre(turn, leg, rung, Pose2(*record.newest.obstruction.middle, 0.0), Way.ASIDE)


def _turn_to_look(
    turn: Transaction, leg: Driving, rung: LadderRung, part: int, from_rad: float
) -> None:
    here = turn.book.status.base_in_map if turn.book.status is not None else None
    if here is None:
        return
    goal = Pose2(here.x_m, here.y_m, wrap(from_rad + rung.turns_rad[part]))
    _manoeuvre(turn, leg, rung, goal, Way.SPIN, part, from_rad)


def _manoeuvre(
    turn: Transaction,
    leg: Driving,
    rung: LadderRung,
    goal: Pose2,
    way: Way,
    part: int = 0,
    heading_rad: float = 0.0,
) -> None:
    until_s = turn.now_s + rung.seconds
    own = Manoeuvre(rung, goal, way, until_s, leg.metres, part, heading_rad)
    turn.change(manoeuvre=own)
    ask_route(turn, detour=True)


def watch_manoeuvre(turn: Transaction, leg: Driving, status: Status) -> None:
    """End a manoeuvre that has come where it was to, or is over; then begin the next rung."""
    own, told, mission = leg.manoeuvre, status.leg, turn.running
    if own is None or mission is None:
        return
    reached = (
        told is not None
        and (told.mission, told.leg) == (mission.id, leg.leg)
        and told.reached
        and standing(status)
        and leg.ticket is None
    )
    aside = own.rung.recovery is Recovery.GIVE_WAY
    if reached and aside and not own.part:
        until_s = min(own.until_s, turn.now_s + PASSING_S)
        turn.change(manoeuvre=replace(own, part=1, until_s=until_s))
        return
    if not (turn.now_s >= own.until_s or (reached and not aside)):
        return
    if own.part + 1 < len(own.rung.turns_rad):
        _turn_to_look(turn, leg, own.rung, own.part + 1, own.heading_rad)
        return
    _end_manoeuvre(turn, leg, own)


def _end_manoeuvre(turn: Transaction, leg: Driving, own: Manoeuvre) -> None:
    """Stand, and go on with the next rung: the leg's own path was lost with the manoeuvre."""
    mission = turn.running
    if mission is None:
        return
    gone_m = mission.recovery.metres + max(0.0, leg.metres - own.begun_m)
    record = mission.recovery.model_copy(update={"metres": round(gone_m, 3)})
    turn.put(mission, recovery=record)
    turn.change(manoeuvre=None, leg=None, ticket=None, blocked_since_s=None)
    _climb_on(turn)


def _way_shut(turn: Transaction, mission: Mission) -> Fail:
    """Return the failure of a way that was given up, naming what stands in it where it was seen."""
    newest, facts = mission.recovery.newest, turn.book.facts
    if newest is None:
        return Fail(Code.BLOCKED, "blocked")
    name = place_name(facts, mission, mission.current_step)
    return Fail(Code.BLOCKED, "blocked", tell_obstruction(facts, newest, name))


# Routes ------------------------------------------------------------------------------------------


def on_routed(turn: Transaction, routed: Routed) -> None:
    """Take the route that was asked for; any other is forgotten."""
    mission, leg = turn.running, turn.driving
    if mission is None or leg is None or (mission.id, leg.ticket) != (routed.id, routed.ticket):
        return
    failure, short_m = routed.failure, routed.short_m
    turn.change(ticket=None)
    leg = turn.driving or leg
    if leg.ticket_doubted or leg.ticket_explores:
        take = take_doubted if leg.ticket_doubted else take_better_viewpoint
        take(turn, mission, leg, routed)
    elif leg.manoeuvre is not None and failure is not None:
        _end_manoeuvre(turn, leg, leg.manoeuvre)
    elif leg.manoeuvre is not None:
        new_leg(turn, mission)
    elif failure is None and leg.way is Way.STRAIGHT and not short_m <= SHORT_M:
        take_short(turn, leg, short_m)
    elif failure is None:
        _take_route(turn, mission, leg, routed)
    elif leg.way is not Way.ROUTE and leg.ticket_detour:
        detour_failed(turn, leg)
    elif failure == OCCUPIED and leg.way is Way.ROUTE:
        wait_beside(turn, mission, leg)
    elif leg.ticket_detour:
        _no_way_round(turn, mission, leg, failure)
    elif failure in TRANSIENT and leg.routes < MAX_ROUTES:
        turn.change(routes=leg.routes + 1, retry_s=turn.now_s + RETRY_S)
    elif mission.recovery.shut and failure == "no_route":
        fail_step(turn, _way_shut(turn, mission))
    else:
        fail_step(turn, Fail(Code.NO_ROUTE, "no_route"))


def _take_route(turn: Transaction, mission: Mission, leg: Driving, routed: Routed) -> None:
    """Stream a route; one round something that ends short of its goal moves the goal, once."""
    if leg.way is Way.EXPLORE:
        take_viewpoint(turn, mission, leg, routed)
        return
    short_m, end_m = routed.short_m, routed.end_m
    moved = leg.way is Way.ROUTE and leg.ticket_detour and short_m > MOVED_M and end_m is not None
    if not moved:
        new_leg(turn, mission)
        if leg.ticket_detour:
            next_rung(turn)
        return
    record = mission.recovery
    if record.approaches + 1 >= MAX_APPROACHES or end_m is None:
        give_up_goal(turn, mission, leg)
        return
    update = {"approaches": record.approaches + 1, "goal": _xy(leg.goal), "goal_moved": end_m}
    mission = turn.put(mission, recovery=record.model_copy(update=update))
    new_leg(turn, mission)
    turn.change(rung_since_s=None, occupied_since_s=None)


def _no_way_round(turn: Transaction, mission: Mission, leg: Driving, failure: str) -> None:
    """Go on up the ladder; a search that only broke is tried again."""
    if failure in TRANSIENT and leg.routes < MAX_ROUTES:
        turn.change(routes=leg.routes + 1, rung_since_s=turn.now_s)
        turn.change(retry_s=turn.now_s + RETRY_S if leg.leg is None else None)
    elif leg.leg is None:
        _climb_on(turn)
    else:
        next_rung(turn)


def _xy(pose: Pose2) -> tuple[float, float]:
    return pose.x_m, pose.y_m
