"""Let Pons drive a base of ROS 2. Runs where ROS runs: rclpy, and eclipse-zenoh beside it."""
