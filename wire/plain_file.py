"""Read a plain file of bounded size, at a path from a person or an archive.

A device, a pipe or a socket in its place would fill the memory or wait for ever, at the start of a
process that is to drive. Knows no format.
"""

from __future__ import annotations

import errno
import os
import stat
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path


def read_plain_file(path: Path, most_bytes: int) -> bytes:
    """Return the bytes of a regular file.

    Raises:
        OSError: it can't be read, is not a regular file, or has more than ``most_bytes``; what was
            expected is in ``strerror``.
    """
    # Without O_NONBLOCK, opening a pipe waits for its writer.
    with os.fdopen(os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as file:
        about = os.fstat(file.fileno())
        if not stat.S_ISREG(about.st_mode):
            raise OSError(errno.EINVAL, "it is not a regular file", str(path))
        if about.st_size > most_bytes:
            text = f"it has more than {most_bytes} bytes, the most that is read"
            raise OSError(errno.EFBIG, text, str(path))
        data = file.read(about.st_size + 1)
    if len(data) > about.st_size:
        raise OSError(errno.EBUSY, "it grew while it was read", str(path))
    return data
