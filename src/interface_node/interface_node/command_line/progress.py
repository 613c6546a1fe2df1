"""The line that tells how a search is getting on."""

from __future__ import annotations

from math import inf, isfinite

from interface_node.command_line.results import Progress


def progress_line(progress: Progress, first_length: float = inf) -> str:
    """One line for people: phase, goals, requests, backtracks, best length [m], time [s].

    ``first_length`` [m] is that of the first plan.
    """
    parts = [progress.phase or 'planning']
    if progress.goals_total:
        parts.append(f'goals {progress.goals_reached}/{progress.goals_total}')
    if progress.requests:
        parts.append(f'requests {progress.requests}')
        parts.append(f'backtracks {progress.backtracks}')
    if isfinite(progress.best_length):
        best = f'best {progress.best_length:.1f} m'
        if isfinite(first_length) and first_length != progress.best_length:
            best += f' (first {first_length:.1f} m)'
        parts.append(best)
    if isfinite(progress.best_cost):
        parts.append(f'cost {progress.best_cost:.1f}')
    parts.append(f'{progress.elapsed:.1f} s')
    return '  '.join(parts)
