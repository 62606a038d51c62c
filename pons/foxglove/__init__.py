"""Show the running robot to Foxglove or Lichtblick: ``pons foxglove``; its window's layout beside.

Needs the extra ``foxglove`` (foxglove-sdk); nothing else of ours imports it.
"""

from __future__ import annotations

import asyncio
import json
import signal
import sys
from typing import TYPE_CHECKING

from pons.extras import tell_missing
from pons.terminal import pick
from processes.log_lines import begin_log

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_UNUSABLE = 0, 2
PORT = 8765
TAKEN = (
    "foxglove_port: {} can't be served at: {}; choose another one with --port",
    "foxglove_port：无法使用端口 {}：{}；请用 --port 另选一个",
)


def run(settings: LaunchSettings, act: str | None, port: int) -> int:
    """Serve until Ctrl-C, or print the layout; 2 where something must be mended first."""
    if act == "layout":
        from pons.foxglove.layout import layout

        print(json.dumps(layout(), indent=1))
        return EXIT_DONE
    from wire import load_robot

    begin_log()
    try:
        from pons.foxglove.live import LiveView
    except ModuleNotFoundError as missing:
        if missing.name != "foxglove":
            raise
        return tell_missing("foxglove")
    robot = load_robot(settings.robot)

    async def serve() -> None:
        task = asyncio.current_task()
        for number in (signal.SIGTERM, signal.SIGINT):
            if task is not None:
                asyncio.get_running_loop().add_signal_handler(number, task.cancel)
        await LiveView(settings, robot).serve(port)

    try:
        asyncio.run(serve())
    except (OSError, RuntimeError) as trouble:
        print(pick(*TAKEN).format(port, trouble), file=sys.stderr)
        return EXIT_UNUSABLE
    except asyncio.CancelledError:
        pass
    return EXIT_DONE
