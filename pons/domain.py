"""Choose the simulator's domain for one ``pons up``, print it, and keep it to be repeated.

Loaded only where ``--domain`` was given: the simulator's package is a large one for a supervisor.
"""

from __future__ import annotations

import secrets
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from pons import private_file
from sim.domain import RANDOM, Domain, draw_domain, load_domain
from sim.site.load import is_declared
from wire import ConfigError

if TYPE_CHECKING:
    from pons.settings import LaunchSettings
    from wire import RobotDescription

DOMAIN_FILE = "domain.toml"
"""In ``$PONS_HOME``: what the robot that was started last with ``--domain`` is in."""
_SEEDS = 1_000_000


def choose_domain(settings: LaunchSettings) -> Domain:
    """Return what ``--domain`` and ``--seed`` ask for; without a seed a draw gets a new one.

    Raises:
        ConfigError: what :func:`sim.domain.load_domain` and ``draw_domain`` refuse.
    """
    if settings.domain == RANDOM:
        seed = secrets.randbelow(_SEEDS) if settings.seed is None else settings.seed
        return draw_domain(seed, declared=is_declared(settings.world or settings.site))
    if settings.domain is None:
        return Domain()
    domain = load_domain(Path(settings.domain))
    return domain if settings.seed is None else replace(domain, seed=settings.seed)


def keep_domain(settings: LaunchSettings, robot: RobotDescription) -> tuple[LaunchSettings, str]:
    """Write the chosen domain into the home; return settings that name the file, and the words.

    Raises:
        ConfigError: ``domain_on_metal``, what is refused, or the home can't be written.
    """
    if not robot.drive.virtual:
        text = f"{settings.robot} drives {robot.drive.kind}; a domain is for the simulator alone"
        raise ConfigError("domain_on_metal", text)
    domain = choose_domain(settings)
    path = settings.home / DOMAIN_FILE
    private_file.write(path, domain.as_toml().encode())
    kept = replace(settings, domain=str(path), seed=domain.seed)
    words = domain.as_toml().strip().replace("\n", ", ")
    return kept, f"domain: {words}; again with: pons up --domain {path}"
