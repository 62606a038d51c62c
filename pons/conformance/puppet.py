"""Be a well-behaved brain in a process of its own, to be killed, frozen, or cut off.

Run as ``python -m pons.conformance.puppet HOME ROBOT [THROUGH]``. One line of JSON on standard
input says who it is; it begins at once, says ``going`` and ends with its standard input.
"""

from __future__ import annotations

import sys
from pathlib import Path

from pons.conformance.brain import Brain
from pons.conformance.driver import Driver, plain
from pons.conformance.mouth import Mouth, dial, read_task
from pons.conformance.track import Track
from wire import Status
from wire.keys import STATUS, Party


def main(arguments: list[str]) -> int:
    """Speak until standard input ends."""
    home, robot_id = Path(arguments[0]), arguments[1]
    through = arguments[2] if len(arguments) > 2 else None
    # As OPERATOR, for there may be many of those: the kit's own brain holds the planner's place.
    with dial(Party.OPERATOR, robot_id, home, through) as session:
        ears, mouth = session.subscriber(STATUS), Mouth(session)
        print("ready", flush=True)
        task = read_task(sys.stdin.readline())
        if not task:
            return 0
        track = Track(tuple(task["start"]), tuple(task["end"]))
        brain = Brain(task["kind"], task["brain_id"], track, mission=task["mission"])
        brain.heading, brain.leg, brain.missions = task["heading"], task["leg"], task["missions"]

        def listen() -> Status | None:
            return ears.newest()

        driver = Driver(brain, listen, mouth.say)
        driver.breaker = plain
        print("going", flush=True)
        sys.stdin.read()
        driver.close()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
