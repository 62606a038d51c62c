"""Rules for Dockerfile and compose file that need no container engine."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

from planner.__main__ import NICE as PLANNER_NICE
from sim.camera.__main__ import NICE as CAMERA_NICE
from tests.deploy.installed import PROCESSES, ROOT, compose, weight_of

KNOWN = {
    *("build", "image", "init", "restart", "read_only", "tmpfs", "cap_drop", "cap_add", "ports"),
    *("security_opt", "stop_grace_period", "network_mode", "volumes", "profiles", "command"),
    *("entrypoint", "environment", "healthcheck", "ulimits", "cpu_shares", "devices", "group_add"),
}
METAL = {"robot-bridge", "robot-planner", "robot-localization"}
"""What any robot of metal drives by; how it senses is a profile each."""
ORDINARY = 1024
"""Of who says nothing."""


def instructions() -> list[tuple[str, str]]:
    """Return the Dockerfile's instructions with their words, lines joined."""
    text = re.sub(r"\\\n\s*", "", (ROOT / "Dockerfile").read_text())
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    return [(line.split()[0], line.split(maxsplit=1)[1]) for line in lines]


def test_the_base_is_named_by_release_and_can_be_pinned_by_digest() -> None:
    made = instructions()
    assert made[0] == ("ARG", "BASE=debian:trixie-slim")
    bases = [words for word, words in made if word == "FROM"]
    assert bases == ["${BASE} AS build", "${BASE} AS run"]


def test_packages_come_from_the_locks_by_hash() -> None:
    runs = " ".join(words for word, words in instructions() if word == "RUN")
    assert "make setup" in runs
    assert not re.search(r"\bpip3?\b|npm install|curl|wget|\| *(ba)?sh\b", runs)
    assert "--require-hashes" in (ROOT / "scripts" / "install.sh").read_text()
    assert "npm ci" in (ROOT / "scripts" / "page.sh").read_text()
    assert "ADD" not in {word for word, _ in instructions()}


def test_apt_leaves_nothing_needless() -> None:
    for words in (words for word, words in instructions() if "apt-get install" in words):
        assert "--no-install-recommends" in words
        assert "rm -rf /var/lib/apt/lists/*" in words


def test_the_last_stage_is_nobody_in_particular() -> None:
    made = instructions()
    last = made[[index for index, (word, _) in enumerate(made) if word == "FROM"][-1] :]
    users = [words for word, words in last if word == "USER"]
    assert users == ["10001:10001"]
    after = [word for word, _ in last[last.index(("USER", users[0])) :]]
    assert not {"RUN", "COPY"} & set(after)


def test_the_context_leaves_state_and_secrets_out() -> None:
    ignored = (ROOT / ".dockerignore").read_text().splitlines()
    assert {".git", ".venv", ".pons", ".env", "**/node_modules"} <= set(ignored)


def test_no_service_says_what_compose_does_not_know() -> None:
    described: dict[str, dict[str, Any]] = compose()["services"]
    for name, service in described.items():
        assert set(service) <= KNOWN, name
        assert service["profiles"], name
        assert "privileged" not in service
        for mount in service["volumes"]:
            assert re.fullmatch(r"(state|fleet|\$\{\w+:-\./[\w./]+\}):/[\w/.]+(:ro)?", mount), mount


def test_profiles_hold_whole_robots() -> None:
    described = compose()["services"]
    members = {
        profile: {name for name, one in described.items() if profile in one["profiles"]}
        for profile in ("sim", "robot", "lidar", "camera", "ros2", "llm", "fleet")
    }
    assert members == {
        "sim": set(PROCESSES),
        "robot": METAL,
        "lidar": {"robot-lidar"},
        "camera": {"robot-camera"},
        "ros2": {"robot-ros2"},
        "llm": {"llm"},
        "fleet": {"fleet"},
    }


def test_without_a_profile_the_simulator_starts() -> None:
    lines = (ROOT / ".env").read_text().splitlines()
    assert [line for line in lines if not line.startswith("#")] == ["COMPOSE_PROFILES=sim"]


def test_processes_share_their_sockets_and_only_the_planner_has_a_network() -> None:
    for name, service in compose()["services"].items():
        if name == "fleet":
            continue
        assert "state:/var/lib/pons" in service["volumes"], name
        expected = {"llm": "service:planner"} | dict.fromkeys(
            ("planner", "robot-planner", "robot-ros2"), "bridge"
        )
        assert service["network_mode"] == expected.get(name, "none"), name
        if "ports" in service:
            assert all(port.startswith("127.0.0.1:") for port in service["ports"])


