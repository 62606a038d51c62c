"""What the doctor finds: each fault by its name, with what to do; and nothing is changed."""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import sys
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from bridge.realtime import Right
from pons.__main__ import main
from pons.doctor import command, host_checks, jitter, model_checks, path_checks
from pons.doctor.finding import BilingualWords, HealthFinding, HealthVerdict
from pons.robot_processes import free_port
from pons.running import RunningNote
from pons.settings import CHECKOUT, LaunchSettings
from tests.known import known
from wire.doors import BRIDGE_DOOR
from wire.sockets import Endpoints

pytestmark = pytest.mark.nightly(keep=12)


TWO_ROOM = CHECKOUT / "sites" / "two_room"
WORDS = BilingualWords("it is taken", "被占用")
WELL = HealthFinding("fine", HealthVerdict.OK, WORDS)


def described(home: Path) -> LaunchSettings:
    return LaunchSettings(home, CHECKOUT / "robot.toml", TWO_ROOM, "127.0.0.1", free_port())


@pytest.fixture
def settings(tmp_path: Path) -> LaunchSettings:
    return described(tmp_path / "h")


@pytest.fixture(scope="module")
def examined(
    tmp_path_factory: pytest.TempPathFactory,
) -> tuple[LaunchSettings, list[HealthFinding]]:
    """Run every check as it is, once: it takes processes and the recogniser's model."""
    settings = described(tmp_path_factory.mktemp("doctor") / "h")
    return settings, command.findings(settings)


