"""Teach the learned reader: assignments for writers, their sentences, the network's fit."""
