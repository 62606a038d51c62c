"""The owner's model: its folder judged, and the real library hearing a toy model in its process."""

from __future__ import annotations

import importlib.util
import math
import shutil
from pathlib import Path

import numpy as np
import onnx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.plan import Language
from planner.settings import Settings, VoiceSettings
from planner.site import KnownPlaces
from planner.voice import Recognition, Sound, VoiceFailure, VoiceWorker
from planner.voice.sherpa_model import find_model, open_model
from planner.voice_factory import VoiceParts
from tests.planner.api.fakes import two_room
from tests.planner.voice.toy_transducer import FAINT, LOUD, MIDDLING, write_model
from wire import ConfigError

pytestmark = pytest.mark.nightly(keep=5)


needs_sherpa = pytest.mark.skipif(
    importlib.util.find_spec("sherpa_onnx") is None, reason="sherpa-onnx is not installed"
)


def noise(
    loudness: int, seconds: float = 0.8, *, rate_hz: int = 16_000, channels: int = 1
) -> Sound:
    """Return steady noise between two silences."""
    chance = np.random.default_rng(1)
    heard = chance.normal(0.0, loudness, int(seconds * rate_hz)).clip(-32_768, 32_767)
    still = np.zeros(rate_hz // 4)
    samples = np.concatenate([still, heard, still]).astype("<i2")
    return Sound(rate_hz, channels, np.repeat(samples, channels).tobytes())


def code_of(folder: Path) -> str:
    with pytest.raises(ConfigError) as refused:
        find_model(folder)
    return str(refused.value)


def test_a_wrong_folder_is_refused_with_what_is_expected_and_what_is_there(tmp_path: Path) -> None:
    told = code_of(tmp_path / "nowhere")
    assert told.startswith("voice_folder")
    assert "tokens.txt, encoder*.onnx and decoder*.onnx" in told
    (tmp_path / "model.onnx").touch()
    told = code_of(tmp_path)
    assert "lacks tokens.txt, encoder*.onnx, decoder*.onnx" in told
    assert told.endswith("there: model.onnx")
    assert code_of(tmp_path / "model.onnx").startswith("voice_folder")  # a file is no folder
    for number in range(99):
        (tmp_path / f"{number}.txt").touch()
    assert code_of(tmp_path).endswith("and 88 more")


@pytest.mark.parametrize("role", ["encoder", "decoder", "tokens.txt"])
def test_each_missing_file_is_named(tmp_path: Path, role: str) -> None:
    folder = write_model(tmp_path)
    for file in folder.glob(f"{role}*"):
        file.unlink()
    assert f"lacks {role}" in code_of(folder)


@needs_sherpa
def test_of_several_forms_the_quantised_is_taken_but_for_the_decoder(tmp_path: Path) -> None:
    for form in ("-epoch-9", "-epoch-9.int8"):
        write_model(tmp_path, suffix=form)
    names = {role: Path(path).name for role, path in find_model(tmp_path).paths.items()}
    assert names == {
        "tokens": "tokens.txt",
        "encoder": "encoder-epoch-9.int8.onnx",
        "decoder": "decoder-epoch-9.onnx",
        "joiner": "joiner-epoch-9.int8.onnx",
    }


@needs_sherpa
def test_without_a_joiner_it_is_a_paraformer(tmp_path: Path) -> None:
    write_model(tmp_path)
    (tmp_path / "joiner.onnx").unlink()
    assert "joiner" not in find_model(tmp_path).paths


def test_a_missing_package_is_told_with_its_cure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
    told = code_of(write_model(tmp_path))
    assert told.startswith("voice_package")
    assert "pons-robot[sherpa]" in told


def test_a_server_and_a_model_contradict_each_other(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="voice_contradictory"):
        open_model(VoiceSettings(url="http://127.0.0.1:9/v1", folder=tmp_path))
    assert open_model(VoiceSettings()) is None


async def hear(folder: Path, *sounds: Sound) -> list[Recognition]:
    worker = open_model(VoiceSettings(folder=folder))
    assert isinstance(worker, VoiceWorker)
    try:
        return [await worker.hear(sound) for sound in sounds]
    finally:
        await worker.close()


@needs_sherpa
async def test_the_real_library_hears_both_languages(tmp_path: Path) -> None:
    folder = write_model(tmp_path)
    heard = await hear(folder, *map(noise, (FAINT, MIDDLING, LOUD)))
    assert [one.transcript for one in heard] == ["go home", "停", "stop"]
    assert [one.language for one in heard] == [Language.EN, Language.ZH, Language.EN]
    assert all(one.sure and one.by == "sherpa" for one in heard)


@needs_sherpa
async def test_silence_is_nothing_and_any_rate_and_two_channels_are_heard(tmp_path: Path) -> None:
    silence, at_44 = noise(0), noise(LOUD, rate_hz=44_100, channels=2)
    heard = await hear(write_model(tmp_path), silence, at_44, noise(LOUD, rate_hz=16_000))
    assert heard[0] == Recognition("", 0.0, understood=False, by="sherpa")
    assert heard[1].transcript in ("stop", "停")  # resampled noise has less of the high sounds
    assert heard[2].transcript == "stop"


def without_kind(file: Path) -> None:
    model = onnx.load(file)
    del model.metadata_props[:]
    onnx.save(model, file)


@needs_sherpa
@pytest.mark.parametrize("wrong", ["empty", "text", "no kind", "another's", "tokens", "few tokens"])
async def test_files_that_are_no_model_cost_the_process_and_never_the_planner(
    tmp_path: Path, wrong: str
) -> None:
    folder = write_model(tmp_path)
    encoder = folder / "encoder.onnx"
    match wrong:
        case "empty":
            encoder.write_bytes(b"")
        case "text":
            encoder.write_text("hello", "utf-8")
        case "no kind":
            without_kind(encoder)  # the library ends its process over this
        case "another's":
            shutil.copy(folder / "joiner.onnx", encoder)
        case "tokens":
            (folder / "tokens.txt").write_text("a b c d\n", "utf-8")
        case _:
            (folder / "tokens.txt").write_text("<blk> 0\n", "utf-8")
    with pytest.raises(VoiceFailure) as failure:
        await hear(folder, noise(LOUD))
    assert failure.value.code == "recogniser_unavailable"


@needs_sherpa
async def test_a_model_that_can_not_be_read_is_not_told_as_what_hears(tmp_path: Path) -> None:
    folder = write_model(tmp_path)
    parts = VoiceParts(Settings(voice=VoiceSettings(folder=folder)), KnownPlaces(two_room()))
    assert parts.abilities().recogniser == "sherpa"
    (folder / "encoder.onnx").write_text("hello", "utf-8")
    recogniser = parts.recogniser()
    try:
        assert (await recogniser.hear(noise(LOUD))).instead_of == "sherpa"
        assert parts.abilities().recogniser == "grammar"
        assert parts.abilities().languages == (Language.EN,)
    finally:
        await parts.close()


@needs_sherpa
@given(st.text(max_size=700), st.lists(st.floats(allow_nan=True, allow_infinity=True), max_size=5))
def test_any_result_is_one_line_and_a_chance(text: str, logs: list[float]) -> None:
    from planner.voice.sherpa import MAX_TEXT, read_result

    heard = read_result(text, logs)
    assert 0.0 <= heard.confidence <= 1.0
    assert len(heard.transcript) <= 2 * MAX_TEXT  # small letters may take two where one was
    assert not set(heard.transcript) & set("\n\r\t\x00")
    assert heard.understood is (heard.confidence >= 0.3)


@needs_sherpa
def test_no_probabilities_are_never_sure() -> None:
    from planner.voice.sherpa import read_result

    heard = read_result(" GO  HOME ", [])
    assert (heard.transcript, heard.understood, heard.sure) == ("go home", True, False)
    assert read_result("go", [math.log(0.9)]).sure


def pieces(sound: Sound, step_s: float = 0.1) -> list[Sound]:
    step = int(step_s * sound.rate_hz) * 2
    starts = range(0, len(sound.pcm), step)
    return [Sound(sound.rate_hz, 1, sound.pcm[start : start + step]) for start in starts]


@needs_sherpa
async def test_a_stop_is_heard_while_it_is_spoken_and_an_order_is_not(tmp_path: Path) -> None:
    worker = open_model(VoiceSettings(folder=write_model(tmp_path)))
    assert worker is not None
    try:
        for loudness, wanted in ((LOUD, "stop"), (MIDDLING, "停"), (FAINT, None)):
            (listener,) = worker.listen()
            heard = [await listener.take(piece) for piece in pieces(noise(loudness, 1.0))]
            found = [number for number, each in enumerate(heard) if each is not None]
            if wanted is None:
                assert found == []
                continue
            first = heard[found[0]]
            assert first is not None
            assert (first.transcript, first.by) == (wanted, "sherpa")
            assert found[0] < 8  # of 15 pieces, 10 of them sound
    finally:
        await worker.close()


@needs_sherpa
async def test_what_follows_a_pause_is_read_alone(tmp_path: Path) -> None:
    worker = open_model(VoiceSettings(folder=write_model(tmp_path)))
    assert worker is not None
    try:
        (listener,) = worker.listen()
        still = Sound(16_000, 1, bytes(2 * 16_000))
        order = [await listener.take(piece) for piece in pieces(noise(FAINT, 0.8))]
        await listener.take(still)
        stop = [await listener.take(piece) for piece in pieces(noise(LOUD, 0.8))]
        assert order == [None] * len(order)
        assert any(each is not None and each.transcript == "stop" for each in stop)
    finally:
        await worker.close()
