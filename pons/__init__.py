"""Offer the command line: up, say, stop, status and the rest."""
