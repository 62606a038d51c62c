"""Start the node that Pons drives by, and the guard that leaves zeros when it was killed.

``ros2 launch pons_ros2 pons.launch.py params:=/my/pons.yaml``
"""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

PARAMETERS = Path(get_package_share_directory("pons_ros2")) / "config" / "pons.yaml"


def generate_launch_description() -> LaunchDescription:
    """Return both nodes; the parameters of both are in one file."""
    given = [LaunchConfiguration("params")]
    return LaunchDescription(
        [
            DeclareLaunchArgument("params", default_value=str(PARAMETERS)),
            Node(package="pons_ros2", executable="guard", parameters=given, respawn=True),
            Node(package="pons_ros2", executable="base", parameters=given, respawn=True),
        ]
    )
