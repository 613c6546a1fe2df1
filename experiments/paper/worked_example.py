"""The worked example, Table 2 and the penalty of Figure 3, as the paper has them and as they are here."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from math import dist, hypot, isnan
from pathlib import Path

import numpy as np

from experiments.paper.derived_codes import NEAREST, Check, checks
from experiments.paper.part import Claim, Part, write_csv
from experiments.paper.report import table
from experiments.pictures import penalty
from experiments.pictures.solver import EXAMPLE, RING
from experiments.results import Target
from motion_planner_node.functions import Array
from motion_planner_node.satisfaction import descend
from motion_planner_node.satisfaction.paper_mode import PaperCriterion, PaperLimits

#: [1/m or 1/rad] between a derived code and central differences.
AGREEMENT = 1e-6
#: What the paper prints.
PRINTED_R1, PRINTED_DISTANCE = (40.0, 67.0), 19.72


@dataclass(frozen=True)
class Sizes:
    """How much is measured: random states, cells along a side of the landscape, descents in a panel."""

    states: int
    cells: int
    descents: int


FULL = Sizes(100_000, 120, 8)
QUICK = Sizes(500, 24, 3)


@dataclass(frozen=True)
class Example:
    """The worked example: states (3,) after one step in mode paper and at the end of the default descent."""

    start: Array
    paper: Array
    step_length: float
    satisfied: bool
    default: Array
    default_steps: int
    printed_minimum: float

    def distance(self, state: Array) -> float:
        """Metres to the object."""
        return dist(state[:2], EXAMPLE.place)


def example() -> Example:
    """Run the worked example in both modes."""
    begin = EXAMPLE.start
    start = np.array([begin.x, begin.y, begin.heading])
    program = EXAMPLE.program(RING)
    criterion = PaperCriterion(program)
    following = criterion.next_state(start, PaperLimits().halvings)
    if following is None:
        raise ValueError('the worked example has no step that helps')
    state, step_length = following
    descent = descend(program, start)
    return Example(
        start,
        state,
        step_length,
        criterion.is_zero(state),
        descent.states[0],
        int(descent.iterations[0]),
        _printed_minimum(),
    )


def _printed_minimum() -> float:
    """The least F with the printed signs: f1 = d - 10 and f2 = 20 - d, both penalised where positive."""
    d = np.linspace(0.0, 100.0, 10_001)
    f1, f2 = np.maximum(d - 10.0, 0.0), np.maximum(20.0 - d, 0.0)
    return float((0.5 * f1**2 + 0.5 * f2**2).min())


def measure(sizes: Sizes, seed: int, folder: Path) -> Part:
    """Run the example, check the derivatives, draw the landscape."""
    worked = example()
    checked = checks(sizes.states, seed)
    write_csv(folder / 'table_2.csv', map(asdict, checked))
    picture, drawn = penalty.draw(folder / 'penalty', sizes.cells, sizes.descents, seed)
    steps = {mode: [len(states) - 1 for states in found] for mode, found in drawn.items()}
    missed = {mode: penalty.violation(found) for mode, found in drawn.items()}
    wrong = max(check.printed for check in checked if not isnan(check.printed))
    library = max(check.library for check in checked)
    moved = hypot(*(worked.paper - worked.start)[:2])
    return Part(
        'The worked example, Table 2 and the penalty of Figure 3',
        _text(worked, checked, sizes, steps, missed),
        {
            'worked_example': {
                'r1': worked.paper.tolist(),
                'distance': worked.distance(worked.paper),
                'step_length': worked.step_length,
                'moved': moved,
                'default': worked.default.tolist(),
                'default_distance': worked.distance(worked.default),
                'least_penalty_with_printed_signs': worked.printed_minimum,
            },
            'table_2': [asdict(check) for check in checked],
            'descents': {'steps': steps, 'greatest_violation': missed},
        },
        [
            Target('derived codes of Table 2 against differences', wrong, AGREEMENT),
            Target("the library's derivatives against differences", library, AGREEMENT),
            Target(
                "the worked example's r1 from the printed one [m]",
                dist(worked.paper[:2], PRINTED_R1),
                hypot(0.5, 0.5),
            ),
        ],
        _claims(worked, wrong, sizes),
        [picture],
    )


def _claims(worked: Example, wrong: float, sizes: Sizes) -> list[Claim]:
    x, y, _ = worked.paper
    return [
        Claim(
            'From r0 = (20, 100, 0) one step with lambda = 1 leads to r1 = (40, 67, 0), where the distance is 19.72 and both '
            'constraints are satisfied.',
            f'One step with lambda = {worked.step_length:g} leads to ({x:.4f}, {y:.4f}, 0), where the distance is '
            f'{worked.distance(worked.paper):.4f}, the greatest that is allowed; 19.72 is that of the rounded (40, 67).',
        ),
        Claim(
            'Table 2: the functions of distance and rel_angle, and their derived codes.',
            f'All four derived codes agree with central differences to {wrong:.0e} over {sizes.states} random states.',
        ),
    ]


def _text(
    worked: Example,
    checked: list[Check],
    sizes: Sizes,
    steps: dict[str, list[int]],
    missed: dict[str, float],
) -> str:
    paper, default = worked.paper, worked.default
    rows = [
        ('distance(r0, o)', '58.31', *2 * [f'{worked.distance(worked.start):.4f}']),
        ('r1 - r0, x', '19.71', f'{paper[0] - 20:.4f}', f'{default[0] - 20:.4f}'),
        ('r1 - r0, y', '-32.85', f'{paper[1] - 100:.4f}', f'{default[1] - 100:.4f}'),
        ('r1', '(40, 67)', *(f'({r[0]:.4f}, {r[1]:.4f})' for r in (paper, default))),
        ('distance(r1, o)', '19.72', *(f'{worked.distance(r):.7f}' for r in (paper, default))),
    ]
    derivatives = [
        (
            f'{check.function}, by {check.component}',
            'none' if isnan(check.printed) else f'{check.printed:.1e}',
            f'{check.library:.1e}',
            'yes' if check.kept else 'no',
            f'{check.greatest:.3g}',
        )
        for check in checked
    ]
    most = {mode: max(counts) for mode, counts in steps.items()}
    return f"""r0 = (20, 100, 0), o = (50, 50), 10 <= distance(r, o) <= 20. The paper's mode ends on the boundary; the default mode keeps a margin
of twice the tolerance inside, so that what is handed out meets the constraint exactly. With the signs of f1 and f2 as
printed there, F is {worked.printed_minimum:g} at its least, and the example would never end.

{table(('', 'printed', 'mode paper', 'default mode'), rows)}

Greatest deviation of Table 2's derived codes, as printed, and of the library's own derivatives, from central differences
of the printed functions, over {sizes.states} random states in the rover's world at least {NEAREST:g} m from the object. Derivatives that
Table 2 leaves out are 0 in the paper's gradient; the default solver's later steps have them.

{table(('derivative', 'as printed', 'library', 'in the truncated gradient', 'greatest value'), derivatives)}

The penalty of Figure 3's photo (50 to 100 m, object on the right), green where it is 0. Left, at the best heading for each position;
right, at heading 0, from which those descents begin. Hollow dots are where descents begin, arrows are headings. In mode paper the
{len(steps['paper'])} descents take at most {most['paper']} steps and end within {missed['paper']:.0e} of the constraints, in the default mode at
most {most['default']} steps and {missed['default']:.0g}.
"""
