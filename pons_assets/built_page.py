"""Hold the built page in memory, and the headers it is served under, for planner and fleet alike.

Read whole at the start: no request reaches the disk, and none can name a file that the build did
not make. Files under assets/ carry a hash in their names and never change, so browsers may keep
them for good; a page itself is asked for anew each time. Standard library only.
"""

from __future__ import annotations

import gzip
import hashlib
import logging
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

log = logging.getLogger(__name__)

MAX_PAGE_BYTES = 8_000_000
FOREVER = "public, max-age=31536000, immutable"
ANEW = "no-cache"
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
SECURITY_HEADERS = (
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"x-frame-options", b"DENY"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (
        b"permissions-policy",
        b"microphone=(self), camera=(), display-capture=(), geolocation=(), payment=(), usb=()",
    ),
    (
        b"content-security-policy",
        (
            b"default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
            b"connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
        ),
    ),
)


@dataclass(frozen=True, slots=True)
class Asset:
    """Hold one file, plain and squeezed."""

    media_type: str
    plain: bytes
    squeezed: bytes | None
    etag: str
    keep: str

    def answer(self, accepts: str, known: str) -> tuple[int, dict[str, str], bytes]:
        """Return status, headers and body of the file; 304 where the browser has it."""
        headers = {"cache-control": self.keep, "etag": self.etag, "vary": "accept-encoding"}
        if self.etag in known:
            return 304, headers, b""
        headers["content-type"] = self.media_type
        if self.squeezed is not None and "gzip" in accepts.lower():
            headers["content-encoding"] = "gzip"
            return 200, headers, self.squeezed
        return 200, headers, self.plain


def load_page(folder: Path) -> dict[str, Asset]:
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
