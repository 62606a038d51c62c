"""Exchange two folders in one step of the kernel, so that a kill finds the old one or the new one.

Two renames would leave an instant with neither. Python has no call for it; glibc has, since 2.28.
"""

from __future__ import annotations

import ctypes
import errno
import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

_HERE = -100  # AT_FDCWD
_EXCHANGE = 2  # RENAME_EXCHANGE of linux/fs.h


def swap_folders(one: Path, other: Path) -> None:
    """Exchange two folders of one file system; either both have changed places or none has.

    Raises:
        OSError: they could not be exchanged; ENOSYS, EINVAL where system or disk can't do it.
    """
    libc = ctypes.CDLL(None, use_errno=True)
    try:
        call = libc.renameat2
    except AttributeError:
        raise OSError(errno.ENOSYS, os.strerror(errno.ENOSYS), str(one)) from None
    if call(_HERE, os.fsencode(one), _HERE, os.fsencode(other), _EXCHANGE) != 0:
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number), str(one))
    sync_folder(one.parent)


def sync_folder(folder: Path) -> None:
    """Have a folder's names outlive a power cut.

    Raises:
        OSError: the disk refuses.
    """
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
