"""Find the key by which the bridge knows its operator. The only reader of operator.key here."""

from __future__ import annotations

import stat
from typing import TYPE_CHECKING

from wire import VIRTUAL_KEY, Misconfigured
from wire.proof import MIN_KEY_BYTES

if TYPE_CHECKING:
    from pathlib import Path

FILE = "operator.key"


def load_operator_key(home: Path, *, virtual: bool) -> bytes:
    """Return the published key for a virtual drive, else what ``$PONS_HOME/operator.key`` holds.

    Raises:
        Misconfigured: metal moves and the key is missing, short, or readable by others.
    """
    if virtual:
        return VIRTUAL_KEY
    path = home / FILE
    try:
        mode = stat.S_IMODE(path.stat().st_mode)
        key = path.read_bytes().strip()
    except OSError as error:
        raise Misconfigured("operator_key_missing", f"{path}: {error.strerror}") from None
    if mode & 0o077:
        text = f"{path} has mode {mode:04o}, expected 0600: others can read what arms the robot"
        raise Misconfigured("operator_key_exposed", text)
    if not len(key) >= MIN_KEY_BYTES:
        text = f"{path} holds {len(key)} bytes, expected at least {MIN_KEY_BYTES}"
        raise Misconfigured("operator_key_short", text)
    return key
