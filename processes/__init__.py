"""Priorities, parent death, supervised workers and pipes of every process. Imports nothing of ours.

Each module here is loaded by its own name and this file stays empty: the recorder's writer takes
:mod:`processes.priority` alone, and neither asyncio nor ctypes comes with it.
"""
