"""What the planner's tables hold outlives kills, full disks, former layouts and spoilt files."""

from __future__ import annotations

import sqlite3
import subprocess
import sys
from contextlib import ExitStack, closing
from pathlib import Path

import pytest

from planner.state_database import FILE, StateDatabase, StateUnavailable
from tests.killed_writers import kill_writers
from wire import ConfigError

ROW = "INSERT INTO imports VALUES (?, ?)"
ROWS = "SELECT path, fingerprint FROM imports ORDER BY path"


def keep(home: Path, *rows: tuple[str, str]) -> None:
    with closing(StateDatabase(home)) as database, database.change() as connection:
        connection.executemany(ROW, rows)


def kept(home: Path) -> list[tuple[str, str]]:
    with closing(StateDatabase(home)) as database:
        return [(path, mark) for path, mark in database.read(ROWS)]


def test_nothing_is_made_before_something_is_kept(tmp_path: Path) -> None:
    assert kept(tmp_path / "home") == []
    assert not (tmp_path / "home").exists()
    keep(tmp_path / "home", ("a", "1"))
    assert kept(tmp_path / "home") == [("a", "1")]
    assert [path.name for path in (tmp_path / "home").iterdir()] == [FILE]


def test_all_of_a_change_is_kept_or_nothing(tmp_path: Path) -> None:
    with closing(StateDatabase(tmp_path)) as database:
        with pytest.raises(StateUnavailable, match="UNIQUE"), database.change() as connection:
            connection.executemany(ROW, [("a", "1"), ("a", "2")])
        assert database.read(ROWS) == []


def test_a_schema_of_a_later_program_is_refused_and_left_alone(tmp_path: Path) -> None:
    keep(tmp_path, ("a", "1"))
    with closing(sqlite3.connect(tmp_path / FILE)) as connection:
        connection.execute("PRAGMA user_version=99")
    before = (tmp_path / FILE).read_bytes()
    with closing(StateDatabase(tmp_path)) as database:
        for use in (lambda: database.read(ROWS), database.put_aside_if_spoilt):
            with pytest.raises(ConfigError, match="schema 99, expected 4") as wrong:
                use()
            assert wrong.value.code == "state_version"
    assert (tmp_path / FILE).read_bytes() == before


def spoil_head(data: bytes) -> bytes:
    return b"not a database at all, far from it" * 100


def spoil_pages(data: bytes) -> bytes:
    return data[:4096] + b"\xa5" * (len(data) - 4096)


