"""Hold the core's memory of sensors and its own loop, and the windows of the detectors."""

from __future__ import annotations

from dataclasses import dataclass

from bridge.core.geometry.lidar_scan import ScanPicture
from wire import DriveState, Imu, Localization, Pose2, Scan
from wire.value import value


@dataclass(slots=True)
class DriveMemory:
    """Remember the drive's newest report and how far its echo lags behind."""

    newest: DriveState | None = None
    received_s: float | None = None
    behind: int = 0
    """Commands sent since the one echoed, judged when a state is received."""
    ahead: int = 0
    """By how much its echo names a command that this bridge has not sent yet."""
    behind_base: int = 0
    """The command seq before which no echo can be asked for (start of this drive's life)."""
    echoed_us: bool = False
    """It has echoed a command of this bridge: it may echo nobody else's after that."""
    echoes_other: str = ""
    """The boot of another commander that it echoes since."""
    reborn_s: float | None = None
    """When the drive's boot id changed last."""
    still_since_s: float | None = None
    moving_since_s: float | None = None


@value
class SectorScan:
    """Hold the farthest return of each bin of one scan, and how the robot stood."""

    far_m: tuple[float, ...]
    """-1 where nothing returned."""
    first_rad: float
    """Direction of the scan's beam 0 in ``base``."""
    yaw_rad: float
    """Of ``base`` in ``odom``."""
    at_s: float


@value
class SectorTurn:
    """Hold what was silent since a turn on the spot began."""

    yaw_rad: float
    travelled_m: float
    """The odometer when it began."""
    began: int
    """Bins that were silent then."""
    through: int
    """Bins that were silent in each scan since."""


@value
class SectorMemory:
    """Remember which directions of the lidar return something, in bins, each a bit of a mask."""

    bins: int = 0
    """Of a turn, counted in ``base``."""
    alive: int = 0
    """Those from which something has come since the start."""
    dead: int = 0
    """Those that are silent by the lidar's own fault."""
    scans: tuple[SectorScan, ...] = ()
    """The last two, newest first."""
    gone: tuple[tuple[float, int], ...] = ()
    """When [s] which bins fell silent together and are so still, oldest first."""
    turn: SectorTurn | None = None
    ahead_rad: float = 0.0
    """How much of the way ahead is dead or never proven; 0 if that is too little to hide much."""
    behind_rad: float = 0.0


NO_SECTORS = SectorMemory()


@dataclass(frozen=True, slots=True)
class LidarMemory:
    """Remember the newest scan, its points, and the returns that are normal for it."""

    newest: Scan | None = None
    received_s: float | None = None
    picture: ScanPicture | None = None
    equal: int = 0
    """Scans in a row that equal the newest, itself included."""
    equal_from_m: float = 0.0
    """Odometer reading when the first of them came."""
    baseline_scans: int = 0
    baseline_returns: float = 0.0
    """Mean number of returns in the first 20 scans that saw something."""
    sectors: SectorMemory = NO_SECTORS


@value
class Drift:
    """Remember where localization has moved the robot to, as far as odometry does not explain it.

    Each correction adds the displacement of the robot's place in ``map``; each metre and radian
    that the robot moved takes some off.
    """

    x_m: float = 0.0
    y_m: float = 0.0
    yaw_rad: float = 0.0
    travelled_m: float = 0.0
    """Odometer readings at the newest correction."""
    turned_rad: float = 0.0
    slipped_rad: float = 0.0
    jumps_at_s: tuple[float, ...] = ()
    """When a jump took a grant away, the last three times."""


@value
class PoseMemory:
    """Remember the pose of ``odom`` in ``map``, its sources, and the gyro."""

    localization: Localization | None = None
    """The newest of this odom_id and map, good or poor."""
    received_s: float | None = None
    jumped_s: float | None = None
    imu: Imu | None = None
    imu_received_s: float | None = None
    good: Localization | None = None
    """The newest that was good: what a jump is measured from."""
    drift: Drift = Drift()
    slipped_rad: float = 0.0
    """Turns that the wheels told and the gyro did not, or the other way round, added up."""


@dataclass(frozen=True, slots=True)
class ButtonMemory:
    """Remember the protective-stop inputs."""

    link_pressed: bool = False
    link_received_s: float | None = None
    pressed_s: float | None = None
    """When an input was last seen pressed."""
    ordered: bool = False
    """op/estop was said since the last reset."""


@dataclass(frozen=True, slots=True)
class LoopMemory:
    """Remember when the loop was late."""

    late_at_s: tuple[float, ...] = ()
    """The last five ticks that started over 5 ms late."""
    capped_s: float | None = None
    """Newest time at which the milder window was full."""
    gaps_at_s: tuple[float, ...] = ()
    """The last three gaps over 100 ms."""
    missed: int = 0
    real_time: bool = False
    recorder_ok: bool = False


@value
class SentBounds:
    """Bound the commands sent to both wheels [m/s at the rim] since a time."""

    since_s: float
    left_low: float
    left_high: float
    right_low: float
    right_high: float


@dataclass(slots=True)
class DetectorMemory:
    """Remember how long each trouble has been seen."""

    blind_s: float = 0.0
    blind_way: float = 0.0
    """Which way it was asked to drive into a sector that returns nothing: 1, -1, or 0 for none."""
    blind_mission: str | None = None
    """For whom; another's way is judged by itself."""
    yaw_s: float = 0.0
    runaway_s: float = 0.0
    sent: tuple[SentBounds, ...] = ()
    """Oldest first; together they reach as far back as a drive may still follow."""
    stuck_s: float = 0.0
    progress_at: Pose2 | None = None
    """Where in ``odom`` the robot was when it last got on; None where nothing is to be got on."""
    progress_s: float = 0.0
    stuck_at_s: tuple[float, ...] = ()
    """When it was found stuck, the last three times."""
    peak_s: float = 0.0
    heat_a2s: float = 0.0
    """Square of the current beyond what may flow for ever, added up [A^2 s]."""
    low_s: float = 0.0
    empty_s: float = 0.0
    zone_mps: float | None = None
    """Speed of the slowest zone that the robot is in."""
    outside: bool = False
    """A hand took the robot out of the fence, and it has not been well inside since."""


@value
class Flood:
    """Count the messages on each command key, in this half window and in the one before."""

    half_since_s: float = 0.0
    counts: tuple[int, ...] = ()
    before: tuple[int, ...] = ()
    level_s: float = 0.0
    key: str = ""
    """Which key was over its limit last."""
