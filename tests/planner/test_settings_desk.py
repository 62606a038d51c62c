"""Try the page's settings on real files: comments stay, keys stay hidden, no start is spoilt."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import pytest

from planner.settings import FILE, Settings, load_settings
from planner.settings.file_edit import KEPT
from planner.settings.page_fields import PAGE_FIELDS
from planner.settings_desk import SettingsDesk, SettingsRefusal
from planner.state_database import StateDatabase
from wire import ConfigError

KEY = "sk-secret-0123456789"
BY_HAND = """# mine, by hand
[model]  # the big one
preset = "ollama"
name = "qwen3:8b"   # fits
temperature = 0.2

[orders]
timezone = "Europe/Berlin"
"""
CLOUD = """
[model]
url = "https://api.openai.com/v1"
name = "NAME"
key = "k"
allow_offhost = true
"""
AT = datetime(2026, 1, 2, 3, 4, 5, tzinfo=UTC)


def desk_of(home: Path, text: str = "", **environment: str) -> SettingsDesk:
    if text:
        (home / FILE).write_text(text, "utf-8")
    return SettingsDesk(
        home, environment, load_settings(home, environment), StateDatabase(home),
        robot_mps=0.5, clock=lambda: AT,
    )  # fmt: skip


def save(desk: SettingsDesk, **changes: Any) -> dict[str, Any]:
    named = {name.replace("__", "."): value for name, value in changes.items()}
    return desk.change(desk.view()["revision"], named, "page")


def field(view: dict[str, Any], name: str) -> dict[str, Any]:
    return next(each for each in view["fields"] if each["name"] == name)


def text_of(home: Path) -> str:
    return (home / FILE).read_text("utf-8")


def test_a_change_keeps_comments_order_and_all_else(tmp_path: Path) -> None:
    view = save(desk_of(tmp_path, BY_HAND), model__name="qwen3:14b", limits__max_speed_mps=0.3)
    wanted = BY_HAND.replace('"qwen3:8b"', '"qwen3:14b"') + "\n[limits]\nmax_speed_mps = 0.3\n"
    assert text_of(tmp_path) == wanted
    assert (tmp_path / (FILE + KEPT)).read_text("utf-8") == BY_HAND
    assert (tmp_path / FILE).stat().st_mode & 0o777 == 0o600
    assert field(view, "model.name") == {
        "name": "model.name", "group": "model", "kind": "text", "value": "qwen3:14b",
        "is_set": True, "source": "file", "choices": [], "least": None, "most": None,
        "in_force": "next_start", "is_pending": True,
    }  # fmt: skip
    assert view["changes"] == [
        {"at": "2026-01-02T03:04:05+00:00", "by": "page",
         "names": ["limits.max_speed_mps", "model.name"]}
    ]  # fmt: skip
    assert not (tmp_path / f".{FILE}.new").exists()


def test_from_no_file_every_setting_of_the_page_can_be_saved_and_started_with(
    tmp_path: Path,
) -> None:
    values: dict[str, Any] = {
        "model.preset": "ollama", "model.name": "<b>m</b>", "model.url": "http://127.0.0.1:1/v1",
        "model.key": KEY, "model.allow_offhost": True, "model.pictures": True,
        "model.allow_pictures_offhost": False, "vision.rate_hz": 2, "vision.search_pictures": 3,
        "speech.engine": "none", "speech.quiet": "22:00-07:00", "speech.key": KEY,
        "speech.url": "http://127.0.0.1:1/v1", "speech.allow_offhost": False,
        "voice.url": "http://127.0.0.1:1/v1", "voice.model": "whisper-1", "voice.key": KEY,
        "voice.allow_offhost": True, "limits.max_speed_mps": 0.2,
        "orders.notify.url": "https://ntfy.sh/very-secret", "orders.notify.form": "ntfy",
        "orders.notify.words": False, "orders.quiet": "21:00-06:00",
        "orders.timezone": "Asia/Shanghai", "budget.goal.money": 0.5, "budget.day.money": 2.0,
        "budget.day.calls": 500, "budget.price.prompt_per_million": 0.1,
        "budget.price.reply_per_million": 0.4, "budget.price.currency": "EUR",
    }  # fmt: skip
    assert values.keys() == PAGE_FIELDS.keys()
    desk = desk_of(tmp_path)
    view = desk.change(desk.view()["revision"], values, "ana")
    shown = {each["name"]: each for each in view["fields"]}
    for name, value in values.items():
        is_secret = shown[name]["kind"] == "secret"
        assert shown[name]["value"] == (None if is_secret else value), name
        assert shown[name]["is_set"]
    assert KEY not in str(view)
    assert "very-secret" not in str(view)
    load_settings(tmp_path, {})
    gone = desk.change(view["revision"], dict.fromkeys(values), "ana")
    assert not any(each["is_set"] for each in gone["fields"])
    assert load_settings(tmp_path, {}) == Settings()


def test_where_a_change_leads_to_another_server_key_and_yes_stay_behind(tmp_path: Path) -> None:
    text = (
        '[model]\nurl = "https://a.example/v1"\nname = "m"\nallow_offhost = true\n'
        f'key = "{KEY}"\nallow_pictures_offhost = true\n'
    )
    desk = desk_of(tmp_path, text)
    save(desk, model__url="https://a.example/v2")
    assert KEY in text_of(tmp_path)
    with pytest.raises(ConfigError, match="model_offhost"):
        save(desk, model__url="https://b.example/v1")
    save(desk, model__url="https://b.example/v1", model__allow_offhost=True)
    assert KEY not in text_of(tmp_path)
    assert "allow_pictures_offhost" not in text_of(tmp_path)


def test_a_key_that_is_typed_takes_the_place_of_a_file_with_one(tmp_path: Path) -> None:
    (tmp_path / "model.key").write_text(KEY)
    desk = desk_of(tmp_path, BY_HAND.replace("temperature = 0.2", 'key_file = "model.key"'))
    assert field(desk.view(), "model.key")["is_set"]
    save(desk, model__key="sk-other-0123456789")
    assert "key_file" not in text_of(tmp_path)
    assert load_settings(tmp_path, {}).model is not None


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"model.url": "http://ana:pw@127.0.0.1/v1", "model.name": "m"}, "model_url"),
        ({"model.url": "http://169.254.169.254/v1", "model.name": "m"}, "model_url"),
        ({"model.url": "https://api.example/v1", "model.name": "m"}, "model_offhost"),
        ({"model.name": "m"}, "model_incomplete"),
        ({"model.preset": "openai", "model.name": "m", "model.allow_offhost": True}, "model_key"),
        ({"model.preset": "ollama", "model.name": "m", "model.key": "two words"}, "model_key"),
        ({"voice.url": "ftp://x"}, "voice_url"),
        ({"voice.url": "https://x.example/v1"}, "voice_offhost"),
        ({"speech.engine": "server"}, "speech_incomplete"),
        ({"speech.quiet": "soon"}, "settings_malformed"),
        ({"orders.timezone": "Mars/Base"}, "timezone_unknown"),
        ({"orders.notify.url": "https://u:p@x.example"}, "settings_malformed"),
        ({"orders.notify.url": "http://169.254.169.254/"}, "orders.notify_url"),
        ({"budget.day.money": 1.0}, "budget_contradictory"),
    ],
)
def test_what_a_start_would_refuse_is_never_saved(
    tmp_path: Path, changes: dict[str, Any], code: str
) -> None:
    desk = desk_of(tmp_path)
    with pytest.raises(ConfigError) as wrong:
        desk.change(desk.view()["revision"], changes, "page")
    assert wrong.value.code == code
    assert "pw@" not in str(wrong.value)
    assert not (tmp_path / FILE).exists()
    assert desk.view()["changes"] == []


@pytest.mark.parametrize(
    ("name", "value", "code"),
    [
        ("limits.max_speed_mps", 0.6, "settings_out_of_range"),
        ("limits.max_speed_mps", float("nan"), "settings_out_of_range"),
        ("limits.max_speed_mps", True, "settings_out_of_range"),
        ("vision.search_pictures", 1.5, "settings_out_of_range"),
        ("model.preset", "mine", "settings_out_of_range"),
        ("model.name", "", "settings_out_of_range"),
        ("model.name", "x" * 2001, "settings_out_of_range"),
        ("model.name", "a\nb", "settings_out_of_range"),
        ("model.allow_offhost", "yes", "settings_out_of_range"),
        ("vision.model", "x.onnx", "settings_unknown"),
        ("drive.port", "/dev/null", "settings_unknown"),
    ],
)
def test_a_value_that_does_not_fit_is_refused_by_name(
    tmp_path: Path, name: str, value: Any, code: str
) -> None:
    desk = desk_of(tmp_path)
    with pytest.raises(SettingsRefusal) as refused:
        desk.change(desk.view()["revision"], {name: value}, "page")
    assert (refused.value.code, refused.value.said["name"]) == (code, name)


def test_of_two_people_the_later_one_is_told_and_overwrites_nothing(tmp_path: Path) -> None:
    desk = desk_of(tmp_path, BY_HAND)
    seen = desk.view()["revision"]
    desk.change(seen, {"orders.quiet": "22:00-07:00"}, "ana")
    with pytest.raises(SettingsRefusal, match="settings_changed"):
        desk.change(seen, {"orders.quiet": "20:00-07:00"}, "bob")
    (tmp_path / FILE).write_text(BY_HAND + "# by an editor\n", "utf-8")
    with pytest.raises(SettingsRefusal, match="settings_changed"):
        desk.change("0" * 16, {"orders.quiet": "20:00-07:00"}, "bob")
    assert "# by an editor" in text_of(tmp_path)


def test_what_the_environment_says_is_shown_as_such_and_not_changed(tmp_path: Path) -> None:
    desk = desk_of(tmp_path, BY_HAND, PONS_MODEL="other")
    shown = field(desk.view(), "model.name")
    assert (shown["value"], shown["source"]) == ("other", "environment")
    with pytest.raises(SettingsRefusal, match="settings_elsewhere"):
        save(desk, model__name="mine")


def test_a_budget_is_in_force_at_once_and_a_model_at_the_next_start(tmp_path: Path) -> None:
    adopted: list[Settings] = []
    desk = SettingsDesk(tmp_path, {}, Settings(), StateDatabase(tmp_path), adopt=adopted.append)
    view = save(desk, budget__day__calls=7, limits__max_speed_mps=0.3)
    assert [each.budget.day.calls for each in adopted] == [7]
    assert not field(view, "budget.day.calls")["is_pending"]
    assert field(view, "limits.max_speed_mps")["is_pending"]
    assert not field(save(desk, limits__max_speed_mps=None), "limits.max_speed_mps")["is_pending"]


def test_the_model_that_is_asked_keeps_its_price_until_the_next_start(tmp_path: Path) -> None:
    asked = CLOUD.replace("NAME", "gpt-4o-mini")
    desk = desk_of(tmp_path, asked)
    before = field(desk.view(), "budget.price.prompt_per_million")
    assert (before["value"], before["source"], before["is_set"]) == (0.15, "default", False)
    view = save(desk, model__name="gpt-4o")
    after = field(view, "budget.price.prompt_per_million")
    assert after["value"] == 2.5
    assert after["is_pending"]
    own = field(save(desk, budget__price__prompt_per_million=1.0), after["name"])
    assert (own["value"], own["source"], own["is_pending"]) == (1.0, "file", False)


def test_a_model_is_switched_off_with_its_table(tmp_path: Path) -> None:
    desk = desk_of(tmp_path, BY_HAND)
    view = save(desk, model__name=None, model__preset=None)
    assert field(view, "model.name")["value"] is None
    assert "[model]" not in text_of(tmp_path)
    assert "Europe/Berlin" in text_of(tmp_path)


def test_a_file_that_may_not_be_written_stays_and_nothing_is_noted(tmp_path: Path) -> None:
    home = tmp_path / "home"
    home.mkdir()
    desk = desk_of(home, BY_HAND)
    (home / f".{FILE}.new").mkdir()  # nothing can be written beside it, not even by root
    with pytest.raises(OSError, match="directory"):
        save(desk, orders__quiet="22:00-07:00")
    assert text_of(home) == BY_HAND
    assert desk.view()["changes"] == []


def test_a_file_by_hand_that_is_broken_is_told_and_never_edited(tmp_path: Path) -> None:
    desk = desk_of(tmp_path)
    (tmp_path / FILE).write_text(f'[model]\nkey = "{KEY}\n', "utf-8")
    with pytest.raises(ConfigError, match="settings_malformed") as wrong:
        desk.view()
    assert KEY not in str(wrong.value)


@pytest.mark.parametrize(
    "text", ["model = 3\n", "orders.notify = 1\n", '"limits" = []\n', "[[budget]]\nday = 1\n"]
)
def test_a_file_of_another_shape_is_refused(tmp_path: Path, text: str) -> None:
    desk = desk_of(tmp_path)
    (tmp_path / FILE).write_text(text, "utf-8")
    with pytest.raises(ConfigError, match="settings_malformed"):
        desk.view()


def test_inline_tables_and_dotted_keys_are_kept_as_they_are_written(tmp_path: Path) -> None:
    text = 'orders = {timezone = "Asia/Tokyo", quiet = "22:00-07:00"}\nbudget.day.calls = 9\n'
    save(desk_of(tmp_path, text), orders__quiet="21:00-07:00", budget__day__calls=8)
    assert text_of(tmp_path) == text.replace("22:", "21:").replace("9", "8")
