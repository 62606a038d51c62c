"""Serve goals: give one, look, and act on one. Translates; decides nothing."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Header, Query, Request

from planner.api.crowd import address_of
from planner.api.interfaces import Services
from planner.api.listing import list_goals
from planner.api.operator import act_behind, persons_act
from planner.api.problems import HttpProblem
from planner.api.rates import Rates
from planner.api.schemas import (
    MAX_GOAL_CHARACTERS,
    GoalMove,
    GoalOrder,
    GoalReply,
    NewGoal,
    OperatorProof,
)
from planner.brain.model_replies import GoalReplies
from planner.language.catalogue import say
from planner.language.sentence import SaidSentence, parse
from planner.mission.agents import is_agents
from planner.mission.api_view import recorded_goal
from planner.mission.errors import MissionError, PersonMissing, UnknownGoal
from planner.mission.state import AGENT_SOURCE
from planner.people import ASKER, Role, name_asker
from planner.plan import Goal, Language
from wire import OpRequest

STATUS = {
    "unknown_goal": 404,
    "bad_state": 409,
    "nothing_to_resume": 409,
    "queue_full": 429,
    "idempotency_conflict": 409,
    "idempotency_reserved": 422,
    "journal_unavailable": 503,
    "not_own_goal": 403,
    "person_needed": 403,
}

A_SECOND, AT_ONCE = 2.0, 50
"""Goals and answers of one address, or of one agent. A person is slower; each costs a thought and a
line on disk."""
STOPPED_BUT_LONG = say("problem.stopped_but_long")

IdempotencyKey = Annotated[str | None, Header(alias="Idempotency-Key", max_length=200)]
Limit = Annotated[int, Query(ge=1, le=200)]
Cursor = Annotated[int | None, Query(ge=0, le=2**53)]
MOST_CHANGED = 30
"""Goals of one list of changes: none of so many is left out for its size."""


def routes(services: Services) -> APIRouter:
    """Return the routes below /v1/goals."""
    router = APIRouter(prefix="/v1/goals", tags=["goals"])
    door = GoalIntake(services)
    _giving(router, services, door)
    _acting(router, services, door)
    return router


class GoalIntake:
    """Let a sentence in that is no longer than an order and comes in time; a stop always."""

    def __init__(self, services: Services) -> None:
        self._services = services
        self._rates = Rates(A_SECOND, AT_ONCE)

    async def judge(self, text: str, request: Request) -> SaidSentence:
        """Read a sentence, the one time, and pass it.

        One that is too long to be kept may still stop the robot.

        Raises:
            HttpProblem: ``goal_too_long`` or ``too_many_goals``.
        """
        said = parse(text)
        stops, length = self._services.goals.hears_stop(text), len(text)
        if not length <= MAX_GOAL_CHARACTERS:
            detail = f"{length} characters; at most {MAX_GOAL_CHARACTERS} are taken"
            if not stops:
                raise HttpProblem(422, "goal_too_long", detail)
            await self._services.goals.stop(name_asker("api"))
            told = STOPPED_BUT_LONG.model_dump()
            raise HttpProblem(
                422, "goal_too_long", f"{detail}; the robot was stopped", message=told
            )
        if not stops:
            self.judge_rate(request)
        return said

    def judge_rate(self, request: Request) -> None:
        """Pass a goal that comes in time.

        Raises:
            HttpProblem: ``too_many_goals``.
        """
        source, address = goal_source(), request.client.host if request.client else ""
        asker = source if is_agents(source) else address_of(address)  # it may share a person's
        wait_s = self._rates.wait_s(asker)
        if wait_s is not None:
            detail = f"at most {AT_ONCE} at once, then {A_SECOND:g} a second; wait {wait_s:.1f} s"
            raise HttpProblem(429, "too_many_goals", detail)


def _giving(router: APIRouter, services: Services, door: GoalIntake) -> None:
    goals = services.goals

    @router.post("", status_code=202, operation_id="give_goal")
    async def give(new: NewGoal, request: Request, idempotency_key: IdempotencyKey = None) -> Goal:
        """Give a goal: words, points of the map, or steps. An impossible one ends refused.

        A plain yes or no answers what waits for one (a step's question, a plan, a brain's only
        offer), where nothing else can be meant.
        """
        source = goal_source()
        if new.text is None:
            if new.points is not None and is_agents(source):
                raise PersonMissing
            door.judge_rate(request)
            act = None if is_agents(source) else persons_act(services.robot, new.operator)
            goal_id = await goals.points.give(
                new.given_steps,
                language=new.language or Language.EN,
                confirm=new.confirm,
                replace=new.replace,
                idempotency_key=idempotency_key,
                act=act,
                source=source,
                by=new.source,
            )
            return await find_goal(services, goal_id, repeats=True)
        said = await door.judge(new.text, request)
        try:
            return await goals.submit(
                new.text,
                language=new.language,
                confirm=new.confirm,
                replace=new.replace,
                idempotency_key=idempotency_key,
                act=_act_of(services, source, said, new.operator),
                source=source,
                by=new.source,
            )
        except UnknownGoal as former:
            return await find_goal(services, former.goal_id, repeats=True)

    @router.get("", operation_id="list_goals")
    async def several(limit: Limit = 50, after: Cursor = None) -> dict[str, Any]:
        """List goals: those that are open first, then those that ended, each newest first.

        With ``after`` those that changed since, each once, the change of longest ago first, and
        ``next``, where the next list goes on; 0 begins with the oldest of 10 000. Long texts are
        shortened, and what would make more than 0.9 MB is left out.
        """
        if after is None:
            return {"goals": list_goals(goals.goals(limit))}
        changed = await services.history.changed_since(after, min(limit, MOST_CHANGED))
        return {
            "goals": list_goals(recorded_goal(mission) for mission in changed.missions),
            "next": changed.cursor,
        }

    @router.get("/{goal_id}", operation_id="get_goal")
    async def one(goal_id: str) -> Goal:
        """Show one goal whole, however old."""
        return await find_goal(services, goal_id)

    @router.get("/{goal_id}/replies", operation_id="list_goal_replies")
    async def replies(goal_id: str) -> GoalReplies:
        """Show what the model wrote about a goal, to operators alone.

        ``kept`` is the setting ``keep_replies``; where it is 0, nothing is kept of any goal.
        """
        return services.replies.replies_of(goals.goal(goal_id).id)


def _acting(router: APIRouter, services: Services, door: GoalIntake) -> None:
    goals = services.goals

    @router.post("/{goal_id}/cancel", operation_id="cancel_goal")
    async def cancel(goal_id: str) -> Goal:
        """End a goal; a moving robot ramps to a stop. An agent ends what it gave."""
        return await goals.cancel(goal_id, source=goal_source())

    @router.post("/{goal_id}/pause", operation_id="pause_goal")
    async def pause(goal_id: str) -> Goal:
        """Keep a goal's place, standing."""
        return await goals.pause(goal_id)

    @router.post("/{goal_id}/resume", operation_id="resume_goal")
    async def resume(goal_id: str, order: GoalOrder | None = None) -> Goal:
        """Go on with a paused goal; an operator's act."""
        act = persons_act(services.robot, order.operator if order else None)
        return await goals.resume(goal_id, act=act)

    @router.post("/{goal_id}/confirm", operation_id="confirm_goal")
    async def confirm(goal_id: str, order: GoalOrder | None = None) -> Goal:
        """Say yes to a plan; an operator's act."""
        said = order or GoalOrder()
        act = persons_act(services.robot, said.operator)
        return await goals.confirm(goal_id, act=act, by=said.source)

    @router.post("/{goal_id}/answer", operation_id="answer_goal")
    async def answer(goal_id: str, reply: GoalReply, request: Request) -> Goal:
        """Answer a goal's question, or say yes or no to its plan; a yes is an operator's act.

        Of an agent, its own goal's question about the order, or a plain no: ``person_needed`` else.
        """
        said, source = await door.judge(reply.text, request), goal_source()
        act = _act_of(services, source, said, reply.operator)
        return await goals.answer(goal_id, reply.text, act=act, by=reply.source, source=source)

    @router.post("/{goal_id}/move", operation_id="move_goal")
    async def move(goal_id: str, where: GoalMove) -> Goal:
        """Put a queued goal before another, or last."""
        return await goals.move(goal_id, where.before)


