"""Fingerprint maps, robots and fences, so that processes can tell that they mean the same."""

from __future__ import annotations

import hashlib

FINGERPRINT_LENGTH = 16
"""Hex digits kept: 64 bits tell honest configurations apart and are no defence against forgery."""


def fingerprint(*parts: bytes) -> str:
    """Return the first 16 hex digits of SHA-256 over the parts, joined by a zero byte."""
    digest = hashlib.sha256(parts[0] if parts else b"")
    for part in parts[1:]:  # not joined: a map's image has up to 80 MB
        digest.update(b"\0")
        digest.update(part)
    return digest.hexdigest()[:FINGERPRINT_LENGTH]


def map_id(yaml_bytes: bytes, image_bytes: bytes) -> str:
    """Name a map by the bytes of its Nav2 ``map.yaml`` and of the image that it points to."""
    return fingerprint(yaml_bytes, image_bytes)
