"""Name what is wrong with a base that speaks and can't be driven, with its cure in two languages.

Told by a base's protocol; for people alone. The bridge gets no state from such a base, and stands.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol, runtime_checkable

if TYPE_CHECKING:
    from collections.abc import Mapping

BASE_TROUBLES: Mapping[str, tuple[str, str]] = {
    "base_firmware_other": (
        (
            "its frames check, and are of another version than ours: build and flash firmware/ "
            "of this version (docs/firmware.md)"
        ),
        "数据帧校验正确，但固件版本不同：请编译并刷写此版本的 firmware/（见 docs/firmware.md）",
    ),
    "base_firmware_old": (
        (
            "it reports odl and odr in metres: its firmware is older than ugv_base_ros 0.96; "
            "update it (github.com/waveshareteam/ugv_base_ros)"
        ),
        "它以米报告 odl 和 odr：固件早于 0.96，请更新（github.com/waveshareteam/ugv_base_ros）",
    ),
    "base_no_encoders": (
        (
            "it reports no way of its wheels (odl, odr): a WAVE ROVER or a board with "
            "ugv_base_general has no encoders, and Pons drives nothing that it can't measure"
        ),
        "它不报告轮子的路程（odl、odr）：WAVE ROVER 或 ugv_base_general 没有编码器，无法使用",
    ),
    "base_not_set": (
        (
            "it reports, but does not print back the heartbeat: is TX wired, and does no other "
            "program speak to it?"
        ),
        "它有数据，但没有回显心跳设置：请检查 TX 接线，以及是否有其他程序占用",
    ),
    "base_motors_missing": (
        "its board does not reach its motors: is the battery on, and are the servos' cables in?",
        "控制板无法连接电机：请检查电池开关和舵机线缆",
    ),
    "base_model_unknown": (
        "its board says a model that is neither Burger nor Waffle",
        "控制板报告的型号既不是 Burger 也不是 Waffle",
    ),
}
"""By code; the bridge's log has the English."""


@runtime_checkable
class TroubledBase(Protocol):
    """Tell what is wrong with a base that speaks."""

    @property
    def trouble(self) -> str | None:
        """Return a code of :data:`BASE_TROUBLES`; None where nothing is known to be wrong."""


@runtime_checkable
class CountingBase(Protocol):
    """Count what of a base's line could not be read."""

    @property
    def spoilt(self) -> int:
        """Return how many lines, or bytes between frames, since the start."""
