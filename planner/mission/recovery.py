"""State what a robot does, in which order, while something stands in its way. Table and records.

Laws. The ladder is climbed rung by rung while the robot gets nowhere, and begun anew once it has
come a metre. It is bounded three ways: by its own end, by how often it is begun in a step, and by
the way driven for it. A place is driven up to twice at most in a step; after that it is shut until
the goal ends. Everything here is kept with the goal in the journal, so that a goal which was paused
or crashed goes on with what it knows. Pure: told times, knows no clock.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from math import hypot, inf, pi
from zlib import crc32

from planner.navigation.obstruction import Obstruction
from planner.navigation.route import is_wide
from planner.plan import Frozen
from wire import Pose2


class Recovery(StrEnum):
    """List what may be tried where the way is shut. The names stand in a step's ``recoveries``."""

    WAIT = "wait"
    REROUTE = "reroute"
    LOOK = "look"
    GIVE_WAY = "give_way"
    BACK_OFF = "back_off"
    OTHER_WAY = "other_way"
    TURN_OUT = "turn_out"
    GIVE_UP = "give_up"


@dataclass(frozen=True, slots=True)
class LadderRung:
    """Bound one recovery. Zero where a bound means nothing to it."""

    recovery: Recovery
    seconds: float = 0.0  # a wait lasts so long, anything else no longer
    metres: float = 0.0  # backwards
    speed_mps: float = 0.0
    turns_rad: tuple[float, ...] = ()  # from the heading at the beginning


LADDER = (
    LadderRung(Recovery.WAIT, seconds=3.0),  # most people have gone on by then
    LadderRung(Recovery.GIVE_WAY, seconds=14.0),  # to somebody who walks; else left out
    LadderRung(Recovery.REROUTE, seconds=5.0),
    LadderRung(Recovery.WAIT, seconds=3.0),
    LadderRung(Recovery.LOOK, seconds=3.0, turns_rad=(pi / 2, -pi / 2)),
    LadderRung(Recovery.BACK_OFF, seconds=5.0, metres=0.3, speed_mps=0.1),
    LadderRung(Recovery.OTHER_WAY, seconds=5.0),
    LadderRung(Recovery.WAIT, seconds=3.0),  # the other way is shut, too
    LadderRung(Recovery.GIVE_UP),
)
"""Before a thing 20 s from standing to giving up, of which the robot moves in 10."""

TURN_OUT = LadderRung(Recovery.TURN_OUT, seconds=10.0, turns_rad=(pi / 2,))
"""No rung of the ladder, which nothing in the way has begun: before a sector of the lidar that is
silent the bridge lets the robot turn on the spot. A quarter turn points each silent beam of up to
90 degrees at something else, and 2 s pass before the bridge believes that a turn is asked for."""
NEW_LADDER_M = 1.0
"""Once it has come so far, what stands in the way now is another matter."""
MAX_LADDERS = 12
"""In one step: a busy home shuts a way often, but not for ever."""
MAX_WALKER_LADDERS = 3
"""In a row before somebody who walked up and stands: people go on in the end, and who waits for
them is met again further on. Where people come and go, as at a door in use, the count begins anew
with each who is seen to walk there; how often the ladder is begun in a step is the bound then.
What is as round and wide as a robot, and was not seen to walk, is given as many."""
MAX_GIVEN_WAY = 3
"""In one step."""
WALKER_S = 1.0
"""Somebody who walked up is waited for so long before the robot gives way."""
PASSING_S = 5.0
"""A robot that stands aside is passed by then: three metres at a slow walk."""
MAX_WIDE_LADDERS = 8
"""Before one who is as wide as a robot: it has to turn and to drive off first."""
WIDE_S = (2.0, 8.0)
"""So much longer, at most, before the robot makes way for it, and while it stands aside: by chance,
so that two who meet don't do the same at once again and again. Who leaves a door needs 8 s, and two
that come back within less meet in it again: the second grows from the third ladder on."""
MOST_TIMES = 4
MAX_RECOVERY_M = 24.0
"""Driven for recoveries in one step."""
MAX_VISITS = 2
"""To one obstruction in one step."""
SAME_M = 0.6
"""Obstructions whose middles are nearer to each other than this are one."""
MEMORY_S = 60.0
"""For so long a way that nobody sees is taken for shut; after that it may be tried once more."""
MAX_SHUT = 16
MAX_TOLD = 60


