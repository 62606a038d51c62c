"""Join the robot to a smart home by MQTT: ``pons mqtt``, or ``[mqtt]`` in settings.toml.

Needs the extra ``mqtt`` (aiomqtt); nothing else of ours imports this package's gateway.
"""

from __future__ import annotations

import os
import signal
import sys
import tomllib
from threading import Timer
from typing import TYPE_CHECKING

from pons.extras import tell_missing
from pons.stop import leave
from pons.terminal import pick
from processes.log_lines import begin_log

if TYPE_CHECKING:
    from pathlib import Path

    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_UNUSABLE = 0, 2
FAREWELL_S = 2.0
"""A broker that answers nothing could hold the end up for as long as the client waits for it."""
SETTINGS_FILE = "settings.toml"
NO_TABLE = (
    "mqtt_unset: {} has no [mqtt] table; docs/smart-home.md shows one",
    "mqtt_unset：{} 中没有 [mqtt] 表；见 docs/smart-home.md",
)


def is_wanted(home: Path) -> bool:
    """Return whether a home's settings name a broker; a file that can't be read names none."""
    try:
        return "mqtt" in tomllib.loads((home / SETTINGS_FILE).read_text("utf-8-sig"))
    except (OSError, ValueError):
        return False  # the planner, which starts with it, tells why


def run(settings: LaunchSettings) -> int:
    """Serve until SIGTERM or Ctrl-C; 2 where something must be mended first."""
    import asyncio  # late, as all below: `pons up` asks for is_wanted alone, and stays small

    from planner.settings import load_settings
    from wire import ConfigError, load_robot

    begin_log()
    try:
        chosen = load_settings(settings.home, os.environ).mqtt
        if chosen is None:
            print(pick(*NO_TABLE).format(settings.home / SETTINGS_FILE), file=sys.stderr)
            return EXIT_UNUSABLE
        from pons.mqtt.gateway import HomeGateway, read_secret

        robot = load_robot(settings.robot)
        read_secret(settings, chosen.password_file)
        if (token := read_secret(settings, chosen.token_file)) is not None:
            os.environ["PONS_OPERATOR_TOKEN"] = token  # what pons.http shows to the planner
        has_camera = robot.camera.kind != "none"

        async def serve() -> None:
            gateway = HomeGateway(settings, chosen, robot.id, has_camera=has_camera)
            task = asyncio.current_task()

            def end() -> None:
                """Say that the robot goes; nobody who does not hear it is waited for long."""
                bound = Timer(FAREWELL_S, leave, (EXIT_DONE,))
                bound.daemon = True
                bound.start()
                if task is not None:
                    task.cancel()

            for number in (signal.SIGTERM, signal.SIGINT):
                asyncio.get_running_loop().add_signal_handler(number, end)
            try:
                await gateway.run()
            except asyncio.CancelledError:
                leave(EXIT_DONE)  # a request to a planner that hangs is not waited for

        asyncio.run(serve())
    except ModuleNotFoundError as missing:
        if missing.name not in ("aiomqtt", "paho", "paho.mqtt"):
            raise
        return tell_missing("mqtt")
    except ConfigError as wrong:
        print(wrong, file=sys.stderr)
        return EXIT_UNUSABLE
    return EXIT_DONE
