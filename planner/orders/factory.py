"""Put the standing orders together for one planner."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner.orders.intake import OrderIntake
from planner.orders.keeper import OrderKeeper
from planner.orders.notifier import Notifier
from planner.orders.store import OrderStore
from planner.orders.zone import find_zone
from wire import ConfigError

if TYPE_CHECKING:
    from pathlib import Path

    from planner.mission import Missions
    from planner.navigation import ObstacleReport
    from planner.settings import OrderSettings
    from planner.state_database import StateDatabase

MAX_TOKEN_BYTES = 4096


@dataclass(frozen=True, slots=True)
class StandingOrders:
    """Hold the desk that takes orders and the keeper that runs them."""

    intake: OrderIntake
    keeper: OrderKeeper


def standing_orders_of(
    settings: OrderSettings, home: Path, database: StateDatabase, missions: Missions
) -> StandingOrders:
    """Return a planner's standing orders, known to its missions; nothing runs yet.

    Raises:
        ConfigError: ``timezone_unknown``, ``notify_token``, ``orders.notify_url``.
    """
    notify = settings.notify

    def report() -> ObstacleReport | None:
        return missions.obstacles.report if missions.obstacles is not None else None

    keeper = OrderKeeper(
        OrderStore(database),
        missions.standing,
        find_zone(settings.timezone, os.environ),
        settings.quiet,
        Notifier(notify, _token(notify.token_file, home)) if notify is not None else None,
        report=report,
    )
    intake = OrderIntake(keeper, missions.standing, report)
    missions.commands.desk = intake
    return StandingOrders(intake, keeper)


def _token(path: Path | None, home: Path) -> str:
    if path is None:
        return ""
    try:
        with (home / path).open("rb") as file:
            token = file.read(MAX_TOKEN_BYTES).decode("ascii").strip()
    except (OSError, ValueError):
        raise ConfigError("notify_token", f"token_file {path}: can't be read as ASCII") from None
    if not token or not token.isprintable() or " " in token:
        raise ConfigError("notify_token", f"token_file {path}: expected one word")
    return token
