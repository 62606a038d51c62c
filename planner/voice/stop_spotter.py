"""Hear the beginning of each piece of speech, again and again while it is spoken, for a stop.

A piece begins with the recording and after each pause, and a stop is short: so what is decoded has
a bound, whatever is said and for however long. Runs in the voice process; the decoder is given.
"""

from __future__ import annotations

import array
import math
import sys
from collections import deque
from collections.abc import Callable

from planner.voice.recogniser import Recognition

FRAME_S = 0.02
PAUSE_FRAMES = 15
"""Of quiet after which the next sound begins a piece: 0.3 s."""
LEAD_FRAMES = 6
"""Kept from before a piece's first loud frame: a hiss begins softly."""
LEAST_LOUD_FRAMES = 8
"""No stop is shorter: "stop" spoken fast takes 0.2 s."""
STEP_FRAMES = 5
"""Between two looks at a piece: 0.1 s."""
MOST_FRAMES = 90
"""Of a piece that are looked at: "please stop now" spoken slowly takes 1.4 s."""
FLOOR_TIMES = 3.0
"""Loud is what stands so far above the background."""
QUIET_LEVEL = 60.0
"""Of 32767: below it nothing is speech."""
FLOOR_RISES = 1.02
"""A frame, so 2.7 times a second: a noisy room is learnt in a few, and syllables have dips."""


class StopSpotter:
    """Cut one recording into pieces and have the beginning of each decoded."""

    def __init__(
        self, rate_hz: int, channels: int, spot: Callable[[bytes], Recognition | None]
    ) -> None:
        """Begin with a recording.

        Args:
            rate_hz: of its samples.
            channels: of its samples, 16 bits each, interleaved.
            spot: returns the stop that is all that some samples say, or None.
        """
        self._channels, self._spot = channels, spot
        self._frame_bytes = 2 * channels * max(1, round(FRAME_S * rate_hz))
        self._rest = b""
        self._lead: deque[bytes] = deque(maxlen=LEAD_FRAMES)
        self._piece: list[bytes] = []
        self._open = True
        self._loud = self._still = self._looked_at = 0
        self._floor = QUIET_LEVEL / FLOOR_TIMES  # who talks at once is heard at once

    def take(self, pcm: bytes) -> Recognition | None:
        """Add samples; return a stop where one was said, else None."""
        data = self._rest + pcm
        whole = len(data) // self._frame_bytes * self._frame_bytes
        self._rest = data[whole:]
        for start in range(0, whole, self._frame_bytes):
            ended = self._add(data[start : start + self._frame_bytes])
            # Where much comes at once a piece may begin and end in it, and is looked at whole.
            stop = self._spot(ended) if ended else None
            if stop is not None and stop.understood:
                return stop
        if not self._is_due(STEP_FRAMES):
            return None
        self._looked_at = len(self._piece)
        return self._spot(b"".join(self._piece))

    def _is_due(self, fresh_frames: int) -> bool:
        fresh = len(self._piece) - self._looked_at >= fresh_frames
        short = len(self._piece) <= MOST_FRAMES
        return self._open and self._loud >= LEAST_LOUD_FRAMES and fresh and short

    def _add(self, frame: bytes) -> bytes:
        """Add a frame; return the piece that ends with it where it was not looked at to its end."""
        loud = self._is_loud(frame)
        self._still = 0 if loud else self._still + 1
        if loud and not self._open:
            self._open, self._piece = True, list(self._lead)
        if self._open:
            self._loud += loud
            if len(self._piece) <= MOST_FRAMES:
                self._piece.append(frame)
        self._lead.append(frame)
        ended = b""
        if self._still >= PAUSE_FRAMES and self._loud:
            unseen = self._looked_at + PAUSE_FRAMES  # its last words stand before the pause
            ended = b"".join(self._piece) if self._is_due(1) and len(self._piece) > unseen else b""
            self._open, self._piece = False, []
            self._loud = self._looked_at = 0
        return ended

    def _is_loud(self, frame: bytes) -> bool:
        level = _level(frame, self._channels)
        background = min(self._floor * FLOOR_RISES, level)
        loud = level >= max(QUIET_LEVEL, FLOOR_TIMES * background)
        self._floor = max(background, QUIET_LEVEL / FLOOR_TIMES)
        return loud


def _level(frame: bytes, channels: int) -> float:
    """Return the root mean square of a frame's first channel, without its offset."""
    samples = array.array("h")
    samples.frombytes(frame)
    if sys.byteorder == "big":
        samples.byteswap()
    heard = samples[::channels]
    mean = sum(heard) / len(heard)
    return math.sqrt(max(0.0, sum(each * each for each in heard) / len(heard) - mean * mean))
