"""Mend a site's map by a drive through it: ``pons map NAME --mend [RECORDING...]``.

The drive is found on the map, what it saw otherwise is listed and drawn as a proposal, and nothing
changes. ``--accept ID`` puts that map in the site's place, all of it or none of it; places, rooms,
fence and keep-outs stay as they are. ``--undo`` takes it back. A robot takes it at its next start.
"""

from __future__ import annotations

import errno
import json
import os
import shutil
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

from localization.distance_field import DistanceField
from localization.mapping.keyframes import (
    KEYFRAMES_FILE,
    KeyframeFileError,
    read_keyframes,
    write_keyframes,
)
from localization.mapping.map_anchors import DriveElsewhere, place_on_map
from localization.mapping.map_builder import MapBuilder
from localization.mapping.mend_proposal import (
    DRIVE_FILE,
    LIST_FILE,
    PICTURE,
    MendProposal,
    keep,
    propose,
)
from localization.mapping.pose_graph import PoseGraph
from maps import SiteError, load_map
from maps.file_errors import system_reason_zh, unwritable
from planner.language.catalogue import say
from planner.plan import Bilingual
from planner.site import Site
from planner.site.fence import load_fence
from planner.site.taught_places import MAX_KEPT, TaughtPlaces
from pons.folder_swap import swap_folders, sync_folder
from pons.home_lock import HomeLock, HomeTaken
from pons.settings import site_of
from pons.site import site_missing
from pons.site_findings import print_findings
from pons.site_refusals import keyframes_malformed, site_refusal
from pons.terminal import pick
from pons_assets import SITES
from wire import ConfigError
from wire.fence import fence_text
from wire.site_map import read_map_id

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from localization.mapping.keyframes import Keyframe
    from localization.mapping.scan_tracker import KeyframeLink
    from pons.settings import LaunchSettings
    from wire import RobotDescription

DECLARATION = "home.yaml"
_WORDS = {"gone": ("gone", "已不在"), "new": ("new", "新出现"), "floor": ("floor", "新看到的地面")}


def known_site(settings: LaunchSettings, name: str) -> Path:
    """Return the folder of a site that there is.

    Raises:
        SiteError: ``site_missing``.
    """
    folder = site_of(name, settings.home)
    if not (folder / "map.yaml").is_file():
        raise site_missing(name, settings.home)
    _finish_killed(settings, folder)
    return folder


def _finish_killed(settings: LaunchSettings, folder: Path) -> None:
    """Set the old map aside where a kill came just after the folders had changed places."""
    beside, where = _new_folder_beside(folder), _proposal_folder(settings, folder)
    try:
        told = json.loads((where / LIST_FILE).read_bytes())
        ids = (read_map_id(beside), read_map_id(folder))
        if ids == (told["base"], told["id"]):
            _set_aside(beside, folder)
            shutil.rmtree(where, ignore_errors=True)
    except (OSError, ValueError, KeyError, TypeError, ConfigError):
        return  # no accept was cut off there


def place_drive(
    folder: Path, links: Sequence[KeyframeLink], robot: RobotDescription
) -> tuple[Keyframe, ...]:
    """Return a drive's keyframes in the frame of a site's map, and print how well they fit it.

    Raises:
        SiteError: ``drive_elsewhere``.
    """
    grid = load_map(folder / "map.yaml").grid
    lidar_m = (robot.lidar.x_m, robot.lidar.y_m)
    try:
        drive = place_on_map(links, DistanceField.of_map(grid), lidar_m)
    except DriveElsewhere as error:
        why = Bilingual(en=str(error), zh=error.zh)
        raise site_refusal("drive_elsewhere", why=why, site=folder.name) from error
    dropped = f", {drive.dropped} left out" if drive.dropped else ""
    print(f"{len(drive.keyframes)} keyframes placed on {folder.name}{dropped}; "
          f"{drive.share:.0%} agree with its map")  # fmt: skip
    return drive.keyframes


