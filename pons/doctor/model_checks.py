"""Check the parts that understand people: the model endpoint if set, and the recogniser."""

from __future__ import annotations

import asyncio
import os
from pathlib import Path
from typing import TYPE_CHECKING

from planner.outbound import Address, CallFailure
from planner.outbound.reach import trouble_reaching
from planner.settings import load_settings
from planner.site import Site
from pons.doctor.finding import BilingualWords, HealthFinding, fail, ok, warn
from wire import ConfigError

if TYPE_CHECKING:
    from planner.settings import ToolServerSettings

_FIX_MODEL = BilingualWords(
    "start the model's server or mend [model] in settings.toml; until then the offline brain plans",
    "请启动模型服务或修正 settings.toml 的 [model]；在此期间由离线大脑回答",
)


def model(home: Path) -> HealthFinding:
    """Connect to the model's server; nothing is sent, so nothing is spent."""
    try:
        chosen = load_settings(home, os.environ).model
        if chosen is None:
            return ok("model", "none is set: the offline brain plans", "未设置模型：由离线大脑规划")
        address = Address.parse(chosen.url)
    except ConfigError as wrong:
        fix = BilingualWords(
            "mend settings.toml or PONS_MODEL_URL", "请修正 settings.toml 或 PONS_MODEL_URL"
        )
        return fail("model", BilingualWords(str(wrong), str(wrong)), fix)
    where = f"{chosen.name} at {address.host}:{address.port}"
    trouble = trouble_reaching(address)
    if trouble is None:
        return ok("model", f"{where} can be reached", f"{where} 可以连接")
    return warn("model", BilingualWords(f"{where}: {trouble}", f"{where}：{trouble}"), _FIX_MODEL)


_FIX_TOOLS = BilingualWords(
    "start the server or mend its table under [tools]; the robot drives on without it",
    "请启动服务器或修正 [tools] 中它的表；没有它机器人照常行驶",
)


def tools(home: Path) -> list[HealthFinding]:
    """Ask each server under [tools] for its tools; none of them is called."""
    try:
        chosen = load_settings(home, os.environ)
    except ConfigError:  # the line on the model tells it
        return []
    return [_tool_server(name, server) for name, server in chosen.tools.items()]


def _tool_server(name: str, settings: ToolServerSettings) -> HealthFinding:
    from planner.outbound.tool_server import ToolServer
    from planner.tool_servers.listing import judge_listing

    async def fetch() -> list[dict[str, object]]:
        key = settings.key.get_secret_value() if settings.key is not None else ""
        server = ToolServer(
            settings.address, key, timeout_s=settings.timeout_s, most_bytes=settings.max_bytes
        )
        try:
            return await server.list_tools()
        finally:
            await server.close()

    where = f"tools.{name}"
    try:
        listing = judge_listing(name, settings, asyncio.run(fetch()))
    except CallFailure as failure:
        told = f"{settings.address.host}:{settings.address.port}: {failure.why}"
        return warn(where, BilingualWords(told, told), _FIX_TOOLS)
    told = ", ".join(t.name + " (writes)" * t.writes for t in listing.tools) or "none"
    rest = "; ".join(f"{left}: {code}" for left, code in listing.left_out)
    found = BilingualWords(
        f"may be asked: {told}" + (f"; not: {rest}" if rest else ""),
        f"可以询问：{told}" + (f"；不可：{rest}" if rest else ""),
    )
    return ok(where, found.en, found.zh) if listing.tools else warn(where, found, _FIX_TOOLS)


def recogniser(site: Site | None) -> HealthFinding:
    """Load the recogniser with the site's English names and list those that can't be said."""
    try:
        from planner.voice.sphinx import Sphinx
    except ImportError as error:
        return warn(
            "recogniser",
            BilingualWords(f"no spoken orders: {error}", f"无法使用语音：{error}"),
            BilingualWords(
                "run `make clean setup PYTHON=python3.11` (or 3.13): pocketsphinx has no wheel "
                "for Python 3.12 on ARM; typing works meanwhile",
                "请运行 `make clean setup PYTHON=python3.11`（或 3.13）：pocketsphinx 没有用于 "
                "ARM 上 Python 3.12 的安装包；文字输入不受影响",
            ),
        )
    names = [name for place in site.places for name in place.said_in_english] if site else []
    try:
        left_out = Sphinx(names).language.left_out
    except (OSError, RuntimeError, ValueError) as error:
        return warn(
            "recogniser",
            BilingualWords(f"no spoken orders: {error}", f"无法使用语音：{error}"),
            BilingualWords("run `make clean setup`", "请运行 `make clean setup`"),
        )
    if left_out:
        shown = ", ".join(left_out[:20])
        return warn(
            "recogniser",
            BilingualWords(
                f"names that can't be spoken: {shown}", f"无法用语音说出的名称：{shown}"
            ),
            BilingualWords(
                "give these places an alias in plain English words", "请为这些地点添加普通英文别名"
            ),
        )
    return ok("recogniser", f"English, {len(names)} names; Chinese by typing",
              f"英文语音，{len(names)} 个名称；中文请用文字")  # fmt: skip
