"""Make maps from scans: a chain of keyframes, loops that close it, and cells drawn from it.

Pure arrays and time, told by a process or a log. Knows scan matching; no sockets, no robot.
"""

import cv2

cv2.setNumThreads(1)  # a pool of threads would compete with the bridge's loop for two cores
