"""Keep the planner's small stores as tables of one SQLite file of its home folder (ADR 0036).

Taught places, objects seen, memory, fence proposals and what the model has cost: each
store owns the statements of its table, this file the connection and the errors. WAL; a change is
on disk before it returns. Whatever SQLite refuses is told as the OSError that a plain file would
have given, so that each store says it in its own words. Blocks on the disk: never called in the
event loop.
"""

from __future__ import annotations

import errno
import hashlib
import logging
import os
import sqlite3
import threading
import time
from contextlib import contextmanager
from itertools import count
from typing import TYPE_CHECKING, Any

from planner.state_schema import SCHEMAS, VERSION
from wire import ConfigError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

log = logging.getLogger(__name__)

FILE = "state.sqlite"
PRIVATE = 0o600
"""Where people were seen in a home is its owner's business, whatever the umask is."""
WAIT_S = 2.0
"""For another program of the same home (an exam, a replay) that is writing."""
AGAIN_S = 0.005
_ERRNO = {
    sqlite3.SQLITE_FULL: errno.ENOSPC,
    sqlite3.SQLITE_READONLY: errno.EROFS,
    sqlite3.SQLITE_PERM: errno.EACCES,
    sqlite3.SQLITE_CANTOPEN: errno.EACCES,
    sqlite3.SQLITE_BUSY: errno.EAGAIN,
    sqlite3.SQLITE_LOCKED: errno.EAGAIN,
}
_SPOILT = (sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB)


class StateUnavailable(OSError):
    """The database can't be read or written now; its errno is what a plain file would have given.

    ``spoilt``: no later try will do better; the file is none of ours any more.
    """

    def __init__(self, path: Path, error: sqlite3.Error | OSError) -> None:
        """Keep the words of SQLite, or of the system where they are about the disk."""
        number, words, self.spoilt = errno.EIO, str(error), False
        if isinstance(error, OSError):
            number, words = error.errno or errno.EIO, error.strerror or words
        else:
            code = getattr(error, "sqlite_errorcode", 0) & 0xFF
            number, self.spoilt = _ERRNO.get(code, errno.EIO), code in _SPOILT
            words = os.strerror(number) if number == errno.ENOSPC else words
        super().__init__(number, words, str(path))


