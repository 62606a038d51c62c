"""Check the owner's settings: what switches a model on, whose key goes where, what refuses."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.settings import (
    FILE,
    JsonMode,
    ModelSettings,
    find_exposed,
    list_keys,
    load_settings,
)
from wire import ConfigError

KEY = "sk-secret-0123456789"
LOCAL = '[model]\nurl = "http://127.0.0.1:11434/v1"\nname = "qwen3:8b"\n'


def model(home: Path, text: str = "", **environment: str) -> ModelSettings | None:
    if text:
        (home / FILE).write_text(text, "utf-8")
    return load_settings(home, environment).model


def key_of(found: ModelSettings | None) -> str | None:
    assert found is not None
    return found.key.get_secret_value() if found.key is not None else None


def test_nothing_set_is_no_model(tmp_path: Path) -> None:
    assert model(tmp_path) is None
    assert model(tmp_path, "# nothing yet\n") is None


def test_a_stray_key_switches_nothing_on(tmp_path: Path) -> None:
    stray = {"OPENAI_API_KEY": KEY, "OPENAI_BASE_URL": "https://api.openai.com/v1",
             "ANTHROPIC_API_KEY": KEY, "OPENAI_MODEL": "m"}  # fmt: skip
    assert model(tmp_path, **stray) is None
    found = model(tmp_path, LOCAL, **stray)
    assert key_of(found) is None


def test_a_model_by_file(tmp_path: Path) -> None:
    more = 'timeout_s = 7.5\nmode = "prompt"\nallow_offhost = true\nparallel = 1\n'
    found = model(tmp_path, LOCAL + more)
    assert found is not None
    assert (found.name, found.timeout_s, found.mode) == ("qwen3:8b", 7.5, JsonMode.PROMPT)
    assert (found.allow_offhost, found.parallel) == (True, 1)


def test_a_byte_order_mark_before_the_file_is_read_past(tmp_path: Path) -> None:
    assert model(tmp_path, "\ufeff" + LOCAL) == model(tmp_path, LOCAL)


def test_what_a_model_writes_is_kept_of_as_many_goals_as_are_set(tmp_path: Path) -> None:
    for more, goals in (("", 0), ("keep_replies = 1\n", 1), ("keep_replies = 200\n", 200)):
        found = model(tmp_path, LOCAL + more)
        assert found is not None
        assert found.keep_replies == goals


def test_every_key_that_is_set_is_listed(tmp_path: Path) -> None:
    keyed = [f'key = "{KEY}-{name}"\n' for name in ("model", "voice", "speech")]
    text = f'{LOCAL}{keyed[0]}[voice]\nurl = "http://127.0.0.1:1/v1"\n{keyed[1]}'
    text += f'[speech]\nengine = "server"\nurl = "http://127.0.0.1:1/v1"\n{keyed[2]}'
    (tmp_path / FILE).write_text(text, "utf-8")
    keys = list_keys(load_settings(tmp_path, {}))
    assert sorted(keys) == [f"{KEY}-{name}" for name in ("model", "speech", "voice")]
    (tmp_path / FILE).write_text(LOCAL, "utf-8")
    assert list_keys(load_settings(tmp_path, {})) == ()


def test_a_model_by_environment(tmp_path: Path) -> None:
    found = model(tmp_path, PONS_MODEL_URL="http://127.0.0.1:1/v1", PONS_MODEL="m",
                  PONS_MODEL_KEY=KEY, PONS_MODEL_ALLOW_OFFHOST="1")  # fmt: skip
    assert found is not None
    assert (found.url, found.name, found.allow_offhost) == ("http://127.0.0.1:1/v1", "m", True)
    assert key_of(found) == KEY


def test_the_environment_wins_over_the_file(tmp_path: Path) -> None:
    found = model(tmp_path, LOCAL, PONS_MODEL="other")
    assert found is not None
    assert (found.url, found.name) == ("http://127.0.0.1:11434/v1", "other")


def test_pictures_need_a_yes_of_their_own_for_their_own_host(tmp_path: Path) -> None:
    """The first yes is not the second, and a yes in the file is for the file's host."""
    first, second = "allow_offhost = true\n", "allow_pictures_offhost = true\n"
    here: dict[str, str] = {"PONS_MODEL_URL": "http://127.0.0.1:11434/other"}
    away: dict[str, str] = {"PONS_MODEL_URL": "http://192.168.1.9/v1"}
    yes: dict[str, str] = {"PONS_MODEL_ALLOW_PICTURES_OFFHOST": "1"}
    for text, environment, allowed in (
        (LOCAL + first, {}, False),
        (LOCAL + first, {"PONS_MODEL_ALLOW_OFFHOST": "1"}, False),
        (LOCAL + first + second, {}, True),
        (LOCAL + first + second, here, True),
        (LOCAL + first + second, away, False),
        (LOCAL + first + second, {**away, **yes}, True),
        (LOCAL + second, {"PONS_MODEL_ALLOW_PICTURES_OFFHOST": "no"}, False),
    ):
        found = model(tmp_path, text, **environment)
        assert found is not None
        assert found.allow_pictures_offhost is allowed, (text, environment)
        assert found.pictures is None, "whether it takes any is found out"


