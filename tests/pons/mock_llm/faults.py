"""Own all faults of model servers that the endpoint client is tried with. Data only."""

from __future__ import annotations

from typing import ClassVar

from pydantic import Field

from pons.mock_llm import Switches

FAULTS: dict[str, str] = {
    # No reply.
    "status": "answer with an HTTP status, 500 unless --status says which",
    "loading": "answer 503, the model is being loaded",
    "rate_limited": "answer 429; --retry-after says what the header says",
    "not_found": "answer 404, the model does not exist",
    "hang": "take the request and never answer",
    "cold": "load the model for --load-s first, and begin again where the client leaves",
    "small_context": "answer 400, the prompt does not fit into the context",
    "lost": "close the connection in the middle of a reply",
    "redirect": "point to a metadata address",
    "filtered": "answer 400, a filter refused the order",
    # Bodies that are refused.
    "no_json_schema": "answer 400 to a JSON schema",
    "only_tool": "answer 400 to any response_format",
    "only_json_object": "answer 400 to a JSON schema and to tools",
    "no_schema": "answer 400 to a response_format or tools",
    "no_system": "answer 400 to a message of the system",
    "no_temperature": "answer 400 to a temperature",
    "new_tokens": "answer 400 to max_tokens",
    "no_extras": "answer 400 to fields that are not OpenAI's",
    "no_stream": "answer 400 to stream",
    # Bodies of replies.
    "endless": "send a reply that never ends",
    "huge": "send a reply of 1 GB",
    "drip": "send a good reply one byte at a time",
    "not_json": "reply with a web page",
    "no_choices": "reply with no choices",
    "error_200": "reply 200 with an error in the body",
    "packed": "reply packed with gzip, unasked",
    # What the model writes.
    "garbage": "reply with prose and broken JSON",
    "hallucinate": "plan to places that do not exist",
    "hostile": "reply with plans that must not be walked, another one each time",
    "wrong_types": "write a plan with a number for a place and a text for a time",
    "two_plans": "write two different plans",
    "refuse_and_plan": "write a refusal that carries a plan",
    "truncated": "cut a good plan off",
    "length": "cut a good plan off at the token limit, and say so",
    "null": "reply with content null",
    "reasoning": "reply with content null and another plan in the reasoning",
    "thoughts_only": "write thoughts that never end",
    "declined": "decline, as the protocol has it",
    "echo_key": "repeat the key in the reply's words",
    "unknown_tool": "call a tool that does not exist",
    "fenced": "wrap a good plan in prose and a code fence",
    "thinking": "put thoughts with another plan before a good one",
    "twice": "write a good plan two times",
    "schema_ignored": "take a schema and hold the model to none of it",
    "schema_barren": "take a JSON schema and reply with empty content",
    "strict_barren": "take every response_format and tool, and reply with empty content",
    "tool_never": "refuse a response_format, take the forced tool, and talk",
    "parts": "write a good plan as a list of parts",
    "object_arguments": "call the tool with an object for its arguments",
    # How it streams.
    "plain": "answer plainly to who asked for a stream",
    "stream_breaks": "close the connection in the middle of a stream",
    "stream_error": "send an error in the middle of a stream",
    "stream_unfinished": "end a stream without saying so",
    "stream_error_choice": "send an error beside an empty choice in the middle of a stream",
    "stream_open": "say that a stream's reply is finished, and leave the stream open",
    "stream_silent": "write a whole reply, say nothing of it, and leave the stream open",
    "stream_garbage": "send an event that is no JSON",
    "stream_endless": "send a stream that never ends",
    "stream_comments": "stream with comments, CRLF and empty choices",
    "odd_index": "stream a tool call without its index",
    "odd_id": "stream a tool call whose id comes late",
    "odd_name": "stream a tool call whose name comes late",
    "odd_object": "stream a tool call whose arguments are an object",
    "odd_repeat": "stream a tool call and send it whole once more",
    # What it makes of pictures; words alone it takes as ever.
    "refuses_pictures": "answer 400 to a picture",
    "drops_pictures": "leave pictures out without a word",
    "slow_pictures": "never answer about a picture",
    "hallucinated_point": "point at something that is not there",
    "point_out_of_range": "point outside of the picture, or with what is no whole number",
    "obeys_pictures": "obey whatever stands written in a picture, looking and planning",
}

READABLE = frozenset(
    {
        *("no_json_schema", "only_tool", "only_json_object", "no_schema", "no_system"),
        *("no_temperature", "new_tokens", "no_extras", "no_stream"),
        *("fenced", "thinking", "twice", "parts", "object_arguments", "plain", "stream_breaks"),
        *("stream_error", "stream_unfinished", "stream_garbage", "stream_comments"),
        *("cold", "schema_ignored", "schema_barren", "strict_barren", "tool_never"),
        *("stream_error_choice", "stream_open", "stream_silent"),
        *("odd_index", "odd_id", "odd_name", "odd_object", "odd_repeat"),
        *("refuses_pictures", "drops_pictures", "slow_pictures", "hallucinated_point"),
        *("point_out_of_range", "obeys_pictures"),
    }
)
"""Faults behind which there is a good plan, for a client that finds it; from all others none may
come, however long they last."""


class BadSwitches(Switches):
    """Say how the tests' server misbehaves from now on."""

    faults: ClassVar[dict[str, str]] = FAULTS
    load_s: float = Field(default=40.0, ge=0.0, le=3600.0)
    """How long one connection must be held until a cold model is loaded."""
    transcript: str = Field(default="go to the kitchen", max_length=20_000)
    """What every recording is heard as."""
    probability: float | None = Field(default=0.95, ge=0.0, le=1.0)
    """How sure it says to be; None: it says nothing of it."""
