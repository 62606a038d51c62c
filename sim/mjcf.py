"""Write the physics world as MJCF from a home's solids and a robot's geometry.

Choices: the chassis collides as a sphere whose equator, at lidar height, is the robot's disc; it
meets walls exactly like the disc does and costs a fraction of a cylinder's contacts. Wheels touch
the floor as spheres (one contact point each, so that turning does not scrub) and collide with
nothing else; two frictionless casters carry the rest. Ray groups: 0 what the lidar sees, 1 the
robot, 2 the floor.
"""

from __future__ import annotations

from math import cos, sin
from typing import TYPE_CHECKING

from sim.site import Disc, Solid
from sim.site.classes import CRATE_M, PERSON_HEIGHT_M, PERSON_RADIUS_M, SPARE_OBSTACLES
from wire.geometry import Pose2

if TYPE_CHECKING:
    from collections.abc import Iterable

    from sim.hardware import Hardware
    from sim.site.objects import Upright
    from wire.robot import Base

OBSTACLES = SPARE_OBSTACLES
"""Movable obstacles, parked below the floor until a test or a story places them."""
PARKED_Z_M = -50.0

SETTLE_STEPS = 250
"""Half a second at 2 ms: the robot sinks onto its springs before anybody reads an encoder."""

_CASTER_RADIUS_M = 0.05
_CASTER_GAP_M = 0.0005
"""Casters hang a little high: the wheels carry the weight, and with it have their grip."""
_TRACKING = 20.0
"""Servo gain [N m s/rad]: with half the robot on a 0.1 m wheel it follows within 10 ms."""
_ARMATURE = 0.05
"""Rotor inertia as the wheel feels it through its gear [kg m2]; keeps the servo stable at 2 ms.

The servo is integrated explicitly: the implicit integrators slow the wheel after the contact force
was found, and a wheel then slips by 25 ms times the acceleration.
"""


def world_mjcf(
    solids: Iterable[Solid],
    base: Base,
    hardware: Hardware,
    step_s: float,
    uprights: Iterable[Upright] = (),
) -> str:
    """Return the whole model as XML: fixed solids, movable things, the robot.

    Elliptic cones with impratio 10 keep wheels from creeping. With some tens of solids and one
    robot, islands and the mid-phase cost more than they save (78 against 62 us for 5 steps).
    """
    return f"""<mujoco model="home">
  <compiler angle="radian" inertiafromgeom="true"/>
  <option timestep="{step_s}" integrator="Euler" cone="elliptic" impratio="10">
    <flag island="disable" midphase="disable" autoreset="disable"/>
  </option>
  <worldbody>
    <geom name="floor" type="plane" size="0 0 1" condim="1" friction="1 0 0" group="2"
          contype="1" conaffinity="0"/>
{chr(10).join(_solid(solid) for solid in solids)}
{chr(10).join([*map(_obstacle, OBSTACLES), *map(_upright, uprights)])}
{_robot(base, hardware)}
  </worldbody>
  <actuator>
{_motor("left", base, hardware)}
{_motor("right", base, hardware)}
  </actuator>
</mujoco>
"""


_SEEN = 'group="0" contype="0" conaffinity="2"'


def _solid(solid: Solid) -> str:
    half = solid.height_m / 2
    shape = solid.shape
    if isinstance(shape, Disc):
        form = f'type="cylinder" size="{shape.radius} {half}" pos="{shape.x} {shape.y} {half}"'
    else:
        x, y = (shape.x0 + shape.x1) / 2, (shape.y0 + shape.y1) / 2
        size = f"{(shape.x1 - shape.x0) / 2} {(shape.y1 - shape.y0) / 2} {half}"
        form = f'type="box" size="{size}" pos="{x} {y} {half}"'
    return f"    <geom {form} {_SEEN}/>"  # nameless: a home may call its furniture anything


