"""Describe the fleet's tables and open their database: an SQLite file, or Postgres by a URL.

A database of an older version is brought up to these tables, one of a newer version is refused. A
new table, or a column that may be empty or has a default of the server's, is added at the start.
Whoever adds one raises ``VERSION``. A change that is more than that is to be done in steps of such.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import sqlalchemy as sa
from sqlalchemy import event
from sqlalchemy.schema import CreateColumn

from wire import ConfigError

if TYPE_CHECKING:
    from collections.abc import Iterable

VERSION = 2
"""Of the tables; a database that knows a higher one has been used by a newer Pons."""
_ONE_AT_A_TIME = 0x504F4E54
"""Of Postgres' advisory locks: of services that start at once one makes the tables."""

metadata = sa.MetaData()

robots = sa.Table(
    "fleet_robots",
    metadata,
    sa.Column("name", sa.String(32), primary_key=True),
    sa.Column("url", sa.Text, nullable=False),
    sa.Column("robot_id", sa.String(64), nullable=False),
    sa.Column("pin_kind", sa.String(16), nullable=False),  # authority, leaf; none: on loopback
    sa.Column("pin_sha256", sa.String(64), nullable=False),
    sa.Column("pin_pem", sa.Text, nullable=False),
    sa.Column("card", sa.Text, nullable=False),
    sa.Column("cursor", sa.BigInteger, nullable=False, default=0),
    sa.Column("stopped_seq", sa.BigInteger, nullable=False, default=0),  # missions up to it stay
    sa.Column("used_seq", sa.BigInteger, nullable=False, default=0),  # the newest mission it got
    sa.Column("added_unix_s", sa.Float, nullable=False),
)
orders = sa.Table(
    "fleet_orders",
    metadata,
    sa.Column("id", sa.String(32), primary_key=True),
    sa.Column("key", sa.String(200), unique=True),
    sa.Column("body", sa.String(64), nullable=False),  # SHA-256 of the request
    sa.Column("text", sa.Text, nullable=False),
    sa.Column("created_unix_s", sa.Float, nullable=False),
)
missions = sa.Table(
    "fleet_missions",
    metadata,
    sa.Column("seq", sa.BigInteger().with_variant(sa.Integer, "sqlite"), primary_key=True),
    sa.Column("id", sa.String(64), nullable=False, unique=True),  # the key at the robot
    sa.Column("order_id", sa.String(32), nullable=False, index=True),
    sa.Column("text", sa.Text, nullable=False),
    sa.Column("body", sa.Text, nullable=False),  # as it is offered, each time the same
    sa.Column("way", sa.String(16), nullable=False),
    sa.Column("names", sa.Text, nullable=False),  # of the robots that may go; empty: any
    sa.Column("is_urgent", sa.Boolean, nullable=False),
    sa.Column("state", sa.String(16), nullable=False, index=True),
    sa.Column("reason", sa.String(64)),
    sa.Column("robot", sa.String(32), index=True),
    sa.Column("is_sent", sa.Boolean, nullable=False, default=False),
    sa.Column("wish", sa.String(16)),  # cancel: to be told to the robot until it confirms
    sa.Column("goal_id", sa.String(64), index=True),
    sa.Column("goal_state", sa.String(32)),
    sa.Column("question", sa.Text),
    sa.Column("outcome", sa.Text),
    sa.Column("unknown_since_unix_s", sa.Float),
    sa.Column("attempt", sa.Integer, nullable=False, default=1),
    sa.Column("created_unix_s", sa.Float, nullable=False),
    sa.Column("updated_unix_s", sa.Float, nullable=False),
    sa.Column("change", sa.BigInteger, nullable=False, index=True),
    sqlite_autoincrement=True,
)
holds = sa.Table(
    "fleet_holds",
    metadata,
    sa.Column("robot", sa.String(32), primary_key=True),
    sa.Column("mission", sa.String(64), nullable=False, unique=True),
)
rooms = sa.Table(
    "fleet_rooms",
    metadata,
    sa.Column("room", sa.String(140), primary_key=True),  # home/id, of those for one robot
    sa.Column("mission", sa.String(64), nullable=False, index=True),
)
house = sa.Table(
    "fleet_house",
    metadata,
    sa.Column("id", sa.Integer, primary_key=True),
    sa.Column("rules", sa.Text, nullable=False),
)
lows = sa.Table(
    "fleet_lows",
    metadata,
    sa.Column("robot", sa.String(32), primary_key=True),  # low on battery until it has charged
    sa.Column("since_unix_s", sa.Float, nullable=False),
)
standing = sa.Table(
    "fleet_standing",
    metadata,
    sa.Column("id", sa.String(16), primary_key=True),
    sa.Column("text", sa.Text, nullable=False),
    sa.Column("cron", sa.String(120), nullable=False),
    sa.Column("zone", sa.String(64), nullable=False),
    sa.Column("skipped", sa.Text, nullable=False),  # days that are left out, as JSON
    sa.Column("handled_unix_s", sa.Float, nullable=False),  # runs up to it are done or told
    sa.Column("last", sa.Text),  # what came of the newest run, as JSON
    sa.Column("fired", sa.Integer, nullable=False),
    sa.Column("missed", sa.Integer, nullable=False),
    sa.Column("created_unix_s", sa.Float, nullable=False),
)
stops = sa.Table(
    "fleet_stops",
    metadata,
    sa.Column("id", sa.String(32), primary_key=True),
    sa.Column("robot", sa.String(32), primary_key=True),
    sa.Column("asked_unix_s", sa.Float, nullable=False),
    sa.Column("confirmed_unix_s", sa.Float),
)
counter = sa.Table(
    "fleet_counter",
    metadata,
    sa.Column("id", sa.Integer, primary_key=True),
    sa.Column("value", sa.BigInteger, nullable=False),
)
"""One row: the number of the newest change. A writer holds its lock until the commit, so that a
change that is read has none before it that is yet to come."""


