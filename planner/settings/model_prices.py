"""Know what models of known servers cost, where the owner has set no price of their own.

The file beside this one is written from genai-prices at build time (``scripts.model_prices``); a
planner asks nobody for prices. A model on an unknown server, or on this machine, has none.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from urllib.parse import urlsplit

from planner.settings.budget import Price

FILE = Path(__file__).with_suffix(".json")


def find_published_price(url: str, name: str) -> Price | None:
    """Return what the server of a URL asks for a model, in USD; None where that is not known."""
    try:
        host = urlsplit(url).hostname or ""
    except ValueError:
        return None
    prices = _read_prices().get(host, {})
    name = name.strip().lower()
    found = prices.get(name)
    if found is None:
        begun = (each for each in prices if each.endswith("*") and name.startswith(each[:-1]))
        found = prices.get(max(begun, key=len, default=""))
    if found is None:
        return None
    return Price(prompt_per_million=found[0], reply_per_million=found[1])


@cache
def _read_prices() -> dict[str, dict[str, list[float]]]:
    hosts: dict[str, dict[str, list[float]]] = json.loads(FILE.read_text("utf-8"))["hosts"]
    return hosts