class StateDatabase:
    """Be the database of one home; made by its first change. Any thread may use it, in turns."""

    def __init__(self, home: Path) -> None:
        """Say where; nothing is opened yet."""
        self.path = home.absolute() / FILE
        self._lock = threading.Lock()
        self._connection: sqlite3.Connection | None = None
        self._folder_synced = False

    def read(self, query: str, values: tuple[object, ...] = ()) -> list[tuple[Any, ...]]:
        """Return rows; none where nothing was ever kept.

        Raises:
            StateUnavailable: it can't be read.
            ConfigError: ``state_version``.
        """
        with self._lock, self._translate_errors():
            connection = self._open(make=False)
            if connection is not None:
                return connection.execute(query, values).fetchall()
            if not self.path.exists():
                return []
            return self._read_only(query, values)

    @contextmanager
    def change(self, *, sync: bool = True) -> Iterator[sqlite3.Connection]:
        """Lend the connection inside one transaction; after it all is kept, or nothing changed.

        Args:
            sync: have it outlive a power cut as well as this process; without, see ``sync``.

        Raises:
            StateUnavailable: it can't be written.
            ConfigError: ``state_version``.
        """
        with self._lock, self._translate_errors():
            connection = self._open(make=True)
            if connection is None:
                raise sqlite3.OperationalError("unable to open database file")
            # NORMAL waits for the disk only where the log begins anew over older entries.
            connection.execute(f"PRAGMA synchronous={'FULL' if sync else 'NORMAL'}")
            with _transaction(connection):
                yield connection

    def sync(self) -> None:
        """Have all changes so far outlive a power cut, beside whoever writes more.

        Raises:
            OSError: the disk refuses.
        """
        paths = [(self._log, os.fdatasync)]
        if not self._folder_synced:  # its name, once
            paths.append((self._log.parent, os.fsync))
        for path, sync in paths:
            try:
                descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
            except FileNotFoundError:  # it was closed, and synced by that
                continue
            try:
                sync(descriptor)
            finally:
                os.close(descriptor)
        self._folder_synced = True

    @property
    def _log(self) -> Path:
        return self.path.with_name(f"{self.path.name}-wal")

    def take_over(self, old: Path, put: Callable[[sqlite3.Connection], None]) -> None:
        """Take a store of the old layout into its table, once, and keep it beside as ``.old``.

        A crash between the two leaves a mark of what was taken, so that it is never taken twice; an
        old file that somebody puts there later is taken again.

        Args:
            old: the file or folder.
            put: reads it and writes its rows; what it raises leaves everything as it was.

        Raises:
            StateUnavailable: it can't be written.
        """
        if not old.exists():
            return
        with self.change() as connection:
            mark = connection.execute("SELECT fingerprint FROM imports WHERE path = ?", (old.name,))
            found, now = mark.fetchone(), _fingerprint(old)
            if now is None:  # another program has just taken it
                return
            if found is None or found[0] != now:
                put(connection)
                connection.execute("REPLACE INTO imports VALUES (?, ?)", (old.name, now))
        try:
            _put_beside(old, "old")
        except OSError as error:
            log.warning("%s was taken over and can't be renamed: %s", old, error.strerror)
        else:
            with self.change() as connection:
                connection.execute("DELETE FROM imports WHERE path = ?", (old.name,))

    def put_aside_if_spoilt(self) -> None:
        """Rename a file that is no database of ours any more; the next change makes a new one.

        Only for the planner, of which a home has one: other programs spend here and rename nothing.

        Raises:
            ConfigError: ``state_version``.
        """
        try:
            rows = self.read("PRAGMA quick_check(1)")
            told = "" if not rows or rows[0][0] == "ok" else str(rows[0][0])
        except StateUnavailable as error:
            told = (error.strerror or "") if error.spoilt else ""
        if not told:
            return
        self.close()
        for end in ("-wal", "-shm"):  # with the file, for whoever wants to save something
            beside = self.path.with_name(self.path.name + end)
            if beside.exists():
                _put_beside(beside, "spoilt")
        log.error(
            "state_spoilt: %s: %s; it was put aside as %s, and what was taught, seen, proposed and "
            "spent begins anew", self.path, told.splitlines()[0][:200],
            _put_beside(self.path, "spoilt").name,
        )  # fmt: skip

    def compact(self) -> None:
        """Move the log into the file and empty it: what was deleted is then in neither.

        While another program reads, nothing is emptied, and the next call does it.

        Raises:
            StateUnavailable: the disk refuses.
        """
        with self._lock, self._translate_errors():
            connection = self._open(make=False)
            if connection is not None:
                connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")

    def close(self) -> None:
        """Give the connection back; another use opens it again."""
        with self._lock:
            if self._connection is not None:
                self._connection.close()
                self._connection = None

    @contextmanager
    def _translate_errors(self) -> Iterator[None]:
        """Tell SQLite's errors, and the system's about the file, as StateUnavailable."""
        try:
            yield
        except sqlite3.Error as error:
            raise StateUnavailable(self.path, error) from None

    def _open(self, *, make: bool) -> sqlite3.Connection | None:
        """Return the connection; None where there is nothing to read, or it can't be opened so."""
        if self._connection is not None:
            return self._connection
        if not make and not (self.path.exists() and os.access(self.path.parent, os.W_OK)):
            return None
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise StateUnavailable(self.path, error) from None
        connection = _connect(str(self.path))
        try:
            _make_private(self.path)
            _begin_log(connection)
            for pragma in ("journal_size_limit=1000000", "secure_delete=ON"):
                connection.execute(f"PRAGMA {pragma}")
            self._make_tables(connection)
        except BaseException:
            connection.close()
            raise
        self._connection = connection
        return connection

    def _make_tables(self, connection: sqlite3.Connection) -> None:
        if _version(connection) != VERSION:
            with _transaction(connection):
                found = _version(connection)  # anew: another program may have made them
                if not 0 <= found <= VERSION:
                    told = f"{self.path} has schema {found}, expected {VERSION}"
                    raise ConfigError("state_version", told)
                for statement in (each for added in SCHEMAS[found:] for each in added):
                    connection.execute(statement)
                connection.execute(f"PRAGMA user_version={VERSION}")

    def _read_only(self, query: str, values: tuple[object, ...]) -> list[tuple[Any, ...]]:
        """Read in a folder that can't be written, where WAL's own files can't be made."""
        connection = _connect(f"{self.path.as_uri()}?mode=ro&immutable=1", uri=True)
        try:
            if _version(connection) == 0:
                return []
            return connection.execute(query, values).fetchall()
        finally:
            connection.close()


