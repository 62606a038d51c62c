"""Fingerprint a site's map by its bytes, as every process does."""

from wire.site_map import read_map_id

__all__ = ["read_map_id"]
