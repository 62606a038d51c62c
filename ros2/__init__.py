"""Dial the node on a robot of ROS 2 (the package pons_ros2), and speak to Pons over the wire.

A process of its own (``python -m ros2``), so that neither a slow network nor a broken message costs
the bridge a tick. No ROS is needed on this side (docs/ros2.md).
"""
