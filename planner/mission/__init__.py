"""Walk goals: one at a time, journalled, believed only on the bridge's word. The door for the API.

``Missions`` (built and started by the app factory; ``missions.link`` is the ``Link``)::

    missions = Missions(site=…, robot=…, link=Link(WireBus(session), robot), router=RouteWorker(…),
                        brain=…, disk=JournalSync(MissionJournal.in_home(home)))
    await missions.start(freeze=True) … await missions.close()

    await submit(text, *, language=None, confirm=False, replace=False, idempotency_key=None,
                 act=None, source="api", answers=True) -> Goal
    goal(id) -> Goal;  goals(limit=50) -> tuple[Goal, ...]  (open ones first, each newest first)
    await cancel(id) | pause(id) | move(id, before=None) -> Goal
    await resume(id=None, act=None) | confirm(id, act=None) | answer(id, text, act=None) -> Goal
    await stop(source) -> StopResult(id, is_echoed, waited_s)
    subscribe() -> Subscription: async iterator of (seq, dict), ``async with`` or ``close()``
    snapshot() -> dict with seq, planner_id, running, queue, goals, status
    failed -> what ended the mission loop, if anything did;  journal_trouble -> str | None

``act`` is the person's signed ``op/resume`` (``wire.OpRequest``), made by the API's handlers, which
clears the bridge's hold. Without it a goal given while a hold stands pauses after 2 s.

Events: {"type": "goal", "goal": …}, {"type": "status", "status": wire.Status (dump it yourself)},
{"type": "bridge", "event": …}, {"type": "say", "goal", "text"}, {"type": "first_waypoint", "goal",
"seconds"}, {"type": "progress", "goal", "step", "left_m" | "left_rad" | "left_s"}, {"type": "act",
"accepted", "code"}, {"type": "gap", "missed"} (take a snapshot again).

Errors (all ``MissionError`` with ``code`` and bilingual ``message``): unknown_goal 404, bad_state
409, nothing_to_resume 409, queue_full 429, idempotency_conflict 409, idempotency_reserved 422,
journal_unavailable 503.

The lockstep harness runs this same door on a clock, a disk and an event loop of its own: it starts
with ``rounds=False`` and calls ``missions.loop.hear()`` and ``tick()`` itself. ``advance`` and
``motion_request`` are pure.
"""

from planner.mission.clocks import Clocks
from planner.mission.engine import Leg
from planner.mission.journal import MissionJournal
from planner.mission.journal_sync import JournalSync
from planner.mission.service import Missions
from planner.mission.spoken_status import tell_doubt
from planner.mission.state import Rules

__all__ = ["Clocks", "JournalSync", "Leg", "MissionJournal", "Missions", "Rules", "tell_doubt"]