@pytest.mark.parametrize("source", ["key", "key_env", "key_file"])
def test_a_key_comes_from_one_place(source: str, tmp_path: Path) -> None:
    (tmp_path / "k").write_text(f"{KEY}\n")
    value = {"key": KEY, "key_env": "MY_KEY", "key_file": "k"}[source]
    assert key_of(model(tmp_path, f'{LOCAL}{source} = "{value}"\n', MY_KEY=KEY)) == KEY


def test_a_key_stays_with_its_host(tmp_path: Path) -> None:
    """The file's key is not sent to another host that the environment names."""
    text = f'{LOCAL}key = "{KEY}"\n'
    assert key_of(model(tmp_path, text, PONS_MODEL_URL="http://127.0.0.1:11434/other")) == KEY
    for url in (
        "http://127.0.0.1:11435/v1",
        "http://evil.example:11434",
        "https://127.0.0.1:11434",
    ):
        assert key_of(model(tmp_path, text, PONS_MODEL_URL=url)) is None
    assert key_of(model(tmp_path, text, PONS_MODEL_URL=url, PONS_MODEL_KEY="its-own")) == "its-own"


@pytest.mark.parametrize(
    ("text", "environment", "code", "told"),
    [
        (LOCAL + "tiemout_s = 3\n", {}, "settings_malformed", "unknown key 'model.tiemout_s'"),
        ("[modle]\nurl = 'x'\n", {}, "settings_malformed", "unknown key 'modle'"),
        (LOCAL + "keep_replies = 201\n", {}, "settings_malformed", "model.keep_replies"),
        (LOCAL + "keep_replies = -1\n", {}, "settings_malformed", "model.keep_replies"),
        (LOCAL + "keep_replies = true\n", {}, "settings_malformed", "model.keep_replies"),
        ("model = 3\n", {}, "settings_malformed", "table"),
        ("[model\n", {}, "settings_malformed", "TOML in UTF-8 (line 1)"),
        (LOCAL + "key = “mine”\n", {}, "settings_malformed", "TOML in UTF-8 (line"),
        ("a = [" * 2000, {}, "settings_malformed", "TOML"),
        ("a = " + "9" * 5000, {}, "settings_malformed", "TOML"),
        ("# " + "x" * 70_000, {}, "settings_malformed", "bytes"),
        ('[model]\nurl = "http://127.0.0.1/v1"\n', {}, "model_incomplete", "model.name"),
        ('[model]\nname = "m"\n', {}, "model_incomplete", "model.url"),
        ("", {"PONS_MODEL": "m"}, "model_incomplete", "PONS_MODEL_URL"),
        ("", {"PONS_MODEL_KEY": KEY}, "model_incomplete", "PONS_MODEL_URL"),
        ("", {"PONS_MODEL_URL": "http://127.0.0.1"}, "model_incomplete", "name"),
        (LOCAL + 'preset = ["ollama"]\n', {}, "settings_malformed", "model.preset"),
        (LOCAL + "preset = {}\n", {"PONS_MODEL_URL": "http://127.0.0.1:1"}, "settings_malformed",
         "model.preset"),
        ("[mission]\nreplan = 1\n", {}, "settings_malformed",
         "'mission.replan'; known: replans, decides, answer_s"),
        ("[budget.goal]\ncall = 1\n", {}, "settings_malformed", "known: calls"),
        ("[voice]\nurll = 'x'\n", {}, "settings_malformed", "key, key_env, key_file, timeout_s"),
        (LOCAL + "timeout_s = nan\n", {}, "settings_malformed", "timeout_s"),
        (LOCAL + "timeout_s = 1e9\n", {}, "settings_malformed", "timeout_s"),
        (LOCAL + 'mode = "magic"\n', {}, "settings_malformed", "mode"),
        (LOCAL + 'key = ""\n', {}, "model_key", "key"),
        (LOCAL + 'key = "two words"\n', {}, "model_key", "one word"),
        (LOCAL + 'key = "密钥"\n', {}, "model_key", "one word"),
        (LOCAL + "key = 12345678\n", {}, "model_key", "text"),
        (LOCAL + 'key_env = "NOT_SET"\n', {}, "model_key", "no key"),
        (LOCAL + 'key_file = "none"\n', {}, "model_key", "key_file"),
        (LOCAL + f'key = "{KEY}"\nkey_env = "X"\n', {}, "model_key", "one of"),
        (LOCAL, {"PONS_MODEL_KEY": "a\nb: c"}, "model_key", "one word"),
        (LOCAL, {"PONS_MODEL_ALLOW_OFFHOST": "maybe"}, "settings_malformed", "maybe"),
        (LOCAL, {"PONS_MODEL_ALLOW_PICTURES_OFFHOST": "both"}, "settings_malformed", "both"),
        (LOCAL + 'pictures = "perhaps"\n', {}, "settings_malformed", "model.pictures"),
    ],
)  # fmt: skip
def test_what_is_wrong_refuses_to_start(
    text: str, environment: dict[str, str], code: str, told: str, tmp_path: Path
) -> None:
    with pytest.raises(ConfigError) as wrong:
        model(tmp_path, text, **environment)
    assert wrong.value.code == code
    assert told in str(wrong.value)


