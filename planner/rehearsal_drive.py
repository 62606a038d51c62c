"""Have a plan driven in the simulator, in a process of its own: one at a time, and killed with us.

Owns the process and its bounds; knows no physics. The process runs ten steps of nice behind the
planner (``processes.parent_death``), begins when it is asked for and ends with its drive.
"""

from __future__ import annotations

import asyncio
import contextlib
import uuid
from time import monotonic
from typing import TYPE_CHECKING

from maps.growing_map import GROWING_MAP
from planner.driven_rehearsal import (
    LONGEST_S,
    MODULE,
    DrivenPlan,
    DrivenRehearsal,
    DrivenStep,
    DriveRequest,
    left_out,
    steps_to_drive,
)
from planner.language.catalogue import say
from planner.rehearsal import RehearsalError
from processes.parent_death import worker_command
from processes.worker import STREAM_ERRORS, read_frame, reap, send_frame, spawn
from processes.worker_protocol import pack

if TYPE_CHECKING:
    from asyncio.subprocess import Process
    from collections.abc import Callable, Iterator

    from planner.navigation import ObstacleReport
    from planner.perception import Thing
    from planner.plan import Language, PlanRecord, StepRecord
    from planner.rehearsal import Rehearsal, Rehearser
    from planner.site import KnownPlaces
    from wire import RobotDescription

LONGEST_REAL_S = 180.0
"""Of real time; then it is killed."""
PERSON_RADIUS_M = 0.25
_CAME = DrivenStep.model_fields.keys() - {"index", "kind", "place", "name", "branch"}
"""What is known of a step only once it is driven."""
PATIENCE_S, TIMES = 120.0, 2.0
"""A drive gets so long beyond what was foretold, and so many times it."""


