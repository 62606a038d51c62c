"""Read home.yaml. The only file of the simulator that knows YAML.

Refuses what YAML would quietly accept: a key written twice (the first would be lost). Only ``true``
and ``false`` are truth values, as in YAML 1.2: elsewhere the key ``on`` would be read as true.
"""

from __future__ import annotations

import os
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import yaml
from pydantic import ValidationError

from sim.site.check import check
from sim.site.mapped import MAP_FILE, mapped_home
from sim.site.spec import Home
from wire import ConfigError
from wire.plain_file import read_plain_file
from wire.robot import explain

if TYPE_CHECKING:
    from pathlib import Path

SPEC_FILE = "home.yaml"
MOST_BYTES = 4_000_000


UNREADABLE = (yaml.YAMLError, ValueError, LookupError, AttributeError, TypeError, RecursionError)
"""What PyYAML ends in: beside its own errors whatever its makers of values raise."""
_BOOL = "tag:yaml.org,2002:bool"


class _OnceLoader(yaml.SafeLoader):
    """Build plain values; refuse a repeated key and an alias."""

    def compose_node(self, parent: yaml.Node | None, index: int) -> yaml.Node | None:
        """Refuse aliases: ten lines of them name more values than any memory holds."""
        if self.check_event(yaml.AliasEvent):
            event = self.peek_event()  # type: ignore[no-untyped-call]  # PyYAML says no types
            line = event.start_mark.line + 1
            raise yaml.YAMLError(f"line {line}: an alias (*); write the value out")
        return super().compose_node(parent, index)


def _mapping_once(loader: _OnceLoader, node: yaml.MappingNode) -> dict[Any, Any]:
    seen: set[str] = set()
    for key_node, _ in node.value:
        key = loader.construct_object(key_node)
        line = key_node.start_mark.line + 1
        if not isinstance(key, str):
            raise yaml.YAMLError(f"line {line}: key {key!r} is not text")
        if key in seen:
            raise yaml.YAMLError(f"line {line}: key {key!r} stands twice")
        seen.add(key)
    return loader.construct_mapping(node, deep=True)


_OnceLoader.yaml_implicit_resolvers = {
    first: [pair for pair in pairs if pair[0] != _BOOL or first in "tTfF"]
    for first, pairs in yaml.SafeLoader.yaml_implicit_resolvers.items()
}
_OnceLoader.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, _mapping_once)


@lru_cache(maxsize=8)
def parse_home(text: str, where: str) -> Home:
    """Turn the text of a home.yaml into a checked home; ``where`` names it in errors.

    The same text gives the same home: where many robots drive, each asks for it (0.1 s).

    Raises:
        ConfigError: ``home_syntax``, ``home_invalid`` or one of check.py's codes.
    """
    try:
        raw = yaml.load(text, Loader=_OnceLoader)
    except UNREADABLE as error:
        raise ConfigError("home_syntax", f"{where}: {' '.join(str(error).split())}") from None
    try:
        home = Home.model_validate(raw)
    except ValidationError as error:
        raise ConfigError("home_invalid", f"{where}: {explain(error)}") from None
    check(home, where)
    return home


def is_declared(site_dir: Path) -> bool:
    """Return whether a site has a home.yaml, from which its other files follow."""
    return os.path.lexists(site_dir / SPEC_FILE)


def load_home(site_dir: Path) -> Home:
    """Read ``<site_dir>/home.yaml`` and check it; without one, make the home of the site's map.

    Raises:
        ConfigError: ``home_missing``, ``home_site_mismatch`` (the folder has another name than
            the spec says) or what ``parse_home`` and ``mapped_home`` raise.
    """
    path = site_dir / SPEC_FILE
    if not is_declared(site_dir) and (site_dir / MAP_FILE).exists():
        return mapped_home(site_dir)
    try:
        text = read_plain_file(path, MOST_BYTES).decode("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigError("home_missing", f"{path}: {error}") from None
    home = parse_home(text, str(path))
    if home.site != site_dir.resolve().name:
        raise ConfigError(
            "home_site_mismatch",
            f"{path}: site is {home.site!r} but its folder is {site_dir.resolve().name!r}",
        )
    return home