def test_the_fleet_shares_nothing_with_a_robot_and_has_its_engine() -> None:
    service = compose()["services"]["fleet"]
    assert service["volumes"] == ["fleet:/var/lib/pons"]
    assert service["network_mode"] == "host", "it serves the host's loopback, and reaches robots"
    assert service["command"] == ["pons", "fleet", "up"]
    assert service["build"]["args"] == {"EXTRAS": "extras"}
    assert service["image"] != compose()["services"]["planner"]["image"]
    runs = " ".join(words for word, words in instructions() if word == "RUN")
    assert "make setup ${EXTRAS}" in runs


def test_only_the_robots_bridge_may_be_real_time() -> None:
    for name, service in compose()["services"].items():
        assert service["cap_drop"] == ["ALL"], name
        assert service["security_opt"] == ["no-new-privileges:true"]
        if name == "robot-bridge":
            assert service["cap_add"] == ["SYS_NICE", "IPC_LOCK"]
            assert service["ulimits"] == {"rtprio": 70, "memlock": -1}
        else:
            assert not {"cap_add", "ulimits"} & set(service), name


def test_a_container_of_metal_has_its_own_device_and_the_group_that_may_open_it() -> None:
    ports = {"robot-bridge": "DRIVE_PORT", "robot-lidar": "LIDAR_PORT", "robot-camera": "CAMERA"}
    for name, service in compose()["services"].items():
        devices = service.get("devices", [])
        assert len(devices) == (name in ports), name
        for device in devices:
            outside, inside = device[: len(device) // 2], device[len(device) // 2 + 1 :]
            assert outside == inside, "robot.toml names one path"
            assert outside.startswith(f"${{PONS_{ports[name]}:-/dev/")
        assert ("group_add" in service) == (name in ports)


def test_a_container_weighs_what_its_process_would_elsewhere() -> None:
    shares = {name: one.get("cpu_shares") for name, one in compose()["services"].items()}
    planner, camera = weight_of(PLANNER_NICE, ORDINARY), weight_of(CAMERA_NICE, ORDINARY)
    assert shares["planner"] == shares["robot-planner"] == pytest.approx(planner, rel=0.02)
    assert shares["camera"] == shares["robot-camera"] == pytest.approx(camera, rel=0.02)
    senses = ("robot-localization", "robot-lidar", "robot-ros2")
    for name in ("bridge", "robot-bridge", "sim", "localization", *senses):
        assert shares[name] > 2 * shares["planner"], name
    assert shares["llm"] is None


def test_the_planner_starts_behind_its_token() -> None:
    for name in ("planner", "robot-planner"):
        assert compose()["services"][name]["entrypoint"] == ["/opt/pons/deploy/with-token.sh"]


def compose_command() -> list[str]:
    """Return how compose is called here; a test that needs it is skipped where it is not."""
    for command in (["docker", "compose"], ["docker-compose"]):
        if shutil.which(command[0]) is None:
            continue
        said = subprocess.run([*command, "version"], capture_output=True, text=True, check=False)
        if said.returncode == 0 and "version 1." not in said.stdout:  # 1 knows no `name:`
            return command
    pytest.skip("neither docker's compose plugin nor docker-compose 2 is installed")


@pytest.mark.parametrize(
    ("profiles", "services"),
    [
        ((), set(PROCESSES)),
        (("sim",), set(PROCESSES)),
        (("robot",), METAL),
        (("robot", "lidar", "camera"), {*METAL, "robot-lidar", "robot-camera"}),
        (("sim", "llm"), {*PROCESSES, "llm"}),
        (("fleet",), {"fleet"}),
    ],
)
def test_compose_itself_takes_the_file(
    profiles: tuple[str, ...], services: set[str], tmp_path: Path
) -> None:
    words = [word for profile in profiles for word in ("--profile", profile)]
    done = subprocess.run(
        [*compose_command(), "-f", str(ROOT / "docker-compose.yml"), *words,
         "config", "--services"],
        capture_output=True, text=True, check=False, cwd=tmp_path,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert set(done.stdout.split()) == services
