"""Choose decoder, line and shape of a scan by ``[lidar]`` of robot.toml."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil
from typing import TYPE_CHECKING, Protocol

from sensors.lidar import ld08, ldrobot, rplidar, ydlidar
from sensors.lidar.turn import Beams, ScanShape, cuts_for
from wire import ConfigError

if TYPE_CHECKING:
    from wire.lidar_config import LidarConfig

LEAST_BEAMS, MOST_BEAMS = 180, 1440
"""Of a scan. A lidar that takes more a turn gives the nearest return of each direction."""


class LidarDecoder(Protocol):
    """Turn one family's bytes into beams, and know what must be said to it."""

    baud: int
    max_gap_deg: float
    opening: tuple[bytes, ...]
    """Requests to send when the port opened, one after another."""
    closing: tuple[bytes, ...]
    rescue: bytes
    """What begins a sensor anew that does not answer; nothing where it takes no requests."""
    frames: int
    spoilt: int
    lost_bytes: int

    def feed(self, data: bytes, arrival_s: float) -> list[Beams]:
        """Take bytes read at ``arrival_s``; return the beams in them."""

    def forget(self) -> None:
        """Drop the unfinished: what comes next is of another time."""


@dataclass(frozen=True, slots=True)
class LidarKind:
    """Hold what robot.toml's choice means for port and scan."""

    config: LidarConfig
    name: str
    baud: int
    dtr: bool | None
    shape: ScanShape

    def decoder(self) -> LidarDecoder:
        """Return a decoder that has heard nothing yet."""
        return _decoder(self.config)


def kind_of(config: LidarConfig) -> LidarKind:
    """Return what robot.toml's lidar is.

    Raises:
        ConfigError: ``lidar_simulated``: the simulator's needs no process.
    """
    if config.is_simulated:
        raise ConfigError(
            "lidar_simulated",
            "lidar.kind is 'sim': the simulator speaks for it; name the kind of a real one",
        )
    cuts = cuts_for(config.scan_s)
    beams = min(MOST_BEAMS, max(LEAST_BEAMS, ceil(_beams_per_s(config) * config.scan_s)))
    return LidarKind(
        config=config,
        name="_".join(filter(None, (config.kind, config.model))),
        baud=config.baud or _decoder(config).baud,
        dtr=_dtr(config),
        shape=ScanShape(
            beams=cuts * ceil(beams / cuts),
            lidar=config,
            clockwise=not config.upside_down,
            cuts=cuts,
        ),
    )


def _decoder(config: LidarConfig) -> LidarDecoder:
    if config.kind == "rplidar":
        rpm = round(60.0 / config.scan_s)
        return rplidar.RplidarDecoder(rplidar.MODELS[config.model or ""], rpm)
    if config.kind == "ydlidar":
        return ydlidar.YdlidarDecoder(ydlidar.MODELS[config.model or ""])
    return ld08.Ld08Decoder() if config.kind == "ld08" else ldrobot.LdRobotDecoder()


def _beams_per_s(config: LidarConfig) -> float:
    if config.kind == "rplidar":
        return rplidar.MODELS[config.model or ""].beams_per_s
    if config.kind == "ydlidar":
        return ydlidar.MODELS[config.model or ""].beams_per_s
    return ld08.POINTS_PER_S if config.kind == "ld08" else ldrobot.POINTS_PER_S


def _dtr(config: LidarConfig) -> bool | None:
    if config.kind == "rplidar":
        return rplidar.MODELS[config.model or ""].dtr
    if config.kind == "ydlidar":
        return ydlidar.MODELS[config.model or ""].dtr
    return None


_ENOUGH_FRAMES = 2
_ENOUGH_BEAMS = 20


def recognize(data: bytes) -> str | None:
    """Return the kind whose frames stand in some bytes, if one's do; None for bytes of no kind."""
    ld = ldrobot.LdRobotDecoder()
    beams = ld.feed(data, 0.0)
    if ld.frames >= _ENOUGH_FRAMES:
        return "ld08" if ld08.is_slow(beams) else "ld19"
    for model in ("x4", "g2"):  # samples of 2 and of 3 bytes
        yd = ydlidar.YdlidarDecoder(ydlidar.MODELS[model])
        yd.feed(data, 0.0)
        if yd.frames >= _ENOUGH_FRAMES:
            return "ydlidar"
    for model, head in (("a1", rplidar.STANDARD_HEAD), ("a2", rplidar.EXPRESS_HEAD)):
        rp = rplidar.RplidarDecoder(rplidar.MODELS[model])
        rp.feed(head + data, 0.0)
        enough = _ENOUGH_BEAMS if model == "a1" else _ENOUGH_FRAMES
        if rp.frames >= enough and rp.lost_bytes <= len(data) // 4:
            return "rplidar"
    return None
