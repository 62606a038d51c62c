"""Check the machine itself: Python, page size, real-time rights, memory, Node."""

from __future__ import annotations

import os
import platform
import pwd
import shutil
import subprocess
import sys
import threading

from bridge.realtime import Right, take_fifo
from pons.doctor.finding import BilingualWords, HealthFinding, fail, ok, warn
from pons_assets import IS_INSTALLED

USUAL_PAGE_BYTES = 4096
NODE_LOWEST = (20, 19)
_LOCK = "from bridge.realtime import lock_memory as l; r = l(); print(int(r.granted), r.detail)"


def python() -> HealthFinding:
    """Look at the interpreter that runs us."""
    have = platform.python_version()
    if (3, 11) <= sys.version_info[:2] <= (3, 13):
        return ok("python", f"Python {have}", f"Python {have}")
    return fail(
        "python",
        BilingualWords(
            f"Python {have}; needed: 3.11, 3.12 or 3.13", f"Python {have}；需要 3.11 至 3.13"
        ),
        BilingualWords(
            "install one and run `make clean setup PYTHON=python3.12`",
            "安装后运行 `make clean setup PYTHON=python3.12`",
        ),
    )


def page_size() -> HealthFinding:
    """Look at the kernel's page size: some boards with 64-bit ARM use 16 or 64 KiB."""
    size = os.sysconf("SC_PAGE_SIZE")
    said = f"{size // 1024} KiB pages on {platform.machine()}"
    if size == USUAL_PAGE_BYTES:
        return ok("page_size", said, f"{platform.machine()}，内存页 {size // 1024} KiB")
    return warn(
        "page_size",
        BilingualWords(
            f"{said}; some binary packages are built for 4 KiB only",
            f"内存页 {size // 1024} KiB；部分二进制包只支持 4 KiB",
        ),
        BilingualWords(
            "if an import fails, boot the 4 KiB kernel (Raspberry Pi 5: kernel=kernel8.img in "
            "config.txt)",
            "若导入失败，请改用 4 KiB 内核（树莓派 5：config.txt 中写 kernel=kernel8.img）",
        ),
    )


def real_time(priority: int, *, virtual: bool) -> HealthFinding:
    """Try the bridge's own request for SCHED_FIFO in a thread that ends at once."""
    got: list[Right] = []
    thread = threading.Thread(target=lambda: got.append(take_fifo(priority)))
    thread.start()
    thread.join()
    if got and got[0].granted:
        said = f"SCHED_FIFO {priority} granted"
        return ok("real_time", said, f"已获得 SCHED_FIFO {priority}")
    detail = got[0].detail if got else "no answer"
    grade = warn if virtual else fail  # without it a robot of metal does not move: row NOT_RT
    return grade(
        "real_time",
        BilingualWords(f"no SCHED_FIFO: {detail}", f"没有实时优先级：{detail}"),
        BilingualWords(
            f"add '{_user()} - rtprio {priority + 10}' to /etc/security/limits.d/pons.conf and log "
            "in again; as a service, deploy/systemd does it",
            f"在 /etc/security/limits.d/pons.conf 中加入 '{_user()} - rtprio {priority + 10}' "
            "后重新登录；作为服务运行时 deploy/systemd 已配置",
        ),
    )


def locked_memory() -> HealthFinding:
    """Try the bridge's own request to lock its memory, in a process that ends at once."""
    done = subprocess.run(
        [sys.executable, "-c", _LOCK], capture_output=True, text=True, timeout=30, check=False
    )
    granted, _, detail = done.stdout.strip().partition(" ")
    if granted == "1":
        return ok("locked_memory", "memory can be locked", "可以锁定内存")
    detail = detail or (done.stderr.strip().splitlines() or ["no answer"])[-1]
    return warn(
        "locked_memory",
        BilingualWords(f"memory can't be locked: {detail}", f"无法锁定内存：{detail}"),
        BilingualWords(
            f"add '{_user()} - memlock unlimited' to /etc/security/limits.d/pons.conf and log in "
            "again; as a service, deploy/systemd does it",
            f"在 /etc/security/limits.d/pons.conf 中加入 '{_user()} - memlock unlimited' "
            "后重新登录；作为服务运行时 deploy/systemd 已配置",
        ),
    )


def node() -> HealthFinding:
    """Look for Node; only building the page needs it, and `make setup` can bring it as a wheel."""
    if IS_INSTALLED:
        return ok("node", "not needed: the page came built", "不需要：网页已随安装包构建")
    path = shutil.which("node")
    found = _node_version(path) if path else None
    if found is not None and found >= NODE_LOWEST:
        shown = ".".join(map(str, found))
        return ok("node", f"Node {shown} (only builds the page)", f"Node {shown}（只用于构建网页）")
    return ok(
        "node",
        "no Node that can build the page; `make setup` fetches one as a Python package",
        "没有可用的 Node；`make setup` 会以 Python 包的形式获取",
    )


def _node_version(path: str) -> tuple[int, int] | None:
    try:
        done = subprocess.run(
            [path, "--version"], capture_output=True, text=True, timeout=10, check=False
        )
        major, minor, *_ = done.stdout.strip().removeprefix("v").split(".")
        return int(major), int(minor)
    except (OSError, ValueError, subprocess.SubprocessError):
        return None


def _user() -> str:
    """Return the user that would be given the right."""
    try:
        return os.environ.get("SUDO_USER") or pwd.getpwuid(os.getuid()).pw_name
    except KeyError:
        return f"#{os.getuid()}"
