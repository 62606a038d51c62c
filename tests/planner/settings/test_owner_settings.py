"""Check the owner's settings: what switches a model on, whose key goes where, what refuses."""

from __future__ import annotations

from dataclasses import asdict, fields
from pathlib import Path
from typing import Any, cast, get_args

import pytest

from planner.mission import Rules
from planner.navigation import RouteLimits
from planner.perception.detect.decoders import ALL
from planner.perception.detect.session import ORDER
from planner.robot_service import LinkedRobot
from planner.settings import (
    FILE,
    BudgetSettings,
    JsonMode,
    MissionSettings,
    ModelSettings,
    find_exposed,
    list_keys,
    load_settings,
)
from planner.settings.loader import Settings
from planner.settings.vision import DecoderName, ProviderName
from tests.wire.examples import STATUS
from wire import ConfigError, RobotDescription, Velocity

KEY = "sk-secret-0123456789"
MALFORMED = "settings_malformed"
WHOLE = """
[budget.goal]
calls = 4
[budget.day]
calls = 100
money = 0.5
[budget.price]
prompt_per_million = 0.4
reply_per_million = 1.6
currency = "CNY"
"""
LOCAL = '[model]\nurl = "http://127.0.0.1:11434/v1"\nname = "qwen3:8b"\n'


def written(home: Path, text: str = "", **environment: str) -> Settings:
    """Return the settings of a home with this file, and of these variables."""
    if text:
        (home / FILE).write_text(text, "utf-8")
    return load_settings(home, environment)


