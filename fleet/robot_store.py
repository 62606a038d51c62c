"""Keep robots and what each has confirmed of stops. Each act is one transaction."""

from __future__ import annotations

import json
import threading
import time
from typing import TYPE_CHECKING, Any

import sqlalchemy as sa

from fleet.errors import FleetError
from fleet.records import RobotRow, robot_row
from fleet.tables import counter, open_database, robots, stops

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping

STOPS_S = 0.25
"""Another service's stop is seen so much later at most."""


class RobotStore:
    """Read and write robots."""

    def __init__(self, url: str, wall: Callable[[], float] = time.time) -> None:
        self.engine, self._wall = open_database(url), wall
        self._stops_lock = threading.Lock()
        self._stops: dict[str, list[str]] = {}
        self._stops_until_s, self._stops_turn = 0.0, 0

    def close(self) -> None:
        """Give the connections back."""
        self.engine.dispose()

    def robots(self) -> list[RobotRow]:
        """Return all robots by name."""
        with self.engine.begin() as connection:
            found = connection.execute(sa.select(robots).order_by(robots.c.name)).mappings()
            return [robot_row(row) for row in found]

    def keep_robot(self, robot: RobotRow, *, again: bool) -> None:
        """Add a robot, or renew one that is known.

        Raises:
            FleetError: ``robot_known`` without ``again``, or ``name_taken`` by another one.
        """
        names = ("url", "pin_kind", "pin_sha256", "pin_pem", "card", "robot_id")
        card = {name: getattr(robot, name) for name in names}
        with self.engine.begin() as connection:
            for row in connection.execute(sa.select(robots)).mappings():
                known = robot_row(row)
                pinned = bool(robot.pin_sha256) and known.pin_sha256 == robot.pin_sha256
                is_same = known.url == robot.url or (pinned and known.robot_id == robot.robot_id)
                if is_same and not (again and known.name == robot.name):
                    raise FleetError("robot_known", name=known.name)
                if not is_same and known.name.casefold() == robot.name.casefold() and not again:
                    raise FleetError("name_taken", name=known.name)
            here = robots.c.name == robot.name
            done = connection.execute(robots.update().where(here).values(**card))
            if not done.rowcount:
                new = {"name": robot.name, "cursor": 0, "stopped_seq": 0, "used_seq": 0}
                made = {**new, **card, "added_unix_s": self._wall()}
                connection.execute(robots.insert().values(**made))

    def update_card(self, name: str, card: Mapping[str, Any]) -> None:
        """Keep what a robot tells of itself now."""
        text = json.dumps(card, ensure_ascii=False)
        self._write(robots.update().where(robots.c.name == name).values(card=text))

    def unconfirmed_stops(self, robot: str) -> list[str]:
        """Return the stops that a robot has not confirmed.

        All robots' are read at once and kept for a moment, for each watch asks twice a second; a
        stop or a confirmation of this process is read at once.
        """
        with self._stops_lock:
            turn = self._stops_turn
            if time.monotonic() < self._stops_until_s:
                return list(self._stops.get(robot, ()))
        wanted = sa.select(stops.c.robot, stops.c.id).where(stops.c.confirmed_unix_s.is_(None))
        found: dict[str, list[str]] = {}
        with self.engine.begin() as connection:
            for row in connection.execute(wanted):
                found.setdefault(row.robot, []).append(row.id)
        with self._stops_lock:
            if turn == self._stops_turn:
                self._stops, self._stops_until_s = found, time.monotonic() + STOPS_S
        return found.get(robot, [])

    def forget_stops(self) -> None:
        """Read the stops anew the next time: they have changed."""
        with self._stops_lock:
            self._stops_turn += 1
            self._stops_until_s = 0.0

    def confirm_stops(self, heard: Mapping[str, Collection[str]]) -> None:
        """Write down which stops each robot has confirmed, all at once."""
        now = self._wall()
        with self.engine.begin() as connection:
            for robot, ids in heard.items():
                mine = (stops.c.robot == robot) & stops.c.id.in_(list(ids))
                connection.execute(stops.update().where(mine).values(confirmed_unix_s=now))
        self.forget_stops()

    def stop_state(self, stop_id: str) -> tuple[list[str], list[str]]:
        """Return who has confirmed a stop, and who has not."""
        wanted = sa.select(stops).where(stops.c.id == stop_id).order_by(stops.c.robot)
        with self.engine.begin() as connection:
            rows = connection.execute(wanted).all()
        confirmed = [row.robot for row in rows if row.confirmed_unix_s is not None]
        return confirmed, [row.robot for row in rows if row.confirmed_unix_s is None]

    def newest_change(self) -> int:
        """Return the cursor after which nothing has changed yet."""
        with self.engine.begin() as connection:
            return int(connection.execute(sa.select(counter.c.value)).scalar_one())

    def _write(self, statement: sa.Executable) -> None:
        with self.engine.begin() as connection:
            connection.execute(statement)
