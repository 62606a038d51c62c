"""Try the fleet: ``python -m tools.fleet_trial storm|pace [OPTION …]``.

``storm`` gives orders while service, robots, network and database are killed, then judges; exit
status 1 where anything was lost, done twice or left open. ``--folder`` keeps a trial that Ctrl-C
breaks off, and goes on with it. ``pace`` measures in fair weather.
"""

from __future__ import annotations

import argparse
import asyncio
import signal
import sys
import tempfile
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path

from tools.fleet_trial.house import House
from tools.fleet_trial.pace import measure, tell
from tools.fleet_trial.storm import CALM_S, Storm, Weather

INTERRUPTED = 130


def main(words: list[str] | None = None) -> int:
    """Run one trial."""
    given = _options(words)
    folder = given.folder or Path(tempfile.mkdtemp(prefix="trial-"))
    folder.mkdir(parents=True, exist_ok=True)
    try:
        return asyncio.run(_try(given, folder.absolute()))
    except (KeyboardInterrupt, asyncio.CancelledError):
        kept = f"; --folder {folder} goes on" if given.folder else ""
        print(f"\nbroken off; all processes are ended{kept}")
        return INTERRUPTED


async def _try(given: argparse.Namespace, folder: Path) -> int:
    if (whole := asyncio.current_task()) is not None:
        for number in (signal.SIGINT, signal.SIGTERM):
            asyncio.get_running_loop().add_signal_handler(number, whole.cancel)
    house, is_done = House(folder, given.robots, given.database), False
    try:
        await house.start()
        print(f"{given.robots} robots, {given.database}, in {folder}", flush=True)
        status = await (_storm(house, given) if given.act == "storm" else _pace(house, given))
        is_done = status == 0
    finally:
        await asyncio.shield(house.close(keep=given.folder is not None or not is_done))
    return status


async def _storm(house: House, given: argparse.Namespace) -> int:
    weather = Weather(
        given.missions, given.span_s,
        {"service": given.service_kills, "robot": given.robot_kills, "cut": given.cuts,
         "postgres": given.postgres_kills if given.database == "postgres" else 0,
         "answer": given.lost_answers},
        tuple(given.cuts_s), given.seed,
    )  # fmt: skip
    storm = Storm(house, weather)
    after_calm, last, took_s = await storm.run()
    print(f"accepted {len(storm.accepted)}; done: {storm.done}")
    print(tell("accept in the storm (no goal)", storm.accept_s or [0.0, 0.0], 0.05))
    for when, verdict in ((f"{CALM_S:.0f} s of calm", after_calm), (f"{took_s:.0f} s", last)):
        counts = {name: len(numbers) for name, numbers in asdict(verdict).items()}
        few = {name: numbers[:8] for name, numbers in asdict(verdict).items() if numbers}
        print(f"after {when}: {counts} {few or ''}")
    return 0 if after_calm.is_clean and last.is_clean else 1


async def _pace(house: House, given: argparse.Namespace) -> int:
    for row in await measure(house, given.missions, given.stops):
        print(row)
    return 0


def _options(words: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tools.fleet_trial", description=__doc__)
    acts = parser.add_subparsers(dest="act", required=True)
    both = argparse.ArgumentParser(add_help=False)
    both.add_argument("--robots", type=int, default=30)
    both.add_argument("--missions", type=int, default=300)
    both.add_argument("--database", choices=("sqlite", "postgres"), default="sqlite")
    both.add_argument("--folder", type=Path, help="keep it here, or go on with what is here")
    storm = acts.add_parser("storm", parents=[both], help="give orders under faults")
    storm.add_argument("--span-s", type=float, default=120.0, help="orders and faults come within")
    storm.add_argument("--service-kills", type=int, default=8)
    storm.add_argument("--robot-kills", type=int, default=8)
    storm.add_argument("--cuts", type=int, default=3)
    storm.add_argument("--cuts-s", type=float, nargs="+", default=[1.0, 10.0, 30.0])
    storm.add_argument("--postgres-kills", type=int, default=2)
    storm.add_argument("--lost-answers", type=int, default=10)
    storm.add_argument("--seed", type=int, default=1)
    pace = acts.add_parser("pace", parents=[both], help="measure without faults")
    pace.add_argument("--stops", type=int, default=100)
    return parser.parse_args(words)


if __name__ == "__main__":
    with suppress(KeyboardInterrupt):
        sys.exit(main())
