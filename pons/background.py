"""Look after a robot that runs in the background: ``pons up -d``, ``down``, ``logs``, ``open``."""

from __future__ import annotations

import fcntl
import os
import signal
import subprocess
import sys
import time
from collections import deque
from contextlib import suppress
from typing import TYPE_CHECKING, Final

from pons.terminal import command_path, pick

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from pons.settings import LaunchSettings

UP_LOG: Final = "up.log"
"""What `pons up` says, where it runs in the background."""
READY_MARK: Final = "ready after "
"""What it says last when the robot can be used."""
START_S, END_S = 90.0, 20.0
POLL_S = 0.1
EXIT_DONE, EXIT_NOTHING, EXIT_MISSING, EXIT_UNREACHED = 0, 1, 2, 6


def start(settings: LaunchSettings, words: list[str]) -> int:
    """Start `pons up` with these words apart from this terminal; wait until it is ready.

    Returns:
        0 ready or still starting, else what `pons up` ended with.
    """
    log = settings.home / "logs" / UP_LOG
    try:
        log.parent.mkdir(parents=True, exist_ok=True)
        with log.open("wb") as sink:
            process = subprocess.Popen(
                [sys.executable, "-m", "pons", *words],
                stdin=subprocess.DEVNULL, stdout=sink, stderr=sink, start_new_session=True,
            )  # fmt: skip
    except OSError as error:
        print(f"home_unwritable: {log}: {error.strerror}", file=sys.stderr)
        return EXIT_MISSING
    end_s, told = time.monotonic() + START_S, 0
    while time.monotonic() < end_s:
        status = process.poll()
        text = log.read_text("utf-8", errors="replace")
        print(text[told:], end="", flush=True)
        told = len(text)
        if status is not None:
            return status
        if READY_MARK in text:
            print(f"pid {process.pid}; `{command_path()} down` ends it")
            return EXIT_DONE
        time.sleep(POLL_S)
    print(pick(f"still starting, see {log}", f"仍在启动，见 {log}"))
    return EXIT_DONE


def end(settings: LaunchSettings) -> int:
    """Be ``pons down``: 0 ended, 1 nothing runs here, 6 it did not end in time."""
    holder = _holder(settings.home)
    if holder is None:
        none = pick("no `pons up` runs with", "没有 `pons up` 在此运行：")
        print(f"not_running: {none} {settings.home}", file=sys.stderr)
        return EXIT_NOTHING
    with suppress(ProcessLookupError):
        os.kill(holder, signal.SIGTERM)
    end_s = time.monotonic() + END_S
    while time.monotonic() < end_s:
        if _holder(settings.home) is None:
            print(pick(f"ended (pid {holder})", f"已结束（pid {holder}）"))
            return EXIT_DONE
        time.sleep(POLL_S)
    print(f"still_running: pid {holder}, after {END_S:.0f} s", file=sys.stderr)
    return EXIT_UNREACHED


def _holder(home: Path) -> int | None:
    """Return the process that holds the home's lock; None where nobody does."""
    with suppress(OSError, ValueError), (home / "run" / "up.lock").open() as file:
        try:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return int(file.read())
    return None


def show_logs(settings: LaunchSettings, names: list[str], count: int, *, follow: bool) -> int:
    """Be ``pons logs``: 0 shown, 1 there is none."""
    folder = settings.home / "logs"
    there = {path.stem: path for path in sorted(folder.glob("*.log"))}
    unknown = [name for name in names if name not in there]
    if unknown or not there:
        known = ", ".join(there) or pick("none", "无")
        print(f"no_log: {', '.join(unknown) or folder}; logs: {known}", file=sys.stderr)
        return EXIT_NOTHING
    tails = [_Tail(there[name], name) for name in (names or there)]
    for tail in tails:
        print("".join(tail.newest(max(0, count))), end="")
    with suppress(KeyboardInterrupt):
        while follow:
            for tail in tails:
                print("".join(tail.read_new()), end="", flush=True)
            time.sleep(POLL_S)
    return EXIT_DONE


class _Tail:
    """Read a log's end, and on as it grows; one that was cut is read from its beginning."""

    def __init__(self, path: Path, name: str) -> None:
        self._path, self._name, self._at = path, name, 0

    def newest(self, count: int) -> Iterator[str]:
        with suppress(OSError), self._path.open("rb") as file:
            lines = deque(file, maxlen=count)
            self._at = file.tell()
            yield from map(self._line, lines)

    def read_new(self) -> Iterator[str]:
        with suppress(OSError), self._path.open("rb") as file:
            if file.seek(0, os.SEEK_END) < self._at:
                self._at = 0
            file.seek(self._at)
            for line in file:
                if not line.endswith(b"\n"):
                    return
                self._at += len(line)
                yield self._line(line)

    def _line(self, line: bytes) -> str:
        return f"{self._name:<13} {line.decode(errors='replace').rstrip()}\n"


def open_page(settings: LaunchSettings) -> int:
    """Be ``pons open``: 0 a planner answers there, 6 nobody does."""
    from pons.http import PlannerDown, PlannerProblem, call, tell_unreached

    try:
        call(settings, "GET", "/v1/robot")
    except PlannerProblem:
        pass  # it answers; its page asks for the token
    except PlannerDown as trouble:
        print(tell_unreached(trouble), file=sys.stderr)
        return EXIT_UNREACHED
    import webbrowser

    print(settings.url)
    webbrowser.open(settings.url)
    return EXIT_DONE
