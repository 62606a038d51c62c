"""Give orders to several robots as to one: durable missions, in a process of its own.

Knows the robots by their HTTPS API alone and imports neither planner nor bridge; nobody imports it
(docs/adr/0093). A mission's id is its Idempotency-Key at the robot, so that no crash does it twice.
"""
