"""The one exception of the set-up."""

from __future__ import annotations


class SetUpError(Exception):
    """The set-up cannot go on; the text says in one sentence why, and what to do about it."""
