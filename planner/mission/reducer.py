"""Advance the missions of one robot by one event. Pure: no clock, no IO, no chance, no ids minted.

Laws, each held by a test: never two missions run; nothing moves or speaks before the journal holds
its beginning; after a restart nothing moves until a person acts; a stop ends all streaming at once;
a goal that still names a forgotten place ends at once, typed, and a leg to a place that was moved
is laid anew. What the bridge should be asked for is a level, read from the book by
``motion_request``.
"""

from __future__ import annotations

from planner.bridge_client.ownership import STAND, MotionRequest
from planner.mission import events, goal_lifecycle
from planner.mission.activity import AskingImage, Driving
from planner.mission.effects import Effect
from planner.mission.events import Command, Event, Fact
from planner.mission.leg_routes import on_routed
from planner.mission.outcomes import moves
from planner.mission.perception_events import on_recalled, on_sight, on_told, on_tool_answered
from planner.mission.plan_roles import change_speed
from planner.mission.queue import cancel, end_running, finish, reorder, settle_activity
from planner.mission.recovery_steps import on_survey
from planner.mission.route_doubts import on_way_news
from planner.mission.state import Mission, MissionState
from planner.mission.status_monitor import on_status, on_tick
from planner.mission.step_execution import begin_step, speak_if_safe, start_next
from planner.mission.transaction import Transaction
from planner.mission.transitions import GoalFact, refusal
from planner.plan import (
    NEEDS_CAMERA,
    NEEDS_DETECTOR,
    Bilingual,
    Code,
    Outcome,
    StepState,
    places_of,
)
from planner.site.site_view import SiteView
from planner.skills.drive_to_place import tell_unknown_place
from planner.skills.object_matching import names_any


def advance(
    book: MissionState, event: Event, now_s: float
) -> tuple[MissionState, tuple[Effect, ...]]:
    """Return the next book and the effects asked of the world. Same arguments, same answer.

    A command that the state doesn't allow changes nothing; ask ``transitions.refusal`` why.
    """
    turn = Transaction(book, now_s)
    if isinstance(event, Command):
        _command(turn, event)
    else:
        _fact(turn, event)
    start_next(turn)
    speak_if_safe(turn)
    return turn.close()


def motion_request(book: MissionState) -> MotionRequest:
    """Return the motion to ask of the bridge now.

    A grant may be asked for as soon as a mission that drives has the robot; a leg is streamed only
    once the step's beginning is on disk.
    """
    mission = book.running_goal
    if mission is None or not any(map(moves, mission.steps_ahead)):
        return STAND
    activity = book.activity
    driven = isinstance(activity, Driving) and book.safe >= activity.record
    return MotionRequest(
        mission.id,
        activity.leg if isinstance(activity, Driving) and driven else None,
        mission.grant_name,
    )


def asked_about_picture(book: MissionState) -> int | None:
    """Return the ticket of the question about the picture whose answer is waited for, if one is."""
    activity = book.activity
    return activity.ticket if isinstance(activity, AskingImage) else None


def looks(book: MissionState) -> bool:
    """Tell whether the running step needs eyes now."""
    mission = book.running_goal
    step = mission.current_step if mission is not None else None
    waits = step is not None and step.kind == "wait_for" and step.object is not None
    return step is not None and (step.kind in NEEDS_CAMERA or waits)


def looks_widely(book: MissionState, open_classes: tuple[str, ...]) -> bool:
    """Tell whether the running step needs the classes that the open-vocabulary model alone finds.

    A question about the picture may be about any of them.
    """
    mission = book.running_goal
    step = mission.current_step if mission is not None else None
    if mission is None or step is None or not open_classes:
        return False
    if step.object is None or step.kind not in (*NEEDS_DETECTOR, "wait_for"):
        return step.kind == "look"
    return names_any(step.object, mission.language, book.eyes.classes, open_classes)


def _fact(turn: Transaction, event: Fact) -> None:  # noqa: C901, PLR0912  # one case an event
    match event:
        case events.Seen():
            on_status(turn, event.status, event.off_path, event.left_m)
        case events.Sighted():
            on_sight(turn, event.sight, event.classes)
        case events.Told():
            on_told(turn, event.id, event.ticket, event.answer)
        case events.Recalled():
            on_recalled(turn, event)
        case events.ToolAnswered():
            on_tool_answered(turn, event)
        case events.Tick():
            on_tick(turn)
        case events.Journalled():
            turn.set(safe=max(turn.book.safe, min(event.entry, turn.book.written)))
        case events.Routed():
            on_routed(turn, event)
        case events.RouteDoubted() | events.Oncoming() | events.ClosingIn():
            on_way_news(turn, event)
        case events.Surveyed():
            on_survey(turn, event)
        case events.Planned():
            goal_lifecycle.take_plan(turn, event)
        case events.Submitted():
            goal_lifecycle.submit(turn, event)
        case events.Stopped():
            goal_lifecycle.stop(turn, event.source)
        case events.Restarted():
            goal_lifecycle.restart(turn, event)
        case events.Known():
            on_known(turn, event.facts)


def _command(turn: Transaction, event: Command) -> None:
    mission = turn.mission(event.id)
    if mission is None or refusal(turn.book, event) is not None:
        return
    match event:
        case events.Cancel():
            cancel(turn, mission)
        case events.Pause():
            goal_lifecycle.pause(turn, mission)
        case events.Resume():
            goal_lifecycle.resume(turn, mission)
        case events.Confirm():
            goal_lifecycle.confirm(turn, mission, event.by)
        case events.Reply():
            goal_lifecycle.reply(turn, mission, event.text, event.by)
        case events.Move():
            reorder(turn, event.id, event.before)
        case events.ChangeSpeed():
            change_speed(turn, mission, slower=event.slower)


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
    named = (place for step in ahead for place in places_of(step))
    return next((p for p in named if p in before.targets and p not in now.targets), None)


def _end(turn: Transaction, mission: Mission, name: Bilingual, facts: SiteView) -> None:
    said = tell_unknown_place(facts, name)
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
