"""Serve the newest picture as the camera gave it. Opens none: the viewer draws the boxes."""

from __future__ import annotations

from fastapi import APIRouter
from starlette.responses import Response

from planner.api.interfaces import Services
from planner.api.problems import HttpProblem

OLDEST_S = 5.0
"""An older picture is no view of anything: the answer is that the camera is silent."""
KINDS = {b"\xff\xd8": "image/jpeg", b"\x89P": "image/png"}


def routes(services: Services) -> APIRouter:
    """Return the route of the picture."""
    router = APIRouter(prefix="/v1", tags=["objects"])

    @router.get(
        "/camera.jpg",
        operation_id="get_camera",
        response_class=Response,
        responses={200: {"content": {"image/jpeg": {}}}},
    )
    async def camera() -> Response:
        """Give the newest picture; headers tell its seq and its age in seconds.

        The camera may rest while nobody looks: the first picture then takes up to a second.
        """
        if services.eyes.sight.blind == "no_camera":
            raise HttpProblem(503, "no_camera", "this robot has no camera")
        picture = await services.eyes.show()
        age_s = None if picture is None else services.eyes.now_s - picture.taken_s
        kind = None if picture is None else KINDS.get(picture.color.data[:2])
        if picture is None or age_s is None or kind is None or not age_s <= OLDEST_S:
            said = "none came yet" if age_s is None else f"the newest is {age_s:.1f} s old"
            raise HttpProblem(503, "camera_silent", f"no picture to show: {said}")
        return Response(
            picture.color.data,
            media_type=kind,
            headers={
                "cache-control": "no-store",
                "x-pons-seq": str(picture.color.header.seq),
                "x-pons-age-s": f"{age_s:.3f}",
            },
        )

    return router
