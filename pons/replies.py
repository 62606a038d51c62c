"""Show what the model wrote about a goal: ``pons replies [GOAL]``, the newest goal unless named."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from pons.http import PlannerDown, PlannerProblem, call, tell_unreached
from pons.terminal import pick, refusal
from pons.terminal_text import goal_line

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

EXIT_SHOWN, EXIT_NOTHING, EXIT_REFUSED, EXIT_DOWN = 0, 1, 3, 6
_OFF = (
    (
        "not_kept: what the model writes is not kept. Set keep_replies = 20 in [model] of "
        "settings.toml and start the planner again; then it is kept of the newest 20 goals."
    ),
    (
        "not_kept: 没有保留模型原文。请在 settings.toml 的 [model] 中设 keep_replies = 20 "
        "并重新启动，之后会保留最近 20 个任务的模型原文。"
    ),
)
_NONE = (
    (
        "no_replies: nothing of this goal is kept. No model wrote about it, the planner was "
        "started again since, or newer goals took its place ({kept} are kept)."
    ),
    (
        "no_replies: 没有保留此任务的模型原文：没有模型参与、规划进程此后重新启动过，"
        "或已被更新的任务取代（只保留 {kept} 个任务）。"
    ),
)
_TURNS = {"plan": "规划", "repair": "修正", "decide": "决定", "replan": "重新规划", "look": "看图"}
_USED = {True: ("used", "已采用"), False: ("not used", "未采用")}


def run(settings: LaunchSettings, goal_id: str | None) -> int:
    """Show them; 0 shown, 1 there is nothing to show, 3 refused, 6 nobody answers."""
    try:
        chosen = goal_id or _newest(settings)
        if chosen is None:
            none_yet = pick("no goal was given yet", "还没有任务")
            print(f"no_goal: {none_yet}", file=sys.stderr)
            return EXIT_NOTHING
        goal = call(settings, "GET", f"/v1/goals/{quote(chosen, safe='')}")
        found = call(settings, "GET", f"/v1/goals/{quote(chosen, safe='')}/replies")
    except PlannerProblem as refused:
        print(f"{refusal(refused, refused.told)}", file=sys.stderr)
        return EXIT_REFUSED
    except PlannerDown as trouble:
        print(tell_unreached(trouble), file=sys.stderr)
        return EXIT_DOWN
    if not found["replies"]:
        print(pick(*_NONE).format(kept=found["kept"]) if found["kept"] else pick(*_OFF))
        return EXIT_NOTHING
    print(goal_line(goal))
    for reply in found["replies"]:
        print(reply_text(reply))
    return EXIT_SHOWN


def reply_text(reply: dict[str, Any]) -> str:
    """Return one reply for a terminal: its head, and its lines below, set in."""
    turn = str(reply["turn"])
    named = pick(turn, _TURNS.get(turn, turn))
    head = f"\n{reply['at']}  {reply['model']}  {named}  {pick(*_USED[bool(reply['used'])])}"
    lines = str(reply["text"]).splitlines() or [pick("(empty)", "（空）")]
    return "\n".join([head, *(f"  {line}" for line in lines)])


def _newest(settings: LaunchSettings) -> str | None:
    goals = call(settings, "GET", "/v1/goals")["goals"]
    newest = max(goals, key=lambda goal: str(goal["created"]), default=None)
    return None if newest is None else str(newest["id"])
