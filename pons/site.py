"""Make a site of a map: ``pons site import | list | rooms | name | masks | check``.

Works on folders and needs no planner; a running robot takes a changed site at its next start.
``masks`` changes nothing: it prints the fence that would hold, for ``pons fence propose``.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import sys
from math import isfinite, radians
from pathlib import Path
from typing import TYPE_CHECKING

from maps import SiteError, load_map
from maps.file_errors import unwritable
from maps.map_file import FARTHEST_M, load_picture
from maps.masks import SpeedScale, join_masks, read_keep_outs, read_speed_zones
from maps.new_site import ASK_FROM_SHARE, new_site, place_text
from maps.room_proposals import read_proposals
from pons.settings import site_of
from pons.site_findings import print_findings
from pons.site_grammar import parser
from pons.site_rooms import print_rooms, proposal_line
from pons.terminal import pick, refusal
from wire import ConfigError, Pose2, load_robot, wrap
from wire.fence import fence_text

if TYPE_CHECKING:
    from maps.grid import GridMap
    from maps.map_file import LoadedMap
    from maps.masks import MaskAreas
    from maps.new_site import NewSite
    from planner.navigation.site_check import SiteFinding
    from pons.settings import LaunchSettings
    from wire import RobotDescription

EXIT_DONE, EXIT_FOUND, EXIT_USAGE, EXIT_REFUSED = 0, 1, 2, 3
SCHEME = "ros2:"
LARGE_CELLS = 16_000_000
_NAME = re.compile(r"[a-z][a-z0-9_]{0,31}")


def run(settings: LaunchSettings, words: list[str]) -> int:
    """Do one act; 0 done, 1 check found something, 2 bad order, 3 refused."""
    said = parser().parse_args(words)
    try:
        if said.act == "import":
            return _import(settings, said)
        if said.act == "list":
            return _list(settings, as_json=said.json)
        folder = site_of(said.name, settings.home)
        if not (folder / "map.yaml").is_file():
            raise site_missing(said.name, settings.home)
        if said.act == "check":
            return _check(settings, folder, as_json=said.json)
        if said.act == "rooms":
            print_rooms(folder, settings.home, as_json=said.json)
            return EXIT_DONE
        if said.act == "masks":
            return _print_fence_with_masks(settings, folder, said)
        return _name_room(folder, said.room, said.english, said.zh or said.english)
    except ConfigError as refused:
        print(f"refused: {refusal(refused, _sentence_of(refused))}", file=sys.stderr)
        return EXIT_REFUSED


def _sentence_of(refused: ConfigError) -> dict[str, str]:
    """Return a refusal's sentence in Chinese, where it has one; English stands in the error."""
    from pons.ros2_robot import TopicRefusal

    if isinstance(refused, SiteError):
        return {"zh": refused.message["zh"]}
    return {"zh": refused.cure_zh} if isinstance(refused, TopicRefusal) else {}


def _import(settings: LaunchSettings, said: argparse.Namespace) -> int:
    if not is_site_name(said.name):
        raise site_name_malformed(said.name)
    is_topic = said.map.startswith(SCHEME)
    is_yaml = is_topic or Path(said.map).suffix in (".yaml", ".yml")
    if is_yaml == (said.resolution is not None):
        return _print_usage("resolution_once", "resolution_twice" if is_yaml else "resolution_due")
    robot = load_robot(settings.robot)
    loaded = _load_topic(said, robot) if is_topic else _load(said)
    start = None if said.start is None else _start(said.start)
    if len(loaded.grid.cells) >= LARGE_CELLS:
        print(
            pick("a large map: this takes a minute or more", "地图很大，需要一分钟以上"),
            file=sys.stderr,
        )
    made = new_site(loaded, robot.base.radius_m, start, _masks(said, loaded.grid, robot))
    folder = settings.home / "sites" / said.name
    _write(made, folder)
    grid, taken_for = loaded.grid, "floor" if said.unknown == "free" else "unknown"
    print(f"{folder}: {grid.width} x {grid.height} cells of {grid.resolution_m:g} m")
    if loaded.kept_unknown:
        print(f"{loaded.kept_unknown} pixels of about grey 205 were taken for {taken_for}")
    print(proposal_line(made))
    print_rooms(folder, settings.home)
    if _has_errors(print_findings(folder, settings.home, robot.base.radius_m)):
        print(pick("before you drive there, mend what is an error", "出发前请先解决上面的错误"))
        return EXIT_FOUND
    print(f"drive there: pons up --site {said.name}")
    return EXIT_DONE


