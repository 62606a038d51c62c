"""Give every record on the wire its strictness: frozen, nothing extra, nothing infinite."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class Record(BaseModel):
    """Be immutable, refuse unknown fields, refuse NaN and infinity."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)
