"""Send bytes on any key of one robot, as they are: broken messages can't use their models."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from wire.doors import BRIDGE_DOOR
from wire.keys import COMMANDS, OPS, Party
from wire.session import open_session
from wire.sockets import Endpoints

if TYPE_CHECKING:
    from pathlib import Path

    from wire.session import Publisher, Session


class Mouth:
    """Hold publishers of every command and every operator's request."""

    def __init__(self, session: Session) -> None:
        keys = (*COMMANDS, *OPS)
        self._publishers: dict[str, Publisher[Any]] = {
            key.path: session.publisher(key) for key in keys
        }

    def say(self, key: str, payload: bytes) -> None:
        """Send and forget."""
        self._publishers[key].put_bytes(payload)


def dial(party: Party, robot_id: str, home: Path, through: str | None) -> Session:
    """Open a session of a home, the bridge behind a proxy where one is named."""
    endpoints = Endpoints(home, {BRIDGE_DOOR: through}) if through else None
    return open_session(party, robot_id, home, endpoints)
