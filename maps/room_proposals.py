"""Read the rooms of a site that wait for a name. Light: a planner reads it, without OpenCV."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from pydantic import Field

from maps.yaml_records import SiteRecord, parse_json, read_bytes
from wire.fence import Outline
from wire.geometry import Pose2

if TYPE_CHECKING:
    from pathlib import Path

ROOMS_JSON = "rooms.json"


class RoomProposal(SiteRecord):
    """Hold a room that nobody named yet."""

    id: Annotated[str, Field(pattern=r"^room_[1-9][0-9]{0,3}$")]
    polygon: Outline
    pose: Pose2  # in ``map``
    area_m2: float
    clearance_m: float


class RoomProposals(SiteRecord):
    """Mirror rooms.json."""

    version: Annotated[int, Field(ge=1, le=1)] = 1
    rooms: tuple[RoomProposal, ...] = ()


def read_proposals(folder: Path) -> tuple[RoomProposal, ...]:
    """Return the rooms that wait for a name; none where the site has no such file.

    Raises:
        SiteError: the file is not ours.
    """
    path = folder / ROOMS_JSON
    if not path.exists():
        return ()
    return parse_json(read_bytes(path), RoomProposals, path).rooms
