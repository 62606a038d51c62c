"""Say why a place can't be taught or forgotten, with a code that stays, in both languages."""

from __future__ import annotations

from types import MappingProxyType

from planner.plan import Bilingual

REASONS = MappingProxyType(
    {
        "place_name_malformed": (
            "a name has 1 to 40 letters, digits, spaces, hyphens or apostrophes",
            "名称应为 1 至 40 个文字、数字、空格、连字符或撇号",
        ),
        "place_name_mixed": (
            "that name mixes the letters of two alphabets; write it in one",
            "这个名称混用了两种字母，请只用一种",
        ),
        "place_name_reserved": (
            "that name would be read as an order or an answer; choose another",
            "这个名称会被当成指令或回答，请换一个",
        ),
        "place_name_taken": ("another place has that name", "已有别的地点使用这个名称"),
        "places_full": ("no more places can be taught here", "这张地图上可记住的地点已满"),
        "pose_unknown": (
            "the robot does not know where it is now",
            "机器人现在不知道自己的位置",
        ),
        "robot_moving": ("the robot must stand still", "机器人必须先停稳"),
        "map_mismatch": (
            "the robot localizes on another map than this site's",
            "机器人所用的地图与本站点不符",
        ),
        "other_map": ("it was taught on another map", "它是在另一张地图上记住的"),
        "place_outside_map": ("the point is off the map", "该点在地图之外"),
        "place_in_obstacle": ("the robot can't stand there", "该点没有足够的空地"),
        "place_outside_fence": ("the point is outside the fence", "该点在围栏之外"),
        "place_unreachable": ("there is no way to the point", "没有通往该点的路"),
        "route_unavailable": (
            "the way to the point can't be checked now; try again",
            "现在无法检查通往该点的路，请重试",
        ),
        "unknown_taught_place": ("no place of that name was taught here", "这里没有记住过这个地点"),
        "place_of_site": (
            "that place belongs to the site's own files and can't be changed here",
            "该地点属于站点文件，不能在此修改",
        ),
        "disk_full": ("the disk is full, so nothing was changed", "磁盘已满，未作任何改动"),
        "places_unwritable": (
            "the memory of places can't be written, so nothing was changed",
            "地点记忆无法写入，未作任何改动",
        ),
    }
)
"""Every code, with its sentence in English and Chinese; the particulars come behind it."""


class PlaceRefused(Exception):
    """Refuse to teach or to forget; nothing changed."""

    def __init__(self, code: str, detail: str = "") -> None:
        """Keep the code and the sentence: what came, what was expected, what exists."""
        en, zh = REASONS[code]
        super().__init__(f"{code}: {en}" + (f" ({detail})" if detail else ""))
        self.code = code
        self.detail = detail or en
        self.why = Bilingual(en=en, zh=zh)
