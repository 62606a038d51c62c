"""The command line is as people know it: help with an example, one meaning of each exit status."""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from pons import completion
from pons.__main__ import main
from pons.command_help import EXIT_STATUS, HELP, exit_table
from pons.completion import grammars
from pons.settings import load, robot_of
from pons.terminal import below, command_path, paint, pick
from pons_assets import DEFAULT_SITE, ROBOT_FILE, ROBOTS

ROOT = Path(__file__).resolve().parents[2]
APART = {"eval", "fleet", "mcp", "mock-llm", "nav2"}
"""Their libraries are large; that they answer --help is their own tests' to say."""


def helps() -> list[tuple[str, str]]:
    """Return the help of every command and of the commands below them."""

    def walk(grammar: argparse.ArgumentParser) -> list[tuple[str, str]]:
        found = [(grammar.prog, grammar.format_help())]
        for one in completion._commands(grammar).values():
            found += walk(one)
        return found

    return [(prog, told) for prog, told in walk(grammars()) if prog.split()[-1] not in APART]


@pytest.mark.parametrize(("prog", "told"), helps(), ids=lambda it: it if len(it) < 40 else "help")
def test_each_help_has_a_sentence_an_example_and_no_word_of_ours(prog: str, told: str) -> None:
    assert "\nexamples:\n  pons" in told, prog
    assert re.search(r"\n\n[A-Za-z].*[.a-z:]", told), prog
    for ours in ("``", "python -m", ".py ", "(pons."):
        assert ours not in told, prog


def test_each_command_has_help() -> None:
    assert set(completion._commands(grammars())) == set(HELP)


def test_the_table_of_exit_statuses_is_shown_and_each_has_one_meaning(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["help", "exit-codes"]) == 0
    assert capsys.readouterr().out.strip() == exit_table()
    assert len({status for status, _ in EXIT_STATUS}) == len(EXIT_STATUS)
    assert exit_table() in grammars().format_help()
    documented = (ROOT / "docs" / "commands.md").read_text("utf-8")
    for status, meaning in EXIT_STATUS:
        assert f"| {status} | {meaning} |" in documented


@pytest.mark.parametrize(
    ("words", "meant"),
    [(["stat"], "status"), (["sya", "go"], "say"), (["orders", "lst"], "list"),
     (["robot", "prests"], "presets"), (["site", "chek"], "check"),
     (["completion", "bsh"], "bash")],
)  # fmt: skip
def test_a_wrong_word_is_answered_by_the_nearest(
    words: list[str], meant: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main(words)
    assert ended.value.code == 2
    told = capsys.readouterr().err
    assert f"did you mean {meant}" in told
    assert len(told.splitlines()) <= 2


def test_the_version_is_told_with_its_commit(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    assert re.fullmatch(r"pons \d+\.\d+\.\d+( \(commit [0-9a-f]{12}\))?\n", capsys.readouterr().out)


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_names_commands_and_options(
    shell: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["completion", shell]) == 0
    script = capsys.readouterr().out
    for word in ("status", "presets", "exit-codes", "no-wait"):
        assert word in script


def test_bash_completes_what_was_begun(capsys: pytest.CaptureFixture[str]) -> None:
    main(["completion", "bash"])
    script = capsys.readouterr().out
    asked = 'COMP_WORDS=(pons robot pre); COMP_CWORD=2; _pons; echo "${COMPREPLY[*]}"'
    done = subprocess.run(
        ["bash", "-c", script + asked], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "presets"


def test_an_order_to_stop_is_told_as_json_wherever_no_robot_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    monkeypatch.setenv("PONS_PORT", "1")
    command = [sys.executable, "-m", "pons", "stop", "--json"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    told = json.loads(done.stdout)
    assert (done.returncode, told["order"], told["confirmed"]) == (6, "stop", False)


@pytest.mark.parametrize(
    ("locale", "chinese"),
    [("zh_CN.UTF-8", True), ("zh", True), ("en_GB.UTF-8", False), ("C", False), ("", False)],
)
def test_one_language_is_said_the_locales(
    locale: str, chinese: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("LC_ALL", "LC_MESSAGES"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("LANG", locale)
    assert pick("english", "中文") == ("中文" if chinese else "english")
    assert below("code: english", {"en": "english", "zh": "中文"}) == (
        "\n  中文" if chinese else ""
    )


def test_colours_are_for_terminals(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setenv("TERM", "xterm")
    assert paint("FAIL", "red") == "\x1b[31mFAIL\x1b[0m"
    monkeypatch.setenv("NO_COLOR", "1")
    assert paint("FAIL", "red") == "FAIL"


def test_the_command_is_named_by_a_path_that_works(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    bin_folder = tmp_path / "bin"
    bin_folder.mkdir()
    (bin_folder / "pons").touch(0o755)
    monkeypatch.setattr(sys, "executable", str(bin_folder / "python"))
    monkeypatch.setenv("PATH", "/nowhere")
    monkeypatch.chdir(tmp_path)
    assert command_path() == "bin/pons"
    monkeypatch.setenv("PATH", str(bin_folder))
    assert command_path() == "pons"


def test_a_preset_is_written_into_the_home_and_used_from_then_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PONS_HOME", str(tmp_path / "home"))
    monkeypatch.delenv("PONS_ROBOT", raising=False)
    before = {path: path.read_bytes() for path in ROBOTS.iterdir()}
    assert load().robot == ROBOT_FILE
    assert main(["robot", "new", "rover", "--from", "waveshare_ugv_rover"]) == 0
    own = tmp_path / "home" / "robot.toml"
    assert load().robot == own
    assert 'id = "rover"' in own.read_text("utf-8")
    assert main(["robot", "new", "other", "--from", "arduino"]) == 3
    assert "robot_exists" in capsys.readouterr().err
    assert {path: path.read_bytes() for path in ROBOTS.iterdir()} == before


@pytest.mark.parametrize(
    ("name", "preset", "status", "code"),
    [("r", "roomba", 2, "preset_unknown"), ("Not OK", "arduino", 3, "robot_name"),
     ('x"\n[drive', "arduino", 3, "robot_name")],
)  # fmt: skip
def test_what_is_no_preset_or_no_name_is_refused(
    name: str, preset: str, status: int, code: str,
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    assert main(["robot", "new", name, "--from", preset]) == status
    assert code in capsys.readouterr().err
    assert not (tmp_path / "robot.toml").exists()


def test_presets_are_listed_and_found_by_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["robot", "presets", "--json"]) == 0
    names = [one["name"] for one in json.loads(capsys.readouterr().out)["presets"]]
    assert names == ["demo", *sorted(path.stem for path in ROBOTS.glob("*.toml"))]
    assert robot_of("waveshare_ugv_rover", tmp_path) == ROBOTS / "waveshare_ugv_rover.toml"
    assert robot_of("robots/arduino.toml", tmp_path) == ROBOTS / "arduino.toml"
    mine = tmp_path / "arduino"
    mine.touch()
    assert robot_of(str(mine), tmp_path) == mine


def test_a_home_with_a_robot_of_its_own_drives_on_the_map_that_was_made_of_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    monkeypatch.delenv("PONS_SITE", raising=False)
    (tmp_path / "robot.toml").write_text('id = "mine"\n')
    assert load().site == DEFAULT_SITE
    (own := tmp_path / "sites" / "home").mkdir(parents=True)
    (own / "map.yaml").touch()
    assert load().site == own
    (tmp_path / "robot.toml").unlink()
    assert load().site == DEFAULT_SITE, "the demo robot keeps its own home"
    monkeypatch.setenv("PONS_SITE", "two_room")
    assert load().site.name == "two_room"
