"""Keep standing orders and their firings as tables of ``state.sqlite`` (ADR 0036). Judges nothing.

Law: the highest number that an order ever had outlives that order, so no later one takes its place.

The tables are made by the first order that is kept. An order and the firing that changed it are
written in one transaction, on disk before it returns: that makes a firing happen at most once.
Blocks on the disk: never called in the event loop.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import ValidationError

from planner.orders.order import Firing, FiringState, StandingOrder
from wire import ConfigError

if TYPE_CHECKING:
    import sqlite3
    from collections.abc import Iterable

    from planner.state_database import StateDatabase

MOST_FIRINGS = 200
"""Of each order; older ones are forgotten."""
_SCHEMA = """
CREATE TABLE IF NOT EXISTS standing_orders (
    id TEXT PRIMARY KEY, number INTEGER NOT NULL, record TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS firings (
    standing_order TEXT NOT NULL, serial INTEGER NOT NULL, open INTEGER NOT NULL,
    record TEXT NOT NULL, PRIMARY KEY (standing_order, serial)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS order_facts (name TEXT PRIMARY KEY, value REAL NOT NULL) WITHOUT ROWID;
"""
_MARK_NUMBER = """
REPLACE INTO order_facts SELECT 'last_number', MAX(
    COALESCE((SELECT value FROM order_facts WHERE name = 'last_number'), 0),
    COALESCE((SELECT MAX(number) FROM standing_orders), 0))
"""
_OPEN = (FiringState.BEGUN, FiringState.GIVEN)
_SAME = (FiringState.MISSED, FiringState.QUIET)


class OrderStore:
    """Be the tables."""

    def __init__(self, database: StateDatabase) -> None:
        """Say in which database."""
        self._database = database

    def load(self) -> tuple[tuple[StandingOrder, ...], tuple[Firing, ...], float, int]:
        """Return the orders, the firings whose end is not known, how far the clock once was, and
        the highest number that an order ever had.

        Raises:
            ConfigError: ``orders_malformed``: a record is not one of ours.
            StateUnavailable: it can't be read.
        """
        if not self._database.read("SELECT 1 FROM sqlite_master WHERE name = 'standing_orders'"):
            return (), (), 0.0, 0
        rows = self._database.read("SELECT record FROM standing_orders ORDER BY number")
        open_ = self._database.read("SELECT record FROM firings WHERE open = 1")
        facts = dict(self._database.read("SELECT name, value FROM order_facts"))
        try:
            orders = tuple(StandingOrder.model_validate_json(record) for (record,) in rows)
            firings = tuple(Firing.model_validate_json(record) for (record,) in open_)
        except ValidationError as error:
            raise ConfigError("orders_malformed", str(error).splitlines()[0]) from None
        highest = max((order.number for order in orders), default=0)  # all that old tables tell
        number = max(highest, int(facts.get("last_number", 0)))
        return orders, firings, float(facts.get("seen_unix_s", 0.0)), number

    def keep(
        self,
        orders: Iterable[StandingOrder],
        firings: Iterable[Firing] = (),
        seen_unix_s: float | None = None,
    ) -> tuple[Firing, ...]:
        """Write orders and firings in one transaction; what is missed in a row is one entry.

        Args:
            orders: as they are by now.
            firings: of these orders, oldest first.
            seen_unix_s: how far the clock is, where that is to be written.

        Returns:
            The firings as they are kept: with the count of those before that came to the same.

        Raises:
            StateUnavailable: it can't be written; nothing has changed.
        """
        with self._database.change() as connection:
            for statement in filter(str.strip, _SCHEMA.split(";")):
                connection.execute(statement)
            for order in orders:
                connection.execute(
                    "REPLACE INTO standing_orders VALUES (?, ?, ?)",
                    (order.id, order.number, order.model_dump_json()),
                )
            connection.execute(_MARK_NUMBER)
            if seen_unix_s is not None:
                _see(connection, seen_unix_s)
            return tuple(_put(connection, firing) for firing in firings)

    def see(self, unix_s: float) -> None:
        """Write how far the clock is.

        Raises:
            StateUnavailable: it can't be written.
        """
        with self._database.change(sync=False) as connection:
            for statement in filter(str.strip, _SCHEMA.split(";")):
                connection.execute(statement)
            _see(connection, unix_s)

    def remove(self, order_id: str) -> None:
        """Forget an order and its firings.

        Raises:
            StateUnavailable: it can't be written.
        """
        with self._database.change() as connection:
            connection.execute(_MARK_NUMBER)  # older programs marked none as they kept it
            connection.execute("DELETE FROM standing_orders WHERE id = ?", (order_id,))
            connection.execute("DELETE FROM firings WHERE standing_order = ?", (order_id,))

    def history(self, order_id: str, most: int) -> tuple[Firing, ...]:
        """Return the newest firings of an order, newest first.

        Raises:
            StateUnavailable: it can't be read.
        """
        return self._firings("WHERE standing_order = ? ORDER BY serial DESC", order_id, most)

    def newest(self, most: int) -> tuple[Firing, ...]:
        """Return the newest firings of all orders, newest first.

        Raises:
            StateUnavailable: it can't be read.
        """
        return self._firings("ORDER BY json_extract(record, '$.at_unix_s') DESC", most)

    def _firings(self, clauses: str, *values: str | int) -> tuple[Firing, ...]:
        if not self._database.read("SELECT 1 FROM sqlite_master WHERE name = 'firings'"):
            return ()
        rows = self._database.read(f"SELECT record FROM firings {clauses} LIMIT ?", values)
        return tuple(Firing.model_validate_json(record) for (record,) in rows)


def _see(connection: sqlite3.Connection, unix_s: float) -> None:
    connection.execute("REPLACE INTO order_facts VALUES ('seen_unix_s', ?)", (unix_s,))


def _put(connection: sqlite3.Connection, firing: Firing) -> Firing:
    newest = connection.execute(
        "SELECT serial, record FROM firings WHERE standing_order = ? AND serial < ?"
        " ORDER BY serial DESC LIMIT 1",
        (firing.order, firing.serial),
    ).fetchone()
    if newest is not None and firing.state in _SAME:
        before = Firing.model_validate_json(newest[1])
        if (before.state, before.reason) == (firing.state, firing.reason):
            connection.execute(
                "DELETE FROM firings WHERE standing_order = ? AND serial = ?",
                (firing.order, newest[0]),
            )
            last_s = firing.until_unix_s or firing.due_unix_s
            firing = firing.model_copy(
                update={
                    "due_unix_s": before.due_unix_s,
                    "count": before.count + firing.count,
                    "until_unix_s": last_s,
                }
            )
    is_open = int(firing.state in _OPEN)
    row = (firing.order, firing.serial, is_open, firing.model_dump_json())
    connection.execute("REPLACE INTO firings VALUES (?, ?, ?, ?)", row)
    connection.execute(
        "DELETE FROM firings WHERE standing_order = ? AND serial <= ? AND open = 0",
        (firing.order, firing.serial - MOST_FIRINGS),
    )
    return firing