@pytest.mark.parametrize("spoil", [spoil_head, spoil_pages])
def test_a_spoilt_file_is_told_and_put_aside_by_whoever_owns_the_home(
    spoil: object, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    assert callable(spoil)
    for number in (1, 2):
        keep(tmp_path, ("a", "1"))
        path = tmp_path / FILE
        path.write_bytes(spoiled := spoil(path.read_bytes()))
        with closing(StateDatabase(tmp_path)) as other, pytest.raises(StateUnavailable) as told:
            other.read(ROWS)
        assert told.value.spoilt
        with closing(StateDatabase(tmp_path)) as database:
            database.put_aside_if_spoilt()
            assert "state_spoilt" in caplog.text
            assert database.read(ROWS) == []
            beside = path.with_name(f"{FILE}.spoilt" + ("" if number == 1 else "-2"))
            assert beside.read_bytes() == spoiled
            database.put_aside_if_spoilt()
        caplog.clear()


def test_a_home_that_cannot_be_written_can_be_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    keep(tmp_path, ("a", "1"))
    monkeypatch.setattr("planner.state_database.os.access", lambda *_: False)  # root may write all
    with closing(StateDatabase(tmp_path)) as database:
        assert database.read(ROWS) == [("a", "1")]


def test_two_programs_write_in_turns(tmp_path: Path) -> None:
    with closing(StateDatabase(tmp_path)) as one, closing(StateDatabase(tmp_path)) as other:
        for number in range(20):
            writer, reader = (one, other) if number % 2 else (other, one)
            with writer.change(sync=False) as connection:
                connection.execute(ROW, (str(number), ""))
            assert len(reader.read(ROWS)) == number + 1


MAKER = """
import sys
from pathlib import Path
from planner.state_database import StateDatabase

for home in sys.stdin:
    database = StateDatabase(Path(home.strip()))
    with database.change() as connection:
        connection.execute("INSERT INTO imports VALUES (?, '')", (sys.argv[1],))
    print("kept", flush=True)
    database.close()
"""


def test_programs_that_make_it_at_once_make_one_of_their_owners_own(
    tmp_path: Path, repository: Path
) -> None:
    with ExitStack() as running:
        makers = [
            running.enter_context(
                subprocess.Popen(
                    [sys.executable, "-c", MAKER, name], stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE, text=True, cwd=repository, umask=0o002,
                )
            )
            for name in "abc"
        ]  # fmt: skip
        for number in range(20):
            home = tmp_path / str(number)
            for maker in makers:
                assert maker.stdin is not None
                print(home, file=maker.stdin, flush=True)
            for maker in makers:
                assert maker.stdout is not None
                assert maker.stdout.readline() == "kept\n"
            assert (home / FILE).stat().st_mode & 0o777 == 0o600
            assert kept(home) == [("a", ""), ("b", ""), ("c", "")]
    assert [maker.returncode for maker in makers] == [0, 0, 0]


def test_a_file_that_others_could_read_is_closed_to_them(tmp_path: Path) -> None:
    keep(tmp_path, ("a", "1"))
    (tmp_path / FILE).chmod(0o644)
    with closing(StateDatabase(tmp_path)) as database:
        with database.change() as connection:
            connection.execute(ROW, ("b", "2"))
        modes = {path.name: path.stat().st_mode & 0o777 for path in tmp_path.iterdir()}
    assert modes == dict.fromkeys((FILE, f"{FILE}-wal", f"{FILE}-shm"), 0o600)


# The layout before -------------------------------------------------------------------------------


def put(connection: sqlite3.Connection) -> None:
    count = connection.execute("SELECT count(*) FROM fence_proposals").fetchone()[0]
    connection.execute("INSERT INTO fence_proposals VALUES (?, '')", (str(count),))


def test_what_is_taken_over_is_taken_once_whenever_the_process_dies(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    old = tmp_path / "old.json"
    old.write_text("1")

    def dies(_self: Path, _target: Path) -> None:
        raise PermissionError(1, "Operation not permitted")

    with closing(StateDatabase(tmp_path)) as database:
        with pytest.raises(ZeroDivisionError):
            database.take_over(old, lambda _: 1 / 0)  # type: ignore[arg-type]
        assert old.exists()
        with monkeypatch.context() as patched:
            patched.setattr(Path, "rename", dies)
            for _ in range(3):  # as if it had died between the two, or may not rename
                database.take_over(old, put)
        assert database.read("SELECT count(*) FROM fence_proposals") == [(1,)]
        database.take_over(old, put)
        assert database.read("SELECT count(*) FROM fence_proposals") == [(1,)]
        assert (old.exists(), (tmp_path / "old.json.old").read_text()) == (False, "1")
        old.write_text("1")  # a person's
        database.take_over(old, put)
        database.take_over(old, put)
        assert database.read("SELECT count(*) FROM fence_proposals") == [(2,)]
        assert (tmp_path / "old.json.old-2").exists()
        assert database.read(ROWS) == []


# Kills -------------------------------------------------------------------------------------------

WRITE = """
from planner.state_database import StateDatabase

def write(home):
    database = StateDatabase(home)
    number = 0
    while True:
        number += 1
        with database.change(sync=number % 3 == 0) as connection:
            for name in "ab":
                connection.execute("REPLACE INTO imports VALUES (?, ?)", (name, str(number)))
        yield number
"""


def test_kill_at_any_instant_keeps_whole_changes(tmp_path: Path, repository: Path) -> None:
    for home, last in kill_writers(WRITE, tmp_path, repository):
        found = dict(kept(home))
        assert found["a"] == found["b"], "both rows of one change, or neither"
        assert int(found["a"]) >= last, "what was reported kept is there"
