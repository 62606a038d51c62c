"""Check an operator's fence and write it, beside the loop, while nothing has torque.

The core has judged the proof, the mode and the place; this thread reads the outlines, writes
fence.json whole or not at all, keeps the old one, and says what became of it. The bridge then ends
so that whoever supervises it starts it anew: a fence is only ever loaded at a start.
"""

from __future__ import annotations

import json
import logging
import threading
from dataclasses import dataclass
from datetime import UTC, datetime
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING

from bridge.core.geometry.fence import permits
from bridge.core.inbox import FenceDone
from bridge.core.state_orders import PendingFence
from bridge.fence_file import NAME, read_record
from bridge.files import replace_file
from wire.errors import ConfigError
from wire.fence import MAX_CORNERS
from wire.fingerprint import fingerprint

if TYPE_CHECKING:
    from pathlib import Path

log = logging.getLogger("bridge.fence")

LINGER_S = 1.0
"""So long the verdict is shown before the bridge ends: twenty statuses."""
LAST_WORD_S = 2.0


@dataclass(frozen=True, slots=True)
class Ground:
    """Hold the fence's paths and the map and hash that it must fit."""

    site: Path
    home: Path
    map_id: str
    fence_hash: str
    """Of the fence in force."""


class FenceDesk:
    """Serve one request at a time. The loop's calls cost a comparison and never wait."""

    def __init__(self, ground: Ground) -> None:
        """Start the thread. Before the loop takes its rank, which threads would inherit."""
        self._ground = ground
        self._noted: PendingFence | None = None
        self._written_s: float | None = None
        self._queue: SimpleQueue[PendingFence | None] = SimpleQueue()
        self._done: SimpleQueue[FenceDone] = SimpleQueue()
        self._thread = threading.Thread(target=self._run, name="fence", daemon=True)
        self._thread.start()

    def take(self) -> FenceDone | None:
        """Return the outcome of a fence request since the last call."""
        if self._noted is None:
            return None
        try:
            return self._done.get_nowait()
        except Empty:
            return None

    def note(self, asked: PendingFence | None, now_s: float) -> None:
        """Queue the fence that the core asks to be written."""
        if asked is self._noted:
            return
        self._noted = asked
        if asked is None:
            return
        if asked.written:
            self._written_s = now_s
        else:
            self._queue.put(asked)

    def is_over(self, now_s: float) -> bool:
        """Return whether a new fence is written and its verdict was shown: time to start anew."""
        return self._written_s is not None and now_s - self._written_s >= LINGER_S

    def close(self) -> bool:
        """Let the thread end; say whether it did. After the loop only: it waits."""
        self._queue.put(None)
        self._thread.join(LAST_WORD_S)
        return not self._thread.is_alive()

    def _run(self) -> None:
        while (asked := self._queue.get()) is not None:
            self._done.put(put_in_force(self._ground, asked))


def put_in_force(ground: Ground, asked: PendingFence) -> FenceDone:
    """Write a fence that is well formed, of this map, and has the robot inside."""
    data = asked.text.encode()
    try:
        check(ground, data, asked.robot_in_map.x_m, asked.robot_in_map.y_m)
    except ConfigError as wrong:
        return FenceDone(asked.id, wrong.code, wrong.detail[:400])
    new_hash = fingerprint(data)
    path = ground.site / NAME
    try:
        kept = path.with_name(f"fence-{ground.fence_hash}.json")
        if path.exists() and not kept.exists():
            replace_file(kept, path.read_bytes())
        replace_file(path, data)
    except OSError as error:
        return FenceDone(asked.id, "fence_unwritable", f"{path}: {error.strerror}"[:400])
    detail = f"{ground.fence_hash} -> {new_hash}, the old one kept as {kept.name}"
    log.warning("fence_accepted: %s by %s: %s", asked.id, asked.source, detail)
    _audit(ground, asked, new_hash)
    return FenceDone(asked.id, "ok", detail)


def check(ground: Ground, data: bytes, x_m: float, y_m: float) -> None:
    """Refuse a fence that must not come into force here and now.

    Raises:
        ConfigError: malformed, crossing itself, too many corners, of another map, the one in
            force, or the robot is outside.
    """
    record = read_record(data, "the fence sent")
    corners = sum(len(outline) for outline in record.outlines)
    if not corners <= MAX_CORNERS:
        raise ConfigError("fence_too_large", f"{corners} corners, at most {MAX_CORNERS}")
    if record.map_id != ground.map_id:
        text = f"it is drawn on map {record.map_id}, here is {ground.map_id}"
        raise ConfigError("fence_of_another_map", text)
    if fingerprint(data) == ground.fence_hash:
        raise ConfigError("fence_unchanged", f"{ground.fence_hash} is in force already")
    if not permits(record.allowed, record.keep_outs, x_m, y_m):
        text = f"the robot stands at ({x_m:.2f}, {y_m:.2f}), which it does not allow"
        raise ConfigError("fence_excludes_robot", text)


def _audit(ground: Ground, asked: PendingFence, new_hash: str) -> None:
    """Add source, time and hash to ``$PONS_HOME/fence/accepted.jsonl``."""
    line = {
        "at": datetime.now(UTC).isoformat(timespec="seconds"),
        "by": asked.source,
        "request": asked.id,
        "old": ground.fence_hash,
        "new": new_hash,
    }
    path = ground.home / "fence" / "accepted.jsonl"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")
    except OSError as error:
        log.warning("fence_audit_unwritable: %s: %s", path, error.strerror)
