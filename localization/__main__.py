"""Start localization: ``python -m localization --site sites/home [--home DIR]``.

``[localization] kind`` of robot.toml says which: ``scans`` matches the lidar's scans with the
site's map (localization.localizer); ``stand_in`` passes the simulator's truth on with noise and
localizes nothing (localization.standin). With ``--mapping`` the site is a canvas, and the map is
made while the robot drives (localization.mapping.live_mapper).
"""

from __future__ import annotations

import argparse
import gc
import logging
import os
import secrets
import signal
import sys
import threading
from pathlib import Path

from localization.node import LocalizerNode, StandInNode, run_periodically
from localization.standin import StandIn
from processes.log_lines import begin_log
from processes.priority import set_fifo
from wire import ConfigError, RobotDescription, load_robot
from wire.keys import Party
from wire.session import open_session
from wire.site_map import read_map_id

log = logging.getLogger("localization")

PRIORITY = 30
"""Of SCHED_FIFO; below the simulator, whose word it takes, and below all of the bridge. It asks for
little at a time: the stand-in next to nothing, the localizer a few milliseconds a scan. As any
other process it was silent for as long as others kept it waiting: POSE_LOST after 0.3 s
(docs/adr/0026)."""


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m localization", description=__doc__)
    parser.add_argument("--site", type=Path, required=True, help="folder with map.yaml")
    parser.add_argument("--robot", type=Path, help="robot.toml (default: the default robot)")
    parser.add_argument("--home", type=Path, help="$PONS_HOME (default: ./.pons)")
    parser.add_argument("--seed", type=int, default=0, help="seed of the noise (default 0)")
    parser.add_argument("--mapping", action="store_true", help="make the map, in the site's folder")
    return parser.parse_args(arguments)


def _serve(options: argparse.Namespace) -> None:
    # Handlers first: a signal during the slow part of the start must end the process cleanly too.
    stopped = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stopped.set())
    robot = load_robot(options.robot) if options.robot else RobotDescription()
    home = options.home or Path(os.environ.get("PONS_HOME") or ".pons")
    if options.mapping:
        _serve_mapping(options.site, robot, home, stopped)
    elif robot.localization.kind == "scans":
        _serve_scans(options.site, robot, home, stopped)
    else:
        _serve_stand_in(options, robot.id, home, stopped)


def _serve_stand_in(
    options: argparse.Namespace, robot_id: str, home: Path, stopped: threading.Event
) -> None:
    stand_in = StandIn(read_map_id(options.site), seed=options.seed)
    set_fifo(PRIORITY)  # before the session, whose threads inherit it
    with open_session(Party.LOCALIZATION, robot_id, home) as session:
        node = StandInNode(stand_in, session)
        gc.collect()
        gc.freeze()
        log.warning("STAND-IN: simulator truth plus noise, no localization; seed %d", options.seed)
        run_periodically(node.turn, stopped.is_set)


def _serve_scans(site: Path, robot: RobotDescription, home: Path, stopped: threading.Event) -> None:
    # Here, so that the stand-in's process is spared numpy's 20 MB.
    from localization.distance_field import DistanceField
    from localization.localizer import Localizer
    from localization.search_client import SearchClient
    from maps import load_map

    loaded = load_map(site / "map.yaml")
    localizer = Localizer(DistanceField.of_map(loaded.grid), robot.lidar, loaded.map_id)
    search = SearchClient(site, robot.lidar)
    search.start()  # before the rank, which the search must not inherit
    try:
        set_fifo(PRIORITY)
        with open_session(Party.LOCALIZATION, robot.id, home) as session:
            node = LocalizerNode(localizer, search, session, f"loc-{secrets.token_hex(4)}")
            gc.collect()
            gc.freeze()
            log.info("scans against map %s, %s", loaded.map_id, site)
            run_periodically(node.turn, stopped.is_set)
    finally:
        search.close()


def _serve_mapping(
    canvas: Path, robot: RobotDescription, home: Path, stopped: threading.Event
) -> None:
    from localization.mapping.builder_client import BuilderClient
    from localization.mapping.builder_process import load_builder
    from localization.mapping.mapping_node import MappingNode
    from maps import SiteError

    map_id, boot_id = read_map_id(canvas), f"map-{secrets.token_hex(4)}"
    try:
        known = load_builder(canvas, (robot.lidar.x_m, robot.lidar.y_m)).keyframes
    except ValueError as error:
        zh = f"{canvas}：保存的关键帧已损坏，无法读取"
        raise SiteError("keyframes_malformed", f"{canvas}: {error}", zh) from error
    builder = BuilderClient(canvas, robot.lidar, len(known))
    builder.start()  # before the rank, which the builder must not inherit
    try:
        set_fifo(PRIORITY)
        with open_session(Party.LOCALIZATION, robot.id, home) as session:
            node = MappingNode(robot.lidar, map_id, builder, session, boot_id, known)
            gc.collect()
            gc.freeze()
            log.info("mapping in %s, from %d keyframes", canvas, len(known))
            run_periodically(node.turn, stopped.is_set)
    finally:
        builder.close()


def main(arguments: list[str] | None = None) -> int:
    """Return 0 after a clean end, 1 where its home can't be written at present, 2 when refused."""
    begin_log()
    try:
        _serve(_options(arguments))
    except ConfigError as error:
        print(f"localization: {error}", file=sys.stderr)
        return error.exit_status
    return 0


if __name__ == "__main__":
    sys.exit(main())
