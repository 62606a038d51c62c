"""Find the robots that run on this machine, from any folder and as any user. Stdlib only.

``pons up`` leaves a note in a folder of its own, ``/tmp/pons-run-UID.XXXX``, that all users may
read and its owner alone may write: where the state lies, and where and how the planner answers. The
lock on it ends with its writer, however that died. A note is believed where its folder, its file
and the number in the folder's name are of one user; what it says is used to make robots stand, and
nobody is sent a secret because of it. Services leave no note; their state is always in one place.
"""

from __future__ import annotations

import fcntl
import json
import os
import stat
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pons.settings import DEFAULT_HOST, DEFAULT_PORT, LaunchSettings, planner_address

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import TracebackType
    from typing import Self

NOTES = "PONS_RUNNING"
"""The variable that names another folder for notes than the machine's."""
MACHINE_WIDE = "/tmp"  # its folders are made by mkdtemp, and judged by their owner
PREFIX = "pons-run-"
NOTE, AUTHORITY = "robot.json", "ca.crt"
MAX_BYTES = 65_536
MOST_OF_A_USER = 8
SERVICE_HOME = Path("/var/lib/pons")
SERVICE_ROBOT = Path("/etc/pons/robot.toml")
_WRITABLE_BY_OTHERS = 0o022


class RunningNote:
    """Keep a robot's note up to date until exit."""

    def __init__(self, settings: LaunchSettings, robot_id: str) -> None:
        self._said = {
            "robot_id": robot_id,
            "home": str(settings.home),
            "robot": str(settings.robot),
            "site": str(settings.site),
            "host": settings.host,
            "port": settings.port,
            "tls": settings.tls,
        }
        self._authority = settings.home / "tls" / "ca.crt" if settings.tls else None
        self._folder: Path | None = None
        self._lock: Any = None

    def keep(self) -> None:
        """Write the note again if something cleaned it up; a full disk keeps nobody back."""
        with suppress(OSError):
            if self._folder is None or not (self._folder / NOTE).exists():
                self._write()
            elif self._folder is not None:
                os.utime(self._folder / NOTE)  # cleaners of /tmp go by age

    def _write(self) -> None:
        import tempfile  # late, as shutil below: an order to stop needs neither

        self._forget()
        root = notes_folder()
        _remove_dead(root)
        folder = Path(tempfile.mkdtemp(prefix=f"{PREFIX}{os.geteuid()}.", dir=root))
        self._folder = folder
        if self._authority is not None:
            (folder / AUTHORITY).write_bytes(self._authority.read_bytes())
            (folder / AUTHORITY).chmod(0o644)
        self._lock = (folder / NOTE).open("w", encoding="utf-8")
        fcntl.flock(self._lock, fcntl.LOCK_EX)
        self._lock.write(json.dumps(self._said))
        self._lock.flush()
        (folder / NOTE).chmod(0o644)
        folder.chmod(0o755)

    def _forget(self) -> None:
        if self._lock is not None:
            self._lock.close()
        if self._folder is not None:
            _remove(self._folder)
        self._folder = self._lock = None

    def __enter__(self) -> Self:
        self.keep()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._forget()


def notes_folder() -> Path:
    """Return the folder in which notes lie."""
    return Path(os.environ.get(NOTES) or MACHINE_WIDE)


def find_robots() -> list[LaunchSettings]:
    """Return the robots that run here: this user's first, then the service's, then others'."""
    found = [one for one in (_read_note(folder) for folder in _folders()) if one is not None]
    service = _find_service()
    if service is not None:
        found.append(service)
    ours = os.geteuid()
    return sorted(found, key=lambda one: (one.owner_uid != ours, one.owner_uid != 0, one.home))


def robots_to_halt(settings: LaunchSettings) -> list[LaunchSettings]:
    """Return every robot that an order to stand still means, where the person named none.

    Args:
        settings: of the working folder, where no robot may be.
    """
    found = find_robots()
    known = any(one.home == settings.home for one in found)
    if known or (is_guess(settings, found) and any(one.port == settings.port for one in found)):
        return found
    return [*found, settings]


def is_guess(settings: LaunchSettings, others: list[LaunchSettings]) -> bool:
    """Return whether nothing of a robot was found, and something of others was."""
    return bool(others) and settings.owner_uid is None and not _lies_there(settings.home)


