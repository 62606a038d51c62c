"""Guess what a sentence asks for by a small model. Knows no grammar and no site."""
