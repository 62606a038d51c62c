"""Choose the model that a tool is to ask: the owner's own, or one named on the command line.

``NAME``, ``URL`` or ``NAME@URL``. What is not named is the owner's. Where the URL is of another
host than the owner's settings lead to, what was set for that host stays behind: the key,
PONS_MODEL_KEY too, `extra_body` and the leaves to send sentences and pictures away. Another host's
key is given together with PONS_MODEL_URL, or where no host is set at all.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping
from pathlib import Path

from planner.settings import ModelSettings, Settings, load_settings, place_of, same_place
from wire import Misconfigured

log = logging.getLogger(__name__)

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
    elsewhere = _elsewhere(url, home, environment)
    named = dict(environment)
    if url:
        named["PONS_MODEL_URL"] = url
    if name:
        named["PONS_MODEL"] = name
    if elsewhere:
        named |= {"PONS_MODEL_ALLOW_OFFHOST": "0", "PONS_MODEL_ALLOW_PICTURES_OFFHOST": "0"}
        if named.pop("PONS_MODEL_KEY", ""):
            log.warning(
                "PONS_MODEL_KEY is not used: it belongs to another host than %s; "
                "if it is this one's, set PONS_MODEL_URL to it as well",
                url,
            )
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
    if elsewhere:
        model = model.model_copy(update={"extra_body": {}})
        settings = settings.model_copy(update={"model": model})
    return settings, model


def _elsewhere(url: str, home: Path, environment: Mapping[str, str]) -> bool:
    """Tell whether a URL is of another host than the one the owner set everything for."""
    owners = place_of(home, environment)
    return bool(url and owners) and not same_place(owners, url)


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
