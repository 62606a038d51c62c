"""Talk to the planner's API with the standard library alone: small, quick to import, bounded."""

from __future__ import annotations

import http.client
import json
import os
import ssl
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pons.terminal import pick

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

AUTHORITY = Path("tls") / "ca.crt"
MAX_REPLY_BYTES = 4_000_000
"""Lists end below a quarter of it (planner/api/listing.py)."""
DEFAULT_TIMEOUT_S = 5.0


class PlannerDown(Exception):
    """The planner did not answer; nothing is known of whether it acted."""


def tell_unreached(trouble: Exception) -> str:
    """Return what a person is told where nothing answers: what came, and what to look at."""
    is_up = pick("Is `pons up` running?", "没有应答：`pons up` 是否在运行？")
    return f"planner_down: {trouble}. {is_up}"


class PlannerProblem(Exception):
    """The planner answered with a problem."""

    def __init__(
        self, status: int, code: str, detail: str, told: dict[str, str] | None = None
    ) -> None:
        super().__init__(f"{code}: {detail}")
        self.status = status
        self.code = code
        self.detail = detail
        self.told = told or {}
        """A sentence for a person by language, where the planner has one."""


def call(
    settings: LaunchSettings,
    method: str,
    path: str,
    body: dict[str, Any] | None = None,
    timeout_s: float = DEFAULT_TIMEOUT_S,
    headers: dict[str, str] | None = None,
    content: bytes | None = None,
) -> Any:
    """Return the JSON of the answer. ``content`` goes as it is, its type among the headers.

    Raises:
        PlannerDown: no connection, no answer in time, or no JSON.
        PlannerProblem: a problem+json answer, with its stable code.
    """
    return _judge(*_exchange(settings, method, path, body, timeout_s, headers, content))


def fetch(settings: LaunchSettings, path: str, timeout_s: float = DEFAULT_TIMEOUT_S) -> bytes:
    """Return an answer that is not JSON. Raises as ``call``."""
    status, raw = _exchange(settings, "GET", path, timeout_s=timeout_s)
    return raw if status == http.HTTPStatus.OK else bytes(_judge(status, raw))


def fetch_text(settings: LaunchSettings, path: str, timeout_s: float = DEFAULT_TIMEOUT_S) -> str:
    """Return an answer that is a text and no JSON. Raises as ``call``."""
    return fetch(settings, path, timeout_s).decode()


def _exchange(
    settings: LaunchSettings,
    method: str,
    path: str,
    body: dict[str, Any] | None = None,
    timeout_s: float = DEFAULT_TIMEOUT_S,
    headers: dict[str, str] | None = None,
    content: bytes | None = None,
) -> tuple[int, bytes]:
    connection = _connection(settings, timeout_s)
    try:
        sent = {"Content-Type": "application/json", **(headers or {})} if method != "GET" else {}
        ours = settings.owner_uid in (None, os.geteuid())
        if ours and (token := os.environ.get("PONS_OPERATOR_TOKEN")):
            sent["Authorization"] = f"Bearer {token}"
        text = json.dumps(body or {}).encode() if content is None else content
        payload = text if method != "GET" else None
        connection.request(method, path, body=payload, headers=sent)
        answer = connection.getresponse()
        status, raw = answer.status, answer.read(MAX_REPLY_BYTES)
    except ssl.SSLCertVerificationError as error:
        known = settings.authority or settings.home / AUTHORITY
        why = f"the certificate is not trusted ({error.verify_message}); PONS_CA names the file "
        why += f"of the authority to trust, else {known}"
        raise PlannerDown(f"{settings.url}: {why}") from None
    except (OSError, http.client.HTTPException) as error:
        raise PlannerDown(f"{settings.url}{path}: {str(error) or type(error).__name__}") from None
    finally:
        connection.close()
    return status, raw


def _connection(settings: LaunchSettings, timeout_s: float) -> http.client.HTTPConnection:
    """Return the connection, not yet open; over TLS, judged by this robot's own authority.

    Raises:
        PlannerDown: the file named as the authority holds no certificate.
    """
    host, port = settings.host_to_dial, settings.port
    if not settings.tls:
        return http.client.HTTPConnection(host, port, timeout=timeout_s)
    file = settings.authority or settings.home / AUTHORITY
    there = settings.authority is not None or os.access(file, os.R_OK)  # else the system's own
    try:
        trusted = ssl.create_default_context(cafile=str(file) if there else None)
    except OSError as error:
        why = f"no authority's certificate in {file}: {error.strerror or error}"
        raise PlannerDown(f"{settings.url}: {why}") from None
    return http.client.HTTPSConnection(host, port, timeout=timeout_s, context=trusted)


def _judge(status: int, raw: bytes) -> Any:
    try:
        content = json.loads(raw) if raw else {}
    except ValueError:
        raise PlannerDown(f"an answer that is no JSON, status {status}") from None
    if status >= 400:
        problem = content if isinstance(content, dict) else {}
        code = str(problem.get("code", f"http_{status}"))
        told = problem.get("message")
        detail = str(problem.get("detail", problem.get("title", "")))
        raise PlannerProblem(status, code, detail, told if isinstance(told, dict) else None)
    return content
