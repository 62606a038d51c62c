"""Make a site of a drive, or mend one: ``pons map NAME [--mend] [RECORDING...]``.

Without recordings the map is what ``pons up --map NAME`` has kept; with them it is built from the
odometry and scans of one run of the bridge. Writes a site with a fence around what was seen and
rooms as a proposal. Needs no running robot. With ``--mend`` a site that was made before is compared
with the drive instead (pons.mending).
"""

from __future__ import annotations

import argparse
import shutil
import sys
from pathlib import Path
from secrets import token_hex
from typing import TYPE_CHECKING

from bridge.recording.recording_reader import BadRecording, read_motion
from bridge.recording.rotation import SUFFIX
from localization.mapping.builder_process import load_builder
from localization.mapping.carmen_log import CarmenError, read_carmen
from localization.mapping.keyframes import KEYFRAMES_FILE
from localization.mapping.map_replay import MapReplay
from localization.mapping.occupancy import MapTooLarge
from maps import LoadedMap, MapRecord, SiteError
from maps.canvas import canvas_site
from maps.errors import BilingualError
from maps.new_site import new_site
from planner.language.catalogue import say
from planner.site.polygon import contains
from planner.site.taught_place_errors import PlaceRefusal
from planner.site.taught_places import MAX_KEPT, TaughtPlaces
from pons.command_parser import CommandParser
from pons.site import is_site_name, site_name_malformed
from pons.site_refusals import keyframes_malformed, recording_refused, site_refusal
from pons.site_rooms import proposal_line
from pons.terminal import pick, refusal
from wire import ConfigError, load_robot
from wire.fingerprint import map_id
from wire.site_map import read_map_id

if TYPE_CHECKING:
    from collections.abc import Sequence

    from localization.mapping.map_builder import MapBuilder
    from maps.new_site import NewSite
    from maps.room_proposals import RoomProposal
    from planner.plan import Bilingual
    from planner.site.taught_places import TaughtPlace
    from pons.settings import LaunchSettings
    from wire import Pose2, RobotDescription
    from wire.lidar_config import LidarConfig

EXIT_DONE, EXIT_REFUSED = 0, 3

FEWEST_KEYFRAMES = 3
"""Fewer are a robot that stood: a map of one spot is no site."""
MIN_FREE_BYTES = 50 * 1024 * 1024


def parser() -> argparse.ArgumentParser:
    """Return the grammar of ``pons map``."""
    top = CommandParser(
        prog="pons map",
        description="Make a site of a drive: of what `pons up --map NAME` has kept, or of "
        "recordings of one run. With --mend compare a site with a drive. Needs no running robot.",
        examples=["pons map attic", "pons map attic --mend", "pons map attic --accept 1f2e3d4c"],
    )
    top.add_argument("name", help="of the new site: small letters, digits, _")
    top.add_argument(
        "recordings", type=Path, nargs="*", metavar="FILE", help="of one run, in order"
    )
    act = top.add_mutually_exclusive_group()
    act.add_argument(
        "--mend", action="store_true",
        help="show what a drive says against the map of a site; without files, the newest run",
    )  # fmt: skip
    act.add_argument("--accept", metavar="ID", help="put a mended map in the site's place")
    act.add_argument("--undo", action="store_true", help="take the last mended map back")
    top.add_argument(
        "--without",
        type=_numbers,
        metavar="N,N",
        default=frozenset(),
        help="with --mend: changes to leave out, by their numbers",
    )
    return top


def _numbers(text: str) -> frozenset[int]:
    """Read numbers of changes. Raises ArgumentTypeError."""
    try:
        return frozenset(map(int, text.split(",")))
    except ValueError:
        expected = pick(
            "expected numbers as the list shows them, as 3,5", "应为列表中的编号，如 3,5"
        )
        told = f"{text!r}; {expected}"
        raise argparse.ArgumentTypeError(told) from None


