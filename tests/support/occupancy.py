"""The occupied cells of a map in map_server's format, read with Pillow, as rectangles."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import yaml
from PIL import Image
from shapely import box
from shapely.geometry import Polygon


def occupied_boxes(map_file: Path) -> tuple[Polygon, list[Polygon]]:
    """The map's extent, and rectangles that cover its cells that are not free; none overlap.

    Cells of a row that lie side by side are one rectangle, and so are equal runs of rows that
    follow one another.
    """
    fields = yaml.safe_load(map_file.read_text(encoding='utf-8'))
    assert not fields['negate']
    assert fields['origin'][2] == 0.0
    shades = np.asarray(Image.open(map_file.parent / fields['image']).convert('L'))[::-1]
    blocked = (255 - shades) / 255.0 >= fields['free_thresh']
    side, (west, south) = fields['resolution'], fields['origin'][:2]
    boxes: list[Polygon] = []
    open_runs: dict[tuple[int, int], int] = {}
    padded = np.pad(blocked, ((0, 1), (1, 1)))
    for row, cells in enumerate(padded.astype(np.int8)):
        steps = np.flatnonzero(np.diff(cells))
        runs = set(zip(steps[::2].tolist(), steps[1::2].tolist(), strict=True))
        for run in [run for run in open_runs if run not in runs]:
            low = open_runs.pop(run)
            left, right = west + run[0] * side, west + run[1] * side
            boxes.append(box(left, south + low * side, right, south + row * side))
        for run in runs:
            open_runs.setdefault(run, row)
    rows, columns = blocked.shape
    return box(west, south, west + columns * side, south + rows * side), boxes
