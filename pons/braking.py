"""Show the bridge's learnt braking of this robot, and forget it: ``pons braking [forget]``.

Forgetting is a person's act after a repair. It needs the bridge to be down: it would otherwise go
on with what it knows, and write it again.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from bridge.braking_file import load_learnt, path_of
from wire import ConfigError, load_robot
from wire.keys import Party
from wire.sockets import Claim

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_REFUSED, EXIT_MISCONFIGURED = 0, 3, 2


def run(settings: LaunchSettings, *, forget: bool) -> int:
    """Print the braking in force, or forget it; 0 done, 2 robot.toml is wrong, 3 refused."""
    try:
        robot = load_robot(settings.robot)
    except ConfigError as wrong:
        print(wrong, file=sys.stderr)
        return EXIT_MISCONFIGURED
    path = path_of(settings.home, robot)
    if forget:
        try:
            claim = Claim(settings.home, Party.BRIDGE)
        except ConfigError as wrong:
            print(f"{wrong}; end `pons up` first", file=sys.stderr)
            return EXIT_REFUSED
        path.unlink(missing_ok=True)
        claim.close()
        print(f"forgotten: {robot.id} brakes as {settings.robot} says until a stop shows worse")
        return EXIT_DONE
    learnt, trouble = load_learnt(path, robot)
    lag_s, decel = robot.drive.lag_s, robot.limits.max_decel_mps2
    print(f"configured: lag {lag_s:.3f} s, deceleration {decel:.2f} m/s2")
    if trouble is not None:
        print(f"{trouble}: {path}; what is configured counts")
    elif learnt.stops == 0:
        print(f"no stop has been judged yet; {path} is written by the first")
    else:
        print(
            f"counts:     lag {lag_s + learnt.lag_more_s:.3f} s, deceleration "
            f"{decel * learnt.decel_share:.2f} m/s2, after {learnt.stops} stops"
        )
    return EXIT_DONE
