"""Read sentences about standing orders: "every evening at eight check the door", 二十分钟后提醒我.

Pure, both languages, whole sentences only; the one door of this package. The stop lane reads every
sentence before.
"""

from planner.language.schedule.command import (
    ChangeOrders,
    ListOrders,
    OrderCommand,
    ScheduleCommand,
)
from planner.language.schedule.reader import read_order_command

__all__ = ["ChangeOrders", "ListOrders", "OrderCommand", "ScheduleCommand", "read_order_command"]
