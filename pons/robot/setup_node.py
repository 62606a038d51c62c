"""Stand at the bridge's place while a robot is set up: ``python -m pons.robot.setup_node``.

``pons up`` starts it instead of a bridge where metal was not tried. It holds the bridge's lock and
door, so that no bridge drives beside it; reports a robot that is disarmed and stands; stops for
whoever says stop, and arms for nobody. Exit status: 0 left when asked, 2 refused to start, 4 to be
replaced by a bridge, for the robot is tried.
"""

from __future__ import annotations

import argparse
import logging
import secrets
import signal
import sys
import threading
import time
from collections import deque
from pathlib import Path
from typing import TYPE_CHECKING, Final

from bridge.fence_file import load_fence
from bridge.operator_key import load_operator_key
from pons.robot.trial_desk import TrialDesk
from pons.robot.trial_parties import TrialRefusal
from pons.robot.trial_words import REFUSALS
from wire import (
    EXIT_SET_UP,
    IDENTITY,
    PROTOCOL,
    STILL,
    Action,
    Answer,
    BrakingReport,
    ConfigError,
    DriveReport,
    LimitsInForce,
    Mode,
    OpRequest,
    Status,
    Stop,
    TickStats,
    TrialOrder,
)
from wire.keys import OPS, STATUS, STOP, TRIAL_ORDER, TRIAL_STATE, Party
from wire.session import open_session
from wire.site_map import read_map_id

if TYPE_CHECKING:
    from wire.session import Session

log = logging.getLogger("setup")

TICK_S: Final = 0.01
STATUS_TICKS, STATE_TICKS = 5, 10
KEPT_ANSWERS = 8
_STANDING_ACTS = frozenset({"disarm", "estop"})
_STANDING = LimitsInForce(v_mps=0.0, w_radps=0.0, by="robot_untried", free_m=None)
_NO_TICKS = TickStats(
    ticks=0, missed=0, late_p50_us=0.0, late_max_us=0.0, step_max_us=0.0, dropped=0, record_gaps=0
)


class SetupNode:
    """Join a desk to the bridge's door."""

    def __init__(self, desk: TrialDesk, session: Session, site: Path, boot: str) -> None:
        self._desk, self._boot = desk, boot
        self._fence_hash = load_fence(site / "fence.json")[1]
        self._map_id = read_map_id(site)
        self._stops = session.subscriber(STOP)
        self._ops = [(key.path.removeprefix("op/"), session.subscriber(key)) for key in OPS]
        self._orders = session.subscriber(TRIAL_ORDER)
        self._status, self._state = session.publisher(STATUS), session.publisher(TRIAL_STATE)
        self._answers: deque[Answer] = deque(maxlen=KEPT_ANSWERS)
        self._stopping: dict[str, str] = {}
        """Requests to stand that are answered when the wheels were told to."""
        self._tick = 0

    def turn(self) -> None:
        """Hear stops first, then all else; speak where it is time, or something was answered."""
        self._hear_stops()
        answered = self._hear_operator()
        for order in self._orders.drain().items:
            if isinstance(order, TrialOrder):
                self._desk.take(order)
        if self._stopping and not self._desk.may_turn:
            for request, kind in self._stopping.items():
                self._answer(request, kind)
            self._stopping.clear()
            answered += 1
        if answered or self._tick % STATUS_TICKS == 0:
            self._status.put(self._report())
        if self._tick % STATE_TICKS == 0:
            self._state.put(self._desk.state())
        self._tick += 1

    def _hear_stops(self) -> None:
        payloads = self._stops.drain()
        if payloads.arrived:  # one that can't be read is a stop too, but one nobody can answer
            self._desk.stop()
        for stop in payloads.items:
            if isinstance(stop, Stop) and all(stop.id != one.id for one in self._answers):
                self._stopping[stop.id] = "stop"

    def _hear_operator(self) -> int:
        count = 0
        for kind, subscriber in self._ops:
            for request in subscriber.drain().items:
                if isinstance(request, OpRequest) and all(
                    request.id != one.id for one in self._answers
                ):
                    if kind in _STANDING_ACTS:
                        self._desk.stop()
                        self._stopping[request.id] = kind
                    else:
                        detail = REFUSALS["trial_missing"][0]
                        self._answer(request.id, kind, "robot_untried", detail)
                        count += 1
        return count

    def _answer(self, request: str, kind: str, code: str = "ok", detail: str = "") -> None:
        accepted = code == "ok"
        self._answers.append(
            Answer(id=request, kind=kind, accepted=accepted, code=code, detail=detail)
        )

    def _report(self) -> Status:
        robot = self._desk.robot
        return Status(
            protocol=PROTOCOL,
            robot=robot.id,
            boot=self._boot,
            seq=self._tick,
            at_s=time.monotonic(),
            mode=Mode.DISARMED,
            action=Action.NONE,
            epoch=f"{self._boot}-0",
            nonce=self._desk.nonce,
            owner=None,
            held=None,
            grant=None,
            leg=None,
            base_in_odom=IDENTITY,
            base_in_map=None,
            asked=STILL,
            sent=STILL,
            measured=STILL,
            limits=_STANDING,
            rows=(),
            answers=tuple(self._answers),
            waiting_for=("robot_untried",),
            blocked=False,
            robot_hash=robot.hash,
            fence_hash=self._fence_hash,
            map_id=self._map_id,
            operator_metres=0.0,
            operator_seconds=0.0,
            drive=DriveReport(
                kind=robot.drive.kind,
                virtual=False,
                enabled=False,
                timed_out=None,
                boot_id=None,
                battery=None,
                real_time=False,
            ),
            braking=BrakingReport(lag_s=0.0, decel_mps2=0.0, learnt=False, stops=0, trouble=None),
            ticks=_NO_TICKS,
        )


def main(arguments: list[str] | None = None) -> int:
    """Serve until told to end; return the exit status."""
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(name)s %(levelname)s %(message)s")
    options = _options(arguments)
    try:
        return _serve(options)
    except ConfigError as error:
        print(f"setup: {error}", file=sys.stderr)
        return error.exit_status
    except TrialRefusal as refused:
        english, chinese = REFUSALS[refused.code]
        told = f"{refused.code} ({refused.detail})" if refused.detail else refused.code
        print(f"setup: {told}: {english} / {chinese}", file=sys.stderr)
        return ConfigError.exit_status


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m pons.robot.setup_node", description=__doc__)
    parser.add_argument("--home", type=Path, required=True, help="$PONS_HOME")
    parser.add_argument("--robot", type=Path, required=True, help="robot.toml")
    parser.add_argument("--site", type=Path, required=True, help="folder with fence.json, map.yaml")
    return parser.parse_args(arguments)


def _serve(options: argparse.Namespace) -> int:
    ending = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: ending.set())
    boot = secrets.token_hex(6)
    key = load_operator_key(options.home, virtual=False)
    desk = TrialDesk(options.robot, key, boot)
    try:
        with open_session(Party.BRIDGE, desk.robot.id, options.home) as session:
            node = SetupNode(desk, session, options.site, boot)
            log.info("run %s: %s is set up, no bridge drives", boot, desk.robot.id)
            while not (ending.is_set() or desk.leaves):
                node.turn()
                ending.wait(TICK_S)
    finally:
        desk.close()
    return EXIT_SET_UP if desk.leaves else 0


if __name__ == "__main__":
    sys.exit(main())
