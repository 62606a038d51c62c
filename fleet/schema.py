"""Bring a database of an older version up to this one's tables; refuse one of a newer version.

A new table, or a column that may be empty or has a default of the server's, is added at the start.
Whoever adds one raises ``VERSION``. A change that is more than that is to be done in steps of such.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import sqlalchemy as sa
from sqlalchemy.schema import CreateColumn

from wire import ConfigError

if TYPE_CHECKING:
    from collections.abc import Iterable

VERSION = 2
"""Of the tables; a database that knows a higher one has been used by a newer Pons."""
_ONE_AT_A_TIME = 0x504F4E54
"""Of Postgres' advisory locks: of services that start at once one makes the tables."""


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