def propose_mend(
    settings: LaunchSettings,
    name: str,
    keyframes: tuple[Keyframe, ...],
    robot: RobotDescription,
    left_out: frozenset[int],
) -> None:
    """Work out, show and keep what a drive says against a site's map.

    Raises:
        SiteError: as :func:`localization.mapping.mend_proposal.propose` and ``keep``.
    """
    folder = known_site(settings, name)
    loaded = load_map(folder / "map.yaml")
    lidar_m = (robot.lidar.x_m, robot.lidar.y_m)
    proposal = propose(loaded.map_id, loaded.grid, keyframes, lidar_m, left_out)
    if not proposal.changes:
        print(f"{folder.name}: {pick('as its map says, nothing to mend', '与地图一致，无需修改')}")
        return
    where = _proposal_folder(settings, folder)
    keep(proposal, where, write_keyframes(keyframes, PoseGraph().table()))
    _print_changes(proposal, Site.load(folder))
    legend = pick("red gone, blue new, green floor", "红：已不在，蓝：新出现，绿：地面")
    print(f"picture: {where / PICTURE} ({legend})")
    if not proposal.accepted_changes:
        print("all of it is left out; nothing would change")
        return
    print(f"nothing is changed yet. Take it: pons map {name} --accept {proposal.id}")
    print(f"leave some of it out: pons map {name} --mend --without N,N")


def kept_drive(settings: LaunchSettings, name: str) -> tuple[Keyframe, ...]:
    """Return the keyframes of the proposal that waits for an answer.

    Raises:
        SiteError: ``mend_unknown``, ``mend_stale`` or ``keyframes_malformed``.
    """
    folder = known_site(settings, name)
    path = _proposal_folder(settings, folder) / DRIVE_FILE
    _read_list(settings, folder)
    try:
        return read_keyframes(path.read_bytes())[0]
    except (OSError, KeyframeFileError) as error:
        raise keyframes_malformed(path, error) from error


def accept_mend(settings: LaunchSettings, name: str, mend_id: str, robot: RobotDescription) -> None:
    """Put a proposed map in the place of a site's own.

    Raises:
        SiteError: ``mend_unknown``, ``mend_stale``, ``robot_running``, ``site_unwritable``, or why
            the site could not be loaded with that map.
        PlaceRefusal: the names that were taught could not be kept.
    """
    folder = known_site(settings, name)
    told, where = _read_list(settings, folder), _proposal_folder(settings, folder)
    if told["id"] != mend_id:
        raise site_refusal("mend_unknown", "mend_other", id=repr(mend_id), waits=told["id"])
    target = folder if folder.parent != SITES else settings.home / "sites" / folder.name
    beside = _new_folder_beside(target)
    with _standing_robot(settings):
        try:
            shutil.rmtree(beside, ignore_errors=True)
            target.parent.mkdir(parents=True, exist_ok=True)
            _build(folder, where, beside)
            _check_loads(beside)
            print_findings(beside, settings.home, robot.base.radius_m, taught_in=folder)
            carried = _carry_taught(settings.home, read_map_id(folder), read_map_id(beside))
            _put_in_place(beside, target)
        except OSError as error:
            shutil.rmtree(beside, ignore_errors=True)
            why = Bilingual(en=str(error.strerror), zh=system_reason_zh(error))
            if error.errno in (errno.ENOSYS, errno.EINVAL):
                why = say("site_refusal.no_exchange")
            at = str(target)
            raise site_refusal("site_unwritable", "nothing_changed", folder=at, why=why) from error
    shutil.rmtree(where, ignore_errors=True)
    print(f"{target}: map {told['id']} in place of {told['base']}; places, rooms, fence as before")
    if carried:
        print(f"taught places that go with it: {carried}")
    print(f"a robot takes it at its next start: pons up --site {name}")
    if (folder / DECLARATION).is_file() or (_previous_folder(folder) / DECLARATION).is_file():
        print(f"{DECLARATION} is not taken over: simulated is from now on what the map shows")
    if target == folder:
        print(f"take it back: pons map {name} --undo")


def undo_mend(settings: LaunchSettings, name: str) -> None:
    """Put the map back that was mended last.

    Raises:
        SiteError: ``mend_unknown``, ``robot_running`` or ``site_unwritable``.
    """
    folder = known_site(settings, name)
    before = _previous_folder(folder)
    if not (before / "map.yaml").is_file():
        raise site_refusal("mend_unknown", "not_mended", folder=str(folder))
    with _standing_robot(settings):
        try:
            swap_folders(before, folder)
        except OSError as error:
            raise unwritable(folder, error) from error
        shutil.rmtree(before, ignore_errors=True)
    print(f"{folder}: map {read_map_id(folder)} again; a robot takes it at its next start")


