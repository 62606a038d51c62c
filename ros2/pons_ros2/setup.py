"""Install the ROS 2 package: colcon reads this."""

from setuptools import setup

NAME = "pons_ros2"

setup(
    name=NAME,
    version="0.1.0",
    packages=[NAME],
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (f"share/{NAME}", ["package.xml"]),
        (f"share/{NAME}/launch", ["launch/pons.launch.py"]),
        (f"share/{NAME}/config", ["config/pons.yaml"]),
    ],
    install_requires=["setuptools", "eclipse-zenoh>=1.10,<1.11"],
    python_requires=">=3.10",
    zip_safe=True,
    entry_points={
        "console_scripts": ["base = pons_ros2.node:main", "guard = pons_ros2.guard:main"]
    },
)
