"""Break the simulated robot on demand: ``pons fault lidar_off slip --for 5``.

Speaks to the simulator alone, which says in its truth what is broken; a real robot hears none of
it. What was broken for a time is mended when that is over, and on Ctrl-C.
"""

from __future__ import annotations

import contextlib
import secrets
import sys
import time
from typing import TYPE_CHECKING

from wire import SimControl, SimFault, SimTruth, load_robot
from wire.keys import SIM_CONTROL, SIM_TRUTH, Party
from wire.session import open_session

if TYPE_CHECKING:
    from pons.settings import LaunchSettings
    from wire.session import Publisher, Subscriber

PERIOD_S, LIMIT_S = 0.05, 2.0
EXIT_DONE, EXIT_NO_SIMULATOR, EXIT_UNKNOWN = 0, 1, 2


def run(settings: LaunchSettings, names: list[str], *, seconds: float | None) -> int:
    """Let exactly these faults stand; without any, mend everything.

    Args:
        settings: whose robot.
        names: of ``wire.SimFault``.
        seconds: mend everything after so long; None lets them stand.

    Returns:
        0 done, 1 no simulator answers, 2 a name is unknown.
    """
    unknown = [name for name in names if name not in list(SimFault)]
    if unknown:
        known = "\n  ".join(SimFault)
        print(f"fault_unknown: {', '.join(unknown)}; there are:\n  {known}", file=sys.stderr)
        return EXIT_UNKNOWN
    robot_id = load_robot(settings.robot).id
    with open_session(Party.JUDGE, robot_id, settings.home) as session:
        mouth, ears = session.publisher(SIM_CONTROL), session.subscriber(SIM_TRUTH)
        with contextlib.suppress(KeyboardInterrupt):
            if not _ask(mouth, ears, [SimFault(name) for name in names]):
                print(
                    "no_simulator: none answered within 2 s; `pons up` starts one", file=sys.stderr
                )
                return EXIT_NO_SIMULATOR
            print(f"broken: {', '.join(names)}" if names else "all is mended", flush=True)
            if seconds is None or not names:
                return EXIT_DONE
            time.sleep(seconds)
        mended = _ask(mouth, ears, [])
        print("all is mended" if mended else "no_simulator: it is gone", flush=True)
        return EXIT_DONE if mended else EXIT_NO_SIMULATOR


def _ask(mouth: Publisher[SimControl], ears: Subscriber[SimTruth], faults: list[SimFault]) -> bool:
    """Repeat the wish until the simulator's truth shows it."""
    wish = SimControl(id=f"fault-{secrets.token_hex(6)}", faults=tuple(faults))
    end_s = time.monotonic() + LIMIT_S
    while time.monotonic() < end_s:
        mouth.put(wish)
        time.sleep(PERIOD_S)
        truth = ears.newest()
        if truth is not None and set(truth.faults) == set(faults):
            return True
    return False
