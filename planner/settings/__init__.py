"""Read the owner's settings: `$PONS_HOME/settings.toml` and a few environment variables."""

from planner.settings.budget import BudgetSettings, DayLimits, GoalLimits, Limits, Price
from planner.settings.limits import LimitSettings
from planner.settings.loader import (
    FILE,
    Settings,
    find_exposed,
    judge_tables,
    list_keys,
    load_settings,
    place_of,
    with_published_price,
)
from planner.settings.memory import MemorySettings
from planner.settings.mission import MissionSettings
from planner.settings.model import OWN_FIELDS, ModelSettings
from planner.settings.model_address import same_place
from planner.settings.mqtt import MqttSettings
from planner.settings.orders import NotifySettings, OrderSettings
from planner.settings.presets import PRESETS, JsonMode, Preset, PresetName, TokensField
from planner.settings.tools import ToolServerSettings
from planner.settings.vision import VisionSettings
from planner.settings.voice import SpeechSettings, VoiceSettings

__all__ = [
    "FILE",
    "OWN_FIELDS",
    "PRESETS",
    "BudgetSettings",
    "DayLimits",
    "GoalLimits",
    "JsonMode",
    "LimitSettings",
    "Limits",
    "MemorySettings",
    "MissionSettings",
    "ModelSettings",
    "MqttSettings",
    "NotifySettings",
    "OrderSettings",
    "Preset",
    "PresetName",
    "Price",
    "Settings",
    "SpeechSettings",
    "TokensField",
    "ToolServerSettings",
    "VisionSettings",
    "VoiceSettings",
    "find_exposed",
    "judge_tables",
    "list_keys",
    "load_settings",
    "place_of",
    "same_place",
    "with_published_price",
]
