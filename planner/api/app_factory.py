"""Put the routes together into one application. Chooses nothing concrete."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fastapi import FastAPI, Request
from starlette.responses import JSONResponse

from planner.api import (
    camera,
    capabilities,
    error_schema,
    fence,
    goals,
    hand,
    health,
    history,
    live_voice,
    localization,
    marks,
    memory,
    objects,
    operator,
    orders,
    people,
    pictures,
    places,
    problems,
    rehearsals,
    robot,
    settings,
    setup,
    skills,
    static_files,
    tools,
    usage,
    voice,
    websocket,
    wizard,
)
from planner.api.interfaces import Services
from planner.api.middleware import Guard
from planner.mission.errors import MissionError
from pons_assets import PAGE

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractAsyncContextManager
    from pathlib import Path
    from typing import Any

    from planner.api.access import Access

_PARTS = (
    goals, rehearsals, voice, live_voice, operator, hand, setup, settings, wizard, robot,
    capabilities, orders, places, localization, objects, memory, pictures, camera, fence, marks,
    people, skills, tools, usage, history, health, websocket,
)  # fmt: skip
API_VERSION = "1.0.0"
DESCRIPTION = "Give a wheeled robot goals in words; stop it; see what it does and why."


class Api(FastAPI):
    """Be FastAPI with a contract that tells the problems too."""

    def openapi(self) -> dict[str, Any]:
        """Return the contract, made once."""
        if self.openapi_schema is None:
            error_schema.with_problems(super().openapi())
        return super().openapi()


def build(
    services: Services,
    access: Access,
    lifespan: Callable[[FastAPI], AbstractAsyncContextManager[None]] | None = None,
    *,
    page: Path = PAGE,
    authority: bytes = b"",
) -> FastAPI:
    """Return the application; documentation pages that load scripts from elsewhere stay off.

    ``page`` is the folder of the built page; where it is not built, ``/`` says so. ``authority`` is
    the certificate that /ca.crt gives out.
    """
    app = Api(
        title="Pons",
        version=API_VERSION,
        description=DESCRIPTION,
        docs_url=None,
        redoc_url=None,
        lifespan=lifespan,
        separate_input_output_schemas=False,  # a step is told as it is taken
    )
    for part in _PARTS:
        app.include_router(part.routes(services))
    problems.install(app)
    app.add_exception_handler(MissionError, _mission)
    app.include_router(static_files.routes(page, authority))
    app.add_middleware(Guard, access=access)
    return app


def warm_up(app: FastAPI) -> None:
    """Have FastAPI build its routes, which it does when a request first comes by them.

    That takes 50 ms of a processor, on the loop that the bridge listens to (docs/adr/0026).
    """
    nowhere = {"type": "http", "method": "GET", "path": "/nowhere", "root_path": "", "headers": []}
    for route in app.router.routes:
        route.matches(dict(nowhere))


async def _mission(_: Request, error: Exception) -> JSONResponse:
    if not isinstance(error, MissionError):
        raise error
    found = goals.problem(error)
    return problems.response(found.status, found.code, found.detail, **found.more)
