"""What each part of the experiment on the paper hands over: figures, targets, tables, pictures."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
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


def write_csv(path: Path, head: Sequence[str], rows: Sequence[Sequence[object]]) -> Path:
    """Write a table for programs and return its path."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open('w', newline='', encoding='utf-8') as file:
        writer = csv.writer(file)
        writer.writerow(head)
        writer.writerows(rows)
    return path