def open_database(url: str) -> sa.Engine:
    """Return the connections, with all tables made. Raises as ``bring_up``."""
    made = sa.make_url(url)
    if made.get_backend_name() == "sqlite":
        engine = sa.create_engine(made, connect_args={"timeout": 30.0})
        event.listen(engine, "connect", _prepare_sqlite)
        event.listen(engine, "begin", _begin_transaction)
    else:
        engine = sa.create_engine(
            made.set(drivername="postgresql+psycopg"), pool_pre_ping=True, pool_size=20,
            connect_args={"connect_timeout": 5, "tcp_user_timeout": 10_000},
        )  # fmt: skip
    try:
        with engine.begin() as connection:
            bring_up(connection, metadata)
            if connection.execute(sa.select(counter.c.value)).scalar() is None:
                connection.execute(counter.insert().values(id=1, value=0))
    except BaseException:
        engine.dispose()
        raise
    return engine


def _prepare_sqlite(connection: object, _: object) -> None:
    connection.isolation_level = None  # type: ignore[attr-defined]  # transactions are ours
    connection.execute("PRAGMA journal_mode=WAL")  # type: ignore[attr-defined]
    connection.execute("PRAGMA synchronous=FULL")  # type: ignore[attr-defined]


def _begin_transaction(connection: sa.Connection) -> None:
    """Take the one writer's turn at once, so that no transaction fails half-way; readers need none.

    A reader that took it too would stand in line with every commit, and thirty robots' watches read
    all the time.
    """
    is_reading = connection.get_execution_options().get("is_reading", False)
    connection.exec_driver_sql("BEGIN" if is_reading else "BEGIN IMMEDIATE")


def bring_up(connection: sa.Connection, metadata: sa.MetaData) -> None:
    """Make what is missing, in the transaction that is open.

    Raises:
        ConfigError: ``fleet_schema_newer``.
    """
    if connection.dialect.name != "sqlite":
        connection.execute(sa.select(sa.func.pg_advisory_xact_lock(_ONE_AT_A_TIME)))
    note = sa.Table("fleet_schema", sa.MetaData(), sa.Column("version", sa.Integer, nullable=False))
    note.create(connection, checkfirst=True)
    found = connection.execute(sa.select(note.c.version)).scalar()
    if found is not None and not found <= VERSION:
        detail = f"the database is of version {found}, this Pons knows {VERSION}"
        raise ConfigError("fleet_schema_newer", f"{detail}; update Pons, or put the backup back")
    looked = sa.inspect(connection)
    for table in metadata.sorted_tables:
        if looked.has_table(table.name):
            there = {column["name"] for column in looked.get_columns(table.name)}
            _add_columns(connection, (each for each in table.columns if each.name not in there))
    metadata.create_all(connection)
    if found is None:
        connection.execute(note.insert().values(version=VERSION))
    elif found < VERSION:
        connection.execute(note.update().values(version=VERSION))


def _add_columns(connection: sa.Connection, columns: Iterable[sa.Column[object]]) -> None:
    for column in columns:
        words = CreateColumn(column).compile(dialect=connection.dialect)
        connection.execute(sa.text(f"ALTER TABLE {column.table.name} ADD COLUMN {words}"))
