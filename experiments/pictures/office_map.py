"""Draw the map of the mission ``office``: one floor of an office building, 24 m by 14 m.

Run it with ``python -m experiments.pictures.office_map``; it writes ``office.png`` and
``office.yaml``, in the format of map_server, into the mission's folder.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from experiments.motion.maps import FREE, Drawing

ROOT = Path(__file__).resolve().parent.parent.parent
FOLDER = ROOT / 'src' / 'interface_node' / 'missions' / 'office'
WIDTH, HEIGHT = 24.0, 14.0
WALL, DOOR = 0.15, 1.1
#: Where the corridor's walls are, its middle lines [m].
CORRIDOR = (6.0, 8.0)
#: x [m] of the walls between the rooms, and of the western edge of each door.
SOUTH_WALLS, SOUTH_DOORS = (6.0, 11.0, 17.0), (8.7, 12.0, 18.6)
NORTH_WALLS, NORTH_DOORS = (8.0, 14.0, 20.0), (4.6, 10.4, 15.0, 21.6)
#: The lobby is open to the corridor.
LOBBY = (0.075, 5.6)
#: x_min, y_min, x_max, y_max [m].
FURNITURE = (
    (2.8, 1.6, 4.6, 2.4),  # the lobby's counter
    (6.2, 0.1, 9.2, 0.7),  # the kitchen's worktop
    (7.2, 2.6, 8.8, 3.6),
    (11.2, 2.0, 12.8, 2.4),  # shelves of the archive
    (15.2, 2.0, 16.8, 2.4),
    (11.2, 3.6, 12.0, 4.0),
    (13.4, 3.6, 16.8, 4.0),
    (19.0, 1.2, 19.7, 4.4),  # racks of the server room
    (21.4, 1.2, 22.1, 4.4),
    (1.2, 10.0, 3.4, 11.0),  # benches of the laboratory
    (5.2, 12.0, 7.0, 12.8),
    (18.4, 11.2, 19.6, 13.2),  # the boiler
    (20.4, 9.6, 21.2, 11.2),  # a desk
    (22.4, 12.9, 23.4, 13.8),
)


def draw_office_floor() -> Drawing:
    """Seven rooms and a lobby on both sides of a corridor, with doors and furniture."""
    drawing = Drawing(WIDTH, HEIGHT)
    half = WALL / 2
    for x in (0.0, WIDTH):
        drawing.box((x - WALL, 0.0, x + WALL, HEIGHT))
    for y in (0.0, HEIGHT):
        drawing.box((0.0, y - WALL, WIDTH, y + WALL))
    south, north = CORRIDOR
    for y in CORRIDOR:
        drawing.box((0.0, y - half, WIDTH, y + half))
    for x in SOUTH_WALLS:
        drawing.box((x - half, 0.0, x + half, south))
    for x in NORTH_WALLS:
        drawing.box((x - half, north, x + half, HEIGHT))
    for doors, y in ((SOUTH_DOORS, south), (NORTH_DOORS, north)):
        for x in doors:
            drawing.box((x, y - half, x + DOOR, y + half), FREE)
    drawing.box((LOBBY[0] + half, south - half, LOBBY[1], south + half), FREE)
    for piece in FURNITURE:
        drawing.box(piece)
    angles = np.linspace(0.0, 2.0 * np.pi, 40)
    table = (11.0 + 1.3 * np.cos(angles), 11.2 + 0.8 * np.sin(angles))
    drawing.polygon(np.column_stack(table))
    return drawing


if __name__ == '__main__':
    draw_office_floor().write(FOLDER, 'office')
