"""Let a step fail: think again with the observation in hand, or end the goal honestly.

Law: at most as many thoughts as the rules allow; what no other plan could mend ends at once. The
robot stands while the brain thinks, and keeps its place: it is this goal's turn.
"""

from __future__ import annotations

from planner.mission.effects import AskBrain
from planner.mission.observed import observed
from planner.mission.queue import end_running, note_step, settle_walk
from planner.mission.records import Mission, Walk
from planner.mission.skills import Cannot, Notes
from planner.mission.turn import Turn
from planner.mission.verdict import failure, spot_at
from planner.plan import Code, GoalState, Outcome, StepState

MENDABLE = frozenset(
    {Code.NO_ROUTE, Code.BLOCKED, Code.NO_ROOM, Code.NOT_REACHED, Code.UNKNOWN_PLACE}
    | {Code.NOT_FOUND, Code.LOST_PERSON}
)
"""Another plan may do better. A fault, a spent budget or a missing skill is told at once."""
SHUT = frozenset({Code.NO_ROUTE, Code.BLOCKED})
AGAIN_S = 1.0
"""A way that is shut stays so for a while: a step that goes on without it is asked no sooner."""


def fail_step(turn: Turn, cannot: Cannot) -> None:
    """End the running step without success; then think again, or end the goal.

    A leg whose skill knows what to do without it ends alone, and the step goes on.
    """
    walk = turn.book.walk
    if walk is not None and walk.otherwise is not None and cannot.code in SHUT:
        _without(turn, walk.otherwise)
        return
    mission = settle_walk(turn)
    if mission is None:
        return
    said = cannot.said or failure(turn.book.facts, mission, mission.now, cannot.code, "")
    why = Outcome(code=cannot.code, message=said)
    mission = note_step(
        turn, mission, state=StepState.FAILED, reason=cannot.reason, **cannot.figures
    )
    mission = turn.put(mission, failure=why)
    if cannot.code in MENDABLE and mission.replans < turn.book.rules.replans:
        think(turn, turn.put(mission, replans=mission.replans + 1))
        return
    give_up(turn, mission)


def _without(turn: Turn, notes: Notes) -> None:
    """Go on in the step without this leg: its skill is asked soon, standing."""
    mission = settle_walk(turn)
    if mission is None:
        return
    turn.put(mission, notes=notes)
    retry_s = turn.now_s + AGAIN_S
    turn.set(walk=Walk("drive", turn.next_entry, retry_s=retry_s, since_s=turn.now_s))


def give_up(turn: Turn, mission: Mission) -> None:
    """End the running goal with what failed in it."""
    step, why = mission.now, mission.failure
    code = why.code if why is not None else Code.BAD_PLAN
    reason = step.reason if step is not None else None
    said = why.message if why is not None else None
    end_running(turn, GoalState.FAILED, code, reason, said=said)


def think(turn: Turn, mission: Mission) -> None:
    """Have the brain think again, standing, with all that came of the goal so far."""
    facts, status = turn.book.facts, turn.book.status
    room = spot_at(facts, status.base_in_map if status is not None else None).room
    turn.set(walk=Walk("think", turn.next_entry))
    turn.emit(
        AskBrain(
            mission.id,
            mission.words,
            mission.language,
            room,
            observed(facts, mission),
            mission.replans,
        )
    )
