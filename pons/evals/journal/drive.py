"""Drive a plan in lockstep: real reducer, real bridge core, simulated robot, simulated clock.

Says what the bridge did about it in the site as it is in its files. Who and what else stood there
on that day is not recorded with the sentence and not simulated.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from planner.brain import ScriptedBrain
from planner.plan import ENDED, GoalState, StepPlan
from pons.evals.journal.think import DriveResult
from tools.lockstep import LockstepWorld, TooLong
from tools.lockstep.judge import Judge
from wire import Pose2, load_robot

LIMIT_S = 180.0
"""Simulated."""
_WAITS = ENDED | {GoalState.PAUSED, GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION}


def drive(
    plan: StepPlan,
    site: Path,
    robot: Path,
    start: tuple[float, float, float] | None,
    limit_s: float = LIMIT_S,
) -> DriveResult:
    """Drive a plan from where the robot stood; where that is not known, from its dock.

    Raises:
        TooLong: the simulated robot did not become ready.
    """
    pose = Pose2(x_m=start[0], y_m=start[1], yaw_rad=start[2]) if start is not None else None
    world = LockstepWorld(
        site=site, robot=load_robot(robot), start=pose, brain=ScriptedBrain([plan])
    )
    judge = Judge(world)
    goal = world.say("drive what was planned")
    held: Counter[str] = Counter()
    seen: set[str] = set()

    def look(_: LockstepWorld) -> bool:
        judge.look()
        rows = {f"{row.row}:{row.action.value}" for row in world.status.rows}
        held.update(rows - seen)
        seen.clear()
        seen.update(rows)
        return goal.state in _WAITS

    began_s = world.now_s
    try:
        world.run_until(look, limit_s)
        state = goal.state.value
    except TooLong:
        state = f"not ended within {limit_s:.0f} simulated seconds"
    record = goal.record
    code = record.outcome.code.value if record.outcome is not None else record.reason or ""
    return DriveResult(
        state,
        code,
        round(world.now_s - began_s, 1),
        round(judge.metres, 2),
        tuple(f"{name} x{count}" for name, count in sorted(held.items())),
        tuple(f"{name} x{count}" for name, count in sorted(judge.broken.items())),
    )
