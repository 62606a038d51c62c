"""Turn the bridge's pacer without work: ``python -m tools.bench.pacer PERIOD_US COUNT PRIORITY``.

Prints how late each wake-up was [us], one a line. For rates at which no bridge runs.
"""

from __future__ import annotations

import sys

from bridge.realtime import MonotonicClock, Pacer, SlackCollector, lock_memory, pin, take_fifo


def main(arguments: list[str]) -> int:
    """Take the bridge's own rights, in its order, and sleep."""
    period_us, count, priority = (int(word) for word in arguments)
    SlackCollector().freeze()
    for right in (lock_memory(), pin(None), take_fifo(priority)):
        if not right.granted:
            print(f"{right.name}: {right.detail}", file=sys.stderr)
    pacer = Pacer(MonotonicClock(), period_us / 1e6)
    late_us = [0.0] * count
    for index in range(count):
        tick = pacer.wait()
        late_us[index] = (tick.late_s + tick.missed * pacer.period_s) * 1e6
    print("\n".join(f"{one:.1f}" for one in late_us))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
