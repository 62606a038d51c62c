"""Check the board of a small computer: its power, heat, processor clock, time of day, ModemManager.

Everything is read from /proc, /sys and /run below ``root``. What a board does not tell is not
guessed: the finding says that nothing reports it.
"""

from __future__ import annotations

import re
from contextlib import suppress
from pathlib import Path
from typing import Final

from pons.doctor.finding import BilingualWords, HealthFinding, ok, warn

ROOT: Final = Path("/")
_THROTTLED: Final = "sys/devices/platform/soc/soc:firmware/get_throttled"
"""Of Raspberry Pi's kernel: what `vcgencmd get_throttled` prints, in hexadecimal."""
_NOW: Final = {
    0x1: ("under-voltage", "欠压"),
    0x2: ("the processor's clock is capped", "处理器频率受限"),
    0x4: ("throttled", "已降频"),
    0x8: ("the soft temperature limit is reached", "已到软温度上限"),
}
"""Bits of the present; sixteen bits higher are the same since the start (Raspberry Pi
documentation, os.html#get_throttled)."""
_SINCE_START: Final = 16
_TOLD: Final = 0xF | 0xF << _SINCE_START
_UNDER_VOLTAGE: Final = 0x1 | 0x1 << _SINCE_START
HOT_C: Final = 75.0
"""A Raspberry Pi begins to lower its clock at 80 degrees."""
_PI_5_USB_MA: Final = 600
"""What all USB ports of a Raspberry Pi 5 get together from a supply that does not say 5 A."""


def describe_board(root: Path = ROOT) -> str:
    """Return the board's model; nothing where no device tree names one."""
    return _text(root / "proc/device-tree/model").rstrip("\0")


def power(root: Path = ROOT) -> HealthFinding:
    """Look whether the board had enough voltage, and was not slowed by heat, since its start."""
    bits = _throttled_bits(root)
    if bits is None:
        return ok("power", "this board reports no under-voltage", "此主板不报告欠压")
    if not bits & _TOLD:
        return ok("power", "no under-voltage since the start", "开机以来没有欠压")
    english, chinese = [], []
    for bit, (en, zh) in _NOW.items():
        if bits & bit:
            english.append(f"{en} now")
            chinese.append(f"{zh}（现在）")
        elif bits & bit << _SINCE_START:
            english.append(f"{en} since the start")
            chinese.append(f"{zh}（开机以来）")
    if bits & _UNDER_VOLTAGE:
        cure = BilingualWords(
            "use a supply of 5 V with enough current (Pi 5: 5 A, Pi 4: 3 A) and a short thick "
            "cable; a board that is short of voltage resets while it drives",
            "请使用电流足够的 5 V 电源（Pi 5：5 A，Pi 4：3 A）和短而粗的线；"
            "欠压的主板会在行驶中重启",
        )
    else:
        cure = BilingualWords("give it a heat sink or a fan", "请加装散热片或风扇")
    said = BilingualWords(f"{', '.join(english)} ({bits:#x})", f"{'，'.join(chinese)}（{bits:#x}）")
    return warn("power", said, cure)


def usb_power(root: Path = ROOT) -> HealthFinding:
    """Look how much current a Raspberry Pi 5 lets its USB ports have: lidars start with 1 A."""
    if not describe_board(root).startswith("Raspberry Pi 5"):
        return ok("usb_power", "this board does not limit USB by its supply", "此主板不按电源限流")
    folder = root / "proc/device-tree/chosen/power"
    allowed, supply_ma = (
        _number(folder / name) for name in ("usb_max_current_enable", "max_current")
    )
    if allowed:
        return ok("usb_power", "USB may draw 1.6 A", "USB 共可用 1.6 A")
    if allowed is None:
        return ok("usb_power", "this kernel does not tell the limit", "此内核不报告限值")
    known = f"{supply_ma} mA" if supply_ma else "nothing"
    return warn(
        "usb_power",
        BilingualWords(
            f"all USB ports together get {_PI_5_USB_MA} mA: the supply told of {known}",
            f"所有 USB 口共 {_PI_5_USB_MA} mA：电源报告 {known}",
        ),
        BilingualWords(
            "use a supply that says 5 A by USB PD; for one that has them and can't say so, write "
            "usb_max_current_enable=1 into /boot/firmware/config.txt",
            "请使用支持 USB PD 5 A 的电源；若电源足够但不能协商，在 /boot/firmware/config.txt 写入 "
            "usb_max_current_enable=1",
        ),
    )


