"""A lidar's part of robot.toml has the keys of its kind, no others, and says what is wrong."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from wire.lidar_config import LIDAR_MODELS, WITHOUT_LINE, LidarConfig


def test_the_simulated_lidar_is_what_is_meant_where_nothing_is_said() -> None:
    assert LidarConfig().is_simulated


@pytest.mark.parametrize(
    ("kind", "model"),
    [(kind, model) for kind, models in LIDAR_MODELS.items() for model in models or (None,)],
)
def test_each_kind_is_taken_with_each_of_its_models(kind: str, model: str | None) -> None:
    port = None if kind in WITHOUT_LINE else "/dev/ttyUSB0"
    made = LidarConfig.model_validate({"kind": kind, "model": model, "port": port})
    assert made.model == model
    assert made.is_simulated == (kind == "sim")
    assert made.has_line == (port is not None)


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"kind": "sim", "port": "/dev/x"}, "lidar.port is for a lidar on a serial line"),
        ({"kind": "sim", "baud": 115_200}, "lidar.baud is for a lidar on a serial line"),
        ({"kind": "sim", "upside_down": True}, "lidar.upside_down is for one on a serial line"),
        ({"kind": "ros2", "port": "/dev/x"}, "lidar.port is for a lidar on a serial line"),
        ({"kind": "sim", "model": "a1"}, "lidar.model is for kinds of several models"),
        ({"kind": "ld19"}, "lidar.port is missing: kind 'ld19'"),
        ({"kind": "ld19", "port": "/dev/x", "model": "a1"}, "not for kind 'ld19'"),
        ({"kind": "rplidar", "port": "/dev/x"}, "lidar.model None is none that kind 'rplidar'"),
        ({"kind": "ydlidar", "port": "/dev/x", "model": "a1"}, "none that kind 'ydlidar' knows"),
    ],
)
def test_a_key_too_many_or_too_few_is_refused_by_name(given: dict[str, Any], says: str) -> None:
    with pytest.raises(ValidationError) as refused:
        LidarConfig.model_validate(given)
    assert says in str(refused.value)


def test_all_that_is_wrong_is_said_at_once() -> None:
    with pytest.raises(ValidationError) as refused:
        LidarConfig.model_validate({"kind": "ld19", "model": "a1"})
    assert "lidar.port is missing" in str(refused.value)
    assert "lidar.model is for" in str(refused.value)
