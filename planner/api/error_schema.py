"""Tell in openapi.json which problems each route answers with, beside what its types tell.

Most follow from what stands before every route (planner.api.middleware) and from its shape; the
rest are its own, by its ``operation_id``.
"""

from __future__ import annotations

from http import HTTPStatus
from typing import Any

from planner.api.access import STOPPING_PATHS, TYPED_METHODS
from planner.api.problems import MEDIA_TYPE

_SCHEMA = "Problem"
_PROBLEM = {
    "title": _SCHEMA,
    "description": "RFC 9457, with a stable code; message where a person may be the one who reads.",
    "type": "object",
    "required": ["type", "title", "status", "code", "detail"],
    "properties": {
        "type": {"type": "string"},
        "title": {"type": "string"},
        "status": {"type": "integer"},
        "code": {"type": "string"},
        "detail": {"type": "string"},
        "message": {"type": "object", "additionalProperties": {"type": "string"}},
    },
}
_ASKS_THE_BRIDGE = (409, 503)
_MISSION = (409, 503)
OWN_PROBLEMS: dict[str, tuple[int, ...]] = {
    "readyz": (503,),
    "get_camera": (503,),
    "arm": _ASKS_THE_BRIDGE,
    "disarm": _ASKS_THE_BRIDGE,
    "estop": _ASKS_THE_BRIDGE,
    "reset": _ASKS_THE_BRIDGE,
    "resume": _ASKS_THE_BRIDGE,
    "accept_fence": _ASKS_THE_BRIDGE,
    "reject_fence": (409,),
    "propose_fence": (409,),
    "give_goal": (*_MISSION, 429),
    "rehearse": (404, 409),
    "drive_rehearsal": (404, 409),
    "get_driven_rehearsal": (404,),
    "cancel_rehearsal": (404,),
    "teleop": (409,),
    "give_spoken_goal": (*_MISSION, 400, 429),
    "answer_goal": _MISSION,
    "cancel_goal": _MISSION,
    "confirm_goal": _MISSION,
    "move_goal": _MISSION,
    "pause_goal": _MISSION,
    "resume_goal": _MISSION,
    "get_settings": (422, 503),
    "change_settings": (409, 503, 507),
    "test_model": (409, 503),
    "restart_planner": (409,),
    "wizard_look": (409, 503),
    "wizard_choose": (409, 503),
    "wizard_measure": (409, 503),
    "wizard_take": (409,),
    "wizard_map": (409, 503),
    "wizard_save_map": (409, 503),
    "trial": (409, 503),
    "set_up": (409, 503),
    "give_order": (409, 429, 503),
    "get_order": (503,),
    "pause_order": _MISSION,
    "resume_order": _MISSION,
    "remove_order": (503,),
    "list_memories": (503,),
    "teach_fact": (409, 503),
    "forget_memories": (503,),
    "forget_memory": (503,),
    "teach_place": (409, 503, 507),
    "put_place": (409, 503, 507),
    "forget_place": (409, 503, 507),
}


def with_problems(schema: dict[str, Any]) -> dict[str, Any]:
    """Add each operation's problems to a contract; FastAPI's own 422 is replaced by ours."""
    schemas = schema["components"]["schemas"]
    schemas[_SCHEMA] = _PROBLEM
    for name in ("HTTPValidationError", "ValidationError"):
        schemas.pop(name, None)
    for path, operations in schema["paths"].items():
        for method, operation in operations.items():
            found = _statuses(path, method.upper(), operation)
            told = {status: _response(int(status)) for status in map(str, sorted(found))}
            typed = {s: what for s, what in operation["responses"].items() if s != "422"}
            operation["responses"] = dict(sorted({**typed, **told}.items()))
    return schema


def _statuses(path: str, method: str, operation: dict[str, Any]) -> set[int]:
    found = {401, 403, *OWN_PROBLEMS.get(operation["operationId"], ())}
    if "422" in operation["responses"]:
        found.add(422)
    if "{" in path:
        found.add(404)
    if path in STOPPING_PATHS:
        return found - {422}  # whatever the body is, it stops
    if method in TYPED_METHODS:
        found.add(415)
    if "requestBody" in operation:
        found |= {400, 413}
    return found


def _response(status: int) -> dict[str, Any]:
    schema = {"$ref": f"#/components/schemas/{_SCHEMA}"}
    return {
        "description": HTTPStatus(status).phrase,
        "content": {MEDIA_TYPE: {"schema": schema}},
    }