def _build(folder: Path, where: Path, beside: Path) -> None:
    """Write the site anew with the mended map; all else of it as it is, but for the map's name."""
    shutil.copytree(folder, beside, symlinks=True)
    # Its map no longer follows from it; without it the simulator builds the home of the map.
    (beside / DECLARATION).unlink(missing_ok=True)
    image = load_map(folder / "map.yaml").record.image
    (beside / image).unlink()
    for name in ("map.yaml", "map.pgm"):
        shutil.copyfile(where / name, beside / name)
    fence = load_fence(folder / "fence.json").record
    fence = fence.model_copy(update={"map_id": read_map_id(beside)})
    (beside / "fence.json").write_text(fence_text(fence), "utf-8")
    path = beside / KEYFRAMES_FILE
    if path.is_file():  # a site that was mapped: another day goes on from the mended map
        try:
            builder = MapBuilder.of_bytes(path.read_bytes(), (0.0, 0.0))
        except ValueError as error:
            raise keyframes_malformed(folder, error) from error
        builder.append_placed(read_keyframes((where / DRIVE_FILE).read_bytes())[0])
        path.write_bytes(builder.to_bytes())
    for file in beside.iterdir():
        if file.is_file():
            _sync_file(file)
    sync_folder(beside)


def _sync_file(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _check_loads(beside: Path) -> None:
    """Refuse a map on which the site's own places no longer stand."""
    try:
        Site.load(beside)
    except SiteError as error:
        shutil.rmtree(beside, ignore_errors=True)
        raise site_refusal(error.code, "leave_out", why=Bilingual(**error.message)) from error


def _put_in_place(beside: Path, target: Path) -> None:
    if not target.exists():  # mended from a shipped site: the first of one's own
        beside.rename(target)
        sync_folder(target.parent)
        return
    swap_folders(beside, target)
    with suppress(OSError):  # the site is mended; what is left beside it, the next order tidies
        _set_aside(beside, target)


def _set_aside(beside: Path, target: Path) -> None:
    before = _previous_folder(target)
    shutil.rmtree(before, ignore_errors=True)
    beside.rename(before)


def _carry_taught(home: Path, old_id: str, new_id: str) -> int:
    """Keep what was taught on the old map for the new one too; return how many.

    Before the folders change places: a kill in between leaves names of a map that nobody has.
    """
    store = TaughtPlaces.in_home(home)
    taught = store.load()
    known = {place.id for place in taught if place.map_id == new_id}
    carried = tuple(
        place.model_copy(update={"map_id": new_id})
        for place in taught
        if place.map_id == old_id and place.id not in known
    )
    if not len(taught) + len(carried) <= MAX_KEPT:
        more = len(carried)
        raise site_refusal("taught_places_full", taught=len(taught), more=more, most=MAX_KEPT)
    if carried:
        store.save((*taught, *carried))
    return len(carried)


@contextmanager
def _standing_robot(settings: LaunchSettings) -> Iterator[None]:
    """Hold off every ``pons up`` of this home meanwhile."""
    try:
        with HomeLock(settings.home):
            yield
    except HomeTaken as error:
        raise site_refusal("robot_running", why=str(error)) from error


def _proposal_folder(settings: LaunchSettings, folder: Path) -> Path:
    return settings.home / "mending" / folder.name


def _new_folder_beside(folder: Path) -> Path:
    return folder.with_name(f".{folder.name}.mending")


def _previous_folder(folder: Path) -> Path:
    return folder.with_name(f".{folder.name}.before")


def _read_list(settings: LaunchSettings, folder: Path) -> dict[str, str]:
    """Return id and base of the proposal that waits.

    Raises:
        SiteError: ``mend_unknown`` where none does, ``mend_stale`` where it is of another map.
    """
    path = _proposal_folder(settings, folder) / LIST_FILE
    try:
        told = json.loads(path.read_bytes())
        found = {"id": str(told["id"]), "base": str(told["base"])}
    except FileNotFoundError:
        raise site_refusal("mend_unknown", "mend_none", site=folder.name) from None
    except (OSError, ValueError, KeyError, TypeError) as error:
        facts = {"path": str(path), "why": str(error)}
        raise site_refusal("mend_unknown", "mend_unread", **facts) from error
    current = read_map_id(folder)
    if found["base"] != current:
        raise site_refusal("mend_stale", **found, site=folder.name, current=current)
    return found


def _print_changes(proposal: MendProposal, site: Site) -> None:
    for number, change in enumerate(proposal.changes, 1):
        kind = pick(*_WORDS[change.kind])
        room = site.room_at(change.x_m, change.y_m)
        where = "" if room is None else f"  {pick(room.name.en, room.name.zh)}"
        out = f"  ({pick('left out', '略去')})" if number in proposal.left_out else ""
        print(f"{number:3}  {kind:5}  {change.width_m:.2f} x {change.depth_m:.2f} m "
              f"at ({change.x_m:.2f}, {change.y_m:.2f}){where}{out}")  # fmt: skip
