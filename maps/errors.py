"""Say why a site cannot be used, with a code that stays. Knows no files and no formats."""

from __future__ import annotations

from wire.errors import ConfigError

CODES = frozenset(
    {
        "site_file_missing",
        "bad_template",
        "yaml_malformed",
        "json_malformed",
        "unknown_key",
        "value_malformed",
        "map_image_missing",
        "map_image_outside",
        "map_image_malformed",
        "map_image_too_large",
        "map_image_ambiguous",
        "map_thresholds_crossed",
        "fence_map_mismatch",
        "polygon_degenerate",
        "polygon_crosses_itself",
        "place_duplicate_id",
        "place_alias_clash",
        "place_outside_map",
        "place_in_obstacle",
        "place_outside_fence",
        "place_name_malformed",
        "place_name_mixed",
        "place_name_reserved",
        "place_name_taken",
        "home_unknown",
        "map_too_ragged",
        "map_no_floor",
        "map_no_drive",
        "map_not_begun",
        "keyframes_malformed",
        "map_of_two_runs",
        "map_too_large",
        "carmen_malformed",
        "drive_elsewhere",
        "recordings_none",
        "mend_unknown",
        "mend_stale",
        "mend_change_unknown",
        "robot_running",
        "taught_places_full",
        "map_unknown_word",
        "mask_elsewhere",
        "disk_full",
        "site_name_malformed",
        "site_exists",
        "site_missing",
        "site_unwritable",
        "room_unknown",
        "recording_missing",
        "recording_damaged",
        "recording_of_old_format",
        "recording_not_mcap",
        "recording_invalid",
        "recording_of_other_core",
    }
)
"""Every code, with which a site, its map or what it is made of is refused."""


class BilingualError(ValueError):
    """Report what is wrong within a file, in English and in Chinese."""

    def __init__(self, en: str, zh: str) -> None:
        super().__init__(en)
        self.zh = zh


class SiteError(ConfigError):
    """Report a site that must not be used. Ours or the owner's to mend: refuse to start."""

    def __init__(self, code: str, message: str, zh: str) -> None:
        """Keep the code and the sentence: what came, what was expected, what exists.

        Args:
            code: one of ``CODES``.
            message: the sentence in English.
            zh: the same in Chinese, whole: names, keys, paths and figures alone stay as they are.
        """
        super().__init__(code, message)
        self.message = {"en": message, "zh": zh}
