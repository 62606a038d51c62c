"""Keep robots, missions, holds and stops in the fleet's database. Each act is one transaction.

"One mission at a robot" is a row of ``fleet_holds``; a mission that waits for one is a row alone.
"""

from __future__ import annotations

import json
import time
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import sqlalchemy as sa

from fleet.errors import FleetError
from fleet.records import (
    ASKING,
    AT_ROBOT,
    CANCELLED,
    ENDED,
    GIVEN_UP,
    GOAL_ENDED,
    OFFERED,
    UNKNOWN,
    WAITING,
    MissionRow,
    mission_row,
    values_of_goal,
)
from fleet.robot_store import RobotStore
from fleet.tables import counter, holds, missions, orders, robots, stops

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

    from fleet.addressee import Addressee

MOST_WAITING = 20_000
_AT_WORK = (OFFERED, AT_ROBOT, ASKING, UNKNOWN)


class FleetStore(RobotStore):
    """Read and write missions, holds and stops beside the robots' rows."""

    def __init__(self, url: str, wall: Callable[[], float] = time.time) -> None:
        super().__init__(url, wall)
        self._owed: list[tuple[Any, Any]] = []

    # Orders ---------------------------------------------------------------------------------------

    def accept(
        self,
        order_id: str,
        text: str,
        body_hash: str,
        key: str | None,
        wanted: Sequence[tuple[str, Addressee, dict[str, Any], bool]],
        order: str,
    ) -> list[MissionRow]:
        """Write an order and its missions down, or return those that the same key made before.

        Args:
            order_id: of the order.
            text: as it was said.
            body_hash: of the request.
            key: of the request, where it has one.
            wanted: of each mission its id, who may go, what is offered, and whether it is urgent.
            order: what is left of the text for the robot.

        Raises:
            FleetError: ``idempotency_conflict`` or ``queue_full``.
        """
        with self.engine.begin() as connection:
            if key is not None and (former := self._order_of(connection, key, body_hash)):
                return former
            count = connection.execute(
                sa.select(sa.func.count()).where(missions.c.state == WAITING)
            ).scalar_one()
            if not count + len(wanted) <= MOST_WAITING:
                raise FleetError("queue_full", count=count)
            now = self._wall()
            row = {"id": order_id, "key": key, "body": body_hash, "text": text}
            connection.execute(orders.insert().values(**row, created_unix_s=now))
            change = self._raise_counter(connection)
            for mission_id, who, body, is_urgent in wanted:
                connection.execute(missions.insert().values(
                    id=mission_id, order_id=order_id, text=order, way=who.way, is_urgent=is_urgent,
                    body=json.dumps(body, ensure_ascii=False), names=json.dumps(list(who.names)),
                    state=WAITING, is_sent=False, attempt=1, created_unix_s=now,
                    updated_unix_s=now, change=change,
                ))  # fmt: skip
            return _select(connection, missions.c.order_id == order_id)

    def _order_of(
        self, connection: sa.Connection, key: str, body_hash: str
    ) -> list[MissionRow] | None:
        found = connection.execute(sa.select(orders).where(orders.c.key == key)).mappings().first()
        if found is None:
            return None
        if found["body"] != body_hash:
            raise FleetError("idempotency_conflict")
        return _select(connection, missions.c.order_id == found["id"])

    def claim(self, mission: MissionRow, robot: str) -> MissionRow | None:
        """Give a waiting mission its robot, for good; None: it waits no more, or that is busy."""
        with self.engine.begin() as connection:
            self._raise_counter(connection)  # one writer at a time from here on
            is_held = sa.select(holds.c.mission).where(holds.c.robot == robot)
            if not mission.is_urgent and connection.execute(is_held).first() is not None:
                return None
            waits = (missions.c.id == mission.id) & (missions.c.state == WAITING)
            values = {"robot": robot, "state": OFFERED, "reason": None}
            if not self._change(connection, waits, values):
                return None
            if not mission.is_urgent:
                row = {"robot": robot, "mission": mission.id}
                connection.execute(holds.insert().values(**row))
            here = robots.c.name == robot
            connection.execute(robots.update().where(here).values(used_seq=mission.seq))
            return _select(connection, missions.c.id == mission.id)[0]

    # Missions -------------------------------------------------------------------------------------

    def mission(self, mission_id: str) -> MissionRow:
        """Return one mission.

        Raises:
            FleetError: ``unknown_mission``.
        """
        found = self._find(missions.c.id == mission_id)
        if not found:
            raise FleetError("unknown_mission", name=mission_id[:64])
        return found[0]

    def waiting(self) -> list[MissionRow]:
        """Return missions that wait for a robot, the oldest first."""
        return self._find(missions.c.state == WAITING)

    def at_work(self, robot: str | None = None) -> list[MissionRow]:
        """Return missions that have a robot and have not ended; of one robot, or of all."""
        ours = sa.true() if robot is None else missions.c.robot == robot
        return self._find(missions.c.state.in_(_AT_WORK) & ours)

    def withdrawals(self, robot: str) -> list[MissionRow]:
        """Return missions that a person ended while their robot was silent: it is yet to hear."""
        return self._find(
            (missions.c.robot == robot)
            & (missions.c.state == GIVEN_UP)
            & missions.c.wish.is_not(None)
        )

    def changed_since(self, cursor: int, limit: int) -> tuple[list[MissionRow], int]:
        """Return missions that changed after a cursor, the change of longest ago first."""
        with self.engine.begin() as connection:
            newest = connection.execute(sa.select(counter.c.value)).scalar_one()
            wanted = sa.select(missions).where(missions.c.change > cursor)
            wanted = wanted.order_by(missions.c.change, missions.c.seq)
            found = [mission_row(row) for row in connection.execute(wanted).mappings()]
        shown = found[:limit]  # a change of many missions is never cut in two
        shown += [row for row in found[limit:] if row.change == shown[-1].change]
        return shown, shown[-1].change if len(found) > len(shown) else max(newest, cursor)

    def newest(self, limit: int) -> list[MissionRow]:
        """Return missions, those that are open first, then the newest."""
        open_first = sa.case((missions.c.state.in_(list(ENDED)), 1), else_=0)
        wanted = sa.select(missions).order_by(open_first, missions.c.seq.desc()).limit(limit)
        with self.engine.begin() as connection:
            return [mission_row(row) for row in connection.execute(wanted).mappings()]

    def missions_at_robots(self) -> dict[str, str]:
        """Return which mission each busy robot has."""
        with self.engine.begin() as connection:
            return {row.robot: row.mission for row in connection.execute(sa.select(holds))}

    def change(self, mission_id: str, **values: Any) -> bool:
        """Write fields of a mission that has not ended; return whether it has not."""
        with self.engine.begin() as connection:
            is_open = (missions.c.id == mission_id) & missions.c.state.not_in(list(ENDED))
            return self._change(connection, is_open, values)

    def end(
        self, mission_id: str, state: str, reason: str | None = None, **values: Any
    ) -> MissionRow:
        """End a mission and let its robot go; a second time it changes nothing."""
        with self.engine.begin() as connection:
            is_open = (missions.c.id == mission_id) & missions.c.state.not_in(list(ENDED))
            self._change(connection, is_open, {**values, "state": state, "reason": reason})
            connection.execute(holds.delete().where(holds.c.mission == mission_id))
            return _select(connection, missions.c.id == mission_id)[0]

    def cancel(self, mission_id: str) -> MissionRow:
        """End a mission that still waits, or wish it ended at its robot.

        Raises:
            FleetError: ``unknown_mission`` or ``mission_ended``.
        """
        row = self.mission(mission_id)
        with self.engine.begin() as connection:
            mine = missions.c.id == mission_id
            ended = {"state": CANCELLED, "reason": "cancelled_first"}
            if self._change(connection, mine & (missions.c.state == WAITING), ended):
                return _select(connection, mine)[0]
            is_open = mine & missions.c.state.not_in(list(ENDED))
            if not self._change(connection, is_open, {"wish": "cancel"}):
                raise FleetError("mission_ended", name=row.id, state=row.state)
            return _select(connection, mine)[0]

    # What robots tell -----------------------------------------------------------------------------

    def apply_goals(
        self, robot: str, goals: Iterable[Mapping[str, Any]], cursor: int | None = None
    ) -> list[str]:
        """Take up goals as their robot tells them, and its cursor; return the missions' ids."""
        touched = []
        with self.engine.begin() as connection:
            for goal in goals:
                mine = (missions.c.robot == robot) & (missions.c.goal_id == goal["id"])
                for mission in _select(connection, mine):
                    if mission.goal_state in GOAL_ENDED and goal["state"] not in GOAL_ENDED:
                        continue  # asked for earlier than what is known; an end is the last word
                    self._change(
                        connection, missions.c.id == mission.id, values_of_goal(mission, goal)
                    )
                    touched.append(mission.id)
            if cursor is not None:
                here = robots.c.name == robot
                connection.execute(robots.update().where(here).values(cursor=cursor))
        return touched

    def bind(self, mission_id: str, goal: Mapping[str, Any]) -> None:
        """Write down that a robot's journal has a mission, as this goal."""
        with self.engine.begin() as connection:
            mission = _select(connection, missions.c.id == mission_id)[0]
            values = {"goal_id": goal["id"], **values_of_goal(mission, goal)}
            self._change(connection, missions.c.id == mission_id, values)

    def mark_lost(self, mission_id: str) -> None:
        """Call a mission unknown whose goal the robot's journal has no more."""
        values = {"state": UNKNOWN, "reason": "goal_lost", "unknown_since_unix_s": self._wall()}
        with self.engine.begin() as connection:
            is_new = (missions.c.id == mission_id) & missions.c.state.in_(_AT_WORK)
            is_new &= missions.c.reason.is_distinct_from("goal_lost")
            self._change(connection, is_new, values)

    def mark_silent(self, robot: str, since_unix_s: float) -> list[str]:
        """Call all that a silent robot may be doing unknown; what was never sent is not."""
        with self.engine.begin() as connection:
            there = (missions.c.robot == robot) & missions.c.state.in_(_AT_WORK)
            there &= missions.c.is_sent & (missions.c.state != UNKNOWN)
            found = [mission.id for mission in _select(connection, there)]
            values = {"state": UNKNOWN, "unknown_since_unix_s": since_unix_s}
            if found:
                self._change(connection, missions.c.id.in_(found), values)
            return found

    def mark_heard(self, robot: str) -> None:
        """Take unknown back: the robot answers, and its journal is asked next."""
        with self.engine.begin() as connection:
            there = (missions.c.robot == robot) & (missions.c.state == UNKNOWN)
            there &= missions.c.reason.is_distinct_from("goal_lost")
            bound = missions.c.goal_id.is_not(None)
            since: dict[str, Any] = {"unknown_since_unix_s": None}
            if _select(connection, there):
                self._change(connection, there & bound, {**since, "state": AT_ROBOT})
                self._change(connection, there & ~bound, {**since, "state": OFFERED})

    def clear_wish(self, mission_id: str) -> None:
        """Note that a robot has heard that a mission is to end."""
        with self.engine.begin() as connection:
            self._change(connection, missions.c.id == mission_id, {"wish": None})

    def is_barred(self, mission: MissionRow) -> bool:
        """Return whether its robot was stopped after a mission was ordered."""
        wanted = sa.select(robots.c.stopped_seq).where(robots.c.name == mission.robot)
        with self.engine.begin() as connection:
            stopped = connection.execute(wanted).scalar()
        return stopped is not None and mission.seq <= stopped

    # Stops ----------------------------------------------------------------------------------------

    def stop(
        self, stop_id: str, names: Collection[str], *, forever: bool, heard: Collection[str] = ()
    ) -> list[str]:
        """Note a stop to be confirmed by these, and bar what was ordered before; return what ended.

        Args:
            stop_id: of the stop; one that is noted is left as it is.
            names: of the robots.
            forever: whether these are all: what waits for anyone then ends too.
            heard: who has confirmed it already.
        """
        with self.engine.begin() as connection:
            if connection.execute(sa.select(stops).where(stops.c.id == stop_id)).first():
                here = (stops.c.id == stop_id) & stops.c.robot.in_(list(heard))
                connection.execute(stops.update().where(here).values(confirmed_unix_s=self._wall()))
                return []
            now = self._wall()
            newest = connection.execute(sa.select(sa.func.max(missions.c.seq))).scalar() or 0
            for name in names:
                row = {"id": stop_id, "robot": name, "asked_unix_s": now}
                at = now if name in heard else None
                connection.execute(stops.insert().values(**row, confirmed_unix_s=at))
            mine = robots.c.name.in_(list(names))
            connection.execute(robots.update().where(mine).values(stopped_seq=newest))
            wait = sa.select(missions.c.id, missions.c.names).where(missions.c.state == WAITING)
            ended = [each for each, to in connection.execute(wait)
                     if (set(json.loads(to)) <= set(names) if to != "[]" else forever)]  # fmt: skip
            values = {"state": CANCELLED, "reason": "stopped_first"}
            if ended:  # at once: thousands may wait, and a stop does not
                self._change(connection, missions.c.id.in_(ended), values)
        self.forget_stops()
        return ended

    def owe_stop(self, *stop: Any, **more: Any) -> None:
        """Keep a stop that the database did not take; it is noted before anything is offered."""
        self._owed.append((stop, more))

    def unconfirmed_stops(self, robot: str) -> list[str]:
        """Return the stops that a robot has not confirmed, those of a database away included."""
        while self._owed:
            stop, more = self._owed[0]
            self.stop(*stop, **more)
            with suppress(ValueError):  # another thread was as quick
                self._owed.remove((stop, more))
        return super().unconfirmed_stops(robot)

    # ----------------------------------------------------------------------------------------------

    def _find(self, condition: sa.ColumnElement[bool]) -> list[MissionRow]:
        with self.engine.begin() as connection:
            return _select(connection, condition)

    def _change(
        self, connection: sa.Connection, condition: sa.ColumnElement[bool], values: dict[str, Any]
    ) -> bool:
        change = self._raise_counter(connection)
        numbered = {**values, "change": change, "updated_unix_s": self._wall()}
        return bool(
            connection.execute(missions.update().where(condition).values(numbered)).rowcount
        )

    def _raise_counter(self, connection: sa.Connection) -> int:
        connection.execute(counter.update().values(value=counter.c.value + 1))
        return int(connection.execute(sa.select(counter.c.value)).scalar_one())


def _select(connection: sa.Connection, condition: sa.ColumnElement[bool]) -> list[MissionRow]:
    wanted = sa.select(missions).where(condition).order_by(missions.c.seq)
    return [mission_row(row) for row in connection.execute(wanted).mappings()]
