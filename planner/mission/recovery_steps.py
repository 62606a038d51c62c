"""Climb the recovery ladder while the running leg is blocked.

The table and its bounds stand in ``recovery``. Only a leg by route recovers: a straight way and a
spin go on or end. Every rung is written into the step's record before it is carried out, so that a
person sees what is tried, and the journal holds it.
"""

from __future__ import annotations

from dataclasses import replace
from math import cos, sin

from planner.bridge_client.bridge_status import standing
from planner.mission import recovery
from planner.mission.account import place_name
from planner.mission.activity import Driving, LegRoutes, Manoeuvre, RoutePurpose
from planner.mission.events import Surveyed
from planner.mission.legs import RETRY_S, ask_route, look_for_room, told_of_leg
from planner.mission.queue import note_step
from planner.mission.spoken_status import tell_obstruction
from planner.mission.state import Mission
from planner.mission.step_failure import fail_step
from planner.mission.transaction import Transaction
from planner.plan import Code
from planner.skills import Fail, Way
from wire import Pose2, Status, wrap

# The lidar's word --------------------------------------------------------------------------------


def on_survey(turn: Transaction, survey: Surveyed) -> None:
    """Remember what stands in the way now, and forget what no longer does."""
    mission, leg = turn.running, turn.driving
    if mission is None or leg is None:
        return
    seen, record = survey.obstruction, mission.recovery
    now_unix_s = turn.now_unix_s
    for way in record.shut:
        if any(way.obstruction == gone for gone in survey.opened):
            record = recovery.note_open(record, way)
    if seen is not None and turn.book.status is not None and turn.book.status.blocked:
        held = record.newest
        known = held is not None and recovery.is_same(held.obstruction, seen)
        # Once a second is enough: each of these is written to the journal.
        if held is None or not known or now_unix_s - held.seen_unix_s >= 1.0:
            record = recovery.note_obstruction(
                *(record, seen, now_unix_s, survey.local_offset_s),
                moves=survey.moves,
                radius_m=survey.radius_m,
            )
    if record is not mission.recovery:
        turn.put(mission, recovery=record)


# The ladder --------------------------------------------------------------------------------------


def recover(turn: Transaction, leg: Driving, status: Status) -> None:
    """Do what the next rung says, for a leg that is blocked now.

    A gate that opens for a moment, so that the robot creeps, starts no wait anew.
    """
    mission, pose = turn.at_work, status.base_in_map
    if pose is None:
        return
    record = recovery.begin_ladder(mission.recovery, (pose.x_m, pose.y_m))
    if record is not mission.recovery:
        mission = turn.put(mission, recovery=record)
        turn.change(rung_since_s=None)
    since_s = _begin_rung(turn)
    rung = recovery.rung_of(record)
    if leg.occupied_since_s is not None:
        look_for_room(turn, mission, leg)
    elif rung.recovery is not recovery.Recovery.WAIT:
        _do_rung(turn, rung, pose)
    elif turn.now_s - since_s >= recovery.wait_s(record):
        next_rung(turn)


def leave_silence(turn: Transaction, leg: Driving, status: Status) -> None:
    """Turn on the spot before a sector of the lidar from which nothing comes, once at a place.

    What is black stays where it is and leaves the sector proven; a hole in the lidar turns along,
    and the bridge holds the way again.
    """
    mission, pose = turn.at_work, status.base_in_map
    record = None if pose is None else recovery.turn_out(mission.recovery, (pose.x_m, pose.y_m))
    if pose is None or record is None:
        return
    mission = turn.put(mission, recovery=record)
    note_recovery(turn, mission, recovery.Recovery.TURN_OUT)
    _turn_to_look(turn, leg, recovery.TURN_OUT, 0, pose.yaw_rad)


def next_rung(turn: Transaction) -> None:
    """Put the foot on the next rung; it begins once the robot is held."""
    mission, record = turn.at_work, turn.at_work.recovery
    turn.put(mission, recovery=record.model_copy(update={"rung": recovery.rung_after(record)}))
    turn.change(rung_since_s=None)


def _begin_rung(turn: Transaction) -> float:
    """Return since when the rung is in hand; where it begins now, tell so."""
    mission, since_s = turn.at_work, turn.leg.rung_since_s
    if since_s is not None:
        return since_s
    turn.change(rung_since_s=turn.now_s)
    note_recovery(turn, mission, recovery.rung_of(mission.recovery).recovery)
    return turn.now_s


def note_recovery(turn: Transaction, mission: Mission, tried: recovery.Recovery) -> Mission:
    """Tell in the step's record what is tried."""
    told = (*mission.steps[mission.step].recoveries, tried.value)
    return note_step(turn, mission, recoveries=told[-recovery.MAX_TOLD :])


def climb_on(turn: Transaction) -> None:
    """Begin the next rung at once, for a leg that streams nothing and so is never called blocked.

    A wait ends with a new search; the last one, before giving up, would wait for nothing.
    """
    next_rung(turn)
    pose = turn.book.pose
    if pose is None:
        turn.change(retry_s=turn.now_s + RETRY_S)
        return
    rung = recovery.rung_of(turn.at_work.recovery)
    _begin_rung(turn)
    if rung.recovery is not recovery.Recovery.WAIT:
        _do_rung(turn, rung, pose)
    elif rung is recovery.LADDER[-2]:
        _do_rung(turn, recovery.LADDER[-1], pose)
    else:
        turn.change(retry_s=turn.now_s + min(RETRY_S, rung.seconds))


