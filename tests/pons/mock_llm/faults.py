"""Own the faults of a server that other tests play out with whole programs. Data only.

Each way in which one reply can be wrong is tried in tests/planner/brain/endpoint, without a server.
"""

from __future__ import annotations

from typing import ClassVar

from pydantic import Field

from pons.mock_llm import Switches

FAULTS: dict[str, str] = {
    **Switches.faults,
    "loading": "answer 503, the model is being loaded",
    "cold": "load the model for --load-s first, and begin again where the client leaves",
    "small_context": "answer 400, the prompt does not fit into the context",
    "redirect": "point to a metadata address",
    "error_200": "reply 200 with an error in the body",
    "huge": "send a reply of 1 GB",
    "no_json_schema": "answer 400 to a JSON schema",
    "no_schema": "answer 400 to a response_format or tools",
    "schema_ignored": "take a schema and hold the model to none of it",
    "schema_barren": "take a JSON schema and reply with empty content",
    "strict_barren": "take every response_format and tool, and reply with empty content",
    "tool_never": "refuse a response_format, take the forced tool, and talk",
    "fenced": "wrap a good plan in prose and a code fence",
    "hallucinate": "plan to places that do not exist",
    "hostile": "reply with plans that must not be walked, another one each time",
    "stream_error_choice": "send an error beside an empty choice in the middle of a stream",
    "stream_open": "say that a stream's reply is finished, and leave the stream open",
    "stream_silent": "write a whole reply, say nothing of it, and leave the stream open",
}


class BadSwitches(Switches):
    """Say how the tests' server misbehaves from now on."""

    faults: ClassVar[dict[str, str]] = FAULTS
    load_s: float = Field(default=40.0, ge=0.0, le=3600.0)
    """How long one connection must be held until a cold model is loaded."""
