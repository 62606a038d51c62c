"""Read, prepare and write what people drew on the map, beside the loop, also while it drives.

The core has judged the proof; this thread reads the outlines, prepares the fence less them, writes
the file whole or not at all, and says what became of it. The core then counts them from one tick to
the next, and has the last word on whether the robot can stop before them: where it says no, the
file is written back as it was.
"""

from __future__ import annotations

import logging
import threading
from dataclasses import dataclass
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING

from pydantic import ValidationError

from bridge.core.inbox import FenceDone
from bridge.core.state_orders import Marks, PendingMarks
from bridge.files import replace_file
from wire.errors import ConfigError, Unwritable
from wire.fence import MAX_MARKS_TEXT, MarksFile, marks_flaw
from wire.fingerprint import fingerprint
from wire.plain_file import read_plain_file
from wire.robot import explain

if TYPE_CHECKING:
    from pathlib import Path

    from bridge.core.geometry.fence import FenceGrid

log = logging.getLogger("bridge.marks")

LAST_WORD_S = 2.0


@dataclass(frozen=True, slots=True)
class Paper:
    """Hold what marks are drawn on and where they are kept."""

    path: Path
    map_id: str
    fence: FenceGrid | None


def marks_path(home: Path, map_id: str) -> Path:
    """Return where the bridge keeps the marks of a map."""
    return home / "fence" / f"marks-{map_id}.json"


def load_marks(path: Path, map_id: str) -> str:
    """Return the text of the marks that an earlier run was left with; empty: there are none.

    Raises:
        ConfigError: they can't be read, and to drive without them would be to forget a keep-out.
    """
    try:
        text = read_plain_file(path, MAX_MARKS_TEXT).decode()
    except (FileNotFoundError, NotADirectoryError):  # of a home that is none others tell
        return ""
    except OSError as error:
        raise Unwritable("marks_unreadable", f"{path}: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise ConfigError("marks_invalid", f"{path}: {error}") from None
    if text:
        read_marks(text, map_id, str(path))
    return text


def read_marks(text: str, map_id: str, name: str = "the marks sent") -> MarksFile:
    """Parse marks of this map.

    Raises:
        ConfigError: malformed, of another map, or with an outline that is none.
    """
    try:
        marks = MarksFile.model_validate_json(text)
    except ValidationError as error:
        raise ConfigError("marks_invalid", f"{name}: {explain(error)}") from None
    if marks.map_id != map_id:
        raise ConfigError("marks_of_another_map", f"{name}: on {marks.map_id}, here is {map_id}")
    wrong = marks_flaw(marks)
    if wrong is not None:
        raise ConfigError(wrong[0], f"{name}: {wrong[1]}")
    return marks


def prepare(paper: Paper, asked: PendingMarks, in_force: str = "") -> FenceDone:
    """Prepare the fence less these marks, and write them down; those in force stay prepared."""
    try:
        marks = read_marks(asked.text, paper.map_id)
        if paper.fence is None or not paper.fence.with_marks(asked.text, in_force).boundary:
            text = f"{len(marks.keep_outs)} outlines cover all that is allowed"
            raise ConfigError("marks_leave_nothing", text)
        replace_file(paper.path, asked.text.encode())
    except ConfigError as wrong:
        return FenceDone(asked.id, wrong.code, wrong.detail[:400])
    except OSError as error:
        return FenceDone(asked.id, "marks_unwritable", f"{paper.path}: {error.strerror}"[:400])
    return FenceDone(asked.id, "ok", f"{len(marks.outlines)} marks, {fingerprint_of(asked.text)}")


def fingerprint_of(text: str) -> str:
    """Return the hash that status shows of marks."""
    return fingerprint(text.encode())


class MarksDesk:
    """Serve one request at a time. The loop's calls cost a comparison and never wait."""

    def __init__(self, paper: Paper) -> None:
        """Start the thread. Before the loop takes its rank, which threads would inherit."""
        self._paper = paper
        self._noted = Marks()
        self._queue: SimpleQueue[PendingMarks | str | None] = SimpleQueue()
        self._done: SimpleQueue[FenceDone] = SimpleQueue()
        self._thread = threading.Thread(target=self._run, name="marks", daemon=True)
        self._thread.start()

    def take(self) -> FenceDone | None:
        """Return the outcome of a request since the last call."""
        if self._noted.asked is None:
            return None
        try:
            return self._done.get_nowait()
        except Empty:
            return None

    def note(self, marks: Marks) -> None:
        """Queue what the core asks to be prepared; keep the file as what counts."""
        if marks is self._noted:
            return
        before, self._noted = self._noted.asked, marks
        if marks.asked is not None and marks.asked is not before:
            self._queue.put(marks.asked)
        elif before is not None and marks.text != before.text:
            self._queue.put(marks.text)  # the core refused what was written

    def close(self) -> bool:
        """Let the thread end; say whether it did. After the loop only: it waits."""
        self._queue.put(None)
        self._thread.join(LAST_WORD_S)
        return not self._thread.is_alive()

    def _run(self) -> None:
        while (asked := self._queue.get()) is not None:
            if isinstance(asked, PendingMarks):
                self._done.put(prepare(self._paper, asked, self._noted.text))
                continue
            try:
                replace_file(self._paper.path, asked.encode())
            except OSError as error:
                log.warning("marks_unwritable: %s: %s", self._paper.path, error.strerror)
