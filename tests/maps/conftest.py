"""Judge every refusal that the tests of maps bring about."""

from tests.site_sentences import refusals_are_whole_in_chinese

__all__ = ["refusals_are_whole_in_chinese"]
