"""Propose: turn a sentence into a plan, a plan into waypoints. Imports wire and never the bridge."""
