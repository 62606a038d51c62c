"""Read the owner's settings: `$PONS_HOME/settings.toml` and a few environment variables."""

from planner.settings.model import OWN_FIELDS, ModelSettings
from planner.settings.owner import FILE, Settings, load_settings
from planner.settings.presets import PRESETS, Mode, Preset, PresetName, TokensField

__all__ = [
    "FILE",
    "OWN_FIELDS",
    "PRESETS",
    "Mode",
    "ModelSettings",
    "Preset",
    "PresetName",
    "Settings",
    "TokensField",
    "load_settings",
]
