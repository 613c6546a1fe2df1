"""What each part of the experiment on the paper hands over: figures, targets, tables, pictures."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from experiments.results import Target


@dataclass(frozen=True)
class Claim:
    """What the paper says, and what was measured of it; both are sentences."""

    paper: str
    measured: str


@dataclass(frozen=True)
class Part:
    """One part of the experiment, measured.

    title: heading of its section
    text: Markdown below the heading, with its tables
    figures: whatever belongs into results.json
    pictures: files in the experiment's folder, shown in this order
    """

    title: str
    text: str
    figures: Mapping[str, Any]
    targets: Sequence[Target] = ()
    claims: Sequence[Claim] = ()
    pictures: Sequence[Path] = field(default=())


def flat(record: Mapping[str, Any]) -> dict[str, Any]:
    """A record without parts: of a ``length`` with a ``median`` comes ``length_median``."""
    columns: dict[str, Any] = {}
    for name, value in record.items():
        if isinstance(value, Mapping):
            columns |= {f'{name}_{part}': each for part, each in flat(value).items()}
        else:
            columns[name] = value
    return columns


def write_csv(path: Path, records: Iterable[Mapping[str, Any]]) -> Path:
    """Write a table for programs, with a column for each name in the flat records; return its path."""
    rows = [flat(record) for record in records]
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open('w', newline='', encoding='utf-8') as file:
        writer = csv.DictWriter(file, list(dict.fromkeys(name for row in rows for name in row)))
        writer.writeheader()
        writer.writerows(rows)
    return path