def _print_usage(code: str, told: str) -> int:
    """Print what an order lacks; return the status of a bad order."""
    from planner.language.catalogue import say

    words = say(f"site_refusal.{told}")
    print(f"{code}: {pick(words.en, words.zh)}", file=sys.stderr)
    return EXIT_USAGE


def site_missing(given: str, home: Path) -> SiteError:
    """Return the refusal of a site that is not there, with the names of those that are."""
    from pons_assets import SITES

    folders = (home / "sites", SITES)
    found = {path.parent.name for folder in folders for path in folder.glob("*/map.yaml")}
    names = ", ".join(sorted(name for name in found if not name.startswith("."))) or "none"
    text = f"{given} is no site: no map.yaml is there; sites: {names}"
    zh = f"{given} 不是站点：那里没有 map.yaml；已有站点：{names}"
    cure = "pons site import MAP.yaml NAME"
    return SiteError(
        "site_missing", f"{text}. `{cure}` makes one of a map", f"{zh}。新建：`{cure}`"
    )


def _write(made: NewSite, folder: Path) -> None:
    """Write a site that loads; one that would not leaves nothing behind."""
    from planner.site import Site

    made.write(folder)
    try:
        Site.load(folder)
    except SiteError:
        shutil.rmtree(folder, ignore_errors=True)
        raise


def is_site_name(name: str) -> bool:
    """Return whether a new site may be called so."""
    return _NAME.fullmatch(name) is not None


def site_name_malformed(name: str) -> SiteError:
    """Return the refusal of a name that no site may have."""
    text = f"got {name!r}; expected a small letter, then small letters, digits or _, 32 in all"
    zh = f"收到 {name!r}；应以小写字母开头，其后为小写字母、数字或 _，最多 32 个字符"
    return SiteError("site_name_malformed", text, zh)


def _load(said: argparse.Namespace) -> LoadedMap:
    frees = said.unknown == "free"
    path = Path(said.map)
    if said.resolution is None:
        loaded = load_map(path, frees_saved_unknown=frees)
    else:
        x_m, y_m, yaw_deg = said.origin
        at = (x_m, y_m, radians(yaw_deg))
        loaded = load_picture(path, said.resolution, at, frees_saved_unknown=frees)
    share = loaded.kept_unknown / max(1, len(loaded.grid.cells))
    if share >= ASK_FROM_SHARE and said.unknown is None:
        from planner.language.catalogue import say

        threshold = loaded.record.free_thresh
        told = say(
            "site_refusal.map_unknown_word",
            share=100.0 * share, map=str(said.map), threshold=threshold,
        )  # fmt: skip
        raise SiteError("map_unknown_word", told.en, told.zh)
    return loaded


def _load_topic(said: argparse.Namespace, robot: RobotDescription) -> LoadedMap:
    from pons.ros2_robot import load_topic_map

    return load_topic_map(robot, said.map.removeprefix(SCHEME))


def _masks(said: argparse.Namespace, grid: GridMap, robot: RobotDescription) -> list[MaskAreas]:
    found = []
    if said.keepout is not None:
        found.append(read_keep_outs(said.keepout, grid))
    if said.speed is not None:
        scale = SpeedScale(
            robot.limits.max_speed_mps, said.speed_kind, said.speed_base, said.speed_multiplier
        )
        found.append(read_speed_zones(said.speed, grid, scale))
    return found


def _start(given: list[float]) -> Pose2:
    x_m, y_m, yaw_deg = given
    if not (max(abs(x_m), abs(y_m)) <= FARTHEST_M and isfinite(yaw_deg)):
        text = f"--start: expected two numbers up to {FARTHEST_M:.0f} and degrees, got {given}"
        zh = f"--start：应为两个不超过 {FARTHEST_M:.0f} 的数和一个角度，收到 {given}"
        raise SiteError("value_malformed", text, zh)
    return Pose2(x_m, y_m, wrap(radians(yaw_deg)))


def _radius_m(settings: LaunchSettings) -> float:
    return load_robot(settings.robot).base.radius_m


