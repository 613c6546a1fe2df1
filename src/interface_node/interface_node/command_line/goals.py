"""What is asked of the interface node."""

from __future__ import annotations

from dataclasses import dataclass

from interface_node.command_line.missions import Mission


@dataclass(frozen=True, slots=True)
class MissionGoal:
    """A mission and how it is to be searched; zeros and empty texts leave a choice to the nodes.

    ``time_budget`` is in [s]; ``output_directory`` is absolute, or empty for no files.
    """

    mission: Mission
    output_directory: str = ''
    seed: int = 0
    time_budget: float = 0.0
    max_alternatives: int = 0
    use_advice: bool = True
    optimise: bool = False
    guidance: str = ''
