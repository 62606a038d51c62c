"""Read sentences about standing orders: "every evening at eight check the door", 二十分钟后提醒我.

Pure, both languages, whole sentences only; the one door of this package. The stop lane reads every
sentence before.
"""

from planner.language.schedule.command import (
    ChangeOrders,
    CorrectOrder,
    Delay,
    LeaveOutDays,
    ListOrders,
    OrderChange,
    OrderCommand,
    RemindAgain,
    Retime,
    ScheduleCommand,
    can_lean,
)
from planner.language.schedule.reader import asks_about_day, read_order_command
from planner.language.schedule.time_finder import split_time

__all__ = [
    "ChangeOrders",
    "CorrectOrder",
    "Delay",
    "LeaveOutDays",
    "ListOrders",
    "OrderChange",
    "OrderCommand",
    "RemindAgain",
    "Retime",
    "ScheduleCommand",
    "asks_about_day",
    "can_lean",
    "read_order_command",
    "split_time",
]
