"""Put the routes together into one application. Chooses nothing concrete."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fastapi import FastAPI, Request
from starlette.responses import HTMLResponse, JSONResponse

from planner.api import events, goals, health, operator, problems, robot
from planner.api.guard import Guard
from planner.api.ports import Services
from planner.mission.errors import MissionError

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractAsyncContextManager

    from planner.api.access import Access

API_VERSION = "1.0.0"
DESCRIPTION = "Give a wheeled robot goals in words; stop it; see what it does and why."

_PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Pons</title></head><body>
<h1>Pons</h1>
<p>The planner runs. Give a goal from a shell / 规划器已运行，可在终端下达任务:</p>
<pre>pons say "go to the living room"
pons say 去厨房
pons stop</pre>
<p><a href="/v1/robot">robot</a> · <a href="/v1/goals">goals</a> ·
<a href="/v1/places">places</a> · <a href="/openapi.json">API</a></p>
</body></html>
"""


def build(
    services: Services,
    access: Access,
    lifespan: Callable[[FastAPI], AbstractAsyncContextManager[None]] | None = None,
) -> FastAPI:
    """Return the application; documentation pages that load scripts from elsewhere stay off."""
    app = FastAPI(
        title="Pons",
        version=API_VERSION,
        description=DESCRIPTION,
        docs_url=None,
        redoc_url=None,
        lifespan=lifespan,
    )
    for part in (goals, operator, robot, health, events):
        app.include_router(part.routes(services))
    problems.install(app)
    app.add_exception_handler(MissionError, _mission)
    app.add_api_route("/", _page, include_in_schema=False)
    app.add_middleware(Guard, access=access)
    return app


async def _page() -> HTMLResponse:
    return HTMLResponse(_PAGE)


async def _mission(_: Request, error: Exception) -> JSONResponse:
    if not isinstance(error, MissionError):
        raise error
    found = goals.problem(error)
    return problems.response(found.status, found.code, found.detail, **found.more)
