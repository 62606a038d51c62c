"""Keep the house's rules, rooms for one robot, low batteries and standing orders."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import sqlalchemy as sa

from fleet.errors import FleetError
from fleet.house import HouseRules
from fleet.robot_store import RobotStore
from fleet.standing import StandingRow, standing_row
from fleet.tables import house, lows, orders, rooms, standing

if TYPE_CHECKING:
    from collections.abc import Mapping

MOST_STANDING = 64


class HouseStore(RobotStore):
    """Read and write what holds for the house beside the robots' rows."""

    def rules(self) -> HouseRules:
        """Return the rules of the house; where none were set, those of the start."""
        with self.engine.begin() as connection:
            return _rules(connection)

    def change_rules(self, changes: Mapping[str, Any]) -> HouseRules:
        """Set some of the rules. Raises pydantic's ValidationError: nothing was changed."""
        with self.engine.begin() as connection:
            rules = HouseRules.model_validate({**_rules(connection).model_dump(), **changes})
            row = {"id": 1, "rules": rules.model_dump_json()}
            connection.execute(house.delete())
            connection.execute(house.insert().values(**row))
        return rules

    # Batteries ------------------------------------------------------------------------------------

    def lows(self) -> dict[str, float]:
        """Return the robots that are low on battery, and since when."""
        with self.engine.begin() as connection:
            return {row.robot: row.since_unix_s for row in connection.execute(sa.select(lows))}

    def note_low(self, robot: str, *, low: bool) -> None:
        """Write down that a robot's battery is low, or that it has charged."""
        mine = lows.c.robot == robot
        with self.engine.begin() as connection:
            known = connection.execute(sa.select(lows).where(mine)).first() is not None
            if low and not known:
                connection.execute(lows.insert().values(robot=robot, since_unix_s=self._wall()))
            elif known and not low:
                connection.execute(lows.delete().where(mine))

    def has_order(self, key: str) -> bool:
        """Return whether an order of this key was given."""
        with self.engine.begin() as connection:
            given = sa.select(orders.c.id).where(orders.c.key == key)
            return connection.execute(given).first() is not None

    def rooms_held(self) -> set[str]:
        """Return the rooms for one robot that a mission is in or bound for."""
        with self.engine.begin() as connection:
            return set(connection.execute(sa.select(rooms.c.room)).scalars())

    # Standing orders ------------------------------------------------------------------------------

    def standing_orders(self) -> list[StandingRow]:
        """Return the standing orders, the oldest first."""
        wanted = sa.select(standing).order_by(standing.c.created_unix_s, standing.c.id)
        with self.engine.begin() as connection:
            return [standing_row(row) for row in connection.execute(wanted).mappings()]

    def keep_standing(self, order_id: str, text: str, cron: str, zone: str) -> StandingRow:
        """Keep a standing order, due from now on.

        Raises:
            FleetError: ``standing_full``.
        """
        with self.engine.begin() as connection:
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
        with self.engine.begin() as connection:
            former = _find(connection, order_id)
            connection.execute(standing.delete().where(standing.c.id == order_id))
            return former

    def skip_standing(self, order_id: str, day: str) -> StandingRow:
        """Leave a day out of a standing order. Raises ``unknown_order``."""
        with self.engine.begin() as connection:
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


def _rules(connection: sa.Connection) -> HouseRules:
    text = connection.execute(sa.select(house.c.rules)).scalar()
    return HouseRules() if text is None else HouseRules.model_validate_json(text)


def _find(connection: sa.Connection, order_id: str) -> StandingRow:
    wanted = sa.select(standing).where(standing.c.id == order_id)
    found = connection.execute(wanted).mappings().first()
    if found is None:
        raise FleetError("unknown_order", name=order_id[:40])
    return standing_row(found)
