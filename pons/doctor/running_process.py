"""Hear what a sensor's running process says of itself, for the checks that look at one."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, TypeVar

from pons.doctor.finding import BilingualWords, HealthFinding, fail
from wire.base import Record
from wire.keys import Party
from wire.session import open_session

if TYPE_CHECKING:
    from pathlib import Path

    from wire import RobotDescription
    from wire.keys import Key

HEAR_S = 2.0
"""Each says its state twice a second."""
PERIOD_S = 0.02
M = TypeVar("M", bound=Record)


def hear_state(home: Path, robot: RobotDescription, key: Key[M]) -> M | None:
    """Return the newest word on a key; None where its process says nothing."""
    with open_session(Party.JUDGE, robot.id, home) as session:
        heard = session.subscriber(key)
        end_s = time.monotonic() + HEAR_S
        while time.monotonic() < end_s:
            time.sleep(PERIOD_S)
            state = heard.newest()
            if state is not None:
                return state
    return None


def says_nothing(line: str) -> HealthFinding:
    """Return the finding about a process that runs and says nothing."""
    return fail(
        line,
        BilingualWords("its process runs and says nothing", "其进程在运行，但没有任何消息"),
        BilingualWords(f"see logs/{line}.log, and start it anew", f"请查看 logs/{line}.log 并重启"),
    )
