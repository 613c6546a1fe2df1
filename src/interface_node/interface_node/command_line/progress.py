"""The line that tells how a search is getting on."""

from __future__ import annotations

from math import isfinite

from interface_node.command_line.results import Progress


def progress_line(progress: Progress) -> str:
    """One line for people: phase, goals, requests, backtracks, best length [m], time [s]."""
    parts = [progress.phase or 'planning']
    if progress.goals_total:
        parts.append(f'goals {progress.goals_reached}/{progress.goals_total}')
    if progress.requests:
        parts.append(f'requests {progress.requests}')
        parts.append(f'backtracks {progress.backtracks}')
    if isfinite(progress.best_length):
        parts.append(f'best {progress.best_length:.1f} m')
    if isfinite(progress.best_cost):
        parts.append(f'cost {progress.best_cost:.1f}')
    parts.append(f'{progress.elapsed:.1f} s')
    return '  '.join(parts)
