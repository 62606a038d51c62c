"""Own the mock's switches: what goes wrong, how often, how late. Data only."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict, Field, field_validator

FAULTS: dict[str, str] = {
    "garbage": "reply with prose and broken JSON",
    "status": "answer with an HTTP status, 500 unless --status says which",
    "hang": "take the request and never answer",
    "hallucinate": "plan to places that do not exist",
    "hostile": "reply with plans that must not be walked, another one each time",
    "endless": "send a reply that never ends",
    "huge": "send a reply of 1 GB",
    "drip": "send a good reply one byte at a time",
    "redirect": "point to a metadata address",
    "no_schema": "answer 400 to a response_format or tools",
    "fenced": "wrap a good plan in prose and a code fence",
    "thinking": "put thoughts with another plan before a good one",
    "twice": "write a good plan two times",
    "truncated": "cut a good plan off",
    "null": "reply with content null",
    "echo_key": "repeat the key in the reply's words",
}


class Switches(BaseModel):
    """Say how the mock behaves from now on."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    fault: str | None = None
    times: int | None = Field(default=None, ge=1, le=1_000_000)
    """Calls until the fault is gone; None: it stays."""
    delay_s: float = Field(default=0.0, ge=0.0, le=3600.0)
    status: int = Field(default=500, ge=400, le=599)
    retry_after: str | None = Field(default=None, max_length=100)
    """The header of that name, as it is."""

    @field_validator("fault")
    @classmethod
    def _known(cls, fault: str | None) -> str | None:
        if fault is not None and fault not in FAULTS:
            raise ValueError(f"unknown fault {fault!r}; known: {', '.join(FAULTS)}")
        return fault
