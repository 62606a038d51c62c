"""Read what a command says to a person: ``words.toml`` beside its code, English and Chinese."""

from __future__ import annotations

import tomllib
from importlib.resources import files

Pair = tuple[str, str]


def load_words(package: str) -> dict[str, dict[str, Pair]]:
    """Return a package's words by table and code: English, Chinese."""
    text = (files(package) / "words.toml").read_text("utf-8")
    return {
        table: {code: (english, chinese) for code, (english, chinese) in rows.items()}
        for table, rows in tomllib.loads(text).items()
    }
