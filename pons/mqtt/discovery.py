"""Describe the robot as Home Assistant's device discovery has it: one message, all entities.

Pure: the robot's id and the owner's settings in, topics and JSON out. Fields are those of the MQTT
integration's documented schemas (docs/smart-home.md names the release); tests hold each to them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pons.mqtt import orders

if TYPE_CHECKING:
    from planner.settings import MqttSettings

ONLINE, OFFLINE = "online", "offline"
BIRTH = "status"
"""Home Assistant says ``online`` there, below the discovery prefix, when it has started."""
COMMAND_EXPIRY_S = 10
"""A command that a broker could not deliver for so long is thrown away by it."""
EVENT_TYPES = ("succeeded", "failed", "refused", "cancelled", "asks")
_FEATURES = ("start", "pause", "stop", "return_home", "status", "locate", "send_command")
_NAMES = {
    "en": {
        "battery": "Battery", "place": "Place", "activity": "Activity", "answer": "Last answer",
        "stop": "Stop", "camera": "Camera", "goal": "Goal",
    },
    "zh": {
        "battery": "电量", "place": "位置", "activity": "活动", "answer": "最近的回答",
        "stop": "停止", "camera": "相机", "goal": "任务",
    },
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Topics:
    """Name the topics of one robot."""

    base: str
    discovery_prefix: str
    device_id: str

    @property
    def config(self) -> str:
        """Return where the device is described."""
        return f"{self.discovery_prefix}/device/{self.device_id}/config"

    @property
    def birth(self) -> str:
        """Return where Home Assistant says that it has started."""
        return f"{self.discovery_prefix}/{BIRTH}"

    def of(self, word: str) -> str:
        """Return one of the robot's own topics."""
        return f"{self.base}/{word}"


def topics_of(settings: MqttSettings, robot_id: str) -> Topics:
    """Return the topics of a robot."""
    device_id = "pons_" + "".join(one if one.isalnum() else "_" for one in robot_id)
    return Topics(f"{settings.prefix}/{robot_id}", settings.discovery_prefix, device_id)


def discovery(
    settings: MqttSettings, robot_id: str, version: str, *, has_camera: bool
) -> dict[str, Any]:
    """Return the message that describes the robot."""
    topics = topics_of(settings, robot_id)
    names = _NAMES[settings.language.value]
    components = {
        "vacuum": _vacuum(topics),
        "stop": _stop(topics, names),
        "goal": {
            **_entity(topics, "event", "goal", names),
            "state_topic": topics.of("event"),
            "event_types": list(EVENT_TYPES),
        },
        **{word: _sensor(topics, word, names) for word in ("battery", "place", "activity")},
        "answer": _sensor(topics, "answer", names),
    }
    if has_camera and settings.picture_s:
        components["camera"] = {
            **_entity(topics, "camera", "camera", names),
            "topic": topics.of("camera"),
        }
    return {
        "device": {
            "identifiers": [topics.device_id],
            "name": settings.name or robot_id,
            "manufacturer": "Pons",
            "model": "Pons robot",
            "sw_version": version,
        },
        "origin": {"name": "Pons", "sw_version": version},
        "components": components,
    }


def _vacuum(topics: Topics) -> dict[str, Any]:
    return {
        **_entity(topics, "vacuum", "vacuum", {"vacuum": None}),  # the device's own name
        "state_topic": topics.of("state"),
        "command_topic": topics.of(orders.COMMAND),
        "send_command_topic": topics.of(orders.SENTENCE),
        "clean_segments_command_topic": topics.of(orders.SEGMENTS),
        "supported_features": list(_FEATURES),
        **_command(),
    }


def _stop(topics: Topics, names: dict[str, str]) -> dict[str, Any]:
    """Return the stop button, which needs the robot's process and no planner."""
    return {
        **_entity(topics, "button", "stop", names),
        "availability": [{"topic": topics.of("availability")}],
        "command_topic": topics.of(orders.STOP),
        "icon": "mdi:stop-circle",
        **_command(),
    }


def _sensor(topics: Topics, word: str, names: dict[str, str]) -> dict[str, Any]:
    found = {
        **_entity(topics, "sensor", word, names),
        "state_topic": topics.of("sensors"),
        "value_template": f"{{{{ value_json.{word} }}}}",
    }
    if word == "battery":
        return found | {
            "device_class": "battery", "unit_of_measurement": "%", "state_class": "measurement",
        }  # fmt: skip
    if word == "answer":
        return found | {"json_attributes_topic": topics.of("answer")}
    return found


def _entity(
    topics: Topics, platform: str, word: str, names: dict[str, str] | dict[str, None]
) -> dict[str, Any]:
    return {
        "platform": platform,
        "unique_id": f"{topics.device_id}_{word}",
        "name": names[word],
        "availability": [{"topic": topics.of("availability")}, {"topic": topics.of("planner")}],
        "availability_mode": "all",
    }


def _command() -> dict[str, Any]:
    """Return how a command is sent: once more if lost, never kept, and not when it is old."""
    return {
        "qos": 1, "retain": False, "message_expiry_interval": {"seconds": COMMAND_EXPIRY_S},
    }  # fmt: skip
