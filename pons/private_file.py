"""Read and write files that only their owner may have read or changed."""

from __future__ import annotations

import os
import stat
from typing import TYPE_CHECKING

from wire import ConfigError, Unwritable

if TYPE_CHECKING:
    from pathlib import Path

MAX_BYTES = 100_000


def own_folder(folder: Path) -> None:
    """Make a folder for its owner alone, unless it is there.

    Raises:
        ConfigError: it can't be made, or is a link, somebody else's, or open to others.
    """
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        found = folder.lstat()
    except OSError as error:
        raise Unwritable("home_unwritable", f"{folder}: {error.strerror}") from None
    private = stat.S_ISDIR(found.st_mode) and not found.st_mode & 0o077
    if not (private and found.st_uid == os.geteuid()):
        detail = f"{folder} must be a folder of yours alone (mode 0700); others could change it"
        raise ConfigError("tls_folder_open", detail)


def read(file: Path) -> bytes | None:
    """Return a file of our own; None where there is none.

    Raises:
        ConfigError: somebody else's, a link, or one that others may write, or read if secret.
    """
    try:
        descriptor = os.open(file, os.O_RDONLY | os.O_NOFOLLOW | os.O_CLOEXEC)
    except FileNotFoundError:
        return None
    except OSError as error:
        raise ConfigError("tls_unreadable", f"{file}: {error.strerror}") from None
    with os.fdopen(descriptor, "rb") as opened:
        found = os.fstat(descriptor)
        closed = 0o022 if file.suffix == ".crt" else 0o077
        if not (found.st_uid == os.geteuid() and not found.st_mode & closed):
            detail = f"{file} is not yours alone (mode {stat.S_IMODE(found.st_mode):04o})"
            raise ConfigError("tls_key_open", f"{detail}; if others had it, move it away")
        return opened.read(MAX_BYTES)


def write(file: Path, data: bytes, mode: int = 0o600) -> None:
    """Replace a file as a whole; nobody else could read it at any moment."""
    new = file.with_suffix(".new")
    new.unlink(missing_ok=True)
    try:
        descriptor = os.open(new, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, mode)
        with os.fdopen(descriptor, "wb") as opened:
            opened.write(data)
            opened.flush()
            os.fsync(descriptor)
        new.replace(file)
    except OSError as error:
        raise Unwritable("home_unwritable", f"{file}: {error.strerror}") from None
