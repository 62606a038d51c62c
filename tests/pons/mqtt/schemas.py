"""The documented fields of Home Assistant's MQTT entities that the robot's description uses.

Written from the option tables of https://www.home-assistant.io/integrations/mqtt/ and its pages for
vacuum, button, sensor, event and camera, of release 2026.9. A field that is not listed here is one
that nobody has looked up.
"""

from __future__ import annotations

ENTITY = frozenset({
    "platform", "unique_id", "name", "availability", "availability_mode", "icon", "qos",
    "json_attributes_topic", "device_class", "entity_category", "encoding",
})  # fmt: skip
"""Of every entity."""
PUBLISHES = frozenset({"command_topic", "retain", "message_expiry_interval"})
FIELDS = {
    "vacuum": ENTITY | PUBLISHES | {
        "state_topic", "send_command_topic", "clean_segments_command_topic", "supported_features",
        "clean_segments_command_template", "fan_speed_list", "set_fan_speed_topic",
    },
    "button": ENTITY | PUBLISHES | {"payload_press", "command_template"},
    "sensor": ENTITY | {
        "state_topic", "value_template", "unit_of_measurement", "state_class", "expire_after",
    },
    "event": ENTITY | {"state_topic", "event_types", "value_template"},
    "camera": ENTITY | {"topic", "image_encoding"},
}  # fmt: skip
REQUIRED = {
    "vacuum": frozenset({"unique_id"}),
    "button": frozenset({"command_topic"}),
    "sensor": frozenset({"state_topic"}),
    "event": frozenset({"state_topic", "event_types"}),
    "camera": frozenset({"topic"}),
}
DEVICE = frozenset({
    "identifiers", "connections", "name", "manufacturer", "model", "model_id", "sw_version",
    "hw_version", "serial_number", "suggested_area", "configuration_url", "via_device",
})  # fmt: skip
ORIGIN = frozenset({"name", "sw_version", "support_url"})
FEATURES = frozenset({
    "start", "pause", "stop", "return_home", "status", "locate", "clean_spot", "fan_speed",
    "send_command",
})  # fmt: skip
STATES = frozenset({"cleaning", "docked", "paused", "idle", "returning", "error"})
EXPIRY = frozenset({"days", "hours", "minutes", "seconds"})