def run(settings: LaunchSettings, words: list[str]) -> int:
    """Make the site; 0 done, 3 refused."""
    said = parser().parse_intermixed_args(words)  # files may follow --mend
    try:
        if said.mend or said.accept or said.undo:
            return _mend(settings, said)
        if said.without:
            raise site_refusal("mend_change_unknown", "without_mend")
        folder = _new_folder(settings.home / "sites", said.name, of_drive=not said.recordings)
        robot = load_robot(settings.robot)
        if said.recordings:
            replay = _replay(said.recordings, MapReplay(_lidar_of(said.recordings, robot)))
            builder, source = replay.builder, f"{replay.scans} scans"
        else:
            builder = _read_canvas(settings.home / "mapping" / said.name, robot)
            source = "the drive"
        made = _site(builder, robot.base.radius_m)
        made.write(folder)
        names = 0 if said.recordings else _carry_names(settings.home, said.name, made)
    except PlaceRefusal as refused:
        chinese = f"refused: 名称未能保存：{refused.why.zh}"
        print(pick(f"refused: its names could not be kept: {refused}", chinese), file=sys.stderr)
        return EXIT_REFUSED
    except ConfigError as refused:
        told = refused.message if isinstance(refused, SiteError) else {}
        print(f"refused: {refusal(refused, told)}", file=sys.stderr)
        return EXIT_REFUSED
    print(f"{folder}: of {source}, {len(builder.keyframes)} keyframes and {builder.loops} loops")
    if names:
        print(f"names given while it was mapped go with it: {names}")
    print(proposal_line(made))
    print(f"look at it: pons site rooms {said.name}; pons site check {said.name}")
    return EXIT_DONE


def _mend(settings: LaunchSettings, said: argparse.Namespace) -> int:
    from pons import mending

    robot, name = load_robot(settings.robot), said.name
    if said.accept:
        mending.accept_mend(settings, name, said.accept, robot)
    elif said.undo:
        mending.undo_mend(settings, name)
    elif said.without and not said.recordings:  # the drive that is kept, with another answer
        drive = mending.kept_drive(settings, name)
        mending.propose_mend(settings, name, drive, robot, said.without)
    else:
        folder = mending.known_site(settings, name)
        files = said.recordings or newest_run(settings.home / "recordings")
        replay = _replay(files, MapReplay(_lidar_of(files, robot), closes_loops=False))
        drive = mending.place_drive(folder, replay.links, robot)
        mending.propose_mend(settings, name, drive, robot, said.without)
    return EXIT_DONE


def newest_run(folder: Path) -> list[Path]:
    """Return the recordings of the run of the bridge that began last, in order.

    Raises:
        SiteError: ``recordings_none``.
    """
    found = sorted(folder.glob(f"*{SUFFIX}"))
    if not found:
        raise site_refusal("recordings_none", folder=str(folder))
    boot = found[-1].name.split("-")[1:2]
    return [path for path in found if path.name.split("-")[1:2] == boot]


def _new_folder(sites: Path, name: str, *, of_drive: bool) -> Path:
    if not is_site_name(name):
        raise site_name_malformed(name)
    folder = sites / name
    if folder.exists():
        text = f"{folder} is there; remove it (rm -r {folder})"
        zh = f"{folder} 已存在；请删除它（rm -r {folder}）"
        if of_drive:  # a drive is found by its name alone
            raise SiteError("site_exists", f"{text}, and save the drive again", f"{zh}，再保存一次")
        raise SiteError("site_exists", f"{text} or choose another name", f"{zh}或换一个名称")
    above = next(path for path in folder.parents if path.is_dir())
    free = shutil.disk_usage(above).free
    if not free >= MIN_FREE_BYTES:
        needed = MIN_FREE_BYTES
        raise site_refusal("disk_full", folder=str(above), free=free, needed=needed)
    return folder


def _replay(recordings: list[Path], replay: MapReplay) -> MapReplay:
    for path in recordings:
        print(f"reading {path}", file=sys.stderr)  # a second for each ten that were recorded
        if path.suffix == SUFFIX:
            try:
                replay.hear(read_motion(path))
            except BadRecording as error:
                raise recording_refused(path, error) from error
            except BilingualError as error:
                raise SiteError(
                    "map_of_two_runs", f"{path}: {error}", f"{path}：{error.zh}"
                ) from error
        else:
            _replay_carmen(path, replay)
    _check_driven(len(replay.links), say("site_refusal.of_scans", scans=replay.scans))
    return replay


def _replay_carmen(path: Path, replay: MapReplay) -> None:
    try:
        for scan in read_carmen(path):
            replay.place_scan(scan.points_m, scan.laser_in_odom, scan.stamp_s)
    except CarmenError as error:
        text = f"{path}: {error}; recordings of the bridge end in {SUFFIX}"
        zh = f"{path}：{error.zh}；桥接进程的记录以 {SUFFIX} 结尾"
        raise SiteError("carmen_malformed", text, zh) from error


def _lidar_of(recordings: Sequence[Path], robot: RobotDescription) -> LidarConfig:
    """Return where the lidar is on the robot that drove: a CARMEN log's base is its laser.

    Raises:
        SiteError: ``map_of_two_runs``: recordings of both kinds.
    """
    kinds = {path.suffix == SUFFIX for path in recordings}
    if len(kinds) > 1:
        raise site_refusal("map_of_two_runs", "two_kinds")
    if True in kinds:
        return robot.lidar
    return robot.lidar.model_copy(update={"x_m": 0.0, "y_m": 0.0, "yaw_rad": 0.0})


