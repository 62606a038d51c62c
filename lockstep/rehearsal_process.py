"""Run the process that drives one plan in the simulator, and tells of it as it goes.

Started by ``planner.rehearsal_drive`` alone; it reads one request and ends with its drive. It may
take a bounded share of memory and of processor time, whatever it was given.
"""

from __future__ import annotations

import gc
import resource
from time import monotonic
from typing import TYPE_CHECKING

from processes.worker_main import ParentPipes, run_worker

if TYPE_CHECKING:
    from lockstep.rehearsal_drive import RehearsalDrive

MOST_BYTES = 2 << 30
"""Of data; a home takes a tenth of it."""
MOST_CPU_S = 170
TELL_S = 0.5
"""Between two words to the planner."""


def main(parent: ParentPipes) -> int:
    """Drive what is asked, and tell of it until it is over."""
    resource.setrlimit(resource.RLIMIT_DATA, (MOST_BYTES, MOST_BYTES))
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_CPU_S, MOST_CPU_S))
    gc.disable()  # first: looks for garbage are a tenth of what loading the planner takes
    from lockstep.rehearsal_drive import RehearsalDrive
    from planner.driven_rehearsal import DriveRequest

    asked = parent.read()
    if asked is None:
        return 0
    drive = RehearsalDrive(DriveRequest.model_validate(asked[0]), asked[1])
    gc.freeze()  # what is loaded stays; what a tick makes goes by its counts
    told_s = monotonic()
    for _ in drive.turns():
        if monotonic() - told_s >= TELL_S:
            told_s = monotonic()
            _tell(parent, drive, is_over=False)
    _tell(parent, drive, is_over=True)
    return 0


def _tell(parent: ParentPipes, drive: RehearsalDrive, *, is_over: bool) -> None:
    gc.collect()
    parent.write({"is_over": is_over, "driven": drive.plan().model_dump(mode="json")})


if __name__ == "__main__":
    run_worker(main)
