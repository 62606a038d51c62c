"""Judge from the writing process's answers whether it writes."""

from __future__ import annotations

from bridge.recording import pipe_frames

SILENT_S = 5.0
"""It speaks twice a second; a slow disk may hold it up for a while without loss."""


DOWN = "recorder_down"
"""Every trouble's code but the disk's own, which the writing process says."""

_ASKS = frozenset({pipe_frames.FULL, pipe_frames.NEXT})
_WRITES = frozenset({pipe_frames.FULL, pipe_frames.WRITING})


class Health:
    """Remember the newest word of one writing process."""

    def __init__(self, now_s: float | None) -> None:
        self._heard_s = now_s
        """None until the first tick gives a time."""
        self._word = b""
        self._text = ""
        self._part = b""
        self.wants_segment = True

    def hear(self, data: bytes, now_s: float) -> None:
        """Take the writing process's answers since the last call."""
        *lines, self._part = (self._part + data).split(b"\n")
        if lines:
            self._heard_s = now_s
            self._word, text = lines[-1][:1], lines[-1][1:]
            self._text = text.decode(errors="replace")
            self.wants_segment = any(line[:1] in _ASKS for line in lines)

    @property
    def failing(self) -> bool:
        """Return whether nothing can be written, so that nothing need be sent."""
        return self._word == pipe_frames.FAILING

    def trouble(self, now_s: float) -> str:
        """Return why nothing may be on the disk; empty where all is well."""
        if self.failing:
            return self._text
        self._heard_s = now_s if self._heard_s is None else self._heard_s
        silent_s = now_s - self._heard_s
        if not silent_s <= SILENT_S:
            return f"{DOWN}: the writing process has been silent for {silent_s:.0f} s"
        return "" if self._word in _WRITES else f"{DOWN}: the writing process begins a file"
