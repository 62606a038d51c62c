"""Check the servers known by name, and that the lines of docs/models.md work as they stand."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from planner.outbound import Address
from planner.settings import FILE, OWN_FIELDS, PRESETS, JsonMode, PresetName, load_settings
from tests.conftest import ROOT
from wire import ConfigError

KEY = "sk-secret-0123456789"
DOCUMENTED = re.findall(
    r"```toml\n(.*?)```", (ROOT / "docs" / "models.md").read_text("utf-8"), re.DOTALL
)


def load(home: Path, text: str, **environment: str) -> Any:
    (home / FILE).write_text(text, "utf-8")
    return load_settings(home, environment).model


@pytest.mark.parametrize("name", PresetName)
def test_every_preset_can_be_asked(name: PresetName, tmp_path: Path) -> None:
    known = PRESETS[name]
    address = Address.parse(known.url)
    assert address.local == (not known.key_name), "what needs a key is elsewhere, and the reverse"
    assert address.local or address.url.startswith("https://")
    assert not known.quiet.keys() & OWN_FIELDS
    found = load(tmp_path, f'[model]\npreset = "{name}"\nname = "m"\nkey = "{KEY}"\n')
    assert (found.url, found.max_tokens, found.known_preset) == (known.url, known.max_tokens, known)


def test_the_documented_lines_are_the_presets(tmp_path: Path) -> None:
    """Each section of docs/models.md is read as it stands, and together they name every preset."""
    named = set()
    for lines in DOCUMENTED:
        words = dict.fromkeys(re.findall(r'key_env = "(\w+)"', lines), KEY)
        (tmp_path / "key").write_text(KEY)
        found = load(tmp_path, lines, **words)
        named.add(found.preset)
        local = Address.parse(found.url).local
        assert local or (found.allow_offhost and found.key is not None), lines
    assert named >= set(PresetName)


def test_own_words_win_over_the_preset(tmp_path: Path) -> None:
    lines = (
        '[model]\npreset = "ollama"\nname = "m"\nurl = "http://127.0.0.1:9/v1"\nmax_tokens = 300\n'
    )
    found = load(tmp_path, lines)
    assert (found.url, found.max_tokens) == ("http://127.0.0.1:9/v1", 300)
    assert found.mode is None
    assert PRESETS[PresetName.ANTHROPIC].mode is JsonMode.TOOL


def test_a_preset_by_environment_leaves_the_key_of_the_file_behind(tmp_path: Path) -> None:
    lines = f'[model]\npreset = "openai"\nname = "m"\nkey = "{KEY}"\n'
    local = load(tmp_path, lines, PONS_MODEL_PRESET="ollama")
    assert (local.url, local.key) == (PRESETS[PresetName.OLLAMA].url, None)
    assert load(tmp_path, "", PONS_MODEL_PRESET="vllm", PONS_MODEL="m").preset == "vllm"
    same = load(tmp_path, lines, PONS_MODEL_PRESET="openai")
    assert same.key.get_secret_value() == KEY


@pytest.mark.parametrize(
    ("lines", "code", "told"),
    [
        ('preset = "openai"', "model_key", "OPENAI_API_KEY"),
        ('preset = "skynet"', "settings_malformed", "deepseek"),
        ('preset = "ollama"\nextra_body = {model = "x"}', "settings_malformed", "model"),
        ('preset = "ollama"\nextra_body = {stream = true}', "settings_malformed", "stream"),
        ('preset = "ollama"\nextra_body = {temperature = 1}', "settings_malformed", "temperature"),
        ('preset = "ollama"\nextra_body = {messages = []}', "settings_malformed", "messages"),
        ('preset = "ollama"\nextra_body = {response_format = {}}', "settings_malformed", "itself"),
        ('preset = "ollama"\nextra_body = {x = nan}', "settings_malformed", "JSON"),
        ('preset = "ollama"\nextra_body = {x = 2026-01-01}', "settings_malformed", "JSON"),
        (f'preset = "ollama"\nextra_body = {{x = "{"a" * 9000}"}}', "settings_malformed", "large"),
        ('preset = "ollama"\nextra_body.a.a.a.a.a.a.a.a.a = 1', "settings_malformed", "deep"),
    ],
)  # fmt: skip
def test_what_is_wrong_refuses_to_start(lines: str, code: str, told: str, tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as wrong:
        load(tmp_path, f'[model]\nname = "m"\n{lines}\n', OPENAI_API_KEY=KEY)
    assert wrong.value.code == code
    assert told in str(wrong.value)
    assert KEY not in str(wrong.value)
