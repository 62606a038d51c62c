"""Make the robot stand from a shell (stop, estop, disarm), as fast as a process can start.

Neither numpy nor pydantic loads. The planner is asked over HTTP. Soon after, or once it has
answered, the same order goes straight to the bridge over the wire, which needs no planner, no disk
that can be written and no right robot.toml. Whatever breaks one way, the other is still waited for.
A planner may have been taken over: what it says of the bridge is believed only where this user
can't ask the bridge itself, and then called the planner's word. Where nobody says which robot is
meant, every robot that runs on this machine is told, and each is named.
"""

from __future__ import annotations

import os
import sys
import threading
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pons.http import PlannerDown, PlannerProblem, call
from pons.settings import asker, is_robot_named
from pons.terminal import pick

if TYPE_CHECKING:
    from typing import Literal, NoReturn

    from pons.settings import LaunchSettings

    Halt = Literal["stop", "estop", "disarm"]

HALTS = {"stop": "停止", "estop": "保护性停止", "disarm": "下电"}  # as they are called in Chinese
HTTP_HEAD_START_S = 0.15
HTTP_TIMEOUT_S = 2.5
GUESS_S = 0.5
"""So long a robot of which nothing was found is waited for, once the others have answered."""
EXIT_UNCONFIRMED = 6
EXIT_REFUSED = 3
CONFIRMED = (
    "stop taken, the robot ramps to a stand (bridge confirmed)",
    "已收到停止，正在停稳（安全桥已确认）",
)
SENT = "{word} sent; asking the bridge itself", "已发出“{word}”，正在向安全桥核实"
SAID_BY_PLANNER = (
    "the planner says that the bridge took the {word} (not asked from here: {why})",
    "规划器称安全桥已收到“{word}”（此处无法直接核实：{why}）",
)
UNCONFIRMED = (
    (
        "the bridge itself did not confirm the {word}. Without a bridge the drive's own "
        "time-out stops the wheels; use the robot's stop button."
    ),
    "安全桥没有确认“{word}”。没有安全桥时，驱动自身的超时会让轮子停下；请按机器人上的停止按钮。",
)


@dataclass(frozen=True, slots=True)
class HaltOutcome:
    """Hold what became of an order at one robot, and the exit status that says so."""

    status: int
    text: str


def run(settings: LaunchSettings, word: Halt = "stop", *, as_json: bool = False) -> int:
    """Give the order; return 0 only when each bridge has confirmed, as far as it can be asked."""
    tell = _tell_json if as_json else _tell
    from pons.running import is_guess, robots_to_halt

    robots = [settings] if is_robot_named() else robots_to_halt(settings)
    if len(robots) == 1:
        outcome = _halt(robots[0], word, tells=True)
        tell(robots[0], word, outcome, named=False)
        return outcome.status
    orders = [_Order(robot, word) for robot in robots]
    for order in orders:
        order.start()
    status = 0
    for order in orders:
        guess = is_guess(order.robot, robots[:-1])
        order.join(GUESS_S if guess else None)
        if order.outcome.status and guess:
            continue  # nothing of a robot is here: the others were meant
        status = max(status, order.outcome.status)
        tell(order.robot, word, order.outcome, named=True)
    return status


def _tell(robot: LaunchSettings, word: Halt, outcome: HaltOutcome, *, named: bool) -> None:
    from pons.running import describe_robot

    head = f"{describe_robot(robot)}: " if named else ""
    print(f"{head}{outcome.text}", file=sys.stderr if outcome.status else sys.stdout, flush=True)


def _tell_json(robot: LaunchSettings, word: Halt, outcome: HaltOutcome, *, named: bool) -> None:
    """Print what became of the order at one robot, an object a line."""
    import json

    told = {
        "order": word,
        "confirmed": outcome.status == 0,
        "status": outcome.status,
        "robot": robot.robot_id or None,
        "home": str(robot.home),
        "told": outcome.text,
    }
    print(json.dumps(told, ensure_ascii=False), flush=True)