def _obstacle(name: str) -> str:
    half = PERSON_HEIGHT_M / 2
    form = f'type="cylinder" size="{PERSON_RADIUS_M} {half}" pos="0 0 {half}"'
    if name.startswith("crate"):
        half = CRATE_M / 2
        form = f'type="box" size="{half} {half} {half}" pos="0 0 {half}"'
    return _mocap_body(name, Pose2(0.0, 0.0, 0.0), PARKED_Z_M, form)


def _upright(thing: Upright) -> str:
    half = thing.height_m / 2
    form = f'type="cylinder" size="{max(thing.half_m)} {half}" pos="0 0 {half}"'
    if not thing.round:
        form = f'type="box" size="{thing.half_m[0]} {thing.half_m[1]} {half}" pos="0 0 {half}"'
    return _mocap_body(thing.id, thing.pose, 0.0, form)


def _mocap_body(name: str, pose: Pose2, z_m: float, form: str) -> str:
    quat = " ".join(map(str, quaternion(pose.yaw_rad)))
    return (
        f'    <body name="{name}" mocap="true" pos="{pose.x_m} {pose.y_m} {z_m}" quat="{quat}">'
        f"<geom {form} {_SEEN}/></body>"
    )


def _robot(base: Base, hardware: Hardware) -> str:
    # A tenth of the mass is in the wheels; the rest sits low, as batteries do.
    chassis_kg, wheel_kg = 0.9 * hardware.mass_kg, 0.05 * hardware.mass_kg
    height = hardware.lidar_height_m
    reach = 0.75 * base.radius_m
    casters = "\n".join(
        f'      <geom name="caster_{name}" type="sphere" size="{_CASTER_RADIUS_M}" mass="0"'
        f' pos="{x} 0 {_CASTER_RADIUS_M + _CASTER_GAP_M}" condim="1" group="1"'
        ' contype="0" conaffinity="1"/>'
        for name, x in (("front", reach), ("rear", -reach))
    )
    return f"""    <body>
      <freejoint name="base"/>
      <geom name="ballast" type="cylinder" size="{0.8 * base.radius_m} 0.04" pos="0 0 0.1"
            mass="{chassis_kg}" group="1" contype="0" conaffinity="0"/>
      <geom name="chassis" type="sphere" size="{base.radius_m}" pos="0 0 {height}" mass="0"
            friction="0.3 0 0" group="1" contype="2" conaffinity="0"/>
{casters}
{_wheel("left", base.wheel_separation_m / 2, base.wheel_radius_m, wheel_kg)}
{_wheel("right", -base.wheel_separation_m / 2, base.wheel_radius_m, wheel_kg)}
    </body>"""


def _wheel(name: str, y_m: float, radius_m: float, mass_kg: float) -> str:
    return f"""      <body pos="0 {y_m} {radius_m}">
        <joint name="wheel_{name}" type="hinge" axis="0 1 0" armature="{_ARMATURE}"/>
        <geom name="wheel_{name}" type="sphere" size="{radius_m}" mass="{mass_kg}" condim="3"
              friction="1 0 0" group="1" contype="0" conaffinity="1"/>
      </body>"""


def _motor(name: str, base: Base, hardware: Hardware) -> str:
    # The servo's own lag, with half the robot's mass on its wheel, is part of the motor's.
    inertia = _ARMATURE + hardware.mass_kg / 2 * base.wheel_radius_m**2
    filter_s = max(0.001, hardware.motor_lag_s - inertia / _TRACKING)
    return (
        f'    <general name="motor_{name}" joint="wheel_{name}" dyntype="filterexact"'
        f' dynprm="{filter_s}" gainprm="{_TRACKING}" biastype="affine"'
        f' biasprm="0 0 -{_TRACKING}" forcerange="-{hardware.motor_torque_nm}'
        f' {hardware.motor_torque_nm}"/>'
    )


def quaternion(yaw_rad: float) -> tuple[float, float, float, float]:
    """Return the unit quaternion (w, x, y, z) of a turn about z."""
    return cos(yaw_rad / 2), 0.0, 0.0, sin(yaw_rad / 2)
