"""Make requests for a drive in the simulator, as the planner makes them."""

from __future__ import annotations

import asyncio
from typing import Any

import numpy as np

from lockstep.rehearsal_drive import RehearsalDrive
from planner.brain.interface import ThinkRequest
from planner.brain.offline_brain import OfflineBrain
from planner.driven_rehearsal import DrivenPlan, DriveRequest
from planner.plan import plan_record
from planner.site.site_view import vocabulary_of
from tests.planner.api.fakes import two_room
from wire import RobotDescription


def request_of(text: str, **fields: Any) -> DriveRequest:
    """Return the request for a sentence from the dock of the two rooms."""
    site = two_room()
    heard = ThinkRequest(text=text, vocabulary=vocabulary_of(site))
    plan = plan_record(asyncio.run(OfflineBrain().think(heard)).plan)
    return DriveRequest(
        site=str(site.folder),
        begins=site.home.pose,
        rows=tuple(enumerate(plan.steps)),
        **{"robot": RobotDescription(), **fields},
    )


def drive(asked: DriveRequest, body: bytes = b"") -> DrivenPlan:
    """Return what came of a request, as it comes over the wire."""
    asked = DriveRequest.model_validate(asked.model_dump(mode="json"))
    driving = RehearsalDrive(asked, body)
    for _ in driving.turns():
        pass
    return DrivenPlan.model_validate(driving.plan().model_dump(mode="json"))


def cells_of(x0: float, y0: float, x1: float, y1: float) -> bytes:
    """Return the cells of a box of the two rooms' map [m], as the obstacle layer tells them."""
    grid = two_room().grid
    (left, low), (right, high) = grid.cell_of(x0, y0), grid.cell_of(x1, y1)
    columns, rows = np.meshgrid(np.arange(left, right + 1), np.arange(low, high + 1))
    return np.column_stack([columns.ravel(), rows.ravel()]).astype("<u2").tobytes()
