"""Check that what was set for one model's host never travels to another that a command names."""

from __future__ import annotations

import logging
from pathlib import Path

import pytest

from planner.settings import FILE
from pons.evals.model_access import choose_model

KEY = "sk-secret-0123456789"
ELSEWHERE = "http://192.168.1.9:11434/v1"
OWNERS = "https://api.openai.com/v1"
BY_FILE = (
    '[model]\npreset = "openai"\nname = "own"\nallow_offhost = true\nextra_body = {user = "me"}\n'
    "allow_pictures_offhost = true\n"
)
BY_ENVIRONMENT = {
    "PONS_MODEL": "own",
    "PONS_MODEL_ALLOW_OFFHOST": "1",
    "PONS_MODEL_ALLOW_PICTURES_OFFHOST": "1",
}


@pytest.mark.parametrize(
    ("text", "environment", "word", "kept"),
    [
        (BY_FILE, {}, f"q@{ELSEWHERE}", False),
        (BY_FILE, {}, ELSEWHERE, False),
        (BY_FILE, {}, "http://api.openai.com/v1", False),
        (BY_FILE, {}, "q", True),
        (BY_FILE, {}, f"q@{OWNERS}", True),
        (BY_FILE, {"PONS_MODEL_URL": ELSEWHERE}, f"q@{ELSEWHERE}", True),
        (BY_FILE, {"PONS_MODEL_URL": ELSEWHERE}, "q@https://api.deepseek.com/v1", False),
        ("", {**BY_ENVIRONMENT, "PONS_MODEL_PRESET": "openai"}, f"q@{ELSEWHERE}", False),
        ("", {**BY_ENVIRONMENT, "PONS_MODEL_URL": OWNERS}, f"q@{ELSEWHERE}", False),
        ("", {**BY_ENVIRONMENT, "PONS_MODEL_URL": OWNERS}, "", True),
        ("", {"PONS_MODEL_ALLOW_OFFHOST": "1"}, f"q@{ELSEWHERE}", True),  # meant for this call
    ],
)
def test_a_key_of_the_environment_stays_with_its_host(
    text: str,
    environment: dict[str, str],
    word: str,
    kept: bool,
    tmp_path: Path,
    caplog: pytest.LogCaptureFixture,
) -> None:
    caplog.set_level(logging.WARNING)
    (tmp_path / FILE).write_text(text, "utf-8")
    settings, model = choose_model(word, tmp_path, {**environment, "PONS_MODEL_KEY": KEY})
    assert settings.model == model
    assert (model.key is not None, model.allow_offhost) == (kept, kept)
    once = environment in ({"PONS_MODEL_URL": ELSEWHERE}, {"PONS_MODEL_ALLOW_OFFHOST": "1"})
    assert model.allow_pictures_offhost == (kept and not once), "neither host was given that yes"
    assert bool(model.extra_body) == (kept and bool(text))
    assert ("PONS_MODEL_KEY is not used" in caplog.text) == (not kept)
    assert KEY not in caplog.text
