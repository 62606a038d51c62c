"""Write state, inbox, decision and configuration as JSON and read them back, exactly.

Floats come back bit for bit; NaN and infinity do not exist in these records. Used by recordings,
replay and tests, never inside a tick.
"""

from __future__ import annotations

from typing import Generic, TypeVar

from pydantic import TypeAdapter

from bridge.core.config import CoreConfig
from bridge.core.decision import Decision
from bridge.core.inbox import Inbox
from bridge.core.state import BridgeState

R = TypeVar("R")


class Json(Generic[R]):
    """Translate one kind of record."""

    def __init__(self, cls: type[R]) -> None:
        self._adapter: TypeAdapter[R] = TypeAdapter(cls)

    def write(self, record: R) -> bytes:
        """Return the record as JSON; fields at their default are left out."""
        return self._adapter.dump_json(record, exclude_defaults=True)

    def read(self, data: bytes) -> R:
        """Return the record.

        Raises:
            pydantic.ValidationError: the bytes are not such a record.
        """
        return self._adapter.validate_json(data)


CONFIG = Json(CoreConfig)
STATE = Json(BridgeState)
INBOX = Json(Inbox)
DECISION = Json(Decision)
