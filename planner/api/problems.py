"""Turn everything that can go wrong with a request into problem+json with a stable code (RFC 9457).

4xx is for requests that are malformed or not allowed. A sentence that is understood but impossible
is no error: it is a goal that ends refused.
"""

from __future__ import annotations

from http import HTTPStatus
from typing import TYPE_CHECKING, Any, get_args

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel
from starlette.exceptions import HTTPException
from starlette.responses import JSONResponse
from starlette.routing import Match

from maps.value_flaws import expected_zh
from planner.language.catalogue import message, say
from planner.language.place_lists import known_places
from planner.plan import Bilingual, Code

if TYPE_CHECKING:
    from collections.abc import Mapping

    from planner.plan import Vocabulary


_LENGTH = say("problem.length")
_BROKEN = say("problem.broken")
_KIND = say("problem.kind")
_EARS = say("problem.ears")
_AGAIN = say("problem.again")
SAYINGS = {
    "goal_forgotten": say("problem.goal_forgotten"),
    "audio_empty": say("problem.audio_empty"),
    "audio_too_short": say("problem.audio_too_short"),
    "audio_too_long": _LENGTH,
    "not_wav": _KIND,
    "wav_unsupported": _KIND,
    "wav_truncated": _BROKEN,
    "wav_malformed": _BROKEN,
    "recogniser_unavailable": _EARS,
    "voice_busy": _AGAIN,
    "no_camera": say("problem.no_camera"),
    "no_detector": say("problem.no_detector"),
    "detector_down": say("problem.detector_down"),
    "camera_silent": say("problem.camera_silent"),
    "camera_frozen": say("problem.camera_frozen"),
    "camera_unusable": say("problem.camera_unusable"),
    "unknown_object": say("problem.unknown_object"),
    "disk_full": say("problem.disk_full"),
    "recorder_down": say("problem.recorder_down"),
    "voice_timed_out": _AGAIN,
    "operator_needed": say("problem.operator_needed"),
    "owner_needed": say("problem.owner_needed"),
    "person_needed": say("problem.person_needed"),
    "unknown_person": say("problem.unknown_person"),
    "person_exists": say("problem.person_exists"),
    "people_full": say("problem.people_full"),
    "person_unnamed": say("problem.person_unnamed"),
    "token_needed": say("problem.token_needed"),
    "foreign_host": say("problem.foreign_host"),
    "foreign_origin": say("problem.foreign_origin"),
    "proxy_without_token": say("problem.proxy_without_token"),
    "goal_too_long": say("problem.goal_too_long"),
    "hand_taken": say("problem.hand_taken"),
    "too_many_goals": say("problem.too_many_goals"),
    "too_many_sockets": say("problem.too_many_sockets"),
    "headers_too_large": say("problem.headers_too_large"),
    "request_timeout": say("problem.request_timeout"),
    "body_too_large": say("problem.body_too_large"),
    "unsupported_media_type": say("problem.unsupported_media_type"),
}  # fmt: skip


def saying_of(code: str) -> dict[str, dict[str, str]]:
    """Return the sentence for a person as ``message``, where the code has one."""
    return {"message": SAYINGS[code].model_dump()} if code in SAYINGS else {}


MEDIA_TYPE = "application/problem+json"
MAX_FOUND = 80
MAX_PLACES = 20
METHODS = ("DELETE", "GET", "HEAD", "PATCH", "POST", "PUT")


class HttpProblem(Exception):
    """Refuse a request: status, stable code, the value given, the expectation, the choices."""

    def __init__(self, status: int, code: str, detail: str, **more: Any) -> None:
        super().__init__(f"{code}: {detail}")
        self.status = status
        self.code = code
        self.detail = detail
        self.more = more


def unknown_place(wanted: str, vocabulary: Vocabulary) -> HttpProblem:
    """Return the refusal of a place that nobody knows, with those that there are."""
    exist = ", ".join(entry.id for entry in vocabulary.entries[:MAX_PLACES])
    known = known_places(vocabulary, MAX_PLACES)
    said = message(Code.UNKNOWN_PLACE, name=wanted[:40], near="", known=known)
    detail = f"got {wanted[:40]!r}; known: {exist}"
    return HttpProblem(404, "unknown_place", detail, message=said.model_dump())


