"""A file that a person wrote is refused in words for people, and no password is repeated."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from wire import ConfigError, load_robot
from wire.file_trouble import LONGEST, describe_syntax, find_broken_line, show_value

SECRET = "hunter2"
STREAM = f'[camera]\nkind = "stream"\nurl = "rtsp://me:{SECRET}@cam/1"\n'


def refused(tmp_path: Path, text: str) -> ConfigError:
    path = tmp_path / "robot.toml"
    path.write_text(text, "utf-8")
    with pytest.raises(ConfigError) as error:
        load_robot(path)
    return error.value


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("[base]\nradius_m = 0.2\n", "robot.toml: base.radius_m 0.2 must be at least 0.25"),
        ("[drive]\nkind = 'pons_mcu'\n", "robot.toml: drive.port is missing: kind 'pons_mcu'"),
        ("drive = 'pons_mcu'\n", "drive: got 'pons_mcu'; expected a table"),
        ("[[drive]]\nkind = 'sim'\n", "drive: got a list; expected a table"),
        ("id = {a = 1}\n", "id: got a table; "),
        ("[drive]\nkind = 'pons_mcu'\nport = 'COM3'\nticks_per_turn = 8\n",
         "drive.port: got 'COM3'; expected a path that begins with /"),
        ("[drive]\ntick_per_turn = 8\n", "; is 'ticks_per_turn' meant?"),
        ("[lider]\n", "known there: id, base, limits, drive, lidar,"),
        ("[lider]\n", "; is 'lidar' meant?"),
        ("[trial]\ndate = '2026-01-02'\n", "trial.wiring is missing; trial.dead_man_s is missing"),
        ("[limits]\nhardest_decel_mps2 = 0.5\n", "limits: hardest_decel_mps2 must not be below"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_said_without_a_validators_jargon(
    tmp_path: Path, text: str, named: str
) -> None:
    detail = refused(tmp_path, text).detail
    assert named in detail
    for jargon in ("Value error", "instance of", "Field required", "{'"):
        assert jargon not in detail


@pytest.mark.parametrize(
    "text",
    [
        f"{STREAM}[base]\nradius_m = 0.2\n",
        f"{STREAM}depth_min_m = 2.0\ndepth_max_m = 1.0\n",
        STREAM.replace("rtsp:", "ftp:"),
        STREAM.replace('"rtsp', '["rtsp').replace('/1"', '/1"]'),
        STREAM.replace("stream", "uvc"),
        STREAM.removesuffix('"\n'),
        STREAM.replace('/1"', '/1"”'),
        STREAM.replace('"rtsp', "“rtsp"),
        f"{STREAM}{STREAM}",
    ],
)
def test_no_refusal_repeats_a_password(tmp_path: Path, text: str) -> None:
    assert SECRET not in str(refused(tmp_path, text))


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ('[drive]\nport = "/dev/ser', "it breaks off in line 2, 'port'; was it cut?"),
        ("[drive", "line 1"),
        ("kind = “sim”\n", "'kind': not understood from '“' on"),
        ("a =\nb = 1\n", "'a': not understood from the end of the line on"),
        ("\n<<<<<<< HEAD\n", "(at line 2, column 1): not understood from '<' on"),
        ("\ufeffid = 'r1'\n", "byte order mark; save it as UTF-8 without one"),
    ],
)
def test_where_a_file_breaks_is_named(tmp_path: Path, text: str, named: str) -> None:
    error = refused(tmp_path, text)
    assert error.code == "robot_toml_syntax"
    assert named in error.detail


def syntax_of(text: str) -> str | None:
    """Return what is said of a text; None where it is TOML."""
    try:
        tomllib.loads(text)
    except ValueError as error:
        return describe_syntax(text, error)
    return None


def test_every_cut_of_a_whole_file_is_read_or_refused_with_its_place() -> None:
    whole = Path("robots/pons_mcu_ld19.toml").read_text("utf-8")
    said = {syntax_of(whole[:length]) for length in range(len(whole))} - {None}
    assert said
    assert all("line" in str(one) for one in said)


def test_a_cut_file_names_the_copy_from_before(tmp_path: Path) -> None:
    for stamp in ("20260101T000000Z", "20260202T000000Z"):
        (tmp_path / f"robot.toml.bak-{stamp}").write_text("", "utf-8")
    detail = refused(tmp_path, '[drive]\nport = "/dev').detail
    assert detail.endswith("; robot.toml.bak-20260202T000000Z beside it is an older copy")


def test_long_values_are_shortened() -> None:
    assert len(show_value("x" * 5_000)) == LONGEST + 1


def test_the_broken_line_is_told_without_a_word_of_it() -> None:
    with pytest.raises(ValueError, match="line 2") as broken:
        tomllib.loads(f"a = 1\nkey = “{SECRET}”\n")
    assert find_broken_line(broken.value) == " (line 2)"
    assert find_broken_line(ValueError(SECRET)) == ""


@pytest.mark.parametrize(
    ("encoding", "told"),
    [("utf-16", "it is in UTF-16"), ("gbk", "line 2 is in another encoding")],
)
def test_of_a_file_in_another_encoding_the_cure_is_told(encoding: str, told: str) -> None:
    written = f"[model]\n# 密钥 {SECRET}\n".encode(encoding)
    with pytest.raises(UnicodeDecodeError) as broken:
        written.decode()
    said = find_broken_line(broken.value)
    assert told in said
    assert "UTF-8" in said
    assert SECRET not in said