def heat(root: Path = ROOT) -> HealthFinding:
    """Look at the hottest zone that the kernel reports."""
    found = [
        value / 1000.0
        for path in (root / "sys/class/thermal").glob("thermal_zone*/temp")
        if (value := _decimal(path)) is not None
    ]
    if not found:
        return ok("heat", "no temperature is reported", "没有温度报告")
    hottest_c = max(found)
    if hottest_c < HOT_C:
        return ok("heat", f"{hottest_c:.0f} degrees at the hottest", f"最高 {hottest_c:.0f} 度")
    return warn(
        "heat",
        BilingualWords(
            f"{hottest_c:.0f} degrees: the processor lowers its clock soon",
            f"{hottest_c:.0f} 度：处理器即将降频",
        ),
        BilingualWords("give it a heat sink or a fan", "请加装散热片或风扇"),
    )


def processor_clock(root: Path = ROOT) -> HealthFinding:
    """Look for a governor that keeps the processor slow whatever it has to do."""
    folders = (root / "sys/devices/system/cpu").glob("cpu[0-9]*/cpufreq/scaling_governor")
    governors = sorted({governor for path in folders if (governor := _text(path))})
    if "powersave" in governors and not _scales_by_itself(root):
        return warn(
            "processor",
            BilingualWords(
                "the governor is powersave: the lowest clock, always",
                "调频策略为 powersave：始终最低频率",
            ),
            BilingualWords(
                "echo schedutil | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor",
                "echo schedutil | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor",
            ),
        )
    said = ", ".join(governors) or "fixed"
    return ok("processor", f"clock: {said}", f"频率策略：{said}")


def time_of_day(root: Path = ROOT) -> HealthFinding:
    """Look whether the time of day is known: driving does not need it, dates and https do."""
    if (root / "run/systemd/timesync/synchronized").exists():
        return ok("time_of_day", "set by a time server", "已由时间服务器校准")
    if (root / "run/chrony").is_dir():
        return ok("time_of_day", "kept by chrony", "由 chrony 校准")
    if not describe_board(root):
        return ok("time_of_day", "kept by this machine", "由本机保持")
    if any((root / "sys/class/rtc").glob("rtc*")):
        return ok("time_of_day", "kept by a clock with a battery", "由实时时钟保持")
    return warn(
        "time_of_day",
        BilingualWords(
            "no clock with a battery, and no time server was heard since the start",
            "没有实时时钟，开机以来也未联系到时间服务器",
        ),
        BilingualWords(
            "connect it to a network once, or add an RTC: the robot drives as ever, but dates of "
            "recordings and goals may be hours off, and certificates may look expired",
            "请联网一次或加装 RTC：机器人照常行驶，但记录的日期可能相差数小时，证书可能显示过期",
        ),
    )


def modem_manager(root: Path = ROOT) -> HealthFinding:
    """Look for ModemManager: it writes to serial ports that are new to it."""
    ignored = any((root / "etc/udev/rules.d").glob("*pons*.rules"))
    for folder in (root / "proc").glob("[0-9]*"):
        if _text(folder / "comm") != "ModemManager":
            continue
        if ignored:
            break
        return warn(
            "modem_manager",
            BilingualWords(
                "ModemManager runs: it questions a base or a lidar when it is plugged in",
                "ModemManager 正在运行：底盘或激光雷达插入时会被它询问",
            ),
            BilingualWords(
                "sudo cp deploy/pi/70-pons.rules /etc/udev/rules.d/ && sudo udevadm control "
                "--reload, or remove the package modemmanager",
                "sudo cp deploy/pi/70-pons.rules /etc/udev/rules.d/ && sudo udevadm control "
                "--reload，或卸载 modemmanager",
            ),
        )
    said = "it leaves our serial ports alone" if ignored else "not running"
    return ok("modem_manager", said, "不会打扰串口")


def _throttled_bits(root: Path) -> int | None:
    """Return the firmware's bits, or the one of the driver rpi_volt; None where neither is."""
    with suppress(ValueError):
        return int(_text(root / _THROTTLED), 16)
    for folder in (root / "sys/class/hwmon").glob("hwmon*"):
        if _text(folder / "name") == "rpi_volt":
            return int(_decimal(folder / "in0_lcrit_alarm") or 0)
    return None


def _scales_by_itself(root: Path) -> bool:
    """Tell whether "powersave" is a name for scaling: Intel's driver in its active mode."""
    driver = _text(root / "sys/devices/system/cpu/cpu0/cpufreq/scaling_driver")
    return re.fullmatch(r"intel_pstate|amd-pstate-epp", driver) is not None


def _text(path: Path) -> str:
    """Return a short file's text; nothing where it can't be read."""
    try:
        return path.read_text("utf-8", "replace").strip()
    except OSError:
        return ""


def _decimal(path: Path) -> int | None:
    try:
        return int(_text(path))
    except ValueError:
        return None


def _number(path: Path) -> int | None:
    """Return a cell of the device tree: 32 bits, the highest byte first."""
    try:
        data = path.read_bytes()
    except OSError:
        return None
    return int.from_bytes(data, "big") if len(data) == 4 else None
