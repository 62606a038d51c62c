"""Act as the operator from a shell: arm, reset, and see the robot's status.

The requests go straight to the bridge. What makes the robot stand is said by ``pons.stop``.
"""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING

from pons.http import PlannerDown, PlannerProblem, call, tell_unreached
from pons.settings import is_robot_named
from pons.terminal_text import goal_line, robot_lines

if TYPE_CHECKING:
    from pons.settings import LaunchSettings
    from wire import Answer, OpKind

_SELFTEST = (
    "  the bridge still tests itself; `pons status` shows what it waits for, `pons doctor` why",
    "  桥仍在自检：`pons status` 显示它在等待什么，`pons doctor` 说明原因",
)


def ask(settings: LaunchSettings, kind: OpKind) -> int:
    """Make the request at the bridge itself and print its verdict."""
    from pons.bridge_client import NoBridge, ask_direct
    from wire import ConfigError

    try:
        answer = ask_direct(settings, kind)
    except (NoBridge, ConfigError) as trouble:
        print(str(trouble), file=sys.stderr)
        return 6
    if answer.accepted:
        print(f"{kind}: accepted {answer.detail}".rstrip())
        return 0
    print("\n".join(refusal_lines(kind, answer)), file=sys.stderr)
    return 3


def refusal_lines(kind: OpKind, answer: Answer) -> list[str]:
    """Return what a person is told of a refusal: code, what came, and why in two languages."""
    from pons.code_messages import code_lines
    from wire import Mode

    head = f"{kind}: refused, {answer.code}: {answer.detail}"
    if kind == "arm" and Mode.SELFTEST.value in answer.detail:  # neither armed nor latched
        return [head, *_SELFTEST]
    return [head, *code_lines(answer.code)]


def status(settings: LaunchSettings, *, as_json: bool) -> int:
    """Show the robot and its goals; of several that run here, where none is named, each."""
    if is_robot_named():
        return _status_of(settings, as_json=as_json)
    from pons.running import describe_robot, is_guess, robots_to_halt

    robots = robots_to_halt(settings)
    shown = [one for one in robots if not is_guess(one, robots[:-1])] or robots
    told = 0
    for robot in shown:
        if len(shown) > 1 and not as_json:
            print(f"{describe_robot(robot)}:")
        told = max(told, _status_of(robot, as_json=as_json))
    return told


def _status_of(settings: LaunchSettings, *, as_json: bool) -> int:
    try:
        robot = call(settings, "GET", "/v1/robot")
        goals = call(settings, "GET", "/v1/goals")["goals"]
    except (PlannerDown, PlannerProblem) as trouble:
        print(tell_unreached(trouble), file=sys.stderr)
        return 6
    if as_json:
        print(json.dumps({"robot": robot, "goals": goals}, ensure_ascii=False, indent=2))
        return 0
    for line in robot_lines(robot):
        print(line)
    for goal in goals[:10]:
        print(goal_line(goal))
    return 0
