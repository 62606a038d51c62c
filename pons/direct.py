"""Speak to the bridge without a planner: the operator's own link, for when nothing else answers."""

from __future__ import annotations

import secrets
import time
from typing import TYPE_CHECKING

from wire import (
    VIRTUAL_KEY,
    Answer,
    FenceRequest,
    OpKind,
    OpRequest,
    Status,
    Stop,
    load_robot,
    sign_fence,
    signed_request,
)
from wire.keys import FENCE, OPS, STATUS, STOP, Party
from wire.session import Publisher, Session, Subscriber, open_session

if TYPE_CHECKING:
    from collections.abc import Callable

    from pons.settings import Settings

PERIOD_S = 0.05
LIMIT_S = 2.0


class NoBridge(Exception):
    """No status was heard: there is no bridge, or it does not run."""


def stop_direct(settings: Settings, request_id: str) -> bool:
    """Send ``cmd/stop`` at 20 Hz until the bridge echoes it or 2 s have passed."""
    robot_id = load_robot(settings.robot).id
    with open_session(Party.OPERATOR, robot_id, settings.home) as session:
        mouth, ears = session.publisher(STOP), session.subscriber(STATUS)
        stop = Stop(id=request_id, source="cli")
        return _until_answered(lambda: mouth.put(stop), ears, request_id) is not None


def ask_direct(settings: Settings, kind: OpKind) -> Answer:
    """Make an operator's request, with a proof where it needs one.

    Raises:
        NoBridge: no status came.
    """
    robot = load_robot(settings.robot)
    request_id = f"cli-{secrets.token_hex(6)}"
    with open_session(Party.OPERATOR, robot.id, settings.home) as session:
        mouth, ears = _op(session, kind), session.subscriber(STATUS)
        status = _first_status(ears)
        key = operator_key(settings, virtual=status.drive.virtual)
        request = OpRequest(id=request_id, source="cli")
        if key is not None:
            request = signed_request(key, kind, status, "cli", request_id)
        answer = _until_answered(lambda: mouth.put(request), ears, request_id)
        if answer is None:
            raise NoBridge(f"no_answer: the bridge speaks but did not answer {kind} within 2 s")
        return answer


def fence_direct(settings: Settings, text: str) -> Answer:
    """Ask the bridge itself to put a fence in force, with a proof that binds this text.

    Raises:
        NoBridge: no status or no verdict came.
    """
    robot = load_robot(settings.robot)
    request_id = f"cli-{secrets.token_hex(6)}"
    with open_session(Party.OPERATOR, robot.id, settings.home) as session:
        mouth, ears = session.publisher(FENCE), session.subscriber(STATUS)
        status = _first_status(ears)
        key = operator_key(settings, virtual=status.drive.virtual)
        proof = sign_fence(key, status.robot, status.nonce, request_id, text) if key else None
        request = FenceRequest(id=request_id, source="cli", fence=text, proof=proof)
        answer = _until_answered(lambda: mouth.put(request), ears, request_id)
        if answer is None:
            raise NoBridge("no_answer: the bridge speaks but did not answer fence within 2 s")
        return answer


def operator_key(settings: Settings, *, virtual: bool) -> bytes | None:
    """Return the key that signs for this robot; None where the owner has made none."""
    if virtual:
        return VIRTUAL_KEY
    path = settings.home / "operator.key"
    return path.read_bytes().strip() if path.is_file() else None


def _op(session: Session, kind: OpKind) -> Publisher[OpRequest]:
    return next(session.publisher(key) for key in OPS if key.path == f"op/{kind}")


def _first_status(ears: Subscriber[Status]) -> Status:
    end_s = time.monotonic() + LIMIT_S
    while time.monotonic() < end_s:
        if (status := ears.newest()) is not None:
            return status
        time.sleep(0.005)
    raise NoBridge("no_bridge: no status from a bridge within 2 s; is `pons up` running?")


def _until_answered(
    say: Callable[[], None], ears: Subscriber[Status], request_id: str
) -> Answer | None:
    end_s = time.monotonic() + LIMIT_S
    next_s = 0.0
    while (now_s := time.monotonic()) < end_s:
        if now_s >= next_s:
            say()
            next_s = now_s + PERIOD_S
        status = ears.newest()
        for answer in status.answers if status else ():
            if answer.id == request_id:
                return answer
        time.sleep(0.002)
    return None
