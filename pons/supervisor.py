"""Keep one child process running: start, notice its death, wait longer each time, start again.

Told the time; knows nothing of what the child does.
"""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import subprocess
from collections import deque
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from typing import IO

from processes.backoff import Backoff
from processes.parent_death import child_command
from wire.errors import ConfigError

FIRST_PAUSE_S = 0.5
LONGEST_PAUSE_S = 10.0
MAX_LOG_BYTES = 10_000_000
KEPT_LOGS = 2
"""Older files beside each log: NAME.log.1 is the newer."""
TOKENS = ("PONS_OPERATOR_TOKEN", "PONS_VIEWER_TOKEN")
"""The planner's alone among the children."""
BEHIND = {"sim.camera": 5}
"""Modules whose sessions stand so many steps of nice behind others: a late picture is only late."""
HANG_S = 5.0
"""As WatchdogSec of the planner's unit: its loop feeds ten times as often, and a hung one can't
hear a stop. Until the first word of a start nothing is counted: a start may be slow."""
STEADY_S = 30.0
"""A child that lived so long starts with the shortest pause again."""
REFUSED_TO_START = ConfigError.exit_status
"""Every process of ours says so for a wrong setting: a restart would meet the same one."""


@dataclass(slots=True)
class Child:
    """Supervise one process."""

    name: str
    arguments: list[str]
    log: Path
    environment: dict[str, str] = field(default_factory=dict)
    knows_tokens: bool = False
    """It inherits what opens the planner's door."""
    waits_for_ready: bool = False
    """Nothing needs it to be ready, and its start would make the others' slower."""
    is_watched: bool = False
    """Its loop says that it turns; when it has and falls silent, it is killed."""
    process: subprocess.Popen[bytes] | None = None
    starts: int = 0
    started_s: float = 0.0
    next_start_s: float = 0.0
    backoff: Backoff = field(
        default_factory=lambda: Backoff(FIRST_PAUSE_S, LONGEST_PAUSE_S, STEADY_S)
    )
    log_began: int = 0
    _ears: socket.socket | None = None
    _fed_s: float = inf

    def start(self, now_s: float) -> None:
        """Start it in a process group of its own, bound to this process, logging to its file."""
        inherited = {
            name: value
            for name, value in os.environ.items()
            if self.knows_tokens or name not in TOKENS
        }
        if self.is_watched:
            inherited["NOTIFY_SOCKET"] = self._listen()
        behind = BEHIND.get(self.arguments[0], 0)
        command = child_command(*self.arguments, session_nice=behind)
        with self._opened_log() as log:
            self.log_began = log.tell()
            self.process = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                start_new_session=True,
                env={**inherited, **self.environment},
            )
        self.starts += 1
        self.started_s = now_s

    def _listen(self) -> str:
        """Return where this start says that its loop turns, as systemd's services do."""
        self._ears = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_CLOEXEC)
        self._ears.setblocking(False)
        self._ears.bind("")  # the kernel's choice, in the abstract namespace: no file to remove
        self._fed_s = inf
        name: bytes = self._ears.getsockname()
        return "@" + name[1:].decode()

    def _stop_listening(self) -> None:
        if self._ears is not None:
            self._ears.close()
            self._ears = None

    def kill_if_hung(self, now_s: float) -> bool:
        """Kill it where its loop has been silent too long; return whether it was."""
        if self._ears is None or self.process is None:
            return False
        with contextlib.suppress(BlockingIOError):
            while word := self._ears.recv(100):
                self._fed_s = inf if word == b"STOPPING=1" else now_s
        if now_s - self._fed_s <= HANG_S:
            return False
        self.signal(signal.SIGKILL)
        self._fed_s = inf
        return True

    def bound_log(self, most_bytes: int = MAX_LOG_BYTES) -> None:
        """Keep the log's end in older files once it is too long, and cut it.

        The file is copied and cut, not renamed or read from a pipe: whoever writes holds it open,
        and a bridge must neither wait for its log's reader nor die of its end. It writes at the
        file's end, wherever that is. A line written between copy and cut is lost.
        """
        try:
            size = self.log.stat().st_size
            if size <= most_bytes:
                return
            for number in range(KEPT_LOGS, 1, -1):
                older = self._older(number - 1)
                if older.exists():
                    older.replace(self._older(number))
            with self.log.open("rb") as log, self._older(1).open("wb") as kept:
                log.seek(size - most_bytes)
                kept.write(log.read(most_bytes))
        except OSError:
            pass  # a full disk: then all the more
        with contextlib.suppress(OSError):
            os.truncate(self.log, 0)
            self.log_began = 0

    def _older(self, number: int) -> Path:
        return self.log.with_name(f"{self.log.name}.{number}")

    def _opened_log(self) -> IO[bytes]:
        """Open its log; where the disk refuses, its words are lost and it runs all the same."""
        try:
            return self.log.open("ab")
        except OSError:
            return Path(os.devnull).open("ab")

    def died(self, now_s: float) -> int | None:
        """Return the exit status of a death not yet noticed and plan the next start."""
        status = self.process.poll() if self.process else None
        if status is None:
            return None
        self.process = None
        self._stop_listening()
        self.next_start_s = now_s + self.backoff.pause_after(now_s - self.started_s)
        return status

    def due(self, now_s: float) -> bool:
        """Say whether it should be started now."""
        return self.process is None and now_s >= self.next_start_s

    def signal(self, number: signal.Signals) -> None:
        """Send a signal to the whole group; a group that is gone already is no error."""
        if self.process is not None:
            try:
                os.killpg(self.process.pid, number)
            except ProcessLookupError:
                return

    def stop(self, patience_s: float) -> None:
        """End it: SIGTERM, then SIGKILL for the rest of its group."""
        if self.process is None:
            return
        self.signal(signal.SIGTERM)
        try:
            self.process.wait(timeout=patience_s)
        except subprocess.TimeoutExpired:
            self.signal(signal.SIGKILL)
            self.process.wait()
        self.signal(signal.SIGKILL)
        self.process = None
        self._stop_listening()

    def last_words(self, lines: int = 8) -> str:
        """Return the end of its log since its start; earlier runs logged other things."""
        try:
            with self.log.open(encoding="utf-8", errors="replace") as text:
                text.seek(self.log_began)
                return "".join(deque(text, maxlen=lines)).rstrip()
        except OSError:
            return ""