class ShutWay(Frozen):
    """Remember one obstruction: where its near side begins and ends, in ``map`` [m]."""

    start: tuple[float, float]
    end: tuple[float, float]
    since_unix_s: float
    seen_unix_s: float
    local_offset_s: float = 0.0
    """Of people's own clock from UTC."""
    gap: bool = False
    """The map's own walls leave too little room there."""
    moves: bool = False
    """It walked up: it is nothing that shuts a way for long."""
    radius_m: float = 0.0
    """Of the disc that held it while it walked, or that it is; 0: neither is known."""
    ladder: int = 0
    """The ladder on which it was met last."""
    visits: int = 1

    @property
    def obstruction(self) -> Obstruction:
        """Return the line that stands in the way."""
        return Obstruction(self.start, self.end, self.gap)

    def is_shut(self, now_unix_s: float) -> bool:
        """Tell whether routes lead round it now."""
        # Written so that a wall clock that was set back forgets nothing.
        return self.visits >= MAX_VISITS or not now_unix_s - self.seen_unix_s > MEMORY_S


class RecoveryRecord(Frozen):
    """Keep what one step has tried so far."""

    rung: int = 0
    """The rung that is next."""
    ladders: int = 0
    """How often it was begun."""
    metres: float = 0.0
    """What was driven for recoveries."""
    began_at: tuple[float, float] | None = None
    """Where the robot stood when the ladder was begun, in ``map`` [m]."""
    shut: tuple[ShutWay, ...] = ()
    newest: ShutWay | None = None
    """What stood in the way last."""
    climbed_again: int = 0
    """Times that the ladder was begun anew since somebody was last seen to walk there."""
    given_way: int = 0
    """Times that the robot stood aside."""
    turned_out_at: tuple[float, float] | None = None
    """Where it turned before a silent sector last, in ``map`` [m]."""
    approaches: int = 0
    """Times that the goal was found occupied."""
    goal: tuple[float, float] | None = None
    """The goal on which something stood, in ``map`` [m]."""
    goal_moved: tuple[float, float] | None = None
    """Where the leg to it ends instead: chosen once."""

    def aim(self, goal: Pose2) -> Pose2:
        """Return where a leg to this goal is to end."""
        if self.goal_moved is None or self.goal != (goal.x_m, goal.y_m):
            return goal
        return Pose2(*self.goal_moved, goal.yaw_rad)


FRESH = RecoveryRecord()
"""Nothing has stood in the way of the step."""


def rung_of(record: RecoveryRecord) -> LadderRung:
    """Return the rung that is next; beyond the last one, or past a bound, that is to give up."""
    spent = record.ladders > MAX_LADDERS or not record.metres <= MAX_RECOVERY_M
    return LADDER[-1] if spent else LADDER[min(record.rung, len(LADDER) - 1)]


def rung_after(record: RecoveryRecord) -> int:
    """Return the place of the rung after the next one; what can't help is left out.

    Way is given to who walks alone, and looking round finds out nothing about a person.
    """
    walked = may_leave(record)
    place = record.rung + 1
    while place < len(LADDER) - 1:
        recovery = LADDER[place].recovery
        gives = recovery is Recovery.GIVE_WAY and not can_give_way(record)
        looks = recovery is Recovery.LOOK and walked
        stays = passes_m(record) > 0.0 and waits_for_other(record)
        leaves = recovery is Recovery.BACK_OFF and stays
        if not (gives or looks or leaves):
            break
        place += 1
    return place


def wait_s(record: RecoveryRecord) -> float:
    """Return how long the rung that is next waits [s]."""
    rung = rung_of(record)
    gives_way = record.rung == 0 and can_give_way(record)
    return min(rung.seconds, WALKER_S + _by_chance(record)[0]) if gives_way else rung.seconds


def aside_s(record: RecoveryRecord) -> float:
    """Return how long a robot that has made way stands there [s]."""
    return PASSING_S + _by_chance(record)[1]


def passes_m(record: RecoveryRecord) -> float:
    """Return the radius of who is to pass, where that is more than a person; 0: it is not."""
    newest = record.newest
    if newest is None or not may_leave(record) or not is_wide(newest.radius_m):
        return 0.0
    return newest.radius_m


def waits_for_other(record: RecoveryRecord) -> bool:
    """Tell whether the other one may still be about to make way: for one ladder."""
    return record.climbed_again < 1


def _by_chance(record: RecoveryRecord) -> tuple[float, float]:
    """Return what is waited longer before and aside: by where it stood, to a part of a millimetre.

    The pose's own noise is the chance: a reducer told the same does the same.
    """
    if not passes_m(record) > 0.0:
        return 0.0, 0.0
    drawn = crc32(f"{record.began_at} {record.ladders}".encode())
    times = max(1, min(record.ladders - 1, MOST_TIMES))
    return WIDE_S[0] * (drawn & 0xFFFF) / 0xFFFF, times * WIDE_S[1] * (drawn >> 16) / 0xFFFF


def can_give_way(record: RecoveryRecord) -> bool:
    """Tell whether standing aside may help: somebody walked up, and it was not tried too often."""
    return may_leave(record) and record.given_way < MAX_GIVEN_WAY


