"""Replace the places while goals are open: a forgotten place is driven to no more.

Law: a goal that still names a forgotten place ends at once, typed, and the robot stands; a leg to a
place that was moved is laid anew.
"""

from __future__ import annotations

from planner.language.catalogue import list_names, message
from planner.mission.queue import end_running, finish, settle_activity
from planner.mission.state import Mission
from planner.mission.step_execution import begin_step
from planner.mission.transaction import Transaction
from planner.mission.transitions import GoalFact
from planner.plan import Bilingual, Code, Outcome, StepRecord, StepState
from planner.site.site_view import SiteView

GONE = "place_gone"
_AHEAD = (StepState.PENDING, StepState.RUNNING)


def on_known(turn: Transaction, facts: SiteView) -> None:
    """Let the book know these places from now on."""
    before = turn.book.facts
    turn.set(facts=facts)
    for mission in tuple(turn.book.missions.values()):
        gone = _find_lost(mission, before, facts)
        if gone is not None:
            _end(turn, mission, before.targets[gone].name, facts)
    _lay_anew(turn, before)


def _find_lost(mission: Mission, before: SiteView, now: SiteView) -> str | None:
    """Return a place that a goal still has to visit and that is no more, or None."""
    if mission.has_ended:
        return None
    again = any(s.kind == "repeat" and s.state is StepState.RUNNING for s in mission.steps_ahead)
    ahead = (step for step in mission.steps_ahead if again or step.state in _AHEAD)
    named = (place for step in ahead for place in _list_places(step))
    return next((p for p in named if p in before.targets and p not in now.targets), None)


def _list_places(step: StepRecord) -> tuple[str, ...]:
    return (step.place,) if step.place else step.places


def _end(turn: Transaction, mission: Mission, name: Bilingual, facts: SiteView) -> None:
    known = list_names(target.name for target in facts.targets.values())
    said = message(Code.UNKNOWN_PLACE, name=name, near="", known=known)
    if turn.book.running == mission.id:
        end_running(turn, GoalFact.PLACE_GONE, Code.UNKNOWN_PLACE, GONE, said=said)
        return
    outcome = Outcome(code=Code.UNKNOWN_PLACE, message=said)
    finish(turn, mission, GoalFact.PLACE_GONE, outcome, GONE)


def _lay_anew(turn: Transaction, before: SiteView) -> None:
    """Begin the running step again where its place is another point now."""
    leg = turn.driving
    if turn.running is None or leg is None or leg.act.target is None:
        return
    old, new = before.targets.get(leg.act.target), turn.book.facts.targets.get(leg.act.target)
    if old is not None and new is not None and old.pose != new.pose:
        settle_activity(turn)
        begin_step(turn)
