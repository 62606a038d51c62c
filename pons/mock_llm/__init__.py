"""Serve the offline brain over the OpenAI protocol, with a few faults of real servers.

A demonstration's model. It knows no site: the closed world is read from each request, so any client
that sends our prompt or a schema with places gets a plan. The tests' server has many more faults.
"""

from pons.mock_llm.app import build
from pons.mock_llm.server import FAULTS, MockServer, Switches

__all__ = ["FAULTS", "MockServer", "Switches", "build"]
