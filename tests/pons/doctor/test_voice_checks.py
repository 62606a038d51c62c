"""What doctor says of a server that hears and of the robot's own voice."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.settings import FILE
from pons.doctor import voice_checks
from pons.doctor.finding import HealthVerdict
from tests.planner.voice.speech import needs_espeak
from tests.planner.voice.test_sherpa import needs_sherpa
from tests.planner.voice.toy_transducer import write_model

pytestmark = pytest.mark.nightly(keep=4)


def home(tmp_path: Path, text: str) -> Path:
    (tmp_path / FILE).write_text(text, "utf-8")
    return tmp_path


def test_nothing_set_is_well(tmp_path: Path) -> None:
    for check in (voice_checks.transcription, voice_checks.speech):
        assert check(tmp_path).verdict is HealthVerdict.OK


def test_a_server_that_nobody_runs_is_told_and_does_no_more_harm(tmp_path: Path) -> None:
    text = '[voice]\nurl = "http://127.0.0.1:1/v1"\n[speech]\nengine = "server"\n'
    text += 'url = "http://127.0.0.1:1/v1"\nplayer = ["cat"]\n'
    for check in (voice_checks.transcription, voice_checks.speech):
        found = check(home(tmp_path, text))
        assert found.verdict is HealthVerdict.WARN
        assert "127.0.0.1:1" in found.found.en
        assert found.fix is not None


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ('[voice]\nurl = "https://voices.example/v1"\n', "voice_offhost"),
        ('[voice]\nurl = "http://169.254.169.254/v1"\n', "voice_url"),
        ('[voice]\nurl = "http://127.0.0.1/v1"\nkey_env = "NOT_SET_ANYWHERE"\n', "voice_key"),
        ('[voice]\nfolder = "no/such"\n', "voice_folder"),
        ('[voice]\nfolder = "x"\nurl = "http://127.0.0.1/v1"\n', "voice_contradictory"),
        ('[speech]\nengine = "espeak"\nplayer = ["no-such-program"]\n', "speech_program"),
        ('[speech]\nengine = "server"\n', "speech_incomplete"),
        ('[speech]\nquiet = "always"\n', "settings_malformed"),
        ('[voice]\nfast = true\n', "settings_malformed"),
    ],
)  # fmt: skip
def test_settings_that_refuse_to_start_are_told_by_their_code(
    tmp_path: Path, text: str, code: str
) -> None:
    check = voice_checks.speech if "speech" in text else voice_checks.transcription
    found = check(home(tmp_path, text))
    assert found.verdict is HealthVerdict.FAIL
    assert code in found.found.en


@needs_sherpa
def test_a_model_is_really_tried(tmp_path: Path) -> None:
    write_model(tmp_path / "ears")
    found = voice_checks.transcription(home(tmp_path, '[voice]\nfolder = "ears"\n'))
    assert (found.verdict, "heard 1 s of noise" in found.found.en) == (HealthVerdict.OK, True)
    (tmp_path / "ears" / "encoder.onnx").write_bytes(b"none")
    found = voice_checks.transcription(tmp_path)
    assert (found.verdict, "recogniser_unavailable" in found.found.en) == (HealthVerdict.WARN, True)


@needs_espeak
def test_espeak_is_really_tried(tmp_path: Path) -> None:
    text = '[speech]\nengine = "espeak"\nplayer = ["cat"]\n'
    assert "both languages" in voice_checks.speech(home(tmp_path, text)).found.en
    wrong = text + 'voice_zh = "klingon-9"\n'
    assert voice_checks.speech(home(tmp_path, wrong)).verdict is HealthVerdict.WARN
