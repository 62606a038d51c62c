"""Keep missions in the fleet's database: read, change, take up what their robots tell."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import sqlalchemy as sa

from fleet.errors import FleetError
from fleet.house_store import HouseStore
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
from fleet.tables import counter, holds, missions, robots, rooms

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping


_AT_WORK = (OFFERED, AT_ROBOT, ASKING, UNKNOWN)


class MissionStore(HouseStore):
    """Read and write missions beside the house's rows. Each act is one transaction."""

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
        with self.reading() as connection:
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
        with self.reading() as connection:
            return [mission_row(row) for row in connection.execute(wanted).mappings()]

    def missions_at_robots(self) -> dict[str, str]:
        """Return which mission each busy robot has."""
        with self.reading() as connection:
            return {row.robot: row.mission for row in connection.execute(sa.select(holds))}

    def change_waiting(self, mission_id: str, **values: Any) -> bool:
        """Write fields of a mission that waits for a robot; return whether it does."""
        with self.writing() as connection:
            waits = (missions.c.id == mission_id) & (missions.c.state == WAITING)
            return self.change_where(connection, waits, values)

    def change(self, mission_id: str, **values: Any) -> bool:
        """Write fields of a mission that has not ended; return whether it has not."""
        with self.writing() as connection:
            is_open = (missions.c.id == mission_id) & missions.c.state.not_in(list(ENDED))
            return self.change_where(connection, is_open, values)

    def end(
        self, mission_id: str, state: str, reason: str | None = None, **values: Any
    ) -> MissionRow:
        """End a mission and let its robot go; a second time it changes nothing."""
        with self.writing() as connection:
            is_open = (missions.c.id == mission_id) & missions.c.state.not_in(list(ENDED))
            self.change_where(connection, is_open, {**values, "state": state, "reason": reason})
            connection.execute(holds.delete().where(holds.c.mission == mission_id))
            if values.get("wish") is None:  # else its robot may still be in the room
                connection.execute(rooms.delete().where(rooms.c.mission == mission_id))
            return select_missions(connection, missions.c.id == mission_id)[0]

    def cancel(self, mission_id: str) -> MissionRow:
        """End a mission that still waits, or wish it ended at its robot.

        Raises:
            FleetError: ``unknown_mission`` or ``mission_ended``.
        """
        row = self.mission(mission_id)
        with self.writing() as connection:
            mine = missions.c.id == mission_id
            ended = {"state": CANCELLED, "reason": "cancelled_first"}
            if self.change_where(connection, mine & (missions.c.state == WAITING), ended):
                return select_missions(connection, mine)[0]
            is_open = mine & missions.c.state.not_in(list(ENDED))
            if not self.change_where(connection, is_open, {"wish": "cancel"}):
                raise FleetError("mission_ended", name=row.id, state=row.state)
            return select_missions(connection, mine)[0]

    # What robots tell -----------------------------------------------------------------------------

    def apply_goals(
        self, robot: str, goals: Iterable[Mapping[str, Any]], cursor: int | None = None
    ) -> list[str]:
        """Take up goals as their robot tells them, and its cursor; return the missions' ids."""
        touched = []
        with self.writing() as connection:
            for goal in goals:
                mine = (missions.c.robot == robot) & (missions.c.goal_id == goal["id"])
                for mission in select_missions(connection, mine):
                    if mission.goal_state in GOAL_ENDED and goal["state"] not in GOAL_ENDED:
                        continue  # asked for earlier than what is known; an end is the last word
                    self.change_where(
                        connection, missions.c.id == mission.id, values_of_goal(mission, goal)
                    )
                    touched.append(mission.id)
            if cursor is not None:
                here = robots.c.name == robot
                connection.execute(robots.update().where(here).values(cursor=cursor))
        return touched

    def bind(self, mission_id: str, goal: Mapping[str, Any]) -> None:
        """Write down that a robot's journal has a mission, as this goal."""
        with self.writing() as connection:
            mission = select_missions(connection, missions.c.id == mission_id)[0]
            values = {"goal_id": goal["id"], **values_of_goal(mission, goal)}
            self.change_where(connection, missions.c.id == mission_id, values)

    def mark_lost(self, mission_id: str) -> None:
        """Call a mission unknown whose goal the robot's journal has no more."""
        values = {"state": UNKNOWN, "reason": "goal_lost", "unknown_since_unix_s": self._wall()}
        with self.writing() as connection:
            is_new = (missions.c.id == mission_id) & missions.c.state.in_(_AT_WORK)
            is_new &= missions.c.reason.is_distinct_from("goal_lost")
            self.change_where(connection, is_new, values)

    def mark_silent(self, robot: str, since_unix_s: float) -> list[str]:
        """Call all that a silent robot may be doing unknown; what was never sent is not."""
        with self.writing() as connection:
            there = (missions.c.robot == robot) & missions.c.state.in_(_AT_WORK)
            there &= missions.c.is_sent & (missions.c.state != UNKNOWN)
            found = [mission.id for mission in select_missions(connection, there)]
            values = {"state": UNKNOWN, "unknown_since_unix_s": since_unix_s}
            if found:
                self.change_where(connection, missions.c.id.in_(found), values)
            return found

    def mark_heard(self, robot: str) -> None:
        """Take unknown back: the robot answers, and its journal is asked next."""
        with self.writing() as connection:
            there = (missions.c.robot == robot) & (missions.c.state == UNKNOWN)
            there &= missions.c.reason.is_distinct_from("goal_lost")
            bound = missions.c.goal_id.is_not(None)
            since: dict[str, Any] = {"unknown_since_unix_s": None}
            if select_missions(connection, there):
                self.change_where(connection, there & bound, {**since, "state": AT_ROBOT})
                self.change_where(connection, there & ~bound, {**since, "state": OFFERED})

    def clear_wish(self, mission_id: str) -> None:
        """Note that a robot has heard that a mission is to end."""
        with self.writing() as connection:
            mine = missions.c.id == mission_id
            self.change_where(connection, mine, {"wish": None})
            if select_missions(connection, mine & missions.c.state.in_(list(ENDED))):
                connection.execute(rooms.delete().where(rooms.c.mission == mission_id))

    def is_barred(self, mission: MissionRow) -> bool:
        """Return whether its robot was stopped after a mission was ordered."""
        wanted = sa.select(robots.c.stopped_seq).where(robots.c.name == mission.robot)
        with self.reading() as connection:
            stopped = connection.execute(wanted).scalar()
        return stopped is not None and mission.seq <= stopped

    def _find(self, condition: sa.ColumnElement[bool]) -> list[MissionRow]:
        with self.reading() as connection:
            return select_missions(connection, condition)

    def change_where(
        self, connection: sa.Connection, condition: sa.ColumnElement[bool], values: dict[str, Any]
    ) -> bool:
        """Write fields of all missions that meet a condition; return whether there was one."""
        change = self.raise_counter(connection)
        numbered = {**values, "change": change, "updated_unix_s": self._wall()}
        return bool(
            connection.execute(missions.update().where(condition).values(numbered)).rowcount
        )

    def raise_counter(self, connection: sa.Connection) -> int:
        """Return the number of a change; who raises it is the one writer until the commit."""
        connection.execute(counter.update().values(value=counter.c.value + 1))
        return int(connection.execute(sa.select(counter.c.value)).scalar_one())


def select_missions(
    connection: sa.Connection, condition: sa.ColumnElement[bool]
) -> list[MissionRow]:
    """Return the missions that meet a condition, the oldest first."""
    wanted = sa.select(missions).where(condition).order_by(missions.c.seq)
    return [mission_row(row) for row in connection.execute(wanted).mappings()]