def test_no_error_and_no_repr_shows_a_key(tmp_path: Path) -> None:
    found = model(tmp_path, f'{LOCAL}key = "{KEY}"\n')
    shown = [repr(found), str(found), found.model_dump_json() if found else ""]
    for broken in (
        f'{LOCAL}key = "{KEY}"\nx = 1\n',
        f'{LOCAL}key = "{KEY}\n',
        f'{LOCAL}key = "{KEY} {KEY}"\n',
        f'{LOCAL}key = ["{KEY}"]\n',
        f'{LOCAL}timeout_s = "{KEY}"\n',
    ):
        with pytest.raises(ConfigError) as wrong:
            model(tmp_path, broken)
        shown.append(f"{wrong.value!r} {wrong.value} {wrong.value.__cause__}")
    assert KEY not in "\n".join(shown)


@pytest.mark.parametrize(
    ("mode", "key", "told"),
    [
        (0o600, True, None),
        (0o640, False, None),
        (0o644, False, None),
        (0o640, True, "others can read the key"),
        (0o604, True, "others can read the key"),
        (0o666, True, "others can change it"),
        (0o620, False, "others can change it"),
    ],
)
def test_a_key_that_others_can_read_or_redirect_is_told_aloud(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, mode: int, key: bool, told: str | None
) -> None:
    path = tmp_path / "settings.toml"
    line = 'key = "sk-very-secret"\n' if key else ""
    path.write_text(f'[model]\nurl = "http://127.0.0.1:1/v1"\nname = "m"\n{line}')
    path.chmod(mode)
    load_settings(tmp_path, {})
    said = [record.getMessage() for record in caplog.records]
    assert ["settings_exposed" in text and told in text for text in said if told] == [True] * bool(
        told
    )
    assert "sk-very" not in caplog.text
    assert bool(find_exposed(tmp_path)) is (told is not None)


def test_a_key_file_that_others_can_read_is_told(tmp_path: Path) -> None:
    (tmp_path / "settings.toml").write_text('[model]\nkey_file = "k"\n')
    (tmp_path / "settings.toml").chmod(0o600)
    assert find_exposed(tmp_path) == []
    (tmp_path / "k").write_text("secret")
    (tmp_path / "k").chmod(0o644)
    assert find_exposed(tmp_path) == [
        f"{tmp_path / 'k'} has mode 0644: others can read the key in it"
    ]
