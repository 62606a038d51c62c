"""Measure our own brains on what `pons eval` does not ask: conversations, pictures, others' orders.

Not part of the wheel. The suites lie beside the code; each is one command of ``tools.evals``.
"""
