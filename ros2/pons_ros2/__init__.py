"""Hold the ROS 2 package ``pons_ros2``, whose pure parts the twin and the tests run too."""
