"""A gyro's part of robot.toml holds what its kind needs, or says what does not fit."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from wire.imu_config import ImuConfig


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ({"up": "x", "forward": "-x"}, "lie along one axis"),
        ({"up": "w"}, "Input should be 'x'"),
        ({"bus": 1}, "imu.bus is for mpu6050, bno085, not for kind 'base'"),
        ({"kind": "mpu6050"}, "imu.bus is missing"),
        ({"kind": "mpu6050", "bus": 1, "address": 0x4A}, "can have 0x68 or 0x69"),
        ({"kind": "bno085", "bus": -1}, "bus"),
    ],
)
def test_what_does_not_fit_is_named(keys: dict[str, Any], says: str) -> None:
    with pytest.raises(ValidationError) as refused:
        ImuConfig.model_validate(keys)
    assert says in str(refused.value)


def test_the_default_is_the_bases_own() -> None:
    assert not ImuConfig().is_on_i2c
    assert ImuConfig(kind="bno085", bus=1, address=0x4B).is_on_i2c
