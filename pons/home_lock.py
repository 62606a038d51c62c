"""Let one ``pons up`` at a time own a home folder; the kernel gives the right back on any death.

Each child has a lock of its own, but while the first supervisor's child is down, waiting to be
started again, a second supervisor's child could take its place.
"""

from __future__ import annotations

import fcntl
import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path
    from types import TracebackType
    from typing import Self


class HomeTaken(Exception):
    """Another ``pons up`` runs there; nothing of its is touched."""


class HomeUnwritable(Exception):
    """Nothing can be kept there, so nothing was started."""


class HomeLock:
    """Hold ``run/up.lock`` until exit."""

    def __init__(self, home: Path) -> None:
        """Take the lock.

        Raises:
            HomeTaken: a living process holds it.
            HomeUnwritable: the folder can't be written.
        """
        path = home / "run" / "up.lock"
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            self._file = path.open("a+")
        except OSError as error:
            raise HomeUnwritable(
                f"home_unwritable: {path}: {error.strerror}; set PONS_HOME to a folder that you "
                "may write"
            ) from None
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self._file.seek(0)
            holder = self._file.read().strip() or "unknown"
            self._file.close()
            raise HomeTaken(
                f"already_running: a `pons up` with pid {holder} already serves {home}; stop it, "
                "or set PONS_HOME to another folder"
            ) from None
        self._file.truncate(0)
        self._file.write(str(os.getpid()))
        self._file.flush()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._file.close()
