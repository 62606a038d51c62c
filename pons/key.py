"""Make the operator's key: ``pons key new``. It never replaces one and never prints one."""

from __future__ import annotations

import os
import secrets
import sys
from typing import TYPE_CHECKING

from bridge.operator_key import FILE
from pons.terminal import pick

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

KEY_BYTES = 32
"""Of chance, written in hexadecimal: nobody guesses it, and a person can type it into the page."""
EXIT_DONE, EXIT_REFUSED = 0, 3


def run(settings: LaunchSettings) -> int:
    """Write $PONS_HOME/operator.key for this user alone; 0 made, 3 refused."""
    path = settings.home / FILE
    try:
        settings.home.mkdir(mode=0o700, exist_ok=True)  # before the first `pons up`, as docs say
        opened = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o600)
    except FileExistsError:
        print(
            pick(
                f"operator_key_exists: {path} is there and stays; remove it first, then page and "
                "shells need the new one",
                f"operator_key_exists: {path} 已存在，不会覆盖；请先删除旧密钥",
            ),
            file=sys.stderr,
        )
        return EXIT_REFUSED
    except OSError as error:
        print(
            f"home_unwritable: {path}: {error.strerror}; "
            + pick("run this as the bridge's user", "无法写入；请以 bridge 的用户执行"),
            file=sys.stderr,
        )
        return EXIT_REFUSED
    with os.fdopen(opened, "w", encoding="ascii") as file:
        file.write(secrets.token_hex(KEY_BYTES) + "\n")
    print(
        pick(
            f"made {path}: {KEY_BYTES} random bytes, readable by this user alone; the bridge takes "
            "it at its next start",
            f"已生成 {path}，仅当前用户可读；bridge 下次启动时生效",
        )
    )
    return EXIT_DONE


def offer_key(settings: LaunchSettings) -> None:
    """Offer a person at a terminal to make the key that a robot of metal can't be armed without."""
    if (settings.home / FILE).exists() or not sys.stdin.isatty():
        return
    asked = pick("There is no operator's key yet. Make one?", "还没有操作员密钥。现在生成吗？")
    if input(f"{asked} [Y/n] ").strip().lower() in ("", "y", "yes", "是"):
        run(settings)
