"""What a small computer's board reports is named; what it does not report is not guessed."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pons.doctor.board_checks import (
    describe_board,
    heat,
    modem_manager,
    power,
    processor_clock,
    time_of_day,
    usb_power,
)
from pons.doctor.finding import HealthFinding, HealthVerdict
from tests.known import known

THROTTLED = "sys/devices/platform/soc/soc:firmware/get_throttled"
PI_5 = b"Raspberry Pi 5 Model B Rev 1.0\0"
ALL: tuple[Callable[[Path], HealthFinding], ...] = (
    power, usb_power, heat, processor_clock, time_of_day, modem_manager,
)  # fmt: skip


def put(root: Path, name: str, content: str | bytes) -> None:
    path = root / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content.encode() if isinstance(content, str) else content)


def put_model(root: Path, model: bytes = PI_5) -> None:
    put(root, "proc/device-tree/model", model)


def put_power(root: Path, name: str, cell: int) -> None:
    put(root, f"proc/device-tree/chosen/power/{name}", cell.to_bytes(4, "big"))


@pytest.mark.parametrize("check", ALL, ids=lambda check: check.__name__)
def test_a_machine_that_reports_nothing_is_not_blamed(
    check: Callable[[Path], HealthFinding], tmp_path: Path
) -> None:
    found = check(tmp_path)
    assert found.verdict is HealthVerdict.OK
    assert found.found.en
    assert found.found.zh


@pytest.mark.parametrize("check", ALL, ids=lambda check: check.__name__)
def test_garbage_in_the_kernels_files_is_no_crash(
    check: Callable[[Path], HealthFinding], tmp_path: Path
) -> None:
    put(tmp_path, THROTTLED, b"\xff\x00 nonsense")
    put(tmp_path, "sys/class/thermal/thermal_zone0/temp", b"\xff")
    put_model(tmp_path)
    put(tmp_path, "proc/device-tree/chosen/power/usb_max_current_enable", b"\0")
    assert check(tmp_path).found.en


def test_the_board_is_named_by_its_device_tree(tmp_path: Path) -> None:
    assert describe_board(tmp_path) == ""
    put_model(tmp_path)
    assert describe_board(tmp_path) == "Raspberry Pi 5 Model B Rev 1.0"


def test_a_board_that_had_enough_voltage_is_well(tmp_path: Path) -> None:
    put(tmp_path, THROTTLED, "0\n")
    assert power(tmp_path).verdict is HealthVerdict.OK


@pytest.mark.parametrize(
    ("bits", "said", "cured_by"),
    [
        (0x1, "under-voltage now", "supply"),
        (0x50000, "under-voltage since the start, throttled since the start", "supply"),
        (0x50005, "under-voltage now, throttled now", "supply"),
        (0x80000, "soft temperature limit is reached since the start", "heat sink"),
        (0x2, "clock is capped now", "heat sink"),
    ],
)
def test_what_the_firmware_tells_is_said_with_its_cure(
    bits: int, said: str, cured_by: str, tmp_path: Path
) -> None:
    put(tmp_path, THROTTLED, f"{bits:x}\n")
    found = power(tmp_path)
    assert found.verdict is HealthVerdict.WARN
    assert said in found.found.en
    assert hex(bits) in found.found.en
    assert cured_by in known(found.fix).en


@given(bits=st.integers(min_value=0, max_value=0xFFFFF))
def test_any_known_bit_is_told_and_no_other(
    bits: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    root = tmp_path_factory.mktemp("board")
    put(root, THROTTLED, f"{bits:x}")
    told = [bit for bit in range(4) if bits & (0x10001 << bit)]
    found = power(root)
    assert (found.verdict is HealthVerdict.WARN) == bool(told)
    assert not told or len(found.found.en.split(", ")) == len(told)


def test_the_driver_of_the_voltage_alarm_counts_where_the_firmware_is_silent(
    tmp_path: Path,
) -> None:
    put(tmp_path, "sys/class/hwmon/hwmon0/name", "cpu_thermal\n")
    put(tmp_path, "sys/class/hwmon/hwmon1/name", "rpi_volt\n")
    put(tmp_path, "sys/class/hwmon/hwmon1/in0_lcrit_alarm", "1\n")
    assert "under-voltage now" in power(tmp_path).found.en


def test_a_pi_5_with_a_weak_supply_is_told(tmp_path: Path) -> None:
    put_model(tmp_path)
    assert usb_power(tmp_path).verdict is HealthVerdict.OK  # the kernel does not tell
    put_power(tmp_path, "usb_max_current_enable", 0)
    put_power(tmp_path, "max_current", 3000)
    weak = usb_power(tmp_path)
    assert weak.verdict is HealthVerdict.WARN
    assert "3000 mA" in weak.found.en
    put_power(tmp_path, "usb_max_current_enable", 1)
    assert usb_power(tmp_path).verdict is HealthVerdict.OK


def test_the_hottest_zone_counts(tmp_path: Path) -> None:
    put(tmp_path, "sys/class/thermal/thermal_zone0/temp", "41000\n")
    assert heat(tmp_path).verdict is HealthVerdict.OK
    put(tmp_path, "sys/class/thermal/thermal_zone1/temp", "83500\n")
    hot = heat(tmp_path)
    assert hot.verdict is HealthVerdict.WARN
    assert "84 degrees" in hot.found.en


def test_powersave_is_told_unless_it_is_a_drivers_name_for_scaling(tmp_path: Path) -> None:
    put(tmp_path, "sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "powersave\n")
    assert processor_clock(tmp_path).verdict is HealthVerdict.WARN
    put(tmp_path, "sys/devices/system/cpu/cpu0/cpufreq/scaling_driver", "intel_pstate\n")
    assert processor_clock(tmp_path).verdict is HealthVerdict.OK


def test_a_board_without_a_clock_is_told_until_a_time_server_was_heard(tmp_path: Path) -> None:
    put_model(tmp_path)
    assert time_of_day(tmp_path).verdict is HealthVerdict.WARN
    put(tmp_path, "run/systemd/timesync/synchronized", "")
    assert time_of_day(tmp_path).verdict is HealthVerdict.OK


@pytest.mark.parametrize("sign", ["sys/class/rtc/rtc0/name", "run/chrony/chronyd.pid"])
def test_a_battery_backed_clock_or_chrony_keeps_the_time(sign: str, tmp_path: Path) -> None:
    put_model(tmp_path)
    put(tmp_path, sign, "")
    assert time_of_day(tmp_path).verdict is HealthVerdict.OK


def test_modem_manager_is_told_unless_our_rules_keep_it_away(tmp_path: Path) -> None:
    put(tmp_path, "proc/812/comm", "ModemManager\n")
    found = modem_manager(tmp_path)
    assert found.verdict is HealthVerdict.WARN
    assert "70-pons.rules" in known(found.fix).en
    put(tmp_path, "etc/udev/rules.d/70-pons.rules", "")
    assert modem_manager(tmp_path).verdict is HealthVerdict.OK
