"""Be a second process of the kit: a brain to be killed, frozen or cut off, or a flood.

Run as ``python -m pons.conformance.worker_process HOME ROBOT``. Says
``ready`` when it has loaded; one line
of JSON on standard input then says what to be and, where it dials a proxy, ``through`` which. Says
``going`` when it has begun and ends with its standard input.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pons.conformance.driver import BrainDriver, plain
from pons.conformance.flooder import flood
from pons.conformance.raw_publisher import Mouth, dial
from pons.conformance.reference_client import ReferenceBrain
from pons.conformance.track import TestTrack
from pons.conformance.worker_processes import FLOODER
from wire.keys import STATUS, Party

if TYPE_CHECKING:
    from wire.session import Session


def main(arguments: list[str]) -> int:
    """Wait for a task and do it."""
    home, robot_id = Path(arguments[0]), arguments[1]
    print("ready", flush=True)
    task: dict[str, Any] = json.loads(sys.stdin.readline() or "{}")
    if not task:
        return 0  # never needed
    # As OPERATOR, for there may be many of those: the kit's own brain holds the planner's place.
    with dial(Party.OPERATOR, robot_id, home, task.get("through")) as session:
        if task["be"] == FLOODER:
            flood(session, task)
        else:
            puppet(session, task)
    return 0


def puppet(session: Session, task: dict[str, Any]) -> None:
    """Be a well-behaved brain until standard input ends."""
    ears, mouth = session.subscriber(STATUS), Mouth(session)
    brain = ReferenceBrain(
        task["kind"],
        task["brain_id"],
        TestTrack(tuple(task["start"]), tuple(task["end"])),
        mission=task["mission"],
        heading=task["heading"],
        leg=task["leg"],
        missions=task["missions"],
    )
    driver = BrainDriver(brain, ears.newest, mouth.say)
    driver.breaker = plain
    print("going", flush=True)
    sys.stdin.read()
    driver.close()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