def of_this_user(settings: LaunchSettings) -> LaunchSettings:
    """Return the one robot that this user runs, where the working folder holds none."""
    if (settings.home / "run").is_dir():
        return settings
    ours = [one for one in find_robots() if one.owner_uid == os.geteuid()]
    return ours[0] if len(ours) == 1 else settings


def of_running(settings: LaunchSettings) -> LaunchSettings:
    """Return settings with the robot.toml and the site of the robot that runs in this home."""
    found = next((one for one in find_robots() if one.home == settings.home), None)
    return settings if found is None else replace(settings, robot=found.robot, site=found.site)


def describe_robot(robot: LaunchSettings) -> str:
    """Return which robot it is: its id, its folder and whose it is, as far as that is known."""
    user = "" if robot.owner_uid is None else f", user {robot.owner_uid}"
    return f"{robot.robot_id or 'robot'} in {robot.home}{user}"


def _lies_there(home: Path) -> bool:
    return os.path.exists(home / "run" / "bridge" / "bridge.sock")  # noqa: PTH110  # never raises


def _folders() -> Iterator[Path]:
    counts: dict[int, int] = {}
    with suppress(OSError), os.scandir(notes_folder()) as entries:
        for entry in entries:
            if not entry.name.startswith(PREFIX):
                continue
            uid = _owner_of(Path(entry.path))
            if uid is not None and counts.get(uid, 0) < MOST_OF_A_USER:
                counts[uid] = counts.get(uid, 0) + 1
                yield Path(entry.path)


def _owner_of(folder: Path) -> int | None:
    """Return the user whose note lies in a folder; None where another may have put it there."""
    number = folder.name.removeprefix(PREFIX).partition(".")[0]
    with suppress(OSError):
        seen = folder.lstat()
        closed = stat.S_ISDIR(seen.st_mode) and not seen.st_mode & _WRITABLE_BY_OTHERS
        if closed and number == str(seen.st_uid):
            return seen.st_uid
    return None


def _read_note(folder: Path) -> LaunchSettings | None:
    """Return what a living robot's note says; None for one that is dead or wrong."""
    uid = _owner_of(folder)
    try:
        flags = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
        with open(os.open(folder / NOTE, flags), "rb") as file:  # noqa: PTH123  # of a descriptor
            seen = os.fstat(file.fileno())
            if not (stat.S_ISREG(seen.st_mode) and seen.st_uid == uid and _is_locked(file)):
                return None
            said = json.loads(file.read(MAX_BYTES))
        port = int(said["port"])
        if not 1 <= port <= 65_535:
            return None
        made = LaunchSettings(
            home=Path(str(said["home"])),
            robot=Path(str(said["robot"])),
            site=Path(str(said["site"])),
            host=str(said["host"]),
            port=port,
            tls=said["tls"] is True,
            owner_uid=uid,
            robot_id=str(said["robot_id"])[:64],
        )
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return None
    if made.tls:
        made = replace(made, authority=folder / AUTHORITY)
    return made if made.home.is_absolute() else None


def _is_locked(file: Any) -> bool:
    """Return whether the writer of a note lives."""
    try:
        fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except OSError:
        return True
    return False


def _remove_dead(root: Path) -> None:
    """Remove what this user's killed robots have left."""
    for folder in root.glob(f"{PREFIX}{os.geteuid()}.*"):
        if _owner_of(folder) == os.geteuid() and _read_note(folder) is None:
            _remove(folder)


def _remove(folder: Path) -> None:
    import shutil

    shutil.rmtree(folder, ignore_errors=True)


def _find_service() -> LaunchSettings | None:
    """Return the robot of the services (docs/deploy.md), where it runs or can't be looked at."""
    socket = SERVICE_HOME / "run" / "bridge" / "bridge.sock"
    uid = 0
    try:
        uid = SERVICE_HOME.stat().st_uid
        socket.stat()
    except PermissionError:
        pass  # a user outside the group: the planner alone can be asked
    except OSError:
        return None
    scheme, host, port = planner_address(SERVICE_HOME) or ("http", DEFAULT_HOST, DEFAULT_PORT)
    return LaunchSettings(
        home=SERVICE_HOME,
        robot=SERVICE_ROBOT,
        site=Path("/etc/pons/sites/home"),
        host=host,
        port=port,
        tls=scheme == "https",
        owner_uid=uid,
    )