@pytest.fixture
def deaf(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave out the one check that costs a second: it loads the recogniser's model."""
    monkeypatch.setattr(model_checks, "recogniser", lambda _site: WELL)


def assert_says(found: HealthFinding, verdict: HealthVerdict, *parts: str) -> None:
    assert found.verdict is verdict, found
    assert (found.fix is None) == (verdict is HealthVerdict.OK)
    for part in parts:
        assert part in found.found.en, found
    for words in (found.found, found.fix):
        assert words is None or (words.en and words.zh)


def test_every_check_reports_once_and_nothing_is_made(
    examined: tuple[LaunchSettings, list[HealthFinding]],
) -> None:
    settings, found = examined
    names = [one.name for one in found]
    assert len(set(names)) == len(names) == 29
    for one in found:
        assert_says(one, one.verdict)
    assert not settings.home.exists(), "the doctor makes nothing"


def test_the_worst_finding_is_the_exit_status(
    settings: LaunchSettings, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for worst, status in ((HealthVerdict.OK, 0), (HealthVerdict.WARN, 1), (HealthVerdict.FAIL, 2)):
        fix = None if worst is HealthVerdict.OK else WORDS
        shown = [WELL, HealthFinding("it", worst, WORDS, fix)]
        monkeypatch.setattr(command, "findings", lambda _settings, shown=shown: shown)
        assert command.run(settings) == status
    assert "FAIL  it" in capsys.readouterr().out


def test_a_fault_is_one_line_with_its_fix_in_each_language(
    settings: LaunchSettings, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    found = HealthFinding("port", HealthVerdict.FAIL, WORDS, BilingualWords("free it", "释放"))
    monkeypatch.setattr(command, "findings", lambda _: [found])
    command.run(settings)
    [english] = capsys.readouterr().out.splitlines()
    assert english.startswith("FAIL  port")
    assert english.endswith("it is taken -> free it")
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    command.run(settings)
    assert capsys.readouterr().out.endswith("被占用 -> 释放\n")


@pytest.mark.usefixtures("deaf")
@pytest.mark.parametrize(
    "error", [PermissionError("denied"), subprocess.TimeoutExpired("x", 1), RuntimeError("odd")]
)
def test_a_check_that_is_cut_short_hides_no_other(
    settings: LaunchSettings, monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    def broken() -> HealthFinding:
        raise error

    monkeypatch.setattr(host_checks, "locked_memory", broken)
    found = {one.name: one for one in command.findings(settings)}
    assert len(found) == 29
    assert_says(found["locked_memory"], HealthVerdict.FAIL, "could not be checked", str(error))


def test_without_the_recogniser_it_says_what_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pocketsphinx", None)
    monkeypatch.delitem(sys.modules, "planner.voice.sphinx", raising=False)
    found = model_checks.recogniser(None)
    assert_says(found, HealthVerdict.WARN, "no spoken orders")
    assert "3.11" in known(found.fix).en


def test_without_cyclictest_it_says_how_to_get_it(
    settings: LaunchSettings, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(shutil, "which", lambda _: None)
    monkeypatch.setattr(command, "findings", lambda _: [WELL])
    rows = jitter.measure(60, ticks=5)
    assert len(rows) == 1
    monkeypatch.setattr(jitter, "measure", lambda _: rows)
    assert command.run(settings, jitter=True) == 0
    assert "rt-tests" in capsys.readouterr().out


def test_a_cyclictest_that_hangs_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jitter, "LATE_S", 0.1)
    with subprocess.Popen(["sleep", "60"], stdout=subprocess.PIPE, text=True) as hanging:
        assert jitter._finish(hanging, 5, 60) == []
        assert hanging.returncode is not None


def test_json_is_for_machines(
    examined: tuple[LaunchSettings, list[HealthFinding]],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    settings, found = examined
    monkeypatch.setenv("PONS_HOME", str(settings.home))
    monkeypatch.setattr(command, "findings", lambda _: found)
    assert main(["doctor", "--json"]) in (0, 1, 2)
    content = json.loads(capsys.readouterr().out)
    assert {"name", "verdict", "found", "fix"} == set(content["findings"][0])
    assert [one["name"] for one in content["findings"]] == [one.name for one in found]


def test_an_old_python_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "version_info", (3, 9, 1))
    assert_says(host_checks.python(), HealthVerdict.FAIL, "3.11")


def test_large_pages_are_a_warning(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "sysconf", lambda _: 16_384)
    assert_says(host_checks.page_size(), HealthVerdict.WARN, "16 KiB")


@pytest.mark.parametrize(
    ("virtual", "verdict"), [(True, HealthVerdict.WARN), (False, HealthVerdict.FAIL)]
)
def test_no_real_time_is_worse_on_metal(
    monkeypatch: pytest.MonkeyPatch, virtual: bool, verdict: HealthVerdict
) -> None:
    refused = Right("fifo", granted=False, detail="priority 60: not permitted")
    monkeypatch.setattr(host_checks, "take_fifo", lambda _: refused)
    assert_says(host_checks.real_time(60, virtual=virtual), verdict, "not permitted")


def test_real_time_is_tried_in_a_thread_of_its_own() -> None:
    before = os.sched_getscheduler(0)
    host_checks.real_time(60, virtual=True)
    assert os.sched_getscheduler(0) == before


def test_memory_that_cant_be_locked_is_a_warning(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(host_checks, "_LOCK", "print(0, 'RLIMIT_MEMLOCK is 8 bytes')")
    assert_says(host_checks.locked_memory(), HealthVerdict.WARN, "8 bytes")
    monkeypatch.setattr(host_checks, "_LOCK", "raise SystemExit('broken')")
    assert_says(host_checks.locked_memory(), HealthVerdict.WARN, "broken")


def test_node_is_never_needed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "which", lambda _: None)
    assert_says(host_checks.node(), HealthVerdict.OK, "Python package")
    monkeypatch.setattr(shutil, "which", lambda _: "/no/such/node")
    assert_says(host_checks.node(), HealthVerdict.OK, "Python package")


def test_a_home_that_others_may_write_is_a_warning(tmp_path: Path) -> None:
    assert_says(path_checks.home(tmp_path), HealthVerdict.OK)
    tmp_path.chmod(0o777)
    assert_says(path_checks.home(tmp_path), HealthVerdict.WARN, "others")
    tmp_path.chmod(0o3770)  # as deploy/systemd makes it: one group, none replaces another's
    assert_says(path_checks.home(tmp_path), HealthVerdict.OK)
    tmp_path.chmod(0o2770)
    assert_says(path_checks.home(tmp_path), HealthVerdict.WARN, "others")
    file = tmp_path / "file"
    file.touch()
    assert_says(path_checks.home(file / "below"), HealthVerdict.FAIL, "can't be written")


@pytest.mark.parametrize(
    ("free", "verdict"),
    [(10**6, HealthVerdict.FAIL), (10**9, HealthVerdict.WARN), (10**11, HealthVerdict.OK)],
)
def test_a_full_disk_is_told_before_it_is_full(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, free: int, verdict: HealthVerdict
) -> None:
    usage = shutil.disk_usage(tmp_path)._replace(free=free)
    monkeypatch.setattr(shutil, "disk_usage", lambda _: usage)
    assert_says(path_checks.disk(tmp_path / "not" / "yet"), verdict)


def test_sockets_too_long_dead_and_alive(tmp_path: Path) -> None:
    assert_says(path_checks.sockets(tmp_path / ("x" * 120)), HealthVerdict.FAIL, "107")
    path = Endpoints(tmp_path).socket(BRIDGE_DOOR)
    path.parent.mkdir(parents=True)
    with closing(socket.socket(socket.AF_UNIX)) as listener:
        listener.bind(str(path))
        listener.listen()
        assert_says(path_checks.sockets(tmp_path), HealthVerdict.OK, "running robot: bridge")
    assert_says(path_checks.sockets(tmp_path), HealthVerdict.OK, "dead processes", "bridge")


def test_a_taken_port_is_a_fault_unless_a_robot_has_it(tmp_path: Path) -> None:
    with closing(socket.socket()) as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        number = int(taken.getsockname()[1])
        here = replace(described(tmp_path), port=number)
        assert_says(path_checks.port(here, running=False), HealthVerdict.FAIL, str(number))
        assert_says(path_checks.port(here, running=True), HealthVerdict.OK, "running robot")
        with RunningNote(replace(here, home=tmp_path / "elsewhere"), "r7"):
            found = path_checks.port(here, running=False)
            assert_says(found, HealthVerdict.WARN, f"r7 in {tmp_path}/elsewhere")
    nowhere = replace(here, host="no.such.host.invalid")
    assert_says(path_checks.port(nowhere, running=False), HealthVerdict.FAIL)


def test_wrong_files_are_quoted(tmp_path: Path) -> None:
    robot = tmp_path / "robot.toml"
    robot.write_text("max_sped = 1\n")
    found, _ = path_checks.robot(robot)
    assert_says(found, HealthVerdict.FAIL, "max_sped")
    found, site = path_checks.site(tmp_path)
    assert_says(found, HealthVerdict.FAIL, "map.yaml")
    assert site is None
    assert model_checks.recogniser(None).name == "recogniser"


def test_a_robot_toml_of_the_former_ways_to_ros_is_told_what_to_install_and_write(
    tmp_path: Path,
) -> None:
    path = tmp_path / "robot.toml"
    path.write_text('[drive]\nkind = "ros2"\n[ros2]\nurl = "ws://10.0.0.5:9090"\nodom = "/o"\n')
    found, _ = path_checks.robot(path)
    assert_says(found, HealthVerdict.FAIL, "ros2_former_keys", 'odom: "/o"', "pons robot node")
    assert "pons robot node" in known(found.fix).zh


@pytest.mark.usefixtures("deaf")
def test_of_a_robot_that_nobody_can_read_nothing_is_called_well(
    settings: LaunchSettings, tmp_path: Path
) -> None:
    half = tmp_path / "half.toml"
    half.write_text('[drive]\nkind = "pons_mcu"\nport = "/dev/ttyA')
    found = {one.name: one for one in command.findings(replace(settings, robot=half))}
    assert_says(found["robot"], HealthVerdict.FAIL, "robot_toml_syntax", "it breaks off in line 3")
    for name in ("drive", "trial", "gyro", "lidar", "camera", "detector", "ros2"):
        assert_says(found[name], HealthVerdict.WARN, "not looked at")


def test_the_model_is_asked_for_nothing_but_a_connection(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("PONS_MODEL_URL", raising=False)
    assert_says(model_checks.model(tmp_path), HealthVerdict.OK, "offline brain")
    with closing(socket.socket()) as server:
        server.bind(("127.0.0.1", 0))
        server.listen()
        number = server.getsockname()[1]
        text = f'[model]\nurl = "http://127.0.0.1:{number}/v1"\nname = "m"\n'
        (tmp_path / "settings.toml").write_text(text)
        assert_says(model_checks.model(tmp_path), HealthVerdict.OK, "m at 127.0.0.1")
        connection, _ = server.accept()
        with closing(connection):
            assert connection.recv(100) == b""
    assert_says(model_checks.model(tmp_path), HealthVerdict.WARN, "refused")
    (tmp_path / "settings.toml").write_text('[model]\nurl = "http://169.254.1.1"\nname = "m"\n')
    assert_says(model_checks.model(tmp_path), HealthVerdict.FAIL, "link-local")
    (tmp_path / "settings.toml").write_text("[modle]\n")
    assert_says(model_checks.model(tmp_path), HealthVerdict.FAIL, "modle")


def test_names_that_cant_be_spoken_are_listed(tmp_path: Path) -> None:
    pytest.importorskip("pocketsphinx")
    _, site = path_checks.site(TWO_ROOM)
    assert site is not None
    assert_says(model_checks.recogniser(site), HealthVerdict.OK, "names")
    first = site.places[0]
    odd = first.model_copy(update={"name": first.name.model_copy(update={"en": "qzxv room"})})
    object.__setattr__(site, "places", (odd, *site.places[1:]))
    assert_says(model_checks.recogniser(site), HealthVerdict.WARN, "qzxv room")


def test_jitter_measures_and_prints_a_table() -> None:
    rows = jitter.measure(60, ticks=10)
    assert rows[0].ticks == 10
    assert 0.0 <= (rows[0].p50_us or 0.0) <= rows[0].max_us
    head, *shown = jitter.table(rows).splitlines()
    assert "p99 us" in head
    assert len(shown) == len(rows)


def test_what_cyclictest_says_is_read_or_left_out() -> None:
    said = "T: 0 (  42) P:60 I:10000 C:    500 Min:     11 Act:   18 Avg:   23 Max:     133\n"
    (row,) = jitter.cyclictest_row(said, 500, 60)
    assert row.max_us == 133.0
    assert "mean 23" in row.cells()[0]
    assert jitter.cyclictest_row("unable to set scheduler", 500, 60) == []


def test_keys_that_lie_open_are_told(tmp_path: Path) -> None:
    assert_says(path_checks.secrets(tmp_path, virtual=True), HealthVerdict.OK, "no key lies open")
    assert_says(
        path_checks.secrets(tmp_path, virtual=False), HealthVerdict.FAIL, "operator_key_missing"
    )
    (tmp_path / "settings.toml").write_text('[model]\nkey = "k"\n')
    (tmp_path / "settings.toml").chmod(0o644)
    assert_says(
        path_checks.secrets(tmp_path, virtual=True), HealthVerdict.WARN, "read the key in it"
    )