def _connect(where: str, *, uri: bool = False) -> sqlite3.Connection:
    return sqlite3.connect(
        where, timeout=WAIT_S, isolation_level=None, check_same_thread=False, uri=uri
    )


def _begin_log(connection: sqlite3.Connection) -> None:
    """Set WAL, which a file keeps. SQLite's own wait does not cover two programs that both set it.

    Raises:
        sqlite3.OperationalError: another program held the file for as long as any write is waited.
    """
    until_s = time.monotonic() + WAIT_S
    while True:
        try:
            connection.execute("PRAGMA journal_mode=WAL")
        except sqlite3.OperationalError as error:
            busy = error.sqlite_errorcode & 0xFF == sqlite3.SQLITE_BUSY
            if not (busy and time.monotonic() < until_s):
                raise
            time.sleep(AGAIN_S)
        else:
            return


def _make_private(path: Path) -> None:
    """Let nobody else read a file that was just opened, and is empty where it is new.

    The log beside it takes its mode. Nothing opens and closes the file here: that would drop the
    locks of this process (sqlite.org, "How To Corrupt An SQLite Database File", 2.2).
    """
    try:
        if path.stat().st_mode & 0o777 != PRIVATE:
            path.chmod(PRIVATE)
    except OSError as error:
        raise StateUnavailable(path, error) from None


def _version(connection: sqlite3.Connection) -> int:
    return int(connection.execute("PRAGMA user_version").fetchone()[0])


@contextmanager
def _transaction(connection: sqlite3.Connection) -> Iterator[None]:
    connection.execute("BEGIN IMMEDIATE")
    try:
        yield
        connection.execute("COMMIT")
    except BaseException:
        if connection.in_transaction:  # a full disk has ended it by itself
            connection.execute("ROLLBACK")
        raise


def _fingerprint(old: Path) -> str | None:
    """Return a hash of a file, or of the names and files of a folder; None where it is gone."""
    digest = hashlib.sha256()
    try:
        paths = sorted(old.iterdir()) if old.is_dir() else [old]
        for path in paths:
            data = path.read_bytes() if path.is_file() else b""
            digest.update(f"{path.name} {len(data)}\n".encode() + data)
    except FileNotFoundError:
        return None
    return digest.hexdigest()


def _put_beside(path: Path, end: str) -> Path:
    """Rename a file or folder to the first name of its kind that is free."""
    names = (f"{path.name}.{end}" + (f"-{n}" if n > 1 else "") for n in count(1))
    beside = next(p for p in map(path.with_name, names) if not p.exists())
    return path.rename(beside)


def open_sound(home: Path) -> StateDatabase:
    """Return the database of a home, a new one in the place of a file that is spoilt."""
    state = StateDatabase(home)
    state.put_aside_if_spoilt()
    return state
