"""Try databases of older and newer versions: brought up with all rows, or refused."""

from __future__ import annotations

from pathlib import Path

import pytest
import sqlalchemy as sa

from fleet import tables
from fleet.addressee import Addressee
from fleet.store import FleetStore
from fleet.tables import metadata, missions
from tests.fleet.postgres import Cluster
from wire import ConfigError


@pytest.fixture(params=["sqlite", pytest.param("postgres", marks=pytest.mark.long)])
def database(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path / 'fleet.sqlite'}"
    cluster: Cluster = request.getfixturevalue("postgres")
    return cluster.make_database()


def test_a_database_of_before_gets_what_it_lacks_and_keeps_its_rows(
    database: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = FleetStore(database)
    store.accept("o-1", "go", "hash", None, [("m-1", Addressee("any"), {}, False)], "go")
    with store.engine.begin() as connection:  # as it was before these were added
        for words in (
            "ALTER TABLE fleet_missions DROP COLUMN outcome",
            "DROP TABLE fleet_stops",
            "DROP TABLE fleet_schema",
        ):
            connection.execute(sa.text(words))
    store.close()
    monkeypatch.setattr(tables, "VERSION", tables.VERSION + 1)
    newer = FleetStore(database)
    assert newer.mission("m-1").outcome is None
    newer.stop("s-1", [], forever=True)
    with newer.engine.begin() as connection:
        version = connection.execute(sa.text("SELECT version FROM fleet_schema")).scalar_one()
    assert version == tables.VERSION
    newer.close()


def test_a_database_of_a_newer_version_is_refused_and_left_as_it_is(database: str) -> None:
    store = FleetStore(database)
    with store.engine.begin() as connection:
        connection.execute(sa.text(f"UPDATE fleet_schema SET version = {tables.VERSION + 1}"))
    store.close()
    with pytest.raises(ConfigError) as refused:
        FleetStore(database)
    assert refused.value.code == "fleet_schema_newer"
    assert "put the backup back" in str(refused.value)


FIRST = (
    "seq id order_id text body way names is_urgent state reason robot is_sent wish goal_id "
    "goal_state question outcome unknown_since_unix_s attempt created_unix_s updated_unix_s change"
)


def test_what_is_added_to_a_mission_can_be_added_to_rows_that_are_there() -> None:
    added = [column for column in missions.columns if column.name not in FIRST.split()]
    assert all(column.nullable or column.server_default is not None for column in added)


def test_a_column_that_rows_can_not_have_is_no_way_to_a_new_version(tmp_path: Path) -> None:
    engine = sa.create_engine(f"sqlite:///{tmp_path / 'x.sqlite'}")
    with engine.begin() as connection:
        metadata.create_all(connection)
        connection.execute(sa.text("INSERT INTO fleet_counter VALUES (1, 0)"))
    more = sa.MetaData()
    sa.Table("fleet_counter", more, sa.Column("id", sa.Integer, primary_key=True),
             sa.Column("owner", sa.Text, nullable=False))  # fmt: skip
    with pytest.raises(sa.exc.OperationalError), engine.begin() as connection:
        tables.bring_up(connection, more)
    engine.dispose()
