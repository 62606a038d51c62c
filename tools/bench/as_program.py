"""Become another user and run a module.

``python -m tools.bench.as_program UID GID,GID… MODULE [WORD …]``, by root.

An interpreter or checkout that lies in a folder which the user may not enter is shown to it: in a
mount namespace of this process alone, that folder is replaced by an open one that holds the same
things.
"""

from __future__ import annotations

import os
import resource
import stat
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

from pons.settings import CHECKOUT
from pons.supervisor import BEHIND
from processes.parent_death import child_command
from tools.bench.chaos.house import MS_BIND, MS_REC, mount, private_mounts, unmount

UNITS_MASK = 0o077
PRIORITY, NICEST = 70, 40
"""LimitRTPRIO of the bridge's unit; and what the units' weights give, here as a right to nice."""
OURS = frozenset({"bridge", "sim", "localization", "planner", "sim.camera"})


def main(arguments: list[str]) -> None:
    """Become the user, then the module; a robot's own process is bound to who started this one."""
    parent_pid = os.getppid()
    uid, groups = int(arguments[0]), [int(one) for one in arguments[1].split(",")]
    words = arguments[2:]
    command = (sys.executable, "-m", *words)
    os.chdir(CHECKOUT)
    show(Path(sys.base_prefix), Path(sys.prefix), CHECKOUT)
    if words[0] in OURS:
        behind = BEHIND.get(words[0], 0)
        command = child_command(*words, session_nice=behind, parent_pid=parent_pid)
        _give_rights(words[0])
    os.environ["HOME"] = os.environ.get("PONS_HOME", "/")
    os.umask(UNITS_MASK)
    os.setgroups(groups)
    os.setresgid(groups[0], groups[0], groups[0])
    os.setresuid(uid, uid, uid)
    os.execv(sys.executable, command)


def _give_rights(name: str) -> None:
    with suppress(OSError, ValueError):  # the process says what it lacks then
        resource.setrlimit(resource.RLIMIT_NICE, (NICEST, NICEST))
        if name == "bridge":
            resource.setrlimit(resource.RLIMIT_RTPRIO, (PRIORITY, PRIORITY))
            resource.setrlimit(resource.RLIMIT_MEMLOCK, (-1, -1))


def show(*paths: Path) -> None:
    """Let every user enter the folders above these paths, as seen by this process from now on.

    Raises:
        OSError: this machine lets nobody mount anything.
    """
    closed = sorted({found for path in paths if (found := _closed_above(path)) is not None})
    if not closed:
        return
    trouble = private_mounts()
    if trouble:
        raise OSError(trouble)
    for folder in closed:
        _open(folder)


def _closed_above(path: Path) -> Path | None:
    """Return the topmost folder above a path that others may not enter."""
    resolved = path.resolve()
    for folder in reversed((resolved, *resolved.parents)):
        if not folder.stat().st_mode & stat.S_IXOTH:
            return folder
    return None


def _open(folder: Path) -> None:
    """Put a folder that anybody may enter in a folder's place, with the same things in it."""
    beside = Path(tempfile.mkdtemp(prefix="pu-"))
    mount(str(folder), beside, "none", MS_BIND | MS_REC)
    things = [one for one in beside.iterdir() if not one.is_symlink()]
    mount("tmpfs", folder, "tmpfs", 0, "size=1m,mode=755")
    for thing in things:
        if thing.is_dir():
            (folder / thing.name).mkdir()
        else:
            (folder / thing.name).touch()
        mount(str(thing), folder / thing.name, "none", MS_BIND | MS_REC)
    unmount(beside)
    beside.rmdir()


if __name__ == "__main__":
    main(sys.argv[1:])
