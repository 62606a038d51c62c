"""Define the base class of all wire messages: frozen, strict, finite."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class Record(BaseModel):
    """Refuse unknown fields, NaN and infinity; immutable."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)