def _read_canvas(canvas: Path, robot: RobotDescription) -> MapBuilder:
    """Return what ``pons up --map`` has kept in a canvas' folder.

    Raises:
        SiteError: ``map_not_begun``, ``keyframes_malformed`` or ``map_no_drive``.
    """
    if not (canvas / KEYFRAMES_FILE).is_file():
        begun = sorted(path.parent.name for path in canvas.parent.glob(f"*/{KEYFRAMES_FILE}"))
        text = f"{canvas} holds no drive; begun are: {', '.join(begun) or 'none'}"
        text = f"{text}. pons up --map {canvas.name}, or give recordings"
        zh = f"还没有为“{canvas.name}”建图；已开始的有：{'、'.join(begun) or '无'}。"
        zh = f"{zh}请运行 pons up --map {canvas.name}，或给出记录文件"
        raise SiteError("map_not_begun", text, zh)
    try:
        builder = load_builder(canvas, (robot.lidar.x_m, robot.lidar.y_m))
    except ValueError as error:
        raise keyframes_malformed(canvas, error) from error
    _check_driven(len(builder.keyframes), say("site_refusal.of_drive"))
    return builder


def carry_names(
    taught: Sequence[TaughtPlace], canvas_id: str, site_id: str, rooms: Sequence[RoomProposal]
) -> tuple[TaughtPlace, ...]:
    """Return what was taught on a canvas as places of the site that was made of it.

    A name that is alone in a proposed room is the room's; the others stay spots. Both lie where
    they were given: a loop that closed later may have moved the walls beside them a little.

    Args:
        taught: all that was ever taught.
        canvas_id: the canvas' map_id.
        site_id: the new site's.
        rooms: the rooms that the site proposes.
    """
    known = {place.id for place in taught if place.map_id == site_id}
    named = [place for place in taught if place.map_id == canvas_id and place.id not in known]
    homes = [_room_around(rooms, place.pose) for place in named]
    return tuple(
        place.model_copy(
            update={
                "map_id": site_id,
                "polygon": room.polygon if room is not None and homes.count(room) == 1 else None,
            }
        )
        for place, room in zip(named, homes, strict=True)
    )


def _carry_names(home: Path, name: str, made: NewSite) -> int:
    """Keep the canvas' names as the site's; return how many."""
    store = TaughtPlaces.in_home(home)
    taught = store.load()
    site_id = map_id(made.files["map.yaml"], made.files["map.pgm"])
    carried = carry_names(taught, read_map_id(home / "mapping" / name), site_id, made.rooms)
    carried = carried[: max(0, MAX_KEPT - len(taught))]
    if carried:
        store.save((*taught, *carried))
    return len(carried)


def _room_around(rooms: Sequence[RoomProposal], pose: Pose2) -> RoomProposal | None:
    around = [room for room in rooms if contains(room.polygon, pose.x_m, pose.y_m)]
    return min(around, key=lambda room: room.area_m2, default=None)


def _check_driven(count: int, source: Bilingual) -> None:
    if not count >= FEWEST_KEYFRAMES:
        fewest = FEWEST_KEYFRAMES
        raise site_refusal("map_no_drive", source=source, count=count, fewest=fewest)


def prepare_canvas(settings: LaunchSettings, name: str, robot: RobotDescription) -> None:
    """Make the folder in which a map grows, unless it is there: then the map goes on.

    A site that was mapped before goes on from its keyframes.

    Raises:
        SiteError: the name is none, or the folder can't be made.
    """
    if not is_site_name(name):
        raise site_name_malformed(name)
    canvas = settings.home / "mapping" / name
    if (canvas / "map.yaml").is_file():
        return
    made = canvas_site(robot.base.radius_m, mark=f"{name}_{token_hex(8)}")
    known = settings.home / "sites" / name / KEYFRAMES_FILE
    if known.is_file():
        made.files[KEYFRAMES_FILE] = known.read_bytes()
    made.write(canvas)


def _site(builder: MapBuilder, radius_m: float) -> NewSite:
    builder.settle()
    try:
        grid = builder.draw()
    except MapTooLarge as error:
        raise SiteError("map_too_large", str(error), error.zh) from error
    record = MapRecord(
        image="map.pgm",
        resolution=grid.resolution_m,
        origin=(grid.origin_x_m, grid.origin_y_m, 0.0),
        occupied_thresh=0.65,
        free_thresh=0.196,
    )
    made = new_site(LoadedMap(grid, 0, "", record), radius_m)
    made.files[KEYFRAMES_FILE] = builder.to_bytes()
    return made