def _list(settings: LaunchSettings, *, as_json: bool) -> int:
    from pons_assets import SITES

    parents = (settings.home / "sites", SITES)
    found = [path.parent for parent in parents for path in sorted(parent.glob("*/map.yaml"))]
    shown = [folder for folder in found if not folder.name.startswith(".")]  # a mend's are not
    if as_json:
        sites = [{"name": folder.name, "folder": str(folder)} for folder in shown]
        print(json.dumps({"sites": sites}, ensure_ascii=False, indent=1))
        return EXIT_DONE
    for folder in shown:
        print(f"{folder.name:<24} {folder}")
    return EXIT_DONE


def _name_room(folder: Path, room_id: str, english: str, chinese: str) -> int:
    from planner.site import (
        PlaceRefusal,
        Site,
        check_not_order,
        owner_of,
        plain_name,
        vocabulary_of,
    )

    proposals = {room.id: room for room in read_proposals(folder)}
    if room_id not in proposals:
        known = ", ".join(proposals)
        text = f"got {room_id!r}; proposed: {known or 'none'}"
        zh = f"没有 {room_id!r}；已有提议：{known or '无'}"
        raise SiteError("room_unknown", text, zh)
    room = proposals[room_id]
    site = Site.load(folder)
    vocabulary = vocabulary_of(site)
    try:
        names = (plain_name(english), plain_name(chinese))
        for name in names:
            owner = owner_of(name, site.places)
            if owner is not None:  # before its reading: what names a place reads as an order
                text = f"{name!r} is a name of {owner.id!r} already; choose another"
                zh = f"{name!r} 已是 {owner.id!r} 的名称，请换一个"
                raise SiteError("place_name_taken", text, zh)
            check_not_order(name, vocabulary)
    except PlaceRefusal as refused:
        came = "、".join(map(repr, dict.fromkeys((english, chinese))))
        text, zh = f"{refused.why.en} ({refused.detail})", f"{refused.why.zh}（收到 {came}）"
        raise SiteError(refused.code, text, zh) from None
    place_id = re.sub(r"[^a-z0-9]+", "_", names[0].lower()).strip("_")
    if not place_id[:1].isalpha():
        place_id = room_id
    path = folder / "places.yaml"
    before = path.read_bytes()
    entry = place_text(place_id, "room", names, room.pose, room.polygon)
    _replace(path, before.rstrip(b"\n") + b"\n" + entry.encode())
    try:
        Site.load(folder)
    except SiteError:
        _replace(path, before)
        raise
    print(f"{room_id} is {names[0]} ({names[1]}) from the next start on")
    return EXIT_DONE


def _replace(path: Path, data: bytes) -> None:
    """Put data in a file's place: a planner that starts meanwhile reads the old or the new."""
    beside = path.with_suffix(".new")
    try:
        beside.write_bytes(data)
        beside.replace(path)
    except OSError as error:
        raise unwritable(path, error) from error


def _print_fence_with_masks(
    settings: LaunchSettings, folder: Path, said: argparse.Namespace
) -> int:
    """Print the fence in force with the masks' areas joined, as text for ``pons fence propose``."""
    from planner.site import Site

    if said.keepout is None and said.speed is None:
        return _print_usage("masks_none", "masks_none")
    site = Site.load(folder)
    masks = _masks(said, site.grid, load_robot(settings.robot))
    fence = join_masks(site.fence.record, masks)
    print(fence_text(fence), end="")
    closed = sum(len(mask.keep_outs) for mask in masks)
    slowed = sum(len(mask.speed_zones) for mask in masks)
    told = f"{closed} areas closed, {slowed} slowed by the masks"
    print(f"{told}; to put it in force: pons fence propose FILE", file=sys.stderr)
    return EXIT_DONE


def _check(settings: LaunchSettings, folder: Path, *, as_json: bool) -> int:
    """Print what was found; a warning alone is no reason for another exit status than 0."""
    found = print_findings(folder, settings.home, _radius_m(settings), as_json=as_json)
    if not found and not as_json:
        print(f"{folder.name}: {pick('nothing is wrong', '没有问题')}")
    return EXIT_FOUND if _has_errors(found) else EXIT_DONE


def _has_errors(found: list[SiteFinding]) -> bool:
    return any(finding.level == "error" for finding in found)
