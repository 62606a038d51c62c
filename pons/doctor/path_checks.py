"""Check where the robot's state and description lie: home folder, sockets, port, robot, site."""

from __future__ import annotations

import os
import shutil
import socket
import stat
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from bridge.operator_key import load_operator_key
from planner.settings import find_exposed
from planner.site import Site, SiteError
from pons.doctor.finding import BilingualWords, HealthFinding, fail, ok, warn
from pons.launch_checks import MIN_FREE_BYTES
from pons.launch_words import chinese_cure
from pons.running import describe_robot, find_robots
from wire import ConfigError, RobotDescription, load_robot
from wire.doors import DOORS
from wire.sockets import MAX_SOCKET_PATH, Endpoints, is_listening

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

ROOMY_BYTES = 10 * MIN_FREE_BYTES
"""Recordings of a day."""


def robot(path: Path) -> tuple[HealthFinding, RobotDescription]:
    """Read robot.toml; an unreadable one counts as the default robot for the other checks."""
    try:
        described = load_robot(path)
    except ConfigError as wrong:
        fix = BilingualWords(
            "mend the file; `pons up` refuses it as it is",
            chinese_cure(str(wrong)) or "请修正该文件，否则无法启动",
        )
        return fail("robot", BilingualWords(str(wrong), str(wrong)), fix), RobotDescription()
    kind = described.drive.kind
    return ok("robot", f"{described.id}, {kind} drive", f"{described.id}，驱动 {kind}"), described


def site(path: Path) -> tuple[HealthFinding, Site | None]:
    """Load the site with all that the planner checks."""
    try:
        loaded = Site.load(path)
    except SiteError as wrong:
        fix = BilingualWords(
            "mend the site, or choose another with PONS_SITE", "请修正场地或用 PONS_SITE 另选"
        )
        return fail("site", BilingualWords(str(wrong), wrong.message["zh"]), fix), None
    count = len(loaded.places)
    return ok(
        "site", f"{path.name}, {count} rooms and places", f"{path.name}，{count} 处地点"
    ), loaded


def home(path: Path) -> HealthFinding:
    """Look whether the home folder is ours alone to write; keys and the journal lie in it."""
    nearest = next(folder for folder in (path, *path.parents) if folder.exists())
    if not nearest.is_dir() or not os.access(nearest, os.W_OK | os.X_OK):
        return fail(
            "home",
            BilingualWords(
                f"{nearest} can't be written by this user", f"当前用户无法写入 {nearest}"
            ),
            BilingualWords("change its owner, or set PONS_HOME", "请更改所有者或设置 PONS_HOME"),
        )
    if path.exists() and _open_to_others(path.stat().st_mode):
        return warn(
            "home",
            BilingualWords(f"{path} can be written by others", f"其他用户可以写入 {path}"),
            BilingualWords(f"chmod go-w {path}", f"chmod go-w {path}"),
        )
    state = "is there" if path.exists() else "will be made"
    return ok("home", f"{path} {state}", f"{path} {'已存在' if path.exists() else '将被创建'}")


def secrets(path: Path, *, virtual: bool) -> HealthFinding:
    """Look whether others may read or change the keys that lie in the home folder."""
    try:
        load_operator_key(path, virtual=virtual)
        found = find_exposed(path)
    except ConfigError as wrong:
        fix = BilingualWords(
            "mend or remove that file; as the bridge's user, `pons key new` makes operator.key",
            "请修正或删除该文件；以 bridge 的用户执行 `pons key new` 可生成 operator.key",
        )
        return fail("secrets", BilingualWords(str(wrong), str(wrong)), fix)
    if found:
        told = "; ".join(found)
        return warn(
            "secrets",
            BilingualWords(told, f"其他用户可以读取或修改：{told}"),
            BilingualWords("chmod 600, as the planner's user", "请以 planner 的用户执行 chmod 600"),
        )
    return ok("secrets", "no key lies open to others", "没有密钥暴露给其他用户")


def _open_to_others(mode: int) -> bool:
    """Tell whether others may replace what lies there; a group may share a sticky folder."""
    return bool(mode & 0o002 or (mode & 0o020 and not mode & stat.S_ISVTX))


def disk(path: Path) -> HealthFinding:
    """Look for room for recordings and the journal."""
    nearest = next(folder for folder in (path, *path.parents) if folder.exists())
    free = shutil.disk_usage(nearest).free
    shown = f"{free / 1e9:.1f} GB"
    if free >= ROOMY_BYTES:
        return ok("disk", f"{shown} free", f"剩余 {shown}")
    grade = warn if free >= MIN_FREE_BYTES else fail
    return grade(
        "disk",
        BilingualWords(f"{shown} free in {nearest}", f"{nearest} 剩余 {shown}"),
        BilingualWords("delete old recordings, or set PONS_HOME to a larger disk",
              "请删除旧录制文件或将 PONS_HOME 设到更大的磁盘"),
    )  # fmt: skip


def sockets(path: Path) -> HealthFinding:
    """Look at the socket paths, and for the leftovers of dead processes."""
    where = Endpoints(path)
    longest = max(len(os.fsencode(where.socket(door))) for door in DOORS)
    if not longest <= MAX_SOCKET_PATH:
        return fail(
            "sockets",
            BilingualWords(f"socket paths of {longest} bytes; the kernel takes {MAX_SOCKET_PATH}",
                  f"套接字路径 {longest} 字节，内核最多 {MAX_SOCKET_PATH}"),
            BilingualWords("set PONS_HOME to a shorter folder", "请将 PONS_HOME 设为更短的目录"),
        )  # fmt: skip
    live = listening(path)
    stale = [door.name for door in DOORS if door.name not in live and where.socket(door).exists()]
    if stale:
        names = ", ".join(stale)
        return ok("sockets", f"left by dead processes and replaced at the next start: {names}",
                  f"已退出的进程留下，下次启动时会替换：{names}")  # fmt: skip
    said = f"in use by a running robot: {', '.join(live)}" if live else "free"
    return ok("sockets", said, f"机器人正在运行：{', '.join(live)}" if live else "空闲")


def listening(path: Path) -> list[str]:
    """Return at which doors of a home folder a living process listens."""
    where = Endpoints(path)
    return [door.name for door in DOORS if is_listening(where.socket(door))]


def port(settings: LaunchSettings, *, running: bool) -> HealthFinding:
    """Look whether page and API can listen, or whose robot does so already."""
    host, number = settings.host, settings.port
    try:
        family, kind, _, _, address = socket.getaddrinfo(host, number, type=socket.SOCK_STREAM)[0]
        with closing(socket.socket(family, kind)) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind(address)
    except OSError as error:
        if running:
            return ok("port", f"{host}:{number} serves the running robot",
                      f"{host}:{number} 正由运行中的机器人使用")  # fmt: skip
        there = next((one for one in find_robots() if one.port == number), None)
        if there is not None:
            found = f"{host}:{number}: {describe_robot(there)}"
            return warn(
                "port",
                BilingualWords(f"{found} runs there", f"{found} 正在运行"),
                BilingualWords(
                    "nothing, or PONS_PORT for a second robot",
                    "无需操作；第二台机器人请设置 PONS_PORT",
                ),
            )
        return fail(
            "port",
            BilingualWords(
                f"{host}:{number}: {error.strerror or error}", f"{host}:{number}：无法监听"
            ),
            BilingualWords(
                "stop what listens there, or set PONS_PORT", "请停止占用者或设置 PONS_PORT"
            ),
        )
    return ok("port", f"{host}:{number} is free", f"{host}:{number} 空闲")
