"""Be the process of a smart home: ``python -m pons.mqtt``, as ``pons up`` starts it."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from pons.mqtt import run
from pons.settings import LaunchSettings


def main(arguments: list[str]) -> int:
    """Serve until SIGTERM. What is set wrong ends this process, never the robot."""
    words = argparse.ArgumentParser(prog="pons.mqtt")
    for name in ("home", "robot", "site"):
        words.add_argument(f"--{name}", type=Path, required=True)
    words.add_argument("--host", required=True)
    words.add_argument("--port", type=int, required=True)
    words.add_argument("--tls", action="store_true")
    said = words.parse_args(arguments)
    settings = LaunchSettings(said.home, said.robot, said.site, said.host, said.port, tls=said.tls)
    return 1 if run(settings) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
