"""Serve the built page from memory. Read whole at the start: no request reaches the disk, and none
can name a file that the build did not make.

Files under /assets carry a hash in their names and never change, so browsers may keep them for
good; the page itself is asked for anew each time.
"""

from __future__ import annotations

import gzip
import hashlib
import logging
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, Header
from starlette.exceptions import HTTPException
from starlette.responses import HTMLResponse, Response

from planner.api.access import AUTHORITY_PATH

log = logging.getLogger(__name__)

MAX_PAGE_BYTES = 8_000_000
FOREVER = "public, max-age=31536000, immutable"
ANEW = "no-cache"
CERTIFICATE_TYPE = "application/x-x509-ca-cert"
"""A phone that is sent this offers to install it."""

TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".json": "application/json",
    ".woff2": "font/woff2",
}
SQUEEZED = frozenset({".html", ".js", ".css", ".svg", ".json"})

NOT_BUILT = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Pons: the page is not built</title></head><body>
<h1>Pons</h1>
<p>The planner runs, but its page is not built. Run <code>make page</code> and start again.</p>
<p lang="zh">规划器已运行，但网页尚未构建。请运行 <code>make page</code> 后重新启动。</p>
<p>Meanwhile, from a shell / <span lang="zh">也可在终端下达任务</span>:</p>
<pre>pons say "go to the living room"
pons say 去厨房
pons stop</pre>
<p><a href="v1/robot">robot</a> · <a href="v1/goals">goals</a> ·
<a href="v1/places">places</a> · <a href="openapi.json">API</a></p>
</body></html>
"""

Accepts = Annotated[str, Header(alias="accept-encoding")]
Known = Annotated[str, Header(alias="if-none-match")]


@dataclass(frozen=True, slots=True)
class Asset:
    """Hold one file, plain and squeezed."""

    media_type: str
    plain: bytes
    squeezed: bytes | None
    etag: str
    keep: str

    def answer(self, accepts: str, known: str) -> Response:
        """Return the file, or 304 where the browser has it."""
        headers = {"cache-control": self.keep, "etag": self.etag, "vary": "accept-encoding"}
        if self.etag in known:
            return Response(None, 304, headers)
        if self.squeezed is not None and "gzip" in accepts.lower():
            headers["content-encoding"] = "gzip"
            return Response(self.squeezed, 200, headers, self.media_type)
        return Response(self.plain, 200, headers, self.media_type)


def routes(folder: Path, authority: bytes = b"") -> APIRouter:
    """Return the page's routes, and the one of the authority's certificate."""
    router = APIRouter(include_in_schema=False)
    assets = load(folder)
    index = assets.get("index.html")

    @router.get("/", response_model=None)
    async def page(accepts: Accepts = "", known: Known = "") -> Response:
        if index is None:
            return HTMLResponse(NOT_BUILT, headers={"cache-control": ANEW})
        return index.answer(accepts, known)

    @router.get("/assets/{name}", response_model=None)
    async def asset(name: str, accepts: Accepts = "", known: Known = "") -> Response:
        found = assets.get(f"assets/{name}")
        if found is None:
            raise HTTPException(404, "the built page has no such file")
        return found.answer(accepts, known)

    @router.get(AUTHORITY_PATH, response_model=None)
    async def certificate() -> Response:
        if not authority:
            raise HTTPException(404, "this planner gives out no authority's certificate")
        return Response(authority, 200, {"cache-control": ANEW}, CERTIFICATE_TYPE)

    return router


def load(folder: Path) -> dict[str, Asset]:
    """Return the built page's files by their path; none where it is not built."""
    if not (folder / "index.html").is_file():
        log.warning("the page is not built (no %s); `make page` builds it", folder / "index.html")
        return {}
    found: dict[str, Asset] = {}
    total = 0
    for path in sorted(folder.rglob("*")):
        if path.suffix not in TYPES or path.is_symlink() or not path.is_file():
            continue
        data = path.read_bytes()
        if not total + len(data) <= MAX_PAGE_BYTES:
            log.error("%s is not served: the page passes %d bytes with it", path, MAX_PAGE_BYTES)
            continue
        total += len(data)
        name = path.relative_to(folder).as_posix()
        found[name] = _asset(path.suffix, data, FOREVER if name.startswith("assets/") else ANEW)
    return found


def _asset(suffix: str, data: bytes, keep: str) -> Asset:
    squeezed = gzip.compress(data, 9, mtime=0) if suffix in SQUEEZED else None
    etag = f'"{hashlib.sha256(data).hexdigest()[:24]}"'
    return Asset(TYPES[suffix], data, squeezed, etag, keep)
