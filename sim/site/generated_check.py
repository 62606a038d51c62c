"""Compare a site's generated files with its declaration, and write them anew."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sim.site.files import site_files
from sim.site.load import is_declared, load_home
from wire import ConfigError

if TYPE_CHECKING:
    from pathlib import Path


def stale(site_dir: Path) -> list[str]:
    """Return the names of generated files that are missing or differ from the declaration."""
    return list(_differing(site_dir))


def write(site_dir: Path) -> list[str]:
    """Write the stale files and return their names."""
    differing = _differing(site_dir)
    for name, data in differing.items():
        (site_dir / name).write_bytes(data)
    return list(differing)


def check_fresh(site_dir: Path) -> None:
    """Refuse a home whose map, places or fence differ from its declaration.

    Raises:
        ConfigError: ``site_stale``, or what ``load_home`` raises.
    """
    names = stale(site_dir)
    if names:
        raise ConfigError(
            "site_stale",
            f"{site_dir}: {', '.join(names)} do not follow from home.yaml; "
            "run `python -m sim.site` to write them anew",
        )


def _differing(site_dir: Path) -> dict[str, bytes]:
    if not is_declared(site_dir):  # its map is the declaration
        return {}
    return {
        name: data
        for name, data in site_files(load_home(site_dir)).items()
        if not (site_dir / name).is_file() or (site_dir / name).read_bytes() != data
    }
