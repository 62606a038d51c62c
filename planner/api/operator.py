"""Serve the operator's acts: stop, protective stop, arm, disarm, reset, teleop.

The only place in the planner that signs, and only for a drive that the bridge itself calls virtual:
on metal a proof comes from the person's CLI or page and is relayed as it is.
"""

from __future__ import annotations

import asyncio
import re
import secrets
from typing import TYPE_CHECKING, Any

from fastapi import APIRouter
from fastapi.exceptions import RequestValidationError
from fastapi.routing import APIRoute
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect, Request

from planner.api.hand import is_taken
from planner.api.interfaces import Robot, Services
from planner.api.problems import HttpProblem
from planner.api.schemas import OperatorOrder, OperatorProof, Steer, StopOrder
from planner.language.sentence import SaidSentence
from wire import NEEDS_PROOF, VIRTUAL_KEY, Answer, OpKind, OpRequest, mark_relayed, signed_request

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine

    from starlette.responses import Response
    from starlette.types import Message

BODY_S = 0.5
"""How long a stop waits for the rest of its body, which says no more than who asks."""
_OF_THE_BODY = frozenset({b"content-type", b"content-length", b"transfer-encoding"})


def routes(services: Services) -> APIRouter:
    """Return the operator's routes."""
    router = APIRouter(prefix="/v1", tags=["operator"])
    router.include_router(_stopping(services))
    _powering(router, services.robot)
    return router


def _stopping(services: Services) -> APIRouter:
    router = APIRouter(route_class=LenientRoute)
    robot = services.robot

    @router.post("/stop", operation_id="stop")
    async def stop(order: StopOrder | None = None) -> dict[str, Any]:
        """Stop now and hold until a person acts. Never refused."""
        stopped = await services.goals.stop((order or StopOrder()).source)
        status = robot.status
        return {"confirmed": stopped.is_echoed, "mode": status.mode if status else None}

    @router.post("/estop", operation_id="estop")
    async def estop(order: OperatorOrder | None = None) -> Answer:
        """Make a protective stop, latched until reset."""
        return await act(robot, "estop", order)

    @router.post("/disarm", operation_id="disarm")
    async def disarm(order: OperatorOrder | None = None) -> Answer:
        """Ramp to zero, then take the torque away."""
        return await act(robot, "disarm", order)

    return router


def _powering(router: APIRouter, robot: Robot) -> None:
    @router.post("/arm", operation_id="arm")
    async def arm(order: OperatorOrder | None = None) -> Answer:
        """Power the drive, standing."""
        return await act(robot, "arm", order)

    @router.post("/reset", operation_id="reset")
    async def reset(order: OperatorOrder | None = None) -> Answer:
        """Leave a latched state; never moves the robot."""
        return await act(robot, "reset", order)

    @router.post("/resume", operation_id="resume")
    async def resume(order: OperatorOrder | None = None) -> Answer:
        """Clear the hold of a stop, a take-over or a restart."""
        return await act(robot, "resume", order)

    @router.post("/teleop", operation_id="teleop", status_code=202)
    async def teleop(steer: Steer, request: Request) -> dict[str, Any]:
        """Steer by hand while the dead-man is held; send at 20 Hz.

        Raises:
            HttpProblem: ``hand_taken`` where another hand steers.
        """
        hand = hand_at(steer.source, request.client.host if request.client else "")
        if steer.dead_man and is_taken(robot, hand):
            raise HttpProblem(409, "hand_taken", "another hand steers the robot now")
        robot.steer(hand, steer.v_mps, steer.w_radps, dead_man=steer.dead_man, name=steer.source)
        return {"mode": robot.status.mode if robot.status else None}


def hand_at(source: str, address: str) -> str:
    """Return the hand's own id: two machines that give the same source are two hands."""
    return f"{source}:{re.sub(r'[^A-Za-z0-9_.:-]', '-', address)}"[:64]


async def act(robot: Robot, kind: OpKind, order: OperatorOrder | None) -> Answer:
    """Ask the bridge and return its verdict.

    Raises:
        HttpProblem: ``bridge_silent``, ``operator_proof_needed`` or the bridge's own refusal code.
    """
    asked = order or OperatorOrder()
    answer = await robot.ask(kind, request(robot, kind, asked.source, asked.operator))
    if answer is None:
        raise HttpProblem(503, "bridge_silent", f"the bridge did not answer {kind} within 2 s")
    if not answer.accepted:
        raise HttpProblem(409, answer.code, answer.detail or f"the bridge refused {kind}")
    return answer


def persons_act(robot: Robot, given: OperatorProof | None) -> OpRequest | None:
    """Return the resume that a goal carries: the person's own, or ours on a virtual drive.

    Raises:
        HttpProblem: ``operator_proof_needed`` where something is held on metal and no proof came.
    """
    status = robot.status
    if given is None and (status is None or not (status.drive.virtual or status.held)):
        return None
    return request(robot, "resume", "api", given)


def act_behind(robot: Robot, said: SaidSentence, given: OperatorProof | None) -> OpRequest | None:
    """Return the resume that comes with a person's sentence, where it may lead to motion.

    Raises:
        HttpProblem: as ``persons_act``; never for a sentence that may mean stop.
    """
    if said.stays_put:
        return None
    try:
        return persons_act(robot, given)
    except HttpProblem:
        if said.may_mean_stop:
            return None
        raise


def request(robot: Robot, kind: OpKind, source: str, given: OperatorProof | None) -> OpRequest:
    """Return the request with the person's proof, or signed where the drive is virtual.

    Raises:
        HttpProblem: ``bridge_silent`` or ``operator_proof_needed``.
    """
    source = mark_relayed(source)
    if given is not None:
        return OpRequest(id=given.id, source=source, proof=given.proof)
    request_id = f"api-{secrets.token_hex(8)}"
    if kind not in NEEDS_PROOF:
        return OpRequest(id=request_id, source=source)
    status = robot.status
    if status is None:
        raise HttpProblem(503, "bridge_silent", f"no bridge is heard, so nobody can {kind}")
    if not status.drive.virtual:
        raise HttpProblem(
            403,
            "operator_proof_needed",
            f"{kind} on this robot needs a proof made with the operator's key; use the page or "
            f"`pons {kind}` on a machine that holds the key",
        )
    return signed_request(VIRTUAL_KEY, kind, status, source, request_id)


class LenientRoute(APIRoute):
    """Answer a request with an unusable body as if it had none: it is no reason to refuse a stop.

    A hurried ``curl -d '{}'`` without a content type, half a JSON, a megabyte of noise, a
    connection that breaks off, or a body that does not come: each still stops.
    """

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """Return the handler that tries a second time, bare; the route ran in neither case yet."""
        handle = super().get_route_handler()

        async def answer(request: Request) -> Response:
            try:
                async with asyncio.timeout(BODY_S):
                    await request.body()  # kept by the request
            except (TimeoutError, ClientDisconnect, HTTPException):
                return await handle(_bare(request))
            try:
                return await handle(request)
            except (RequestValidationError, HTTPException):
                return await handle(_bare(request))

        return answer


def _bare(request: Request) -> Request:
    headers = [pair for pair in request.scope["headers"] if pair[0] not in _OF_THE_BODY]
    return Request({**request.scope, "headers": headers}, _nothing)


async def _nothing() -> Message:
    return {"type": "http.request", "body": b"", "more_body": False}
