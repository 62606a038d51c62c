"""Locate the doors' sockets, check their permissions, and lock each for one listener.

Unix sockets ``$PONS_HOME/run/DOOR/DOOR.sock`` unless a TCP endpoint is given. Each door has a
folder of its listener's, which nobody else may write: none can rename, replace or forestall
another's socket. A lock file tells a live process from what a dead one left: the kernel drops the
lock with the process, however it died.
"""

from __future__ import annotations

import fcntl
import os
import socket
import stat
import struct
from contextlib import ExitStack, closing, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from wire.errors import ConfigError, Unwritable

if TYPE_CHECKING:
    from wire.doors import Door
    from wire.keys import Party

MAX_SOCKET_PATH = 107
"""sun_path holds 108 bytes with its closing zero (unix(7))."""
PRIVATE = 0o700
_WRITABLE_BY_OTHERS = 0o022
PROBE_S = 0.3


@dataclass(frozen=True, slots=True)
class Endpoints:
    """Give the zenoh locators of the doors, for one home folder."""

    home: Path
    tcp: dict[Door, str] = field(default_factory=dict)
    """host:port of a door that is on another host."""

    def locator(self, door: Door) -> str:
        """Return the zenoh locator of a door.

        Raises:
            ConfigError: the socket's path is longer than the kernel takes.
        """
        if door in self.tcp:
            return f"tcp/{self.tcp[door]}"
        path = self.socket(door)
        length = len(os.fsencode(path))
        if not length <= MAX_SOCKET_PATH:
            raise ConfigError(
                "socket_path_too_long",
                f"{path} has {length} bytes, at most {MAX_SOCKET_PATH}; set PONS_HOME to a "
                "shorter folder",
            )
        return f"unixsock-stream/{path}"

    def socket(self, door: Door) -> Path:
        """Return the absolute path of a door's socket."""
        return _run(self.home) / door.name / f"{door.name}.sock"


class Claim:
    """Hold the right to be the one process of a kind in a home folder, until close or death."""

    def __init__(self, home: Path, party: Party) -> None:
        """Take the lock.

        Raises:
            ConfigError: another live process holds it, and nothing of its is touched; or others
                may write the folder.
            Unwritable: the folder can't be written.
        """
        self._run = _run(home)
        folder = self._run / party.value
        self._path = folder / f"{party.value}.lock"
        _own(self._run)
        _own(folder)
        try:
            self._file = self._path.open("a+")
        except OSError as error:
            raise Unwritable("home_unwritable", f"{self._path}: {error.strerror}") from None
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self._file.seek(0)
            holder = self._file.read().strip() or "unknown"
            self._file.close()
            raise ConfigError(
                "already_running",
                f"a {party.value} with pid {holder} already serves {self._run}; stop it, or set "
                "PONS_HOME to another folder",
            ) from None
        self._sign()

    def _sign(self) -> None:
        """Write our pid into the lock, for the message to the second who comes."""
        try:
            self._file.truncate(0)
            self._file.write(str(os.getpid()))
            self._file.flush()
        except OSError as error:
            with suppress(OSError):  # closing tries to write the same again
                self._file.close()
            raise Unwritable("home_unwritable", f"{self._path}: {error.strerror}") from None

    def make_way(self, path: Path) -> None:
        """Make the folder of a socket and remove what a dead listener left; ours is the lock.

        Raises:
            ConfigError: others may write the folder.
            Unwritable: the folder can't be written.
        """
        _own(path.parent)
        try:
            path.unlink(missing_ok=True)
            path.with_name(path.name + ".lock").unlink(missing_ok=True)
        except OSError as error:
            raise Unwritable("home_unwritable", f"{path}: {error.strerror}") from None

    def close(self) -> None:
        """Give the right back."""
        self._file.close()


def admit(path: Path) -> None:
    """Set a new socket's permissions: those of its folder's owner, or its group too."""
    shared = path.parent.stat().st_mode & stat.S_IXGRP
    path.chmod(0o660 if shared else 0o600)


