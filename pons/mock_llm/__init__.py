"""Serve the offline brain over the OpenAI protocol, with switches for real servers' faults.

The tests' main model, and a demonstration's. It knows no site: the closed world is read from each
request, so any client that sends our prompt or a schema with places gets a plan.
"""

from pons.mock_llm.app import build
from pons.mock_llm.fault_switches import FAULTS, READABLE, Switches
from pons.mock_llm.serve import MockOptions, run

__all__ = ["FAULTS", "READABLE", "MockOptions", "Switches", "build", "run"]
