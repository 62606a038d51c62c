"""Try a fleet by force: many robots' planners with their real journals, killed, cut off, counted.

``python -m tools.fleet_trial`` (docs/fleet.md). It starts the service as its users do and imports
nothing of it; ``verdict`` judges from files and rows alone.
"""