def misplaced_listener(home: Path, door: Door) -> str | None:
    """Return why a door's listener is not to be believed; None where it owns the folder.

    Believed are root, ourselves, and the owner of the door's folder where nobody else could have
    put that folder there: in a run/ that others may write, sticky or not, anybody may be the first.
    Elsewhere than on Linux the kernel does not tell, and nothing is checked.
    """
    path = Endpoints(home).socket(door)
    if not hasattr(socket, "SO_PEERCRED"):
        return None
    try:
        uid = _listening_uid(path)
        expected = {0, os.geteuid(), *_owners(path.parent)}
    except OSError as error:
        return f"wrong_listener: who listens at {path} can't be told: {error.strerror or error}"
    if uid in expected:
        return None
    return (
        f"wrong_listener: user {uid} listens at {path}, expected user "
        f"{' or '.join(map(str, sorted(expected)))} / 监听该套接字的不是它的所有者"
    )


def unreachable(home: Path, door: Door) -> str | None:
    """Return why this user can't connect to a door; None where it can."""
    path = Endpoints(home).socket(door)
    try:
        _dial(path).close()
    except OSError as error:
        return f"{path}: {error.strerror or error}"
    return None


def is_listening(path: Path) -> bool:
    """Tell at once whether a process listens at a socket; False too to a user who may not connect.

    Nothing is waited for: a full queue of others who connect is a listener too, hung or not.
    """
    return connect_refusal(path) is None


def connect_refusal(path: Path) -> OSError | None:
    """Return at once why the kernel lets this user not connect to a socket; None where it does."""
    with closing(socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)) as probe:
        probe.setblocking(False)
        try:
            probe.connect(str(path))
        except BlockingIOError:
            return None  # so many wait that it takes no more
        except OSError as error:
            return error
    return None


def _listening_uid(path: Path) -> int:
    """Return the user of the process that listens, as the kernel noted it (unix(7))."""
    with _dial(path) as probe:
        told = probe.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, struct.calcsize("3i"))
    return int(struct.unpack("3i", told)[1])


def _dial(path: Path) -> socket.socket:
    with ExitStack() as undo:
        probe = undo.enter_context(socket.socket(socket.AF_UNIX, socket.SOCK_STREAM))
        probe.settimeout(PROBE_S)
        probe.connect(str(path))
        undo.pop_all()
    return probe


def _owners(folder: Path) -> tuple[int, ...]:
    """Return the owner of a door's folder, unless another may have made or replaced it."""
    run = folder.parent.stat()
    if run.st_uid not in (0, os.geteuid()) or run.st_mode & _WRITABLE_BY_OTHERS:
        return ()
    return (folder.stat().st_uid,)


def _run(home: Path) -> Path:
    return home.absolute() / "run"


def _own(folder: Path) -> None:
    """Make a folder for this user alone; an existing one must be nobody else's to write.

    Raises:
        ConfigError: ``socket_folder_exposed``.
        Unwritable: ``home_unwritable``.
    """
    try:
        folder.mkdir(mode=PRIVATE, parents=True, exist_ok=True)
        found = folder.stat()
        ours = found.st_uid == os.geteuid()
        if ours and _open_to_others(found.st_mode):
            folder.chmod(stat.S_IMODE(found.st_mode) & ~_WRITABLE_BY_OTHERS)
    except OSError as error:
        raise Unwritable("home_unwritable", f"{folder}: {error.strerror}") from None
    if not ours and (found.st_uid != 0 or _open_to_others(found.st_mode)):
        raise ConfigError(
            "socket_folder_exposed",
            f"{folder} belongs to user {found.st_uid}, mode {stat.S_IMODE(found.st_mode):04o}; "
            "others could replace a socket there, so it must be this user's or root's and "
            "writable by no group (docs/deploy.md: systemd-tmpfiles --create)",
        )


def _open_to_others(mode: int) -> bool:
    """Return whether others could replace what lies there."""
    return bool(mode & _WRITABLE_BY_OTHERS and not mode & stat.S_ISVTX)