def body(status: int, code: str, detail: str, **more: Any) -> dict[str, Any]:
    """Return the JSON of a problem; ``message`` where a person may be the one who reads it."""
    said = saying_of(code)
    title = HTTPStatus(status).phrase
    return {"type": f"urn:pons:problem:{code}", "title": title, "status": status,
            "code": code, "detail": detail, **said, **more}  # fmt: skip


def response(
    status: int, code: str, detail: str, headers: Mapping[str, str] | None = None, **more: Any
) -> JSONResponse:
    """Return a problem as an answer."""
    content = body(status, code, detail, **more)
    return JSONResponse(content, status, headers=headers, media_type=MEDIA_TYPE)


def install(app: FastAPI) -> None:
    """Make every error of the application a problem."""
    app.add_exception_handler(HttpProblem, _problem)
    app.add_exception_handler(RequestValidationError, _invalid)
    app.add_exception_handler(HTTPException, _http)


async def _problem(_: Request, error: Exception) -> JSONResponse:
    if not isinstance(error, HttpProblem):
        raise error
    return response(error.status, error.code, error.detail, **error.more)


async def _invalid(request: Request, error: Exception) -> JSONResponse:
    if not isinstance(error, RequestValidationError):
        raise error
    first = error.errors()[0]
    if first["type"] == "json_invalid":
        at = first["loc"][-1]
        why = say("request.no_json", why=str(first["ctx"]["error"]), at=at)
        return _as_sent(400, "malformed_json", why)
    why, keys = _what_is_wrong(first), _what_exists(request)
    if keys:
        why = say("request.takes", why=why, keys=keys)
    return _as_sent(422, "invalid_request", why)


def _as_sent(
    status: int, code: str, why: Bilingual, headers: Mapping[str, str] | None = None
) -> JSONResponse:
    """Return the refusal of what was sent. A person meets it too, by a name that is too long."""
    told = say("problem.as_sent", detail=why).model_dump()
    return response(status, code, why.en, headers=headers, message=told)


def _what_is_wrong(error: Mapping[str, Any]) -> Bilingual:
    where = ".".join(str(part) for part in error["loc"])
    found = repr(error.get("input"))[:MAX_FOUND]
    if error["type"] in ("extra_forbidden", "missing", "model_attributes_type"):
        return say(f"request.{error['type']}", at=where, found=found)
    expected = Bilingual(en=error["msg"], zh=expected_zh(error))
    return say("request.unfit", at=where, expected=expected, found=found)


def _what_exists(request: Request) -> str:
    """Return the keys that the route's body takes; empty where it takes none."""
    taken = getattr(request.scope.get("route"), "body_field", None)
    model = taken.field_info.annotation if taken is not None else None
    for kind in (model, *get_args(model)):
        if isinstance(kind, type) and issubclass(kind, BaseModel):
            keys = (n if f.is_required() else f"{n}?" for n, f in kind.model_fields.items())
            return ", ".join(keys)
    return ""


_CODES = {
    400: "malformed_json",
    404: "unknown_route",
    405: "method_not_allowed",
    413: "body_too_large",
}


async def _http(request: Request, error: Exception) -> JSONResponse:
    if not isinstance(error, HTTPException):
        raise error
    status, asked = error.status_code, f"{request.method} {request.url.path}"
    code = _CODES.get(status, f"http_{status}")
    headers = dict(error.headers or {})
    detail = f"{asked}: {error.detail}"
    if status == 400:  # the framework's only one: bytes that json can't read, for two reasons
        nested = isinstance(error.__cause__, RecursionError)
        why = say(f"request.{'nested' if nested else 'no_text'}", asked=asked)
        return _as_sent(status, code, why, headers)
    if status == 404:
        told = say("request.no_route", asked=asked)
    elif status == 405:
        headers["Allow"] = _methods(request)
        told = say("request.no_method", asked=asked, methods=headers["Allow"])
    else:
        return response(status, code, detail, headers=headers)
    return response(status, code, told.en, headers=headers, message=told.model_dump())


def _methods(request: Request) -> str:
    """Return all methods of a path: the framework's own answer names only its first route's."""
    routes = request.app.router.routes
    found = (
        method
        for method in METHODS
        if any(r.matches({**request.scope, "method": method})[0] is Match.FULL for r in routes)
    )
    return ", ".join(found)
