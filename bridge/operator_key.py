"""Load the operator's key. The only reader of operator.key.

In a sticky home whoever comes first may make a file of that name, or a link to another's. A key
counts only where it is a regular file, not reached by a link, of this very user or of root, that
nobody else may read. Asked of the file that was opened, not of its name.
"""

from __future__ import annotations

import os
import stat
from typing import TYPE_CHECKING

from wire import VIRTUAL_KEY, ConfigError
from wire.operator_hmac import MIN_KEY_BYTES

if TYPE_CHECKING:
    from pathlib import Path

FILE = "operator.key"
MAX_KEY_BYTES = 4096


def load_operator_key(home: Path, *, virtual: bool) -> bytes:
    """Return the published key for a virtual drive, else that of ``$PONS_HOME/operator.key``.

    Raises:
        ConfigError: metal moves and the key is missing, short, readable by others, another
            user's, or no regular file.
    """
    if virtual:
        return VIRTUAL_KEY
    path = home / FILE
    try:
        key = _read(path)
    except OSError as error:
        raise ConfigError(
            "operator_key_missing", f"{path}: {error.strerror}; `pons key new` makes one"
        ) from None
    if not len(key) >= MIN_KEY_BYTES:
        text = f"{path} holds {len(key)} bytes, expected at least {MIN_KEY_BYTES}"
        raise ConfigError("operator_key_short", text)
    return key


def _read(path: Path) -> bytes:
    """Read a plain file, neither following a link nor waiting for a pipe.

    Raises:
        ConfigError: it is not ours alone.
        OSError: it can't be opened or read.
    """
    if path.is_symlink():
        text = f"{path} is a link to {path.readlink()}, expected a regular file"
        raise ConfigError("operator_key_linked", text)
    opened = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    try:
        found = os.fstat(opened)
        _hold_ours(path, found)
        return os.read(opened, MAX_KEY_BYTES).strip()
    finally:
        os.close(opened)


def _hold_ours(path: Path, found: os.stat_result) -> None:
    if not stat.S_ISREG(found.st_mode):
        text = f"{path} is a {_kind(found.st_mode)}, expected a regular file"
        raise ConfigError("operator_key_no_file", text)
    if found.st_uid not in (0, os.geteuid()):
        text = (
            f"{path} belongs to user {found.st_uid}, expected {os.geteuid()} (this user) or root: "
            "another could have put it there; act as the user to whom it belongs"
        )
        raise ConfigError("operator_key_not_yours", text)
    mode = stat.S_IMODE(found.st_mode)
    if mode & 0o077:
        text = f"{path} has mode {mode:04o}, expected 0600: others can read what arms the robot"
        raise ConfigError("operator_key_exposed", text)


def _kind(mode: int) -> str:
    if stat.S_ISDIR(mode):
        return "folder"
    return "pipe" if stat.S_ISFIFO(mode) else "device or socket"
