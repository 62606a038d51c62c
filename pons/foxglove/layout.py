"""Describe Foxglove's window for this robot: 3D, camera, plots, rows and log."""

from __future__ import annotations

from typing import Any

from pons.foxglove.topics import LiveTopic

_SPEEDS = ("asked_v_mps", "sent_v_mps", "measured_v_mps", "limit_v_mps")
_TICKS = ("late_p50_ms", "late_max_ms", "step_max_ms")
_DRAWN = (
    LiveTopic.SCAN,
    LiveTopic.POSE,
    LiveTopic.ROUTE,
    LiveTopic.MAP,
    LiveTopic.PLACES,
    LiveTopic.FENCE,
    LiveTopic.OBJECTS,
)


def layout() -> dict[str, Any]:
    """Return the layout as Foxglove imports it."""
    return {
        "configById": {
            "3D!home": {
                "followTf": "base",
                "followMode": "follow-none",
                "cameraState": {"perspective": False, "phi": 0, "distance": 16},
                "topics": {topic.value: {"visible": True} for topic in _DRAWN},
            },
            "Image!camera": {
                "imageMode": {
                    "imageTopic": LiveTopic.CAMERA.value,
                    "annotations": {LiveTopic.BOXES.value: {"visible": True}},
                }
            },
            "Plot!speed": _plot("Speed [m/s]", LiveTopic.SPEEDS, _SPEEDS),
            "Plot!ticks": _plot("Tick lateness [ms]", LiveTopic.TICKS, _TICKS),
            "RawMessages!rows": {"topicPath": LiveTopic.ROWS.value},
            "RosOut!log": {"minLogLevel": 1, "topicToRender": LiveTopic.LOG.value},
        },
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 1},
        "layout": {
            "direction": "row",
            "splitPercentage": 55,
            "first": {
                "direction": "column", "splitPercentage": 75,
                "first": "3D!home", "second": "RosOut!log",
            },
            "second": {
                "direction": "column", "splitPercentage": 40,
                "first": "Image!camera",
                "second": {
                    "direction": "column", "splitPercentage": 35,
                    "first": "Plot!speed",
                    "second": {
                        "direction": "column", "first": "Plot!ticks", "second": "RawMessages!rows",
                    },
                },
            },
        },
    }  # fmt: skip


def _plot(title: str, topic: LiveTopic, fields: tuple[str, ...]) -> dict[str, Any]:
    paths = [
        {"value": f"{topic.value}.{field}", "enabled": True, "timestampMethod": "receiveTime",
         "label": field}
        for field in fields
    ]  # fmt: skip
    return {
        "title": title, "paths": paths, "showLegend": True, "isSynced": True,
        "xAxisVal": "timestamp", "followingViewWidth": 30,
    }  # fmt: skip
