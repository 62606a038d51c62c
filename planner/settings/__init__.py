"""Read the owner's settings: `$PONS_HOME/settings.toml` and a few environment variables."""

from planner.settings.model import Mode, ModelSettings
from planner.settings.owner import FILE, Settings, load_settings

__all__ = ["FILE", "Mode", "ModelSettings", "Settings", "load_settings"]
