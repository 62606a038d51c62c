"""Say why a site cannot be used, with a code that stays. Knows no files and no formats."""

from __future__ import annotations

from types import MappingProxyType

from wire.errors import ConfigError

REASONS = MappingProxyType(
    {
        "site_file_missing": "缺少站点文件",
        "yaml_malformed": "YAML 文件格式错误",
        "json_malformed": "JSON 文件格式错误",
        "unknown_key": "文件中有未知的键",
        "value_malformed": "文件中的值不合要求",
        "map_image_missing": "地图图像不存在",
        "map_image_outside": "地图图像不在站点文件夹内",
        "map_image_malformed": "地图图像无法读取",
        "map_image_too_large": "地图图像过大",
        "map_image_ambiguous": "地图图像的文件名写法有歧义",
        "map_thresholds_crossed": "地图阈值顺序错误",
        "fence_map_mismatch": "围栏属于另一张地图",
        "polygon_degenerate": "多边形面积为零",
        "polygon_crosses_itself": "多边形自相交",
        "place_duplicate_id": "地点编号重复",
        "place_alias_clash": "两个地点使用同一名称",
        "place_outside_map": "地点在地图之外",
        "place_in_obstacle": "地点在障碍物或未知区域内",
        "place_outside_fence": "地点在围栏之外",
        "place_name_malformed": "名称不合要求",
        "place_name_mixed": "名称混用了相似的字母",
        "place_name_reserved": "该名称会被当作命令或回答",
        "place_name_taken": "该名称已属于另一个地点",
        "home_unknown": "未知的起始地点",
        "map_too_ragged": "地图边界过于零碎：请清理图像中的杂点，或自行画出围栏",
        "map_no_floor": "地图上没有可站立的空地",
        "map_no_drive": "录制中没有可用来建图的行驶：请边扫描边行驶至少一米",
        "map_not_begun": "还没有为这个名称建图",
        "keyframes_malformed": "保存的关键帧已损坏",
        "map_of_two_runs": "录制来自不同的运行，请只给出同一次运行的",
        "map_too_large": "地图过大",
        "carmen_malformed": "不是可用的 CARMEN 日志",
        "drive_elsewhere": "这次行驶不在这张地图上",
        "recordings_none": "没有可用的录制：请先在家中行驶一遍",
        "mend_unknown": "没有这份地图修改提案，或它已被采用；可运行 pons map 名称 --mend 新建一份",
        "mend_stale": "提案之后地图已被更换：请重新运行 pons map 名称 --mend",
        "mend_change_unknown": "没有这个编号的变化；--without 须与 --mend 同用",
        "robot_running": "机器人正在运行，它仍用原来的地图：请先停止 pons up",
        "taught_places_full": "记住的地点已满：请先忘记一些",
        "map_unknown_word": "未知区域是否可通行需要人来说明",
        "mask_elsewhere": "掩膜与地图不重叠",
        "disk_full": "磁盘空间不足",
        "site_name_malformed": "站点名称不合要求",
        "site_exists": "已有同名站点",
        "site_missing": "没有这个站点",
        "site_unwritable": "站点文件夹无法写入",
        "room_unknown": "没有这个房间提议",
    }
)
"""Every code, with its sentence in Chinese; the English sentence carries the particulars."""


class SiteError(ConfigError):
    """Report a site that must not be used. Ours or the owner's to mend: refuse to start."""

    def __init__(self, code: str, message: str, zh: str | None = None) -> None:
        """Keep the code and the sentence: what came, what was expected, what exists.

        Args:
            code: one of ``REASONS``.
            message: the sentence in English.
            zh: the same in Chinese; None: that of ``REASONS``, shown below the English one.
        """
        super().__init__(code, message)
        self.message = {"en": message, "zh": zh or REASONS[code]}