class RehearsalDrives:
    """Drive plans in the simulator, one at a time, and keep the newest."""

    def __init__(
        self,
        rehearser: Rehearser,
        site: KnownPlaces,
        robot: RobotDescription,
        layer: Callable[[], ObstacleReport | None] = lambda: None,
        things: Callable[[], tuple[Thing, ...]] = lambda: (),
        module: str = MODULE,
    ) -> None:
        """Take what is known of the surroundings; nothing is started.

        Args:
            rehearser: finds the ways first.
            site: the places, and what people drew on the map.
            robot: its description.
            layer: what the lidar saw and the map does not know.
            things: what the camera saw.
            module: drives, as a worker process.
        """
        self._rehearser, self._site, self._robot = rehearser, site, robot
        self._layer, self._things, self._module = layer, things, module
        self.newest: DrivenRehearsal | None = None
        self._begins = False
        self._driving: asyncio.Task[None] | None = None
        self._process: Process | None = None
        self._ending: asyncio.Task[None] | None = None

    @property
    def pid(self) -> int | None:
        """Return the id of the process that drives, while there is one."""
        return None if self._process is None else self._process.pid

    @property
    def is_busy(self) -> bool:
        """Return whether a plan is being driven now."""
        return self._begins or (self._driving is not None and not self._driving.done())

    async def of_text(self, text: str, language: Language | None = None) -> DrivenRehearsal:
        """Begin to drive what the built-in reader makes of a sentence.

        Raises:
            RehearsalError: as of a rehearsal; ``rehearsal_running``: one is driven already.
        """
        with self._beginning():
            return await self._begin(await self._rehearser.plan_of(text, language))

    async def of_plan(self, plan: PlanRecord | None) -> DrivenRehearsal:
        """Begin to drive a plan from here and now; raises as :meth:`of_text` does."""
        with self._beginning():
            return await self._begin(plan)

    async def cancel(self) -> DrivenRehearsal | None:
        """End the drive, if one runs, and its process; return the newest."""
        driving = self._driving
        if driving is not None and not driving.done():
            driving.cancel()
            await asyncio.gather(driving, return_exceptions=True)
            if self._ending is not None:
                await self._ending
            self._change(state="cancelled")
        return self.newest

    async def close(self) -> None:
        """End with the planner; no process is left."""
        await self.cancel()

    @contextlib.contextmanager
    def _beginning(self) -> Iterator[None]:
        if self.is_busy:
            raise RehearsalError("rehearsal_running", "a plan is driven in the simulator already")
        self._begins = True
        try:
            yield
        finally:
            self._begins = False

    async def _begin(self, plan: PlanRecord | None) -> DrivenRehearsal:
        if (self._site.site.folder / GROWING_MAP).is_file():
            raise RehearsalError("rehearsal_map_grows", "the map is being made")
        shown = await self._rehearser.of_plan(plan)
        if plan is None or not (rows := steps_to_drive(plan, shown)):
            raise RehearsalError("rehearsal_no_plan", "no step of it can be driven without eyes")
        self.newest = DrivenRehearsal(
            id=uuid.uuid4().hex[:12],
            state="running",
            map_id=shown.map_id,
            begins=shown.begins,
            shown=shown,
            driven=DrivenPlan(steps=_before(shown)),
            left_out=left_out(plan, shown, nav2=self._robot.ros2 is not None),
        )
        asked, body = self._request(rows, shown)
        frame = pack(asked.model_dump(mode="json"), body)
        self._driving = asyncio.create_task(self._drive(frame), name="drive a rehearsal")
        return self.newest

    def _request(
        self, rows: tuple[tuple[int, StepRecord], ...], shown: Rehearsal
    ) -> tuple[DriveRequest, bytes]:
        """Return what the process is told: the plan, and the surroundings as last seen."""
        layer, site = self._layer(), self._site
        people = [(t.x_m, t.y_m, PERSON_RADIUS_M) for t in self._things() if t.label == "person"]
        movers = () if layer is None else layer.movers
        request = DriveRequest(
            site=str(site.site.folder.absolute()),
            robot=self._robot,
            begins=shown.begins,
            rows=rows,
            places=tuple(place for place in site.places if place not in site.site.places),
            marks=site.drawn.marks,
            discs=(*people, *((m.x_m, m.y_m, m.radius_m) for m in movers)),
            cells_bytes=0 if layer is None else len(layer.cells),
            limit_s=min(LONGEST_S, TIMES * shown.seconds + PATIENCE_S),
        )
        return request, b"" if layer is None else layer.cells + layer.suspicions

    async def _drive(self, frame: bytes) -> None:
        """Follow one process to its end; whatever becomes of it, the newest says so."""
        code = None
        starting = asyncio.create_task(spawn(worker_command(self._module)))
        try:
            async with asyncio.timeout(LONGEST_REAL_S):
                await self._follow(await asyncio.shield(starting), frame)
        except TimeoutError:
            code = "rehearsal_timed_out"
        except STREAM_ERRORS:
            code = "rehearsal_died"
        finally:
            # Shielded, and waited for by who cancels: no process is left that nobody waits for.
            self._ending = asyncio.create_task(self._end(starting))
            await asyncio.shield(self._ending)
        if code is None:
            self._change(state="done")
        else:
            self._change(state="failed", code=code, message=say(f"problem.{code}"))

    async def _follow(self, process: Process, frame: bytes) -> None:
        """Tell a process what to drive, and note what it tells until it is over."""
        began_s, self._process = monotonic(), process
        await send_frame(process, frame)
        is_over = False
        while not is_over:
            told, _ = await read_frame(process)
            is_over = told["is_over"]
            self._note(DrivenPlan.model_validate(told["driven"]), monotonic() - began_s)

    async def _end(self, starting: asyncio.Task[Process]) -> None:
        """Kill the process, which may be starting still, and wait until it is gone."""
        with contextlib.suppress(OSError):
            await reap(await starting)
        self._process = None

    def _note(self, driven: DrivenPlan, took_s: float) -> None:
        """Put what was driven so far beside what was foretold, step by step."""
        if self.newest is None:
            return
        came = {step.index: step for step in driven.steps}
        steps = tuple(
            before.model_copy(update={name: getattr(came[before.index], name) for name in _CAME})
            if before.index in came
            else before
            for before in self.newest.driven.steps
        )
        self._change(
            driven=driven.model_copy(update={"steps": steps}),
            took_s=round(took_s, 1),
            times_faster=round(driven.seconds / took_s, 1) if took_s > 0.0 else None,
        )

    def _change(self, **fields: object) -> None:
        if self.newest is not None:
            self.newest = self.newest.model_copy(update=fields)


def _before(shown: Rehearsal) -> tuple[DrivenStep, ...]:
    """Return the steps as they stand before anything is driven."""
    return tuple(
        DrivenStep(
            index=step.index, kind=step.kind, place=step.place, name=step.name, branch=step.branch,
            outcome="left_out" if step.does == "open" else "pending",
        )
        for step in shown.steps
        if not step.instead
    )  # fmt: skip
