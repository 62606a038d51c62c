"""Write planner/settings/model_prices.json: what known servers ask for a million tokens.

``python -m scripts.model_prices [--check]``. Reads the data of the installed genai-prices, which no
robot needs; asks no network. Of several prices of a model, the last that began counts, by day the
dearest, and what a prompt of ordinary length costs.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path

from genai_prices import types
from genai_prices.data import providers

from scripts.generated_text import write_or_check

ROOT = Path(__file__).resolve().parents[1]
FILE = ROOT / "planner" / "settings" / "model_prices.json"
HOSTS = {
    "anthropic": ("api.anthropic.com",),
    "deepseek": ("api.deepseek.com",),
    "google": ("generativelanguage.googleapis.com",),
    "groq": ("api.groq.com",),
    "mistral": ("api.mistral.ai",),
    "moonshotai": ("api.moonshot.ai", "api.moonshot.cn"),
    "openai": ("api.openai.com",),
    "openrouter": ("openrouter.ai",),
    "together": ("api.together.xyz",),
    "x-ai": ("api.x.ai",),
    "zai": ("api.z.ai",),
    "zhipuai": ("open.bigmodel.cn",),
}
"""Servers that speak the API that Pons asks, by the name that genai-prices has for them."""


def make_text() -> str:
    """Return the file: by host and name [prompt, reply] in USD; ``*`` ends a name's beginning."""
    found: dict[str, dict[str, list[float]]] = {}
    for provider in providers:
        prices: dict[str, list[float]] = {}
        for model in provider.models if provider.id in HOSTS else ():
            for name in _names(model):
                if (price := _price(model)) is not None:
                    prices.setdefault(name, price)  # the first that matches counts there, too
        for host in HOSTS.get(provider.id, ()):
            found[host] = prices
    hosts = ",\n".join(
        f"{json.dumps(host)}: {{\n{_rows(found[host])}\n}}" for host in sorted(found)
    )
    made = json.dumps(
        f"genai-prices {metadata.version('genai-prices')} (MIT), by scripts.model_prices"
    )
    return f'{{\n"made": {made},\n"hosts": {{\n{hosts}\n}}}}\n'


def _rows(prices: dict[str, list[float]]) -> str:
    return ",\n".join(f"{json.dumps(name)}: {json.dumps(prices[name])}" for name in sorted(prices))


def _names(model: types.ModelInfo) -> Iterator[str]:
    if model.is_match(model.id):
        yield model.id.lower()
    rows = [model.match]
    while rows:
        match = rows.pop(0)
        if isinstance(match, types.ClauseOr):
            rows += match.or_
        elif isinstance(match, types.ClauseEquals):
            yield match.equals.lower()
        elif isinstance(match, types.ClauseStartsWith):
            yield f"{match.starts_with.lower()}*"


def _price(model: types.ModelInfo) -> list[float] | None:
    if isinstance(model.prices, types.ModelPrice):
        rows = [model.prices]
    else:
        by_hour = [p for p in model.prices if isinstance(p.constraint, types.TimeOfDateConstraint)]
        rest = [p for p in model.prices if p not in by_hour]
        rows = [p.prices for p in (*rest[-1:], *by_hour)]
    pairs = [(_base(row.input_mtok), _base(row.output_mtok)) for row in rows]
    known = [(sent, back) for sent, back in pairs if sent is not None and back is not None]
    return [max(pair[at] for pair in known) for at in (0, 1)] if known else None


def _base(price: object) -> float | None:
    whole = price.base if isinstance(price, types.TieredPrices) else price
    return None if whole is None else float(str(whole))


def main() -> int:
    """Write the file, or say that it is stale."""
    return write_or_check({FILE: make_text()}, sys.argv[1:], "make docs")


if __name__ == "__main__":
    sys.exit(main())