def model(home: Path, text: str = "", **environment: str) -> ModelSettings | None:
    return written(home, text, **environment).model


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
        (LOCAL + "tiemout_s = 3\n", {}, MALFORMED, "unknown key 'model.tiemout_s'"),
        ("[modle]\nurl = 'x'\n", {}, MALFORMED, "unknown key 'modle'"),
        (LOCAL + "keep_replies = 201\n", {}, MALFORMED, "model.keep_replies"),
        (LOCAL + "keep_replies = -1\n", {}, MALFORMED, "model.keep_replies"),
        (LOCAL + "keep_replies = true\n", {}, MALFORMED, "model.keep_replies"),
        ("model = 3\n", {}, MALFORMED, "table"),
        ("[model\n", {}, MALFORMED, "TOML in UTF-8 (line 1)"),
        (LOCAL + "key = “mine”\n", {}, MALFORMED, "TOML in UTF-8 (line"),
        ("a = [" * 2000, {}, MALFORMED, "TOML"),
        ("a = " + "9" * 5000, {}, MALFORMED, "TOML"),
        ("# " + "x" * 70_000, {}, MALFORMED, "bytes"),
        ('[model]\nurl = "http://127.0.0.1/v1"\n', {}, "model_incomplete", "model.name"),
        ('[model]\nname = "m"\n', {}, "model_incomplete", "model.url"),
        ("", {"PONS_MODEL": "m"}, "model_incomplete", "PONS_MODEL_URL"),
        ("", {"PONS_MODEL_KEY": KEY}, "model_incomplete", "PONS_MODEL_URL"),
        ("", {"PONS_MODEL_URL": "http://127.0.0.1"}, "model_incomplete", "name"),
        (LOCAL + 'preset = ["ollama"]\n', {}, MALFORMED, "model.preset"),
        (LOCAL + "preset = {}\n", {"PONS_MODEL_URL": "http://127.0.0.1:1"}, MALFORMED,
         "model.preset"),
        ("[mission]\nreplan = 1\n", {}, MALFORMED,
         "'mission.replan'; known: replans, decides, answer_s"),
        ("[budget.goal]\ncall = 1\n", {}, MALFORMED, "known: calls"),
        ("[voice]\nurll = 'x'\n", {}, MALFORMED, "key, key_env, key_file, timeout_s"),
        (LOCAL + "timeout_s = nan\n", {}, MALFORMED, "timeout_s"),
        (LOCAL + "timeout_s = 1e9\n", {}, MALFORMED, "timeout_s"),
        (LOCAL + 'mode = "magic"\n', {}, MALFORMED, "mode"),
        (LOCAL + 'key = ""\n', {}, "model_key", "key"),
        (LOCAL + 'key = "two words"\n', {}, "model_key", "one word"),
        (LOCAL + 'key = "密钥"\n', {}, "model_key", "one word"),
        (LOCAL + "key = 12345678\n", {}, "model_key", "text"),
        (LOCAL + 'key_env = "NOT_SET"\n', {}, "model_key", "no key"),
        (LOCAL + 'key_file = "none"\n', {}, "model_key", "key_file"),
        (LOCAL + f'key = "{KEY}"\nkey_env = "X"\n', {}, "model_key", "one of"),
        (LOCAL, {"PONS_MODEL_KEY": "a\nb: c"}, "model_key", "one word"),
        (LOCAL, {"PONS_MODEL_ALLOW_OFFHOST": "maybe"}, MALFORMED, "maybe"),
        (LOCAL, {"PONS_MODEL_ALLOW_PICTURES_OFFHOST": "both"}, MALFORMED, "both"),
        (LOCAL + 'pictures = "perhaps"\n', {}, MALFORMED, "model.pictures"),
        ("[budget]\ncals = 3\n", {}, MALFORMED, "unknown key 'budget.cals'"),
        ("[budget.goal]\ncals = 3\n", {}, MALFORMED, "known: calls, prompt_tokens"),
        ("[budget.week]\n", {}, MALFORMED, "known: goal, day, price"),
        ("[budget.price]\nper_million = 3\n", {}, MALFORMED, "known: prompt_per_million"),
        ("budget = 3\n", {}, MALFORMED, "budget"),
        ("[budget.day]\ncalls = -1\n", {}, MALFORMED, "budget.day.calls"),
        ("[budget.day]\ncalls = 1.5\n", {}, MALFORMED, "budget.day.calls"),
        ("[budget.day]\ncalls = inf\n", {}, MALFORMED, "budget.day.calls"),
        ("[budget.day]\nseconds = nan\n", {}, MALFORMED, "budget.day.seconds"),
        ("[budget.price]\nreply_per_million = -2\n", {}, MALFORMED, "reply_per_million"),
        ('[budget.price]\ncurrency = "€ 2"\n', {}, MALFORMED, "currency"),
        ("[budget.day]\nmoney = 2.0\n", {}, "budget_contradictory", "needs [budget.price]"),
        (LOCAL + "[budget.goal]\nreply_tokens = 50\n", {}, "budget_contradictory", "max_tokens"),
        ("[vision]\nmodle = 'x'\n", {}, MALFORMED, "'vision.modle'; known: model, detector"),
        ("vision = 3\n", {}, MALFORMED, "vision"),
        ("[vision]\nmodel = 3\n", {}, MALFORMED, "vision.model"),
        ("[vision]\ndecoder = 'yolo'\n", {}, MALFORMED, "'yolov8'"),
        ("[vision]\ndetector = 'open'\n", {}, MALFORMED, "detector = 'open' needs model"),
        ("[vision]\ndetector = 'closed'\n", {}, MALFORMED, "vision.detector"),
        ("[vision]\nprovider = 'gpu'\n", {}, MALFORMED, "'cuda'"),
        ("[vision]\nthreads = 0\n", {}, MALFORMED, "vision.threads"),
        ("[vision]\nrate_hz = nan\n", {}, MALFORMED, "vision.rate_hz"),
        ("[vision]\nrate_hz = 0.9\n", {}, MALFORMED, "vision.rate_hz"),  # a gaze lasts 6 s
        ("[vision]\nmin_score = 0\n", {}, MALFORMED, "vision.min_score"),
        ("[vision]\ninput_px = 100\n", {}, MALFORMED, "multiple of 32"),
        ("", {"PONS_VISION_THREADS": "many"}, MALFORMED, "vision.threads"),
        ("[mission]\nreplans = -1\n", {}, MALFORMED, "mission.replans"),
        ("[mission]\nanswer_s = nan\n", {}, MALFORMED, "mission.answer_s"),
        ("[mission]\ndecides = 21\n", {}, MALFORMED, "mission.decides"),
        ("[mission]\nretries = 1\n", {}, MALFORMED, "'mission.retries'"),
    ],
)  # fmt: skip
def test_what_is_wrong_refuses_to_start(
    text: str, environment: dict[str, str], code: str, told: str, tmp_path: Path
) -> None:
    with pytest.raises(ConfigError) as wrong:
        written(tmp_path, text, **environment)
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


