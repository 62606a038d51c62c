"""Speak to the bridge without a planner: the operator's own link, for when nothing else answers.

What makes the robot stand still (stop, estop, disarm) goes to whichever robot is on this home's
socket: it reads no robot.toml and no key, and writes nothing. What lets a robot move again must
name the right one.
"""

from __future__ import annotations

import secrets
import time
from typing import TYPE_CHECKING

from bridge.operator_key import load_operator_key
from pons.settings import asker
from pons.terminal import pick
from wire import (
    Answer,
    FenceRequest,
    Mode,
    OpKind,
    OpRequest,
    Status,
    Stop,
    load_robot,
    sign_fence,
    signed_request,
)
from wire.doors import BRIDGE_DOOR
from wire.keys import ANY_ROBOT, FENCE, OPS, STATUS, STOP, Party
from wire.operator_hmac import NEEDS_PROOF
from wire.session import Publisher, Session, Subscriber, open_session
from wire.sockets import Endpoints, connect_refusal, misplaced_listener, unreachable

if TYPE_CHECKING:
    from collections.abc import Callable

    from pons.settings import LaunchSettings

PERIOD_S = 0.05
LIMIT_S = 2.0
OTHERS_S = 0.3
"""So much longer the right robot is waited for once another was heard."""
_SELFTEST = (
    "  the bridge still tests itself; `pons status` shows what it waits for, `pons doctor` why",
    "  桥仍在自检：`pons status` 显示它在等待什么，`pons doctor` 说明原因",
)


class NoBridge(Exception):
    """No bridge answered, or not the one that was meant."""


def stop_direct(settings: LaunchSettings) -> Answer:
    """Send ``cmd/stop`` at 20 Hz until the bridge echoes it.

    Raises:
        NoBridge: 2 s have passed, or another than the bridge answered; it was said all the same.
    """
    request_id = _new_id()
    with open_session(Party.OPERATOR, ANY_ROBOT, settings.home) as session:
        mouth, ears = session.publisher(STOP), session.subscriber(STATUS)
        stop = Stop(id=request_id, source=asker())
        answer = _until_answered(settings, lambda: mouth.put(stop), ears, request_id, "stop")
        _believe(settings)
        return answer


def out_of_reach(settings: LaunchSettings) -> str | None:
    """Say why this user can't ask the bridge of this home; None where it can, or one has died here.

    The robot may be elsewhere, or this user have no right to the bridge's socket. A socket that
    nobody listens at any more is of a bridge that has died, and can't have confirmed anything.
    """
    path = Endpoints(settings.home).socket(BRIDGE_DOOR)
    error = connect_refusal(path)
    if error is None or isinstance(error, ConnectionRefusedError):
        return None
    return f"{path}: {error.strerror or error}"


def ask_direct(settings: LaunchSettings, kind: OpKind) -> Answer:
    """Make an operator's request, with a proof where it needs one.

    Raises:
        NoBridge: no bridge answered, or another process in its place, or only that of another
            robot where a proof is needed.
        ConfigError: robot.toml or the operator's key can't be used, where a proof is needed.
    """
    request_id = _new_id()
    if kind not in NEEDS_PROOF:
        request = OpRequest(id=request_id, source=asker())
        with open_session(Party.OPERATOR, ANY_ROBOT, settings.home) as session:
            mouth, ears = _op(session, kind), session.subscriber(STATUS)
            answer = _until_answered(settings, lambda: mouth.put(request), ears, request_id, kind)
            _believe(settings)
            return answer
    robot_id = load_robot(settings.robot).id
    with open_session(Party.OPERATOR, robot_id, settings.home) as session:
        mouth, ears = _op(session, kind), session.subscriber_to_any_robot(STATUS)
        status = _first_status(settings, ears, robot_id)
        _believe(settings)  # before a proof is made: whoever has it may use it once
        key = load_operator_key(settings.home, virtual=status.drive.virtual)
        request = signed_request(key, kind, status, asker(), request_id)
        return _until_answered(settings, lambda: mouth.put(request), ears, request_id, kind)


def arm_direct(settings: LaunchSettings) -> bool:
    """Arm at the bridge itself; tell whether it is armed."""
    try:
        return ask_direct(settings, "arm").accepted
    except NoBridge:
        return False


