"""Propose: a sentence becomes a plan, a plan waypoints. Imports wire and never the bridge."""