def _do_rung(turn: Transaction, rung: recovery.LadderRung, pose: Pose2) -> None:
    mission, leg = turn.at_work, turn.leg
    match rung.recovery:
        case recovery.Recovery.REROUTE | recovery.Recovery.OTHER_WAY:
            ask_route(turn, RoutePurpose.DETOUR)
        case recovery.Recovery.GIVE_WAY:
            _give_way(turn, mission, leg, rung)
        case recovery.Recovery.LOOK:
            _turn_to_look(turn, leg, rung, 0, pose.yaw_rad)
        case recovery.Recovery.BACK_OFF:
            back = Pose2(
                pose.x_m - rung.metres * cos(pose.yaw_rad),
                pose.y_m - rung.metres * sin(pose.yaw_rad),
                pose.yaw_rad,
            )
            _manoeuvre(turn, leg, rung, back, Way.STRAIGHT)
        case _:
            _give_up(turn, mission, leg)


def _give_up(turn: Transaction, mission: Mission, leg: LegRoutes) -> None:
    """Fail the step; before somebody who walked up, only once the ladder was climbed thrice."""
    again = recovery.climb_again(mission.recovery)
    if again is None:
        fail_step(turn, way_shut(turn, mission))
        return
    turn.put(mission, recovery=again)
    turn.change(rung_since_s=None, retry_s=turn.now_s + RETRY_S if leg.leg is None else None)
    _begin_rung(turn)


def skip_rung(turn: Transaction, leg: LegRoutes) -> None:
    """Leave a rung out; a leg that streams nothing begins the next one itself."""
    if leg.leg is None:
        climb_on(turn)
    else:
        next_rung(turn)


def _give_way(turn: Transaction, mission: Mission, leg: Driving, rung: recovery.LadderRung) -> None:
    """Stand aside for somebody who walked up; a thing that never moved is not given way to."""
    record = mission.recovery
    if not recovery.can_give_way(record) or record.newest is None:
        skip_rung(turn, leg)
        return
    update = {"given_way": record.given_way + 1}
    turn.put(mission, recovery=record.model_copy(update=update))
    _manoeuvre(turn, leg, rung, Pose2(*record.newest.obstruction.middle, 0.0), Way.ASIDE)


def _turn_to_look(
    turn: Transaction, leg: Driving, rung: recovery.LadderRung, part: int, from_rad: float
) -> None:
    here = turn.book.pose
    if here is None:
        return
    goal = Pose2(here.x_m, here.y_m, wrap(from_rad + rung.turns_rad[part]))
    _manoeuvre(turn, leg, rung, goal, Way.SPIN, part, from_rad)


def _manoeuvre(
    turn: Transaction,
    leg: Driving,
    rung: recovery.LadderRung,
    goal: Pose2,
    way: Way,
    part: int = 0,
    heading_rad: float = 0.0,
) -> None:
    until_s = turn.now_s + rung.seconds
    own = Manoeuvre(rung, goal, way, until_s, leg.metres, part, heading_rad)
    turn.change(manoeuvre=own)
    ask_route(turn, RoutePurpose.DETOUR)


def watch_manoeuvre(turn: Transaction, leg: Driving, status: Status) -> None:
    """End a manoeuvre that has come where it was to, or is over; then begin the next rung."""
    own, told = leg.manoeuvre, told_of_leg(turn)
    if own is None:
        return
    if own.stays:
        if not status.blocked:
            turn.change(manoeuvre=None, rung_since_s=None)
        elif turn.now_s >= own.until_s:
            turn.change(manoeuvre=None)
            next_rung(turn)
        return
    is_there = told is not None and told.reached and standing(status)
    reached = is_there and leg.ticket is None
    aside = own.rung.recovery is recovery.Recovery.GIVE_WAY
    if reached and aside and not own.part:
        until_s = turn.now_s + recovery.aside_s(turn.at_work.recovery)
        turn.change(manoeuvre=replace(own, part=1, until_s=until_s))
        return
    if not (turn.now_s >= own.until_s or (reached and not aside)):
        return
    if own.part + 1 < len(own.rung.turns_rad):
        _turn_to_look(turn, leg, own.rung, own.part + 1, own.heading_rad)
        return
    end_manoeuvre(turn, leg, own)


def end_manoeuvre(turn: Transaction, leg: Driving, own: Manoeuvre) -> None:
    """Stand, and go on with the next rung: the leg's own path was lost with the manoeuvre.

    A turn out of a silent sector is no rung: the leg's way is searched again.
    """
    mission = turn.at_work
    gone_m = mission.recovery.metres + max(0.0, leg.metres - own.begun_m)
    record = mission.recovery.model_copy(update={"metres": round(gone_m, 3)})
    turn.put(mission, recovery=record)
    turn.change(manoeuvre=None, leg=None, ticket=None, blocked_since_s=None)
    if own.rung is recovery.TURN_OUT:
        ask_route(turn)
    else:
        climb_on(turn)


def way_shut(turn: Transaction, mission: Mission) -> Fail:
    """Return the failure of a way that was given up, naming what stands in it where it was seen."""
    newest, facts = mission.recovery.newest, turn.book.facts
    if newest is None:
        return Fail(Code.BLOCKED, "blocked")
    name = place_name(facts, mission, mission.current_step)
    return Fail(Code.BLOCKED, "blocked", tell_obstruction(facts, newest, name))