def test_there_are_limits_without_a_word(tmp_path: Path) -> None:
    found = written(tmp_path).budget
    assert found == BudgetSettings()
    assert 0 < found.goal.calls <= found.day.calls


def test_limits_and_prices_are_data(tmp_path: Path) -> None:
    found = written(tmp_path, WHOLE).budget
    assert (found.goal.calls, found.day.calls, found.day.money) == (4, 100, 0.5)
    assert found.price is not None
    assert (found.price.reply_per_million, found.price.currency) == (1.6, "CNY")


def test_nothing_set_is_the_model_that_comes_with_pons(tmp_path: Path) -> None:
    found = written(tmp_path).vision
    assert (found.model, found.labels, found.decoder, found.threads) == (None, None, None, 1)


def test_a_file_is_looked_for_in_the_home_folder(tmp_path: Path) -> None:
    text = '[vision]\nmodel = "best.onnx"\nlabels = "/data/names.txt"\n'
    found = written(tmp_path, text).vision
    assert (found.model, found.labels) == (tmp_path / "best.onnx", Path("/data/names.txt"))


def test_the_environment_wins_and_its_files_are_where_the_command_was_given(tmp_path: Path) -> None:
    text = '[vision]\nmodel = "best.onnx"\nthreads = 1\nrate_hz = 2.5\n'
    more = {"MODEL": "other.onnx", "THREADS": "2", "DECODER": "yolox", "MIN_SCORE": "0.5"}
    found = written(tmp_path, text, **{f"PONS_VISION_{k}": v for k, v in more.items()}).vision
    assert found.model == Path("other.onnx").absolute()
    assert (found.threads, found.decoder, found.rate_hz, found.min_score) == (2, "yolox", 2.5, 0.5)


def test_settings_know_every_decoder_and_provider() -> None:
    assert get_args(DecoderName) == tuple(ALL)
    assert get_args(ProviderName) == tuple(ORDER)


def test_the_settings_are_the_rules_by_name_and_by_default() -> None:
    assert MissionSettings().model_dump() == asdict(Rules())
    assert [field.name for field in fields(Rules)] == list(MissionSettings.model_fields)


def test_what_the_owner_sets_about_goals_is_taken(tmp_path: Path) -> None:
    settings = written(tmp_path, "[mission]\nreplans = 0\nanswer_s = 30\n").mission
    assert (settings.replans, settings.decides, settings.answer_s) == (0, 3, 30.0)


@pytest.mark.parametrize(("text", "mps"), [("", 0.5), ("0.2", 0.2), ("1.5", 0.5)])
def test_a_limit_of_the_owners_only_lowers(tmp_path: Path, text: str, mps: float) -> None:
    limits = written(tmp_path, f"[limits]\nmax_speed_mps = {text}\n" if text else "").limits
    robot = RobotDescription()
    assert limits.lower_speed(robot.limits.max_speed_mps) == mps
    assert RouteLimits.of(robot, limits.max_speed_mps).max_speed_mps == mps


class HeardLink:
    """Keep what a hand is relayed as."""

    def __init__(self) -> None:
        self.said: list[Velocity] = []
        self.status = type("Aged", (), {"value": STATUS})()

    def teleop(self, velocity: Velocity) -> None:
        self.said.append(velocity)


def test_no_hand_is_relayed_faster() -> None:
    link = HeardLink()
    robot = LinkedRobot(cast("Any", link), RobotDescription(), 0.2)
    for asked in (0.5, -0.5, 0.1):
        robot.steer("a", asked, 0.3, dead_man=True)
    assert [(one.v_mps, one.w_radps) for one in link.said] == [(0.2, 0.3), (-0.2, 0.3), (0.1, 0.3)]
