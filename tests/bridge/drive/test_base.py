"""A drive whose wheels roll on without torque is refused, by whatever it calls that."""

from __future__ import annotations

from typing import cast

import pytest

from bridge.drive import Drive, SimDrive, require_brakes
from wire import ConfigError


class Metal:
    """Be as much of a drive as is looked at."""

    kind, virtual = "metal", False

    def __init__(self, braking: object) -> None:
        self.braking = braking


def test_wheels_that_brake_without_torque_are_taken() -> None:
    drive = cast("Drive", Metal("brake"))
    assert require_brakes(drive) is drive
    assert SimDrive.braking == "brake"


@pytest.mark.parametrize("declared", ["coast", "", "Brake", None])
def test_wheels_that_may_roll_on_are_refused(declared: object) -> None:
    with pytest.raises(ConfigError, match=r"^drive_coasts: drive 'metal' .*expected 'brake'"):
        require_brakes(cast("Drive", Metal(declared)))
