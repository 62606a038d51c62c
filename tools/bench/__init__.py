"""Measure and print tables; never asserted in tests."""
