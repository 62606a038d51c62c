"""Keep robots, what each has confirmed of stops, and what holds for the house.

Each act is one transaction.
"""

from __future__ import annotations

import json
import threading
import time
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import TYPE_CHECKING, Any

import sqlalchemy as sa

from fleet.errors import FleetError
from fleet.house import HouseRules
from fleet.records import RobotRow, robot_row
from fleet.standing import StandingRow, standing_row
from fleet.tables import counter, house, lows, open_database, orders, robots, rooms, standing, stops

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Mapping

STOPS_S = 0.25
"""Another service's stop is seen so much later at most."""
MOST_STANDING = 64


class HouseStore:
    """Read and write robots, stops and what holds for the house."""

    def __init__(self, url: str, wall: Callable[[], float] = time.time) -> None:
        self.engine, self._wall = open_database(url), wall
        self._reader = self.engine.execution_options(is_reading=True)
        self._is_file = self.engine.dialect.name == "sqlite"
        # SQLite's own way to wait for another writer is to sleep, up to 0.1 s at a time.
        self._turn: AbstractContextManager[Any] = (
            threading.Lock() if self._is_file else nullcontext()
        )
        self._stops_lock = threading.Lock()
        self._stops: dict[str, list[str]] = {}
        self._stops_until_s, self._stops_turn = 0.0, 0

    def close(self) -> None:
        """Give the connections back."""
        self.engine.dispose()

    @contextmanager
    def writing(self) -> Iterator[sa.Connection]:
        """Open a transaction that may write: the one writer from its first read to its commit.

        What it reads can't have changed when it writes: a mission that has ended stays ended.
        """
        with self._turn, self.engine.begin() as connection:
            if not self._is_file:  # a file's transaction has begun as the one writer
                connection.execute(sa.select(counter.c.value).with_for_update())
            yield connection

    def reading(self) -> AbstractContextManager[sa.Connection]:
        """Open a transaction that reads: it waits for no writer."""
        return self._reader.begin()

    def robots(self) -> list[RobotRow]:
        """Return all robots by name."""
        with self.reading() as connection:
            found = connection.execute(sa.select(robots).order_by(robots.c.name)).mappings()
            return [robot_row(row) for row in found]

    def keep_robot(self, robot: RobotRow, *, again: bool) -> None:
        """Add a robot, or renew one that is known.

        Raises:
            FleetError: ``robot_known`` without ``again``, or ``name_taken`` by another one.
        """
        names = ("url", "pin_kind", "pin_sha256", "pin_pem", "card", "robot_id")
        card = {name: getattr(robot, name) for name in names}
        with self.writing() as connection:
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

    def unconfirmed_stops(self) -> dict[str, list[str]]:
        """Return of each robot the stops that it has not confirmed.

        They are kept for a moment, for each watch asks with each round; a stop or a confirmation of
        this process is read at once.
        """
        with self._stops_lock:
            turn = self._stops_turn
            if time.monotonic() < self._stops_until_s:
                return self._stops
        wanted = sa.select(stops.c.robot, stops.c.id).where(stops.c.confirmed_unix_s.is_(None))
        found: dict[str, list[str]] = {}
        with self.reading() as connection:
            for row in connection.execute(wanted):
                found.setdefault(row.robot, []).append(row.id)
        with self._stops_lock:
            if turn == self._stops_turn:
                self._stops, self._stops_until_s = found, time.monotonic() + STOPS_S
        return found

    def forget_stops(self) -> None:
        """Read the stops anew the next time: they have changed."""
        with self._stops_lock:
            self._stops_turn += 1
            self._stops_until_s = 0.0

    def confirm_stops(self, heard: Mapping[str, Collection[str]]) -> None:
        """Write down which stops each robot has confirmed, all at once."""
        robots_of: dict[str, list[str]] = {}
        for robot, ids in heard.items():
            for each in ids:
                robots_of.setdefault(each, []).append(robot)
        now = self._wall()
        with self.writing() as connection:
            for each, names in robots_of.items():
                mine = (stops.c.id == each) & stops.c.robot.in_(names)
                connection.execute(stops.update().where(mine).values(confirmed_unix_s=now))
        self.forget_stops()

    def newest_stop(self) -> tuple[str, list[str], list[str]] | None:
        """Return the newest stop's id, with who has confirmed it and who has not."""
        newest = sa.select(stops.c.id).order_by(stops.c.asked_unix_s.desc()).limit(1)
        with self.reading() as connection:
            found = connection.execute(newest).scalar()
        return None if found is None else (found, *self.stop_state(found))

    def stop_state(self, stop_id: str) -> tuple[list[str], list[str]]:
        """Return who has confirmed a stop, and who has not."""
        wanted = sa.select(stops).where(stops.c.id == stop_id).order_by(stops.c.robot)
        with self.reading() as connection:
            rows = connection.execute(wanted).all()
        confirmed = [row.robot for row in rows if row.confirmed_unix_s is not None]
        return confirmed, [row.robot for row in rows if row.confirmed_unix_s is None]

    def newest_change(self) -> int:
        """Return the cursor after which nothing has changed yet."""
        with self.reading() as connection:
            return int(connection.execute(sa.select(counter.c.value)).scalar_one())

    # Rules ----------------------------------------------------------------------------------------

    def rules(self) -> HouseRules:
        """Return the rules of the house; where none were set, those of the start."""
        with self.reading() as connection:
            return _rules(connection)

    def change_rules(self, changes: Mapping[str, Any]) -> HouseRules:
        """Set some of the rules. Raises pydantic's ValidationError: nothing was changed."""
        with self.writing() as connection:
            rules = HouseRules.model_validate({**_rules(connection).model_dump(), **changes})
            row = {"id": 1, "rules": rules.model_dump_json()}
            connection.execute(house.delete())
            connection.execute(house.insert().values(**row))
        return rules

    # Batteries ------------------------------------------------------------------------------------

    def lows(self) -> dict[str, float]:
        """Return the robots that are low on battery, and since when."""
        with self.reading() as connection:
            return {row.robot: row.since_unix_s for row in connection.execute(sa.select(lows))}

    def note_low(self, robot: str, *, low: bool) -> None:
        """Write down that a robot's battery is low, or that it has charged."""
        mine = lows.c.robot == robot
        with self.writing() as connection:
            known = connection.execute(sa.select(lows).where(mine)).first() is not None
            if low and not known:
                connection.execute(lows.insert().values(robot=robot, since_unix_s=self._wall()))
            elif known and not low:
                connection.execute(lows.delete().where(mine))

    def has_order(self, key: str) -> bool:
        """Return whether an order of this key was given."""
        with self.reading() as connection:
            given = sa.select(orders.c.id).where(orders.c.key == key)
            return connection.execute(given).first() is not None

    def rooms_held(self) -> set[str]:
        """Return the rooms for one robot that a mission is in or bound for."""
        with self.reading() as connection:
            return set(connection.execute(sa.select(rooms.c.room)).scalars())

    # Standing orders ------------------------------------------------------------------------------

    def standing_orders(self) -> list[StandingRow]:
        """Return the standing orders, the oldest first."""
        wanted = sa.select(standing).order_by(standing.c.created_unix_s, standing.c.id)
        with self.reading() as connection:
            return [standing_row(row) for row in connection.execute(wanted).mappings()]

    def keep_standing(self, order_id: str, text: str, cron: str, zone: str) -> StandingRow:
        """Keep a standing order, due from now on.

        Raises:
            FleetError: ``standing_full``.
        """
        with self.writing() as connection:
            kept = connection.execute(sa.select(sa.func.count()).select_from(standing)).scalar_one()
            if not kept < MOST_STANDING:
                raise FleetError("standing_full", count=kept)
            now = self._wall()
            row = {"id": order_id, "text": text, "cron": cron, "zone": zone, "skipped": "[]"}
            counted = {"handled_unix_s": now, "created_unix_s": now, "fired": 0, "missed": 0}
            connection.execute(standing.insert().values(**row, **counted))
            return _find(connection, order_id)

    def remove_standing(self, order_id: str) -> StandingRow:
        """Remove a standing order; missions of it that run go on. Raises ``unknown_order``."""
        with self.writing() as connection:
            former = _find(connection, order_id)
            connection.execute(standing.delete().where(standing.c.id == order_id))
            return former

    def skip_standing(self, order_id: str, day: str) -> StandingRow:
        """Leave a day out of a standing order. Raises ``unknown_order``."""
        with self.writing() as connection:
            days = sorted({*_find(connection, order_id).days_skipped, day})[-100:]
            mine = standing.c.id == order_id
            connection.execute(standing.update().where(mine).values(skipped=json.dumps(days)))
            return _find(connection, order_id)

    def note_run(self, order_id: str, until_unix_s: float, told: Mapping[str, Any]) -> None:
        """Write down what came of a run, once: of two services the second changes nothing."""
        count = standing.c.fired if told["code"] == "fired" else standing.c.missed
        counted = {} if told["code"] == "day_skipped" else {count.name: count + 1}
        row = {"handled_unix_s": until_unix_s, "last": json.dumps(told), **counted}
        is_new = (standing.c.id == order_id) & (standing.c.handled_unix_s < until_unix_s)
        self._write(standing.update().where(is_new).values(**row))

    def _write(self, statement: sa.Executable) -> None:
        with self.writing() as connection:
            connection.execute(statement)


def _rules(connection: sa.Connection) -> HouseRules:
    text = connection.execute(sa.select(house.c.rules)).scalar()
    return HouseRules() if text is None else HouseRules.model_validate_json(text)


def _find(connection: sa.Connection, order_id: str) -> StandingRow:
    wanted = sa.select(standing).where(standing.c.id == order_id)
    found = connection.execute(wanted).mappings().first()
    if found is None:
        raise FleetError("unknown_order", name=order_id[:40])
    return standing_row(found)
