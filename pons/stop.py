"""Stop the robot from a shell, as fast as a process can start: neither numpy nor pydantic loads.

The planner is asked over HTTP. Soon after, or once it has answered, the same stop goes straight to
the bridge over the wire, which needs no planner, no disk that can be written and no right
robot.toml. Whatever breaks one way, the other is still waited for. A planner may have been taken
over: what it says of the bridge is believed only where this user can't ask the bridge itself, and
then called the planner's word.
"""

from __future__ import annotations

import secrets
import sys
import threading
from typing import TYPE_CHECKING

from pons.http import PlannerDown, PlannerProblem, call

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

HTTP_HEAD_START_S = 0.15
HTTP_TIMEOUT_S = 2.5
CONFIRMED = "stop taken, the robot ramps to a stand / 已收到停止，正在停稳 (bridge confirmed)"
SENT = "stop sent; asking the bridge itself / 停止已发出，正在向 bridge 核实"
SAID_BY_PLANNER = (
    "the planner says that the bridge took the stop (not asked from here: {why})"
    " / 规划器称 bridge 已收到停止（此处无法直接核实）"
)


def run(settings: LaunchSettings) -> int:
    """Stop; say how; return 0 only when the bridge has confirmed, as far as it can be asked."""
    by_http = _Attempt(settings)
    by_http.start()
    by_http.join(HTTP_HEAD_START_S)
    if by_http.confirmed:  # loading the wire takes longer than the stop itself
        print(SENT, file=sys.stderr, flush=True)
    out_of_reach = _out_of_reach(settings) if by_http.confirmed else None
    trouble = out_of_reach or _straight_to_the_bridge(settings)
    if trouble is None:
        print(CONFIRMED)
        return 0
    by_http.join(HTTP_TIMEOUT_S)
    if by_http.confirmed and (out_of_reach := out_of_reach or _out_of_reach(settings)):
        print(SAID_BY_PLANNER.format(why=out_of_reach))
        return 0
    planner = by_http.trouble or "no answer yet"
    if by_http.confirmed:
        planner = "it says that the bridge confirmed, and is not believed"
    print(
        "no_bridge: the bridge itself did not confirm the stop. "
        "Without a bridge the drive's own time-out stops the wheels; use the robot's stop button. "
        f"Planner: {planner}. Bridge: {trouble}\n"
        "bridge 没有确认停止。没有 bridge 时，驱动自身的超时会让轮子停下；请按机器人上的停止按钮。",
        file=sys.stderr,
    )
    return 1


def _out_of_reach(settings: LaunchSettings) -> str | None:
    """Say why the bridge itself can't be asked from here; None where it can."""
    try:
        from pons.bridge_client import out_of_reach

        return out_of_reach(settings)
    except Exception as trouble:  # noqa: BLE001  # a broken second way is out of reach
        return in_a_line(trouble)


def _straight_to_the_bridge(settings: LaunchSettings) -> str | None:
    """Say the stop over the wire; return in one line why it is not confirmed, None where it is."""
    try:
        from pons.bridge_client import stop_direct

        stop_direct(settings, f"cli-{secrets.token_hex(6)}")
    except Exception as trouble:  # noqa: BLE001  # nothing may keep the first way from being told
        return in_a_line(trouble)
    return None


def in_a_line(trouble: Exception) -> str:
    """Describe an error without a traceback; a person reads it while a robot moves."""
    text = " ".join(str(trouble).split())
    return text if ": " in text else f"{type(trouble).__name__}: {text}"


class _Attempt(threading.Thread):
    """Ask the planner, beside the main thread."""

    def __init__(self, settings: LaunchSettings) -> None:
        super().__init__(daemon=True)
        self._settings = settings
        self.confirmed = False
        self.trouble = ""

    def run(self) -> None:
        try:
            answer = call(
                self._settings, "POST", "/v1/stop", {"source": "cli"}, timeout_s=HTTP_TIMEOUT_S
            )
            self.confirmed = bool(answer.get("confirmed"))
            self.trouble = "" if self.confirmed else "the bridge did not confirm"
        except (PlannerDown, PlannerProblem) as trouble:
            self.trouble = str(trouble)
        except Exception as trouble:  # noqa: BLE001  # another service may answer on that port
            self.trouble = in_a_line(trouble)
