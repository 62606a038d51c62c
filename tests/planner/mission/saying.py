"""Have goals ask, and read what was told: shared by the stories of answers in words."""

from __future__ import annotations

from planner.plan import Ask, Bilingual, Clarify, Code, Goal, GoalState, GoTo, Option, StepPlan
from tests.planner.mission.live import Together

ASKS, CONFIRMS = GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION
RUNNING, PAUSED = GoalState.RUNNING, GoalState.PAUSED
SUCCEEDED, REFUSED, CANCELLED = GoalState.SUCCEEDED, GoalState.REFUSED, GoalState.CANCELLED
DRIVES = StepPlan(steps=(Ask(question="Shall I drive there?"), GoTo(place="kitchen")))
TWICE = StepPlan(steps=(Ask(question="Shall I?"), Ask(question="Are you sure?")))
WHICH = Clarify(code=Code.AMBIGUOUS, question=Bilingual(en="Which?", zh="哪个？"))
GO = Option(label=Bilingual(en="Go", zh="去"), text="go to the kitchen")
OFFERS = Clarify(code=Code.NO_CAPABILITY, question=Bilingual(en="Go?", zh="去？"), options=(GO,))


async def asking(world: Together, text: str = "please see to it") -> Goal:
    """Give a goal whose first step asks, and wait until it does; then let time pass."""
    goal = await world.give(text, ASKS)
    await later(world)
    return goal


async def asking_on_the_way(world: Together) -> tuple[Goal, Goal]:
    """Give a goal that asks, and one that drives meanwhile; return both once it does."""
    return await asking(world), await world.drive()


async def later(world: Together) -> None:
    seq = world.bridge.seq
    await world.until(lambda: world.bridge.seq > seq + 1)


def told(goal: Goal) -> tuple[GoalState, Code | None, str]:
    said = goal.outcome
    return goal.state, said.code if said else None, said.message.en if said else ""


def answer_of(world: Together, goal: Goal) -> str | None:
    plan = world.missions.goal(goal.id).plan
    return plan.steps[0].answer if plan is not None and plan.steps else None


def heard(world: Together) -> list[str]:
    return [request.text for request in world.brain.asked]
