"""Decide purely: same state, inbox and time, same decision. Never imports time, sockets, logging, random or threads."""
