"""Check what hears and speaks beside the built-in recogniser: servers, a model, programs."""

from __future__ import annotations

import array
import asyncio
import os
import random
import shutil
import time
from pathlib import Path

from planner.outbound import Address
from planner.outbound.reach import trouble_reaching
from planner.plan import Language
from planner.settings import Settings, SpeechSettings, VoiceSettings, load_settings
from planner.voice import Sound, VoiceFailure, VoiceWorker
from planner.voice.sherpa_model import open_model
from planner.voice.speech_engines import ROUTE as SPEECH_ROUTE
from planner.voice.speech_engines import EspeakVoice, open_speech
from planner.voice.speech_output import SpeechFailure
from planner.voice.transcription import ROUTE, open_caller
from pons.doctor.finding import BilingualWords, HealthFinding, fail, ok, warn
from wire import ConfigError

_FIX = BilingualWords(
    "mend [voice] or [speech] in settings.toml (docs/voice.md)",
    "请修正 settings.toml 的 [voice] 或 [speech]（docs/voice.md）",
)
_MEANWHILE = BilingualWords(
    "start the server or mend settings.toml; until then the built-in recogniser hears English",
    "请启动该服务器或修正 settings.toml；在此期间由内置识别器听英文",
)
_FIX_MODEL = BilingualWords(
    "unpack a streaming model that sherpa-onnx reads into that folder (docs/voice.md); until then "
    "the built-in recogniser hears English",
    "请把 sherpa-onnx 可读取的流式模型解压到该文件夹（docs/voice.md）；在此期间由内置识别器听英文",
)
TRIED = {Language.EN: "Hello.", Language.ZH: "你好。"}
_NOISE_HZ = 16_000
"""A second of it is what a model is tried with."""


def _settings(home: Path) -> Settings:
    return load_settings(home, os.environ)


def _wrong(name: str, wrong: ConfigError) -> HealthFinding:
    return fail(name, BilingualWords(str(wrong), str(wrong)), _FIX)


def transcription(home: Path) -> HealthFinding:
    """Connect to the server that hears, sending nothing, or let the model hear some noise."""
    name = "transcription"
    try:
        chosen = _settings(home).voice
        model = open_model(chosen)
        if model is not None:
            return _try_model(name, chosen, model)
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


def _try_model(name: str, chosen: VoiceSettings, model: VoiceWorker) -> HealthFinding:
    chance = random.Random(0)
    samples = array.array("h", [int(chance.gauss(0.0, 1_000.0)) for _ in range(_NOISE_HZ)])

    async def hear() -> float:
        """Return how long the loaded model takes [s]."""
        try:
            await model.hear(Sound(_NOISE_HZ, 1, samples.tobytes()))
            began_s = time.monotonic()
            await model.hear(Sound(_NOISE_HZ, 1, samples.tobytes()))
            return time.monotonic() - began_s
        finally:
            await model.close()

    where = f"{chosen.folder}"
    try:
        took_s = asyncio.run(hear())
    except VoiceFailure as failure:
        return warn(name, BilingualWords(f"{where}: {failure}", f"{where}：{failure}"), _FIX_MODEL)
    return ok(name, f"the model in {where} heard 1 s of noise in {took_s:.2f} s",
              f"{where} 中的模型用 {took_s:.2f} 秒听完 1 秒噪声")  # fmt: skip


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
