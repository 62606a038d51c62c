"""Show status, path and places of the planner to those who look with RViz. Moves nothing."""

from __future__ import annotations

import json
from typing import Any

from geometry_msgs.msg import Point, PoseStamped
from nav_msgs.msg import Path
from std_msgs.msg import String
from visualization_msgs.msg import Marker, MarkerArray

from .goals import ShownPlan, read_plan
from .readings import UnusableMessage
from .senses import KEPT

OLD_S = 3.0
"""A planner that showed nothing for so long counts as not heard."""


class RvizDisplay:
    """Publish what was heard last, for one node, on its own thread."""

    def __init__(self, node: Any, frame: str) -> None:
        self._node, self._frame = node, frame
        self._path = node.create_publisher(Path, "pons/path", KEPT)
        self._markers = node.create_publisher(MarkerArray, "pons/markers", KEPT)
        self._status = node.create_publisher(String, "pons/status", KEPT)
        self._heard: tuple[str, float] = "", 0.0
        self._shown: ShownPlan | None = None

    def hear(self, text: str, now_s: float) -> None:
        """Take what the planner shows, on whichever thread."""
        self._heard = text, now_s

    def look(self, now_s: float) -> str:
        """Publish what is new; return how the bridge stands, empty where no planner is heard."""
        text, heard_s = self._heard
        if not text or now_s - heard_s > OLD_S:
            return ""
        try:
            plan = read_plan(text)
        except UnusableMessage as why:
            self._node.get_logger().warning(str(why))
            return ""
        before, self._shown = self._shown, plan
        if before is None or before.path != plan.path:
            self._path.publish(self._make_path(plan))
        if before is None or before.places != plan.places:
            clear = Marker(action=Marker.DELETEALL)
            clear.header.frame_id = self._frame
            places = [self._make_place(number, *one) for number, one in enumerate(plan.places)]
            self._markers.publish(MarkerArray(markers=[clear, *places]))
        if before is None or (before.mode, before.held) != (plan.mode, plan.held):
            self._status.publish(String(data=json.dumps({"mode": plan.mode, "held": plan.held})))
        return f"{plan.mode} {plan.held}".strip()

    def _make_path(self, plan: ShownPlan) -> Any:
        path = Path()
        path.header.frame_id = self._frame
        path.header.stamp = self._node.get_clock().now().to_msg()
        for x, y in plan.path:
            pose = PoseStamped(header=path.header)
            pose.pose.position = Point(x=x, y=y)
            pose.pose.orientation.w = 1.0
            path.poses.append(pose)
        return path

    def _make_place(self, number: int, name: str, x: float, y: float) -> Any:
        marker = Marker(ns="places", id=number, type=Marker.TEXT_VIEW_FACING, text=name)
        marker.header.frame_id = self._frame
        marker.pose.position = Point(x=x, y=y, z=0.3)
        marker.pose.orientation.w, marker.scale.z = 1.0, 0.25
        marker.color.r = marker.color.g = marker.color.b = marker.color.a = 1.0
        return marker