def leave(status: int) -> NoReturn:
    """End the process with a status, and with nothing in between.

    The thread that a hung planner keeps, and those of the wire, may still run. Ended by the
    interpreter, one of them aborted the process now and then: a stop that was confirmed then had
    the status of one that was not.
    """
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError):  # nobody reads it any more
            stream.flush()
    os._exit(status)


def _halt(robot: LaunchSettings, word: Halt, *, tells: bool) -> HaltOutcome:
    """Give one robot the order by both ways."""
    by_http, named = _Attempt(robot, word), pick(word, HALTS[word])
    by_http.start()
    by_http.join(HTTP_HEAD_START_S)
    if by_http.confirmed and tells:  # loading the wire takes longer than the stop itself
        print(pick(*SENT).format(word=named), file=sys.stderr, flush=True)
    out_of_reach = _out_of_reach(robot) if by_http.confirmed else None
    answer = out_of_reach or _straight_to_the_bridge(robot, word)
    if not isinstance(answer, str):
        return answer
    by_http.join(HTTP_TIMEOUT_S)
    if by_http.confirmed and (out_of_reach := out_of_reach or _out_of_reach(robot)):
        return HaltOutcome(0, pick(*SAID_BY_PLANNER).format(word=named, why=out_of_reach))
    planner = by_http.trouble or "no answer yet"
    if by_http.confirmed:
        planner = "it says that the bridge confirmed, and is not believed"
    return HaltOutcome(
        EXIT_UNCONFIRMED,
        f"no_bridge: {pick(*UNCONFIRMED).format(word=named)} Planner: {planner}. Bridge: {answer}",
    )


def _out_of_reach(robot: LaunchSettings) -> str | None:
    """Say why the bridge itself can't be asked from here; None where it can."""
    try:
        from pons.bridge_client import out_of_reach

        return out_of_reach(robot)
    except Exception as trouble:  # noqa: BLE001  # a broken second way is out of reach
        return in_a_line(trouble)


def _straight_to_the_bridge(robot: LaunchSettings, word: Halt) -> HaltOutcome | str:
    """Give the order over the wire; return the verdict, or in one line why there is none."""
    try:
        from pons.bridge_client import ask_direct, refusal_lines, stop_direct

        if word == "stop":
            stop_direct(robot)
            return HaltOutcome(0, pick(*CONFIRMED))
        answer = ask_direct(robot, word)
        if answer.accepted:
            return HaltOutcome(0, f"{word}: accepted {answer.detail}".rstrip())
        return HaltOutcome(EXIT_REFUSED, "\n".join(refusal_lines(word, answer)))
    except Exception as trouble:  # noqa: BLE001  # nothing may keep the first way from being told
        return in_a_line(trouble)


def in_a_line(trouble: Exception) -> str:
    """Describe an error without a traceback; a person reads it while a robot moves."""
    text = " ".join(str(trouble).split())
    return text if ": " in text else f"{type(trouble).__name__}: {text}"


class _Order(threading.Thread):
    """Give one robot of several the order, beside the others."""

    def __init__(self, robot: LaunchSettings, word: Halt) -> None:
        super().__init__(daemon=True)
        self.robot, self._word = robot, word
        self.outcome = HaltOutcome(EXIT_UNCONFIRMED, "not told")

    def run(self) -> None:
        self.outcome = _halt(self.robot, self._word, tells=False)


class _Attempt(threading.Thread):
    """Ask the planner, beside the thread that asks the bridge."""

    def __init__(self, robot: LaunchSettings, word: Halt) -> None:
        super().__init__(daemon=True)
        self._robot, self._word = robot, word
        self.confirmed = False
        self.trouble = ""

    def run(self) -> None:
        path, body = f"/v1/{self._word}", {"source": asker()}
        try:
            answer = call(self._robot, "POST", path, body, timeout_s=HTTP_TIMEOUT_S)
            self.confirmed = bool(answer.get("confirmed") or answer.get("accepted"))
            self.trouble = "" if self.confirmed else "the bridge did not confirm"
        except (PlannerDown, PlannerProblem) as trouble:
            self.trouble = str(trouble)
        except Exception as trouble:  # noqa: BLE001  # another service may answer on that port
            self.trouble = in_a_line(trouble)
