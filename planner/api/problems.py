"""Turn everything that can go wrong with a request into problem+json with a stable code (RFC 9457).

4xx is for requests that are malformed or not allowed. A sentence that is understood but impossible
is no error: it is a goal that ends refused.
"""

from __future__ import annotations

from http import HTTPStatus
from typing import TYPE_CHECKING, Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.responses import JSONResponse

if TYPE_CHECKING:
    from collections.abc import Mapping

MEDIA_TYPE = "application/problem+json"


class Problem(Exception):
    """Refuse a request: status, stable code, and what came, was expected and exists."""

    def __init__(self, status: int, code: str, detail: str, **more: Any) -> None:
        super().__init__(f"{code}: {detail}")
        self.status = status
        self.code = code
        self.detail = detail
        self.more = more


def body(status: int, code: str, detail: str, **more: Any) -> dict[str, Any]:
    """Return the JSON of a problem."""
    title = HTTPStatus(status).phrase
    return {"type": f"urn:pons:problem:{code}", "title": title, "status": status,
            "code": code, "detail": detail, **more}  # fmt: skip


def response(
    status: int, code: str, detail: str, headers: Mapping[str, str] | None = None, **more: Any
) -> JSONResponse:
    """Return a problem as an answer."""
    content = body(status, code, detail, **more)
    return JSONResponse(content, status, headers=headers, media_type=MEDIA_TYPE)


def install(app: FastAPI) -> None:
    """Make every error of the application a problem."""
    app.add_exception_handler(Problem, _problem)
    app.add_exception_handler(RequestValidationError, _invalid)
    app.add_exception_handler(HTTPException, _http)


async def _problem(_: Request, error: Exception) -> JSONResponse:
    if not isinstance(error, Problem):
        raise error
    return response(error.status, error.code, error.detail, **error.more)


async def _invalid(_: Request, error: Exception) -> JSONResponse:
    if not isinstance(error, RequestValidationError):
        raise error
    first = error.errors()[0]
    where = ".".join(str(part) for part in first["loc"])
    if first["type"] == "json_invalid":
        return response(400, "malformed_json", f"{where}: {first['msg']}")
    found = repr(first.get("input"))[:80]
    return response(422, "invalid_request", f"{where}: {first['msg']}; got {found}")


_CODES = {
    400: "malformed_json",
    404: "unknown_route",
    405: "method_not_allowed",
    413: "body_too_large",
}


async def _http(request: Request, error: Exception) -> JSONResponse:
    if not isinstance(error, HTTPException):
        raise error
    code = _CODES.get(error.status_code, f"http_{error.status_code}")
    detail = f"{request.method} {request.url.path}: {error.detail}"
    if error.status_code == 404:
        detail += "; /openapi.json lists what exists"
    return response(error.status_code, code, detail, headers=error.headers)
