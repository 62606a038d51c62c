"""Write one mission as a page to share: one HTML file that asks no network and runs no one's words.

All it knows stands in it as JSON; what people and models wrote is shown as text, never as markup.
"""

from __future__ import annotations

import html
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from planner.plan import Language

TEMPLATE = Path(__file__).with_suffix(".html")
MOST_OF_TITLE = 80


def page_of(told: dict[str, Any], track: dict[str, Any], language: Language) -> str:
    """Return the page of a goal as /v1/history/ID tells it, its labels in a language."""
    content = json.dumps({**told, "track": track, "labels": language.value}, ensure_ascii=False)
    inert = content.replace("<", "\\u003c")  # no sentence can end the script that holds it
    title = html.escape(told["goal"]["text"][:MOST_OF_TITLE])
    page = TEMPLATE.read_text("utf-8").replace("__TITLE__", title)
    return page.replace("__CONTENT__", inert)