def may_leave(record: RecoveryRecord) -> bool:
    """Tell whether what stood in the way last walked up, or may be a robot that waits likewise.

    What is as round and wide as a robot is a thing for one ladder, and then made way for: who
    comes upon another one that stands in a door has not seen it walk.
    """
    newest, waited = record.newest, record.climbed_again > 0
    return newest is not None and (newest.moves or (waited and is_wide(newest.radius_m)))


def begin_ladder(record: RecoveryRecord, robot_xy_m: tuple[float, float]) -> RecoveryRecord:
    """Return the record of a robot that is held here: on the same ladder, or at a new one's foot.

    Law: a robot that has come less than a metre since goes on where it was.
    """
    began = record.began_at
    gone_m = hypot(robot_xy_m[0] - began[0], robot_xy_m[1] - began[1]) if began else inf
    if not gone_m >= NEW_LADDER_M:
        return record
    return record.model_copy(
        update={"rung": 0, "ladders": record.ladders + 1, "began_at": robot_xy_m}
    )


def turn_out(record: RecoveryRecord, at_m: tuple[float, float]) -> RecoveryRecord | None:
    """Return the record of a robot that turns before a silent sector; None where it has.

    Law: one turn tells a hole in the lidar from a black thing; a second one there tells no more.
    """
    last = record.turned_out_at
    if last is not None and not hypot(at_m[0] - last[0], at_m[1] - last[1]) >= NEW_LADDER_M:
        return None
    return record.model_copy(update={"turned_out_at": at_m})


def climb_again(record: RecoveryRecord) -> RecoveryRecord | None:
    """Return the record at the ladder's foot, where giving up would be too soon; else None.

    What is waited for shuts no way.
    """
    walked = record.newest is not None and record.newest.moves
    wide = record.newest is not None and is_wide(record.newest.radius_m)
    most = MAX_WIDE_LADDERS if walked and wide else MAX_WALKER_LADDERS
    if not (walked or wide) or record.climbed_again + 1 >= most:
        return None
    spent = record.ladders >= MAX_LADDERS or not record.metres <= MAX_RECOVERY_M
    update = {
        "rung": 0,
        "ladders": record.ladders + 1,
        "climbed_again": record.climbed_again + 1,
        "given_way": 0,
        "shut": tuple(way for way in record.shut if way != record.newest),
    }
    return None if spent else record.model_copy(update=update)


def note_obstruction(
    record: RecoveryRecord,
    seen: Obstruction,
    now_unix_s: float,
    local_offset_s: float = 0.0,
    *,
    moves: bool = False,
    radius_m: float = 0.0,
) -> RecoveryRecord:
    """Remember what stands in the way. A thing that is met again keeps since when it stands.

    Met on another ladder it was visited again: the robot had left it, and came back. Somebody who
    walks shuts no way: they will be elsewhere.

    Args:
        record: what the step has tried so far.
        seen: what stands there now.
        now_unix_s: now.
        local_offset_s: of people's own clock from UTC.
        moves: somebody was seen to walk there within the last seconds.
        radius_m: of who did.
    """
    met = (*record.shut, *((record.newest,) if record.newest is not None else ()))
    known = next((way for way in met if is_same(way.obstruction, seen)), None)
    way = ShutWay(
        start=seen.start,
        end=seen.end,
        since_unix_s=known.since_unix_s if known else now_unix_s,
        seen_unix_s=now_unix_s,
        local_offset_s=local_offset_s,
        gap=seen.gap,
        moves=moves or (known is not None and known.moves),
        radius_m=max(radius_m, known.radius_m if known else 0.0),
        ladder=record.ladders,
        visits=known.visits + (known.ladder != record.ladders) if known else 1,
    )
    others = tuple(w for w in record.shut if not is_same(w.obstruction, seen))
    climbed = 0 if moves else record.climbed_again
    update = {"shut": others, "newest": way, "climbed_again": climbed}
    noted = record.model_copy(update=update)
    if may_leave(noted):
        return noted
    return noted.model_copy(update={"shut": (*others, way)[-MAX_SHUT:]})


def note_open(record: RecoveryRecord, gone: ShutWay) -> RecoveryRecord:
    """Forget a way that was seen open: the next route may lead through it."""
    return record.model_copy(update={"shut": tuple(w for w in record.shut if w != gone)})


def is_same(a: Obstruction, b: Obstruction) -> bool:
    """Tell whether two sights are of one thing."""
    return hypot(a.middle[0] - b.middle[0], a.middle[1] - b.middle[1]) <= SAME_M


def shut_now(record: RecoveryRecord, now_unix_s: float) -> tuple[Obstruction, ...]:
    """Return the ways that routes lead round now."""
    return tuple(way.obstruction for way in record.shut if way.is_shut(now_unix_s))
