"""Say where each listener is found, and make sure that only one process listens there.

Unix sockets ``$PONS_HOME/run/{bridge,robot,localization,camera}.sock`` unless a TCP endpoint is
given. A lock file beside each socket tells a live listener from what a dead one left: the kernel
drops the lock with the process, however it died.
"""

from __future__ import annotations

import fcntl
import os
from dataclasses import dataclass, field
from pathlib import Path

from wire.errors import Misconfigured
from wire.keys import Party

MAX_SOCKET_PATH = 107
"""sun_path holds 108 bytes with its closing zero (unix(7))."""

LISTENERS = (Party.BRIDGE, Party.ROBOT, Party.LOCALIZATION, Party.CAMERA)
DIALS: dict[Party, tuple[Party, ...]] = {
    Party.PLANNER: LISTENERS,
    Party.OPERATOR: (Party.BRIDGE,),
    Party.JUDGE: LISTENERS,
    Party.LOCALIZATION: (Party.BRIDGE, Party.ROBOT),
    Party.BRIDGE: (Party.ROBOT,),
    Party.ROBOT: (),
    Party.CAMERA: (Party.ROBOT,),
}


@dataclass(frozen=True, slots=True)
class Endpoints:
    """Give the zenoh locators of the listeners, for one home folder."""

    home: Path
    tcp: dict[Party, str] = field(default_factory=dict)
    """host:port of a listener that is on another host."""

    def locator(self, listener: Party) -> str:
        """Return the zenoh locator of a listener.

        Raises:
            Misconfigured: the socket's path is longer than the kernel takes.
        """
        if listener in self.tcp:
            return f"tcp/{self.tcp[listener]}"
        path = self.socket(listener)
        length = len(os.fsencode(path))
        if not length <= MAX_SOCKET_PATH:
            raise Misconfigured(
                "socket_path_too_long",
                f"{path} has {length} bytes, at most {MAX_SOCKET_PATH}; set PONS_HOME to a "
                "shorter folder",
            )
        return f"unixsock-stream/{path}"

    def socket(self, listener: Party) -> Path:
        """Return the absolute path of a listener's socket."""
        return self.home.absolute() / "run" / f"{listener.value}.sock"


class Claim:
    """Hold the right to be the one process of a kind in a home folder, until close or death."""

    def __init__(self, home: Path, party: Party) -> None:
        """Take the lock.

        Raises:
            Misconfigured: another live process holds it, and nothing of its is touched; or the
                folder can't be written.
        """
        run = home.absolute() / "run"
        self._path = run / f"{party.value}.lock"
        try:
            run.mkdir(parents=True, exist_ok=True)
            self._file = self._path.open("a+")
        except OSError as error:
            raise Misconfigured("home_unwritable", f"{self._path}: {error.strerror}") from None
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self._file.seek(0)
            holder = self._file.read().strip() or "unknown"
            self._file.close()
            raise Misconfigured(
                "already_running",
                f"a {party.value} with pid {holder} already serves {run}; stop it, or set "
                "PONS_HOME to another folder",
            ) from None
        self._file.truncate(0)
        self._file.write(str(os.getpid()))
        self._file.flush()

    def clear_stale(self, socket: Path) -> None:
        """Remove what a dead listener left; ours is the lock, so nobody listens there."""
        socket.unlink(missing_ok=True)
        socket.with_name(socket.name + ".lock").unlink(missing_ok=True)

    def close(self) -> None:
        """Give the right back."""
        self._file.close()
