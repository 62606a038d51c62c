"""Choose the model that a tool is to ask: the owner's own, or one named on the command line.

``NAME``, ``URL`` or ``NAME@URL``. What is not named is the owner's. The owner's key goes to the
owner's host alone; another host's key comes from PONS_MODEL_KEY.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from planner.settings import ModelSettings, Settings, load_settings
from wire import Misconfigured

_SCHEMES = ("http://", "https://")
HOW = "NAME, URL or NAME@URL"


def chosen(word: str, home: Path, environment: Mapping[str, str]) -> tuple[Settings, ModelSettings]:
    """Return the owner's settings with this model in them, and the model.

    Args:
        word: as it stands on the command line; empty for the owner's own model.
        home: where settings.toml lies.
        environment: as ``load_settings`` reads it.

    Raises:
        Misconfigured: ``model_not_set``: nothing says which; and all of ``load_settings``.
    """
    name, url = split(word)
    named = dict(environment)
    if url:
        named["PONS_MODEL_URL"] = url
    if name:
        named["PONS_MODEL"] = name
    try:
        settings = load_settings(home, named)
    except Misconfigured as wrong:
        if wrong.code != "model_incomplete":
            raise
        detail = f"which model, and where? give {HOW}, or set [model] in settings.toml: {wrong}"
        raise Misconfigured("model_not_set", detail) from None
    model = settings.model
    if model is None:
        detail = f"no model is set; give {HOW}, or set [model] in settings.toml"
        raise Misconfigured("model_not_set", detail)
    if url:  # what the owner's model costs says nothing about another
        budget = settings.budget.model_copy(update={"price": None})
        settings = settings.model_copy(update={"budget": budget})
    return settings, model


def split(word: str) -> tuple[str, str]:
    """Return name and URL, each empty where not given."""
    word = word.strip()
    if word.startswith(_SCHEMES):
        return "", word
    for scheme in _SCHEMES:
        name, found, rest = word.partition(f"@{scheme}")
        if found:
            return name, scheme + rest
    return word, ""
