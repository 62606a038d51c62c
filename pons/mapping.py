"""Make a site of a drive: ``pons map NAME RECORDING...``.

Reads the bridge's recordings of one run, builds a map from their odometry and scans, and writes a
site with a fence around what was seen and rooms as a proposal. Needs no running robot.
"""

from __future__ import annotations

import argparse
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from bridge.recording.recording_reader import BadRecording, read_motion
from localization.mapping.map_replay import MapReplay
from localization.mapping.occupancy import MapTooLarge
from maps import LoadedMap, MapRecord, SiteError
from maps.new_site import new_site
from pons.site import is_site_name
from wire import ConfigError, load_robot

if TYPE_CHECKING:
    from maps.new_site import NewSite
    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_REFUSED = 0, 3
KEYFRAMES = "keyframes.npz"
FEWEST_KEYFRAMES = 3
"""Fewer are a robot that stood: a map of one spot is no site."""
MIN_FREE_BYTES = 50 * 1024 * 1024


def parser() -> argparse.ArgumentParser:
    """Return the grammar of ``pons map``."""
    top = argparse.ArgumentParser(prog="pons map", description=__doc__)
    top.add_argument("name", help="of the new site: small letters, digits, _")
    top.add_argument(
        "recordings", type=Path, nargs="+", metavar="FILE", help="of one run, in order"
    )
    return top


def run(settings: LaunchSettings, words: list[str]) -> int:
    """Make the site; 0 done, 3 refused."""
    said = parser().parse_args(words)
    try:
        folder = _new_folder(settings.home / "sites", said.name)
        robot = load_robot(settings.robot)
        replay = _replay(said.recordings, MapReplay(robot.lidar))
        made = _site(replay, robot.base.radius_m)
        made.write(folder)
    except BadRecording as refused:
        print(f"refused: {refused}", file=sys.stderr)
        return EXIT_REFUSED
    except ConfigError as refused:
        zh = f"\n{refused.message['zh']}" if isinstance(refused, SiteError) else ""
        print(f"refused: {refused}{zh}", file=sys.stderr)
        return EXIT_REFUSED
    keyframes, loops = len(replay.builder.keyframes), replay.builder.loops
    print(f"{folder}: of {replay.scans} scans, {keyframes} keyframes and {loops} loops")
    print(f"home at ({made.home.x_m:.2f}, {made.home.y_m:.2f}), {len(made.rooms)} rooms proposed")
    print(f"look at it: pons site rooms {said.name}; pons site check {said.name}")
    return EXIT_DONE


def _new_folder(sites: Path, name: str) -> Path:
    if not is_site_name(name):
        text = f"got {name!r}; expected a small letter, then letters, digits or _"
        raise SiteError("site_name_malformed", text)
    folder = sites / name
    if folder.exists():
        raise SiteError("site_exists", f"{folder} is there; remove it or choose another name")
    above = next(path for path in folder.parents if path.is_dir())
    free = shutil.disk_usage(above).free
    if not free >= MIN_FREE_BYTES:
        raise SiteError("disk_full", f"{above} has {free} bytes, needs {MIN_FREE_BYTES}")
    return folder


def _replay(recordings: list[Path], replay: MapReplay) -> MapReplay:
    for path in recordings:
        try:
            replay.hear(read_motion(path))
        except ValueError as error:
            raise SiteError("map_of_two_runs", f"{path}: {error}") from error
    keyframes = len(replay.builder.keyframes)
    if not keyframes >= FEWEST_KEYFRAMES:
        text = f"{replay.scans} scans gave {keyframes} keyframes, expected {FEWEST_KEYFRAMES}"
        raise SiteError("map_no_drive", f"{text}: drive at least a metre while it scans")
    return replay


def _site(replay: MapReplay, radius_m: float) -> NewSite:
    replay.builder.settle()
    try:
        grid = replay.builder.draw()
    except MapTooLarge as error:
        raise SiteError("map_too_large", str(error)) from error
    record = MapRecord(
        image="map.pgm",
        resolution=grid.resolution_m,
        origin=(grid.origin_x_m, grid.origin_y_m, 0.0),
        occupied_thresh=0.65,
        free_thresh=0.196,
    )
    made = new_site(LoadedMap(grid, 0, "", record), radius_m)
    made.files[KEYFRAMES] = replay.builder.to_bytes()
    return made
