"""Read what a sentence changes about the newest order, as one closed value. Pure."""

from __future__ import annotations

from functools import lru_cache

from planner.language.changes.rows import MAX_READ, lay_out, read_rows
from planner.language.motion_guard.mentioned_names import find_places
from planner.plan import Change, Vocabulary


@lru_cache(maxsize=64)
def read_changes(text: str, names: Vocabulary) -> tuple[Change, ...]:
    """Return what a sentence may change, the likeliest first; none where it changes nothing.

    Args:
        text: as it was said.
        names: of the site's places.
    """
    written = lay_out(text)
    if len(written) > MAX_READ:  # before names are sought: a text may be of any length
        return ()
    found = find_places(written, names)
    return read_rows(text, tuple((each.id, each.start, each.end) for each in found))
