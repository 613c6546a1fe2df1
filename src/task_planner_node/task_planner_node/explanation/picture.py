"""A decomposition tree as a picture (SVG): a row for each task, joined to the task that it comes from."""

from __future__ import annotations

from itertools import islice
from xml.sax.saxutils import escape

from task_planner_node.explanation.rows import Row, more, rows_of, title
from task_planner_node.search.tree import Tree

MOST_ROWS = 5_000
#: Of the picture, in pixels.
ROW, INDENT, MARGIN, LETTER = 22, 22, 12, 7.2
DEEPEST = 60
STYLE = (
    'text{font:12px monospace;fill:#222}.way{fill:#777}.action{fill:#1b5e9b;font-weight:bold}'
    'path{fill:none;stroke:#bbb}.hidden{fill:#999}circle{fill:#fff;stroke:#777}rect{fill:#1b5e9b}'
)


def svg(tree: Tree) -> str:
    """The picture; actions are blue, with their number in the plan, ways of decomposing grey.

    Of a tree with more than MOST_ROWS tasks only the first ones are drawn.
    """
    rows = list(islice(rows_of(tree), MOST_ROWS))
    places = {row.number: (_x(row), MARGIN + ROW * (index + 0.5)) for index, row in enumerate(rows)}
    lines, width = [], 0.0
    for row in rows:
        x, y = places[row.number]
        if row.parent is not None:
            above_x, above_y = places[row.parent]
            lines.append(f'<path d="M{above_x:g} {above_y + 5:g}V{y:g}H{x - 5:g}"/>')
    for row in rows:
        x, y = places[row.number]
        lines.append(_mark(row, x, y))
        words, markup = _label(row)
        lines.append(f'<text x="{x + 10:g}" y="{y + 4:g}">{markup}</text>')
        width = max(width, x + 10 + LETTER * len(words))
    height = 2 * MARGIN + ROW * len(rows)
    for line in more(tree, MOST_ROWS):
        lines.append(f'<text x="{MARGIN}" y="{height}">{line}</text>')
        height += ROW
    size = f'width="{width + MARGIN:.0f}" height="{height:.0f}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size}><style>{STYLE}</style>'
    return '\n'.join(
        [head, '<rect width="100%" height="100%" style="fill:#fff"/>', *lines, '</svg>\n']
    )


def _x(row: Row) -> float:
    return MARGIN + 5 + INDENT * min(row.depth, DEEPEST)


def _mark(row: Row, x: float, y: float) -> str:
    if row.node.primitive:
        return f'<rect x="{x - 4:g}" y="{y - 4:g}" width="8" height="8"/>'
    return f'<circle cx="{x:g}" cy="{y:g}" r="4"/>'


def _label(row: Row) -> tuple[str, str]:
    """The label as plain text, for its length, and marked up."""
    task = title(row.node)
    if row.node.step is not None:
        task = f'{row.node.step + 1}. {task}'
        return task, f'<tspan class="action">{escape(task)}</tspan>'
    if row.node.primitive:
        return task, f'<tspan class="hidden">{escape(task)}</tspan>'
    return f'{task}  {row.way}', f'{escape(task)} <tspan class="way">{escape(row.way)}</tspan>'
