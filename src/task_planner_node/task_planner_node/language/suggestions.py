"""Which known word somebody probably meant."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

MOST_COMPARED = 2000
LONGEST_COMPARED = 100


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """A half-sentence ``; did you mean ...?`` to append, or an empty text."""
    if len(word) > LONGEST_COMPARED:
        return ''
    candidates = sorted(set(known) - {word})[:MOST_COMPARED]
    close = get_close_matches(word, candidates, n=1, cutoff=0.6)
    return f'; did you mean {close[0]}?' if close else ''