async def find_goal(services: Services, goal_id: str, *, repeats: bool = False) -> Goal:
    """Return a goal, with its progress while it is at hand, else as the journal has it.

    Args:
        services: of the planner.
        goal_id: of the goal.
        repeats: a request asks that made it once and is not to make another.

    Raises:
        UnknownGoal: there is none; HttpProblem where it ``repeats``.
    """
    try:
        return services.goals.goal(goal_id)
    except UnknownGoal:
        pass
    try:
        return recorded_goal((await services.history.story(goal_id))[0])
    except UnknownGoal:
        if not repeats:
            raise
        detail = f"this key made goal {goal_id}, whose record is kept no more; nothing is done"
        raise HttpProblem(409, "goal_forgotten", detail) from None


def goal_source() -> str:
    """Return whose goals a request may reach: an agent's own, else those of all people."""
    asker = ASKER.get()
    is_agent = asker is not None and asker.role is Role.AGENT
    return f"{AGENT_SOURCE}{asker.id}" if asker is not None and is_agent else "api"


def _act_of(
    services: Services, source: str, said: SaidSentence, given: OperatorProof | None
) -> OpRequest | None:
    """Return the resume that comes with a sentence; an agent's clears no hold."""
    return None if is_agents(source) else act_behind(services.robot, said, given)


def problem(error: MissionError) -> HttpProblem:
    """Say a mission's refusal over HTTP, in both languages."""
    status = STATUS.get(error.code, 409)
    return HttpProblem(status, error.code, error.message.en, message=error.message.model_dump())
