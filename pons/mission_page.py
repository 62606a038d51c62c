"""Write one mission as a page to share: one HTML file that asks no network and runs no one's words.

All it knows stands in it as JSON; what people and models wrote is shown as text, never as markup.
"""

from __future__ import annotations

import html
import json
import sys
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from pons.mission_track import read_track
from pons.terminal import pick

if TYPE_CHECKING:
    from pathlib import Path

    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_UNWRITABLE = 0, 2
MARGIN_S = 5.0
"""So much of the recording before and after a mission is shown with it."""


def write_page(settings: LaunchSettings, told: dict[str, Any], path: Path) -> int:
    """Write the page of a goal, as /v1/history/ID tells it; 0 done, 2 the file can't be written."""
    changes = told["story"]["changes"]
    track: dict[str, Any] = {"samples": [], "events": [], "gaps": [], "way_m": 0.0}
    if changes:
        begin_s, end_s = changes[0]["at_unix_s"], changes[-1]["at_unix_s"]
        recordings = settings.home / "recordings"
        track = read_track(recordings, begin_s - MARGIN_S, end_s + MARGIN_S)
    try:
        path.write_text(page_of(told, track), "utf-8")
    except OSError as error:
        print(f"file_unwritable: {path}: {error.strerror}", file=sys.stderr)
        return EXIT_UNWRITABLE
    print(pick(f"wrote {path}", f"已写入 {path}"))
    return EXIT_DONE


def page_of(told: dict[str, Any], track: dict[str, Any]) -> str:
    """Return the page's text."""
    content = json.dumps({**told, "track": track}, ensure_ascii=False)
    inert = content.replace("<", "\\u003c")  # no sentence can end the script that holds it
    page = (files("pons") / "mission_page.html").read_text("utf-8")
    return page.replace("__TITLE__", html.escape(told["goal"]["text"][:80])).replace(
        "__CONTENT__", inert
    )
