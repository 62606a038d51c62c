"""Step ordinary and hostile ticks on the core that ``PONS_CORE`` asks for; print what came.

Run as a process of its own, for a process has one core: ``python tests/bridge/compiled_ticks.py``.
First line: which core. Then a line per tick: its number and the hash of the whole decision as JSON,
in which floats are written exactly; then a line per value of functions given odd numbers.
"""

from __future__ import annotations

import sys
from hashlib import sha256
from itertools import product
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SEEDS = 24
TICKS = 30
ODD = (0.0, -0.0, 5e-324, 1e-9, 0.3, -0.7, 3.2, 1e6, -1e300, float("inf"), float("nan"))


def main() -> None:
    sys.path.insert(0, str(ROOT))
    from bridge.compiled import use

    print(use().text)
    for number, line in enumerate(_ticks()):
        print(number, line)
    for line in _odd():
        print(line)


def _ticks() -> list[str]:
    from bridge.core import step
    from bridge.core.codec import DECISION, STATE
    from tests.bridge.core.hostile import Hostile
    from tests.bridge.core.scripted import World
    from tests.bridge.core.test_step_laws import prepared

    ordinary = World(keep=True).driving()
    ordinary.obstacle_m = (3.0, 0.05, 0.3)
    ordinary.run(6.0)
    ordinary.obstacle_m = None
    ordinary.run(4.0)
    ordinary.op("estop")
    ordinary.run(3.0)
    lines = [_line(DECISION.write(decision)) for decision in ordinary.decisions]
    starts = ("boot", "ready", "armed", "driving", "stopping", "teleop", "estopped")
    for start, seed in product(starts, range(SEEDS)):
        world = prepared(start)
        hostile = Hostile(seed, world.core)
        state, now_s = STATE.read(STATE.write(world.state)), world.now_s
        for _ in range(TICKS):
            now_s += hostile.gap_s()
            decision = step(world.core, state, hostile.inbox(state, now_s), now_s)
            lines.append(f"{start} {seed} {_line(DECISION.write(decision))}")
            state = decision.state
    return lines


def _line(data: bytes) -> str:
    return sha256(data).hexdigest()[:24]


def _odd() -> list[str]:
    from bridge.core.geometry.kinematics import saturate, twist_of, wheels_of
    from bridge.core.geometry.odometry import along_arc
    from bridge.core.motion.limiter import shape, tick_length
    from bridge.core.state_motion import LimiterState
    from wire import Pose2, RobotDescription, Twist2, compose, wrap

    robot = RobotDescription()
    base, limits = robot.base, robot.limits
    lines = []
    for a, b in product(ODD, ODD):
        sent, asked = Twist2(a, b), Twist2(b, a)
        shaped = shape(asked, LimiterState(sent, a, b), base, limits, a, room_m=b)
        pose = Pose2(a, b, 0.5)
        answers = (
            saturate(sent, base, limits, b),
            wheels_of(sent, base),
            twist_of(a, b, base),
            shaped,
            tick_length(a, b),
            wrap(a),
            along_arc(pose, b, a),
            compose(Pose2(0.1, 0.2, 0.3), pose),
        )
        lines.append(f"{a} {b} {answers!r}")
    return lines


if __name__ == "__main__":
    main()