def refusal_lines(kind: OpKind, answer: Answer) -> list[str]:
    """Return what a person is told of a refusal: code, what came, and why."""
    from pons.code_messages import code_lines

    head = f"{kind}: refused, {answer.code}: {answer.detail}"
    if kind == "arm" and Mode.SELFTEST.value in answer.detail:  # neither armed nor latched
        return [head, pick(*_SELFTEST)]
    return [head, *code_lines(answer.code)]


def resume_request(settings: LaunchSettings) -> OpRequest:
    """Return a resume with the operator's proof, for a planner to relay with a goal's order.

    Raises:
        NoBridge, ConfigError: as ``ask_direct``.
    """
    robot_id = load_robot(settings.robot).id
    with open_session(Party.OPERATOR, robot_id, settings.home) as session:
        status = _first_status(settings, session.subscriber_to_any_robot(STATUS), robot_id)
        _believe(settings)  # before a proof is made: whoever has it may use it once
        key = load_operator_key(settings.home, virtual=status.drive.virtual)
        return signed_request(key, "resume", status, asker(), _new_id())


def fence_direct(settings: LaunchSettings, text: str) -> Answer:
    """Ask the bridge itself to put a fence in force, with a proof that binds this text.

    Raises:
        NoBridge: no bridge answered, or only that of another robot.
        ConfigError: robot.toml or the operator's key can't be used.
    """
    robot_id = load_robot(settings.robot).id
    request_id = _new_id()
    with open_session(Party.OPERATOR, robot_id, settings.home) as session:
        mouth, ears = session.publisher(FENCE), session.subscriber_to_any_robot(STATUS)
        status = _first_status(settings, ears, robot_id)
        _believe(settings)  # before a proof is made: whoever has it may use it once
        key = load_operator_key(settings.home, virtual=status.drive.virtual)
        proof = sign_fence(key, status.robot, status.nonce, request_id, text)
        request = FenceRequest(id=request_id, source="cli", fence=text, proof=proof)
        return _until_answered(settings, lambda: mouth.put(request), ears, request_id, "fence")


def _new_id() -> str:
    """Return an id that nobody had: process ids come again, and a known id may be taken for old."""
    return f"cli-{secrets.token_hex(6)}"


def _believe(settings: LaunchSettings) -> None:
    """Hold that the bridge's own user listens where it should.

    Raises:
        NoBridge: somebody else does: what was answered is worth nothing.
    """
    trouble = misplaced_listener(settings.home, BRIDGE_DOOR)
    if trouble is not None:
        raise NoBridge(trouble)


def _op(session: Session, kind: OpKind) -> Publisher[OpRequest]:
    return next(session.publisher(key) for key in OPS if key.path == f"op/{kind}")


def _first_status(settings: LaunchSettings, ears: Subscriber[Status], robot_id: str) -> Status:
    """Wait for the word of one robot; name those that answer in its place."""
    end_s = time.monotonic() + LIMIT_S
    others: set[str] = set()
    while time.monotonic() < end_s:
        status = ears.newest()
        if status is not None and status.robot == robot_id:
            return status
        if status is not None:
            others.add(status.robot)
            end_s = min(end_s, time.monotonic() + OTHERS_S)
        time.sleep(0.005)
    if others:
        raise NoBridge(
            f"other_robot: {settings.robot} describes {robot_id}, but {', '.join(sorted(others))} "
            f"answers in {settings.home}; set PONS_ROBOT to that robot's file"
        )
    raise _silence(settings)


def _silence(settings: LaunchSettings) -> NoBridge:
    """Tell that nothing was heard, and the obstacle to this user's socket, if there is one."""
    why = unreachable(settings.home, BRIDGE_DOOR)
    hint = "is `pons up` running?" if why is None else f"{why}; is `pons up` running, as this user?"
    return NoBridge(f"no_bridge: no status from a bridge within 2 s; {hint}")


def _until_answered(
    settings: LaunchSettings,
    say: Callable[[], None],
    ears: Subscriber[Status],
    request_id: str,
    what: str,
) -> Answer:
    """Say it at 20 Hz until a status answers it.

    Raises:
        NoBridge: none did within 2 s.
    """
    end_s = time.monotonic() + LIMIT_S
    next_s = 0.0
    heard = False
    while (now_s := time.monotonic()) < end_s:
        if now_s >= next_s:
            say()
            next_s = now_s + PERIOD_S
        status = ears.newest()
        heard = heard or status is not None
        for answer in status.answers if status else ():
            if answer.id == request_id:
                return answer
        time.sleep(0.002)
    if heard:
        raise NoBridge(f"no_answer: the bridge speaks but did not answer {what} within 2 s")
    raise _silence(settings)
