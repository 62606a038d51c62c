"""Keep orders, who carries them, and stops in the fleet's database. Each act is one transaction.

"One mission at a robot" is a row of ``fleet_holds``; a mission that waits for one is a row alone.
"""

from __future__ import annotations

import json
import time
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import sqlalchemy as sa

from fleet.errors import FleetError
from fleet.mission_store import MissionStore, select_missions
from fleet.records import CANCELLED, OFFERED, WAITING, MissionRow
from fleet.tables import holds, missions, orders, robots, rooms, stops

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence

    from fleet.addressee import Addressee

MOST_WAITING = 20_000


class FleetStore(MissionStore):
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
        with self.writing() as connection:
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
            change = self.raise_counter(connection)
            for mission_id, who, body, is_urgent in wanted:
                connection.execute(missions.insert().values(
                    id=mission_id, order_id=order_id, text=order, way=who.way, is_urgent=is_urgent,
                    body=json.dumps(body, ensure_ascii=False), names=json.dumps(list(who.names)),
                    state=WAITING, is_sent=False, attempt=1, created_unix_s=now,
                    updated_unix_s=now, change=change,
                ))  # fmt: skip
            return select_missions(connection, missions.c.order_id == order_id)

    def _order_of(
        self, connection: sa.Connection, key: str, body_hash: str
    ) -> list[MissionRow] | None:
        found = connection.execute(sa.select(orders).where(orders.c.key == key)).mappings().first()
        if found is None:
            return None
        if found["body"] != body_hash:
            raise FleetError("idempotency_conflict")
        return select_missions(connection, missions.c.order_id == found["id"])

    def claim(
        self, mission: MissionRow, robot: str, wanted: Collection[str] = ()
    ) -> MissionRow | None:
        """Give a waiting mission its robot, for good, and the rooms for one robot that it wants.

        None: it waits no more, or the robot is busy, or one of the rooms is held by another.
        """
        with self.writing() as connection:
            is_held = sa.select(holds.c.mission).where(holds.c.robot == robot)
            if not mission.is_urgent and connection.execute(is_held).first() is not None:
                return None
            is_taken = sa.select(rooms.c.mission).where(rooms.c.room.in_(list(wanted)))
            if wanted and connection.execute(is_taken).first() is not None:
                return None
            waits = (missions.c.id == mission.id) & (missions.c.state == WAITING)
            values = {"robot": robot, "state": OFFERED, "reason": None}
            if not self.change_where(connection, waits, values):
                return None
            if not mission.is_urgent:
                row = {"robot": robot, "mission": mission.id}
                connection.execute(holds.insert().values(**row))
            for room in wanted:  # all at once, so that no two missions wait for each other
                connection.execute(rooms.insert().values(room=room, mission=mission.id))
            here = robots.c.name == robot
            connection.execute(robots.update().where(here).values(used_seq=mission.seq))
            return select_missions(connection, missions.c.id == mission.id)[0]

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
        with self.writing() as connection:
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
                self.change_where(connection, missions.c.id.in_(ended), values)
        self.forget_stops()
        return ended

    def owe_stop(self, *stop: Any, **more: Any) -> None:
        """Keep a stop that the database did not take; it is noted before anything is offered."""
        self._owed.append((stop, more))

    def unconfirmed_stops(self) -> dict[str, list[str]]:
        """Return the stops that robots have not confirmed, those of a database away included."""
        while self._owed:
            stop, more = self._owed[0]
            self.stop(*stop, **more)
            self.forget_stops()  # one that was noted before is confirmed only now
            with suppress(ValueError):  # another thread was as quick
                self._owed.remove((stop, more))
        return super().unconfirmed_stops()
