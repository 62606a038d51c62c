"""Run one robot as a person does: ``pons up`` in a home of its own, the CLI and plain HTTP.

The home is a small disk of its own where this machine lets us mount one, in a mount namespace that
ends with this process: nothing stays mounted, however it ends.
"""

from __future__ import annotations

import ctypes
import io
import os
import signal
import subprocess
import time
import wave
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

import psutil

from pons.http import PlannerDown, PlannerProblem, call
from pons.robot_processes import ProcessGone
from pons.settings import CHECKOUT, LaunchSettings
from processes.parent_death import module_in
from tools.bench.chaos.draw import PROCESSES
from tools.bench.context import MeasurementFailure, line, until
from tools.pons_up import PonsUp

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path
    from types import TracebackType
    from typing import Self

DISK_MB = 640
START_S, GONE_S, HEARD_S = 90.0, 12.0, 30.0
RATE_HZ = 16_000
CLONE_NEWNS, MS_RDONLY, MS_REMOUNT, MS_BIND, MS_REC = 0x20000, 1, 32, 4096, 16384
MS_PRIVATE, MNT_DETACH = 1 << 18, 2


class House(PonsUp):
    """Be one running robot, its disk and its processes."""

    def __init__(self, home: Path, log: Path, *, mounts: bool) -> None:
        """Describe it; entering the context starts it.

        Args:
            home: an empty folder; becomes its ``$PONS_HOME``.
            log: what ``pons up`` prints; beside the home, whose disk is going to be full.
            mounts: put a disk of its own below the home.
        """
        site = CHECKOUT / "sites" / "home"
        super().__init__(home, site, log)
        self.settings = LaunchSettings(home, CHECKOUT / "robot.toml", site, "127.0.0.1", self.port)
        self.mounts = mounts

    def __enter__(self) -> Self:
        if self.mounts:
            mount("tmpfs", self.home, "tmpfs", 0, f"size={DISK_MB}m,mode=755")
        try:
            self.launch()
            until(self._is_up, START_S, "the line of pons up with its URL", 0.1)
            until(lambda: not self.missing(), START_S, "all processes", 0.2)
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """End every process of it, then its disk."""
        left = self.tree()
        for process in left:
            with suppress(psutil.NoSuchProcess):
                process.resume()
        with suppress(subprocess.TimeoutExpired):
            self.end_by(signal.SIGINT, GONE_S)
        self.destroy()
        for process in left:
            with suppress(psutil.NoSuchProcess):
                process.kill()
        psutil.wait_procs(left, GONE_S)
        if self.mounts:
            unmount(self.home)

    def _is_up(self) -> bool:
        try:
            return self.has_greeted()
        except ProcessGone as gone:
            raise MeasurementFailure(str(gone)) from None

    # Processes ----------------------------------------------------------------------------------

    def find(self, name: str) -> psutil.Process | None:
        """Return one of them by its name in ``draw.PROCESSES``, where it lives."""
        for process in self.tree()[1:]:
            with suppress(psutil.Error):
                alive = process.status() != psutil.STATUS_ZOMBIE
                if alive and role(process.cmdline()) == name:
                    return process
        return None

    def missing(self) -> list[str]:
        """Name those that do not live now."""
        found = set()
        for process in self.tree()[1:]:
            with suppress(psutil.Error):
                if process.status() != psutil.STATUS_ZOMBIE:
                    found.add(role(process.cmdline()))
        return [name for name in PROCESSES if name not in found]

    # Requests -----------------------------------------------------------------------------------

    def ask(self, method: str, path: str, body: dict[str, Any] | None = None) -> Any:
        """Send one request. Raises PlannerDown, PlannerProblem."""
        return call(self.settings, method, path, body, timeout_s=4.0)

    def ready(self) -> bool:
        """Tell whether the planner says that a goal could be carried out."""
        try:
            call(self.settings, "GET", "/readyz", timeout_s=1.0)
        except (PlannerDown, PlannerProblem):
            return False
        return True

    def speak(self) -> None:
        """Let the planner hear a second of silence: it starts a recogniser for the next recording.

        Raises:
            PlannerDown: no answer in time.
            Refused: a problem, as of a recogniser that does not start.
        """
        sort = {"Content-Type": "audio/wav"}
        call(self.settings, "POST", "/v1/voice", None, HEARD_S, sort, silence())

    def pons(self, *words: str) -> subprocess.Popen[str]:
        """Begin a ``pons`` command as a person in a shell."""
        return subprocess.Popen(
            self.command(*words),
            cwd=self.folder,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    def shell(self, *words: str, limit_s: float) -> tuple[int | None, str]:
        """Run a ``pons`` command; return its exit status, None where it hung, and what it said."""
        process = self.pons(*words)
        try:
            said, _ = process.communicate(timeout=limit_s)
            return process.returncode, said
        except subprocess.TimeoutExpired:
            process.kill()
            said, _ = process.communicate()
            return None, said

    def logs(self, since_s: float, lines: int = 12) -> dict[str, list[str]]:
        """Return the ends of those logs that were written to lately, for a look afterwards."""
        newer_s = time.time() - (time.monotonic() - since_s)
        tails = self.tails(lines, newer_s)
        return {name: [line(one) for one in tail] for name, tail in tails.items()}


WORKERS = {
    "planner.navigation.process_main": "route",
    "planner.perception.process_main": "vision",
    "planner.voice.process_main": "voice",
    "sim.camera": "camera",
}
"""What the draw calls the processes whose module has another name."""


def role(words: list[str]) -> str:
    """Return what a process of ``pons up`` is, by its command line; empty where it is none."""
    text = " ".join(words)
    if "bridge.recording" in text:
        return "recorder"
    module = module_in(words)
    if module is None:
        return ""
    return WORKERS.get(module, module.rsplit(".", 1)[-1])


def silence() -> bytes:
    """Return a recording of a second in which nobody speaks."""
    out = io.BytesIO()
    with wave.open(out, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE_HZ)
        file.writeframes(bytes(2 * RATE_HZ))
    return out.getvalue()


# Mounts -----------------------------------------------------------------------------------------


def private_mounts() -> str:
    """Enter a mount namespace of our own; say why not, where this machine does not let us."""
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.unshare(CLONE_NEWNS) != 0:
        return f"no mount namespace: {os.strerror(ctypes.get_errno())}"
    if libc.mount(None, b"/", None, MS_REC | MS_PRIVATE, None) != 0:
        return f"mounts stay shared: {os.strerror(ctypes.get_errno())}"
    return ""


def mount(source: str, target: Path, kind: str, flags: int, data: str = "") -> None:
    """Mount something. Raises OSError."""
    libc = ctypes.CDLL(None, use_errno=True)
    done = libc.mount(
        source.encode(), os.fsencode(target), kind.encode(), flags, data.encode() or None
    )
    if done != 0:
        raise OSError(ctypes.get_errno(), f"mount on {target}")


def unmount(target: Path) -> None:
    """Take off what is mounted topmost there; what still uses it keeps it until it lets go."""
    libc = ctypes.CDLL(None, use_errno=True)
    libc.umount2(os.fsencode(target), MNT_DETACH)


@contextmanager
def read_only(home: Path) -> Iterator[None]:
    """Make every new opening in a home read-only; files that are open stay as they are.

    A second mount lies over the first: the kernel refuses to remount a disk with files open for
    writing, as a healthy one's always are.
    """
    mount(str(home), home, "none", MS_BIND)
    try:
        mount("none", home, "none", MS_REMOUNT | MS_BIND | MS_RDONLY)
        yield
    finally:
        unmount(home)
