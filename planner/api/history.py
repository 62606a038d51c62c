"""Serve the list of missions: by day, state and words, a page at a time; and one with its story.

Whoever may see the goals may see them here; the model's own words stay with /v1/goals.
"""

from __future__ import annotations

import html
import json
import re
from pathlib import Path
from typing import Annotated, Any

from fastapi import APIRouter, Query
from starlette.responses import HTMLResponse

from planner.api.goals import Cursor, find_goal
from planner.api.interfaces import Services
from planner.budget import Usage
from planner.mission.goal_history import GoalStory, HistoryPage, HistoryQuery, RecordedTrack
from planner.plan import Frozen, Goal, GoalState, Language

Limit = Annotated[int, Query(ge=1, le=200)]
UnixTime = Annotated[float | None, Query(ge=0.0, le=1e11)]
Words = Annotated[str | None, Query(max_length=200)]
TEMPLATE = Path(__file__).with_name("shared_mission.html")
MOST_OF_TITLE = 80
_NO_FILE_NAME = re.compile(r"[^A-Za-z0-9_.-]")


class ToldGoal(Frozen):
    """Show a goal whole, with its story and what the model cost for it."""

    goal: Goal
    story: GoalStory
    usage: Usage


def routes(services: Services) -> APIRouter:
    """Return the routes below /v1/history."""
    router = APIRouter(prefix="/v1/history", tags=["history"])

    @router.get("", operation_id="list_history")
    async def several(
        since_unix_s: UnixTime = None,
        until_unix_s: UnixTime = None,
        state: GoalState | None = None,
        search: Words = None,
        before: Cursor = None,
        limit: Limit = 50,
    ) -> HistoryPage:
        """List goals, the newest first; ``before`` is a former page's ``next``."""
        return await services.history.find(
            HistoryQuery(
                since_unix_s=since_unix_s, until_unix_s=until_unix_s, state=state, search=search,
                before=before, limit=limit,
            )
        )  # fmt: skip

    @router.get("/{goal_id}", operation_id="get_history")
    async def one(goal_id: str) -> ToldGoal:
        """Show one goal with who gave it, what was asked and answered, and what it cost."""
        return await _tell(services, goal_id)

    @router.get("/{goal_id}/track", operation_id="get_history_track")
    async def track(goal_id: str) -> RecordedTrack:
        """Show how the robot moved: pose, speed asked and measured, rows, as the black box has it.

        Empty where nothing of that time is kept any more.
        """
        return await _track(services, goal_id)

    @router.get(
        "/{goal_id}/page",
        operation_id="get_history_page",
        response_class=HTMLResponse,
        responses={200: {"content": {"text/html": {}}}},
    )
    async def page(goal_id: str, language: Language = Language.EN) -> HTMLResponse:
        """Return the mission as one HTML file to share: it asks no network, and is to be saved.

        As a page of the planner's own it runs nothing: the policy of all answers forbids it.
        """
        told = (await _tell(services, goal_id)).model_dump(mode="json")
        track = (await _track(services, goal_id)).model_dump(mode="json")
        name = f"pons-{_NO_FILE_NAME.sub('_', goal_id)}.html"
        saved = {"content-disposition": f'attachment; filename="{name}"'}
        return HTMLResponse(page_of(told, track, language), headers=saved)

    return router


async def _tell(services: Services, goal_id: str) -> ToldGoal:
    _, story = await services.history.story(goal_id)
    goal = await find_goal(services, goal_id)
    await services.budget.look(goal_id)
    return ToldGoal(goal=goal, story=story, usage=services.budget.usage(goal_id))


async def _track(services: Services, goal_id: str) -> RecordedTrack:
    mission, story = await services.history.story(goal_id)
    began = story.changes[0].at_unix_s if story.changes else mission.created_unix_s
    return await services.history.tracks.read(began, mission.updated_unix_s)


def page_of(told: dict[str, Any], track: dict[str, Any], language: Language) -> str:
    """Return one mission as a page to share: one HTML file that asks no network and runs no words.

    All it knows stands in it as JSON, as /v1/history/ID tells it; what people and models wrote is
    shown as text, never as markup. Its labels are in a language.
    """
    content = json.dumps({**told, "track": track, "labels": language.value}, ensure_ascii=False)
    inert = content.replace("<", "\\u003c")  # no sentence can end the script that holds it
    title = html.escape(told["goal"]["text"][:MOST_OF_TITLE])
    page = TEMPLATE.read_text("utf-8").replace("__TITLE__", title)
    return page.replace("__CONTENT__", inert)
