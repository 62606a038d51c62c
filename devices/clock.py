"""Put a sensor's own time onto our clock, though bytes arrive late and in bursts.

Bytes can be late (a busy host, a USB adapter that waits 16 ms), never early. So of all arrivals
the least delayed says most: the offset is the smallest seen lately, and a burst after a pause
changes nothing. An instant so found is later than the truth by the least delay at most, and
never later than the arrival of the bytes that tell of it.
"""

from __future__ import annotations

from collections import deque

WINDOW_S = 2.0
"""Long enough for an undelayed arrival. A sensor whose clock is slow by 1 %, as one without quartz
may be, is stamped 20 ms too old by it, which is the safe side."""
BUCKETS = 20


class SensorClock:
    """Turn the sensor's seconds into ours."""

    def __init__(self, window_s: float = WINDOW_S) -> None:
        """Learn from the arrivals of the last ``window_s``."""
        self._window_s = window_s
        self._least: deque[tuple[float, float]] = deque()
        """(when the bucket began on our clock, least offset in it)."""

    def reset(self) -> None:
        """Forget what was learnt: the sensor began anew, or was silent."""
        self._least.clear()

    def note(self, sensor_s: float, arrival_s: float) -> float:
        """Take one arrival; return when ``sensor_s`` was, on our clock.

        Args:
            sensor_s: on the sensor's clock, which never goes back between two resets.
            arrival_s: when the bytes that tell of it were read, on our clock.
        """
        offset = arrival_s - sensor_s
        bucket_s = self._window_s / BUCKETS
        if self._least and arrival_s - self._least[-1][0] < bucket_s:
            began_s, least = self._least[-1]
            self._least[-1] = (began_s, min(least, offset))
        else:
            self._least.append((arrival_s, offset))
        while self._least[0][0] < arrival_s - self._window_s:
            self._least.popleft()
        # What was just read was not measured later, whatever the last digit of a float says.
        return min(sensor_s + min(least for _, least in self._least), arrival_s)

    def date(self, sensor_s: float, arrival_s: float) -> float | None:
        """Return when ``sensor_s`` was, on our clock, and learn nothing; None before any arrival.

        For what comes with a delay of its own (a scan takes a turn), dated by what comes without.
        """
        if not self._least:
            return None
        return min(sensor_s + min(least for _, least in self._least), arrival_s)


class WrappedCounter:
    """Unwrap a counter that begins again at a modulus."""

    def __init__(self, modulus: int) -> None:
        self._modulus = modulus
        self._last: int | None = None
        self._base = 0

    def unwrap(self, value: int) -> int:
        """Return the counter as if it had never begun again; steps back count as a new round."""
        if self._last is not None and value < self._last:
            self._base += self._modulus
        self._last = value
        return self._base + value
