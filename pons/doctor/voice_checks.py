"""Check what hears and speaks beside the built-in recogniser: servers that are set, programs."""

from __future__ import annotations

import asyncio
import os
import shutil
from pathlib import Path

from planner.outbound import Address
from planner.plan import Language
from planner.settings import Settings, SpeechSettings, load_settings
from planner.voice.speech_engines import ROUTE as SPEECH_ROUTE
from planner.voice.speech_engines import EspeakVoice, open_speech
from planner.voice.speech_output import SpeechFailure
from planner.voice.transcription import ROUTE, open_caller
from pons.doctor.finding import BilingualWords, HealthFinding, fail, ok, warn
from pons.doctor.reach import trouble_reaching
from wire import ConfigError

_FIX = BilingualWords(
    "mend [voice] or [speech] in settings.toml (docs/voice.md)",
    "请修正 settings.toml 的 [voice] 或 [speech]（docs/voice.md）",
)
_MEANWHILE = BilingualWords(
    "start the server or mend settings.toml; until then the built-in recogniser hears English",
    "请启动该服务器或修正 settings.toml；在此期间由内置识别器听英文",
)
TRIED = {Language.EN: "Hello.", Language.ZH: "你好。"}


def _settings(home: Path) -> Settings:
    return load_settings(home, os.environ)


def _wrong(name: str, wrong: ConfigError) -> HealthFinding:
    return fail(name, BilingualWords(str(wrong), str(wrong)), _FIX)


def transcription(home: Path) -> HealthFinding:
    """Connect to the server that hears; nothing is sent, so nothing is spent."""
    name = "transcription"
    try:
        chosen = _settings(home).voice
        if chosen.url is None:
            return ok(name, "none is set: English orders alone", "未设置：只能听英文指令")
        address = Address.parse(chosen.url, ROUTE, "voice")
        open_caller(chosen)
    except ConfigError as wrong:
        return _wrong(name, wrong)
    where = f"{chosen.model} at {address.host}:{address.port}"
    trouble = trouble_reaching(address)
    if trouble is None:
        return ok(name, f"{where} can be reached", f"{where} 可以连接")
    return warn(name, BilingualWords(f"{where}: {trouble}", f"{where}：{trouble}"), _MEANWHILE)


def speech(home: Path) -> HealthFinding:
    """Have the robot's voice make a sound in both languages; nothing is played."""
    name = "speech"
    try:
        chosen = _settings(home).speech
        open_speech(chosen)
    except ConfigError as wrong:
        return _wrong(name, wrong)
    if chosen.engine == "none":
        return ok(name, "mute: only pages read aloud", "静音：仅由网页朗读")
    return _server(name, chosen) if chosen.engine == "server" else _espeak(name, chosen)


def _server(name: str, chosen: SpeechSettings) -> HealthFinding:
    address = Address.parse(chosen.url or "", SPEECH_ROUTE, "speech")
    where = f"{chosen.model} at {address.host}:{address.port}"
    trouble = trouble_reaching(address)
    if trouble is None:
        return ok(name, f"{where} can be reached", f"{where} 可以连接")
    return warn(name, BilingualWords(f"{where}: {trouble}", f"{where}：{trouble}"), _FIX)


def _espeak(name: str, chosen: SpeechSettings) -> HealthFinding:
    engine = EspeakVoice(chosen)

    async def make() -> int:
        return sum([len(await engine.make(text, each)) for each, text in TRIED.items()])

    try:
        made = asyncio.run(make())
    except SpeechFailure as failure:
        return warn(name, BilingualWords(str(failure), str(failure)), _FIX)
    player = shutil.which(chosen.player[0])
    return ok(name, f"espeak-ng made {made} bytes in both languages; {player} plays them",
              f"espeak-ng 已生成两种语言的语音（{made} 字节），由 {player} 播放")  # fmt: skip
