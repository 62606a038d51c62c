"""Serve the built page (``pons_assets.built_page``), and the authority's certificate."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from fastapi import APIRouter, Header
from starlette.exceptions import HTTPException
from starlette.responses import HTMLResponse, Response

from planner.api.access import AUTHORITY_PATH
from pons_assets.built_page import ANEW, load_page

if TYPE_CHECKING:
    from pathlib import Path

    from pons_assets.built_page import Asset

CERTIFICATE_TYPE = "application/x-x509-ca-cert"
"""A phone that is sent this offers to install it."""

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


def routes(folder: Path, authority: bytes = b"") -> APIRouter:
    """Return the page's routes, and the one of the authority's certificate."""
    router = APIRouter(include_in_schema=False)
    assets = load_page(folder)
    index = assets.get("index.html")

    @router.get("/", response_model=None)
    async def page(accepts: Accepts = "", known: Known = "") -> Response:
        if index is None:
            return HTMLResponse(NOT_BUILT, headers={"cache-control": ANEW})
        return _answer(index, accepts, known)

    @router.get("/assets/{name}", response_model=None)
    async def asset(name: str, accepts: Accepts = "", known: Known = "") -> Response:
        found = assets.get(f"assets/{name}")
        if found is None:
            raise HTTPException(404, "the built page has no such file")
        return _answer(found, accepts, known)

    @router.get(AUTHORITY_PATH, response_model=None)
    async def certificate() -> Response:
        if not authority:
            raise HTTPException(404, "this planner gives out no authority's certificate")
        return Response(authority, 200, {"cache-control": ANEW}, CERTIFICATE_TYPE)

    return router


def _answer(asset: Asset, accepts: str, known: str) -> Response:
    status, headers, body = asset.answer(accepts, known)
    return Response(body, status, headers)
