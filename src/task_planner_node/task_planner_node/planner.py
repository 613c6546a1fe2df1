"""The task planner as one function: two texts and a motion planner to a plan, or to why there is none."""

from __future__ import annotations

import time
from collections.abc import Callable
from math import inf

from task_planner_node.deep import on_deep_stack
from task_planner_node.errors import (
    Cancelled,
    Diagnostic,
    GeometryFailed,
    GeometryUnavailable,
    LimitReached,
    MissionError,
)
from task_planner_node.explanation import (
    details_of,
    explain_failure,
    explain_solution,
    place_refusal,
)
from task_planner_node.language.model import Domain, Problem, show
from task_planner_node.memory import resident
from task_planner_node.mission import MissionText, check_and_compile, read_mission
from task_planner_node.oracle import INVALID_CODES, Oracle, Purpose, Token
from task_planner_node.outcomes import Options, Outcome, Progress, Result
from task_planner_node.search.anytime import Anytime
from task_planner_node.search.domain import Start
from task_planner_node.search.geometry import Geometry, RequestRefused
from task_planner_node.search.partial_plan import Limits
from task_planner_node.search.plans import Plan, Plans
from task_planner_node.search.repair import Interrupted, Repair
from task_planner_node.search.state import State
from task_planner_node.search.statistics import Statistics

PROGRESS_INTERVAL = 0.1
PURPOSES = {'tour': Purpose.SHORTEST_TOUR, 'nearest_first': Purpose.NEAREST_FIRST}


class Planner:
    """One mission's way through loading, checking and searching.

    ``should_stop`` tells that the client took the mission back; ``report`` hears of every better plan at once, and
    of progress at most every PROGRESS_INTERVAL seconds.
    """

    def __init__(
        self,
        oracle: Oracle,
        options: Options,
        should_stop: Callable[[], bool] = lambda: False,
        report: Callable[[Progress], None] = lambda _: None,
    ) -> None:
        self._oracle = oracle
        self._options = options
        self._should_stop = should_stop
        self._report = report
        self._began = time.monotonic()
        self._reported = -1.0
        self._held = resident()
        self._statistics = Statistics()
        self._anytime: Anytime | None = None
        self._plans: Plans | None = None
        self._improvements: list[Progress] = []
        self._problem: Problem | None = None
        self._domain: Domain | None = None

    def plan(
        self,
        domain: MissionText,
        problem: MissionText,
        start: Token = (),
        interrupted: Interrupted | None = None,
    ) -> Result:
        """Plan a mission from the geometric state ``start``; never raises for what is in the texts.

        With ``interrupted`` the facts of the problem are those that hold now, and what is left of that plan is to
        be done instead of the tasks of the problem: as much of it as possible is kept (search/repair.py).
        """
        diagnostics: tuple[Diagnostic, ...] = ()
        try:
            outcome, explanation, diagnostics = on_deep_stack(
                lambda: self._plan(domain, problem, start, interrupted)
            )
        except MissionError as error:
            outcome, explanation = Outcome.INVALID, str(error)
            diagnostics = error.diagnostics
        except RequestRefused as refused:
            outcome, explanation, diagnostics = self._refused(refused)
        except Cancelled:
            outcome, explanation = Outcome.CANCELLED, 'cancelled by the client'
        except LimitReached as error:
            outcome, explanation, diagnostics = self._at_limit(str(error))
        except RecursionError:
            outcome, explanation, diagnostics = self._at_limit('the axioms recurse too deeply')
        except GeometryUnavailable as error:
            outcome, explanation = Outcome.UNAVAILABLE, str(error)
        except GeometryFailed as error:
            outcome, explanation = Outcome.FAILED, str(error)
        self._statistics.planning_time = time.monotonic() - self._began
        self._statistics.work = self._anytime.state.work if self._anytime else 0
        self._say('writing', force=True)
        kept = self._plans.kept if self._plans else ()
        plans = tuple(kept) if outcome == Outcome.SOLVED else ()
        details = details_of(explanation, self._anytime.search if self._anytime else None)
        told = tuple(self._improvements)
        return Result(outcome, explanation, diagnostics, plans, self._statistics, details, told)

    def _plan(
        self,
        domain_text: MissionText,
        problem_text: MissionText,
        start: Token,
        interrupted: Interrupted | None,
    ) -> tuple[Outcome, str, tuple[Diagnostic, ...]]:
        self._say('loading', force=True)
        domain, problem = read_mission(domain_text, problem_text)
        self._domain, self._problem = domain, problem
        self._say('checking', force=True)
        mission = check_and_compile(domain, problem, self._oracle, self._options.linear_matching)
        facts = [(fact.name, *fact.args) for fact in problem.facts]
        beginning: Start = mission.domain.beginning(problem)
        if interrupted is not None:
            facts = interrupted.facts(domain, facts)
            beginning = Repair(
                beginning, interrupted, lambda: self._anytime.search.deepest if self._anytime else 0
            )
        options = self._options
        limits = Limits(
            options.max_depth,
            options.optimise,
            options.use_advice,
            options.plans,
            PURPOSES[options.guidance],
        )
        plans = self._plans = Plans(limits, self._improve)
        anytime = self._anytime = Anytime(
            mission.domain,
            beginning,
            problem.tasks if interrupted is None else None,
            State(mission.domain.plan, facts, self._check),
            Geometry(self._oracle, self._statistics, options.max_alternatives, self._check),
            self._statistics,
            limits,
            plans,
            self._check,
        )
        self._say('searching', force=True)
        anytime.run(start)
        if plans.best is not None:
            return Outcome.SOLVED, explain_solution(plans.best), mission.warnings
        search = anytime.search
        outcome = Outcome.NO_PLAN if search.proven else Outcome.LIMIT
        reason = '' if search.proven else 'not everything could be tried: nothing is proven'
        explanation, remarks = explain_failure(search, reason, domain, problem)
        return outcome, explanation, (*remarks, *mission.warnings)

    def _refused(self, refused: RequestRefused) -> tuple[Outcome, str, tuple[Diagnostic, ...]]:
        if refused.code not in INVALID_CODES:
            task = show(refused.task)
            explanation = f'the motion planner cannot work on {task}: {refused.message}'
            return Outcome.FAILED, explanation, ()
        domain, problem = self._domain, self._problem
        diagnostic = place_refusal(refused, domain, problem) if domain and problem else None
        if diagnostic is None:
            return Outcome.INVALID, refused.message, ()
        return Outcome.INVALID, str(diagnostic), (diagnostic,)

    def _at_limit(self, reason: str) -> tuple[Outcome, str, tuple[Diagnostic, ...]]:
        """A limit ends the search: with the best plan so far when there is one."""
        anytime, domain, problem = self._anytime, self._domain, self._problem
        if anytime is None or domain is None or problem is None:
            return Outcome.LIMIT, reason, ()
        best = self._plans.best if self._plans else None
        if best is not None:
            return Outcome.SOLVED, explain_solution(best), ()
        explanation, remarks = explain_failure(anytime.search, reason, domain, problem)
        return Outcome.LIMIT, explanation, remarks

    def _improve(self, plan: Plan) -> None:
        """Tell a plan that is better than all before."""
        plans = self._plans
        if plans is None or plan is not plans.best:
            return
        progress = self._progress('searching', plan)
        self._statistics.improvements = len(self._improvements)
        self._improvements.append(progress)
        self._report(progress)

    def _check(self) -> None:
        if self._should_stop():
            raise Cancelled
        if time.monotonic() - self._began > self._options.time_budget:
            raise LimitReached(f'the time budget of {self._options.time_budget:g} s is spent')
        if self._say('searching') and resident() - self._held > self._options.memory_limit * 2**20:
            raise LimitReached(f'the memory limit of {self._options.memory_limit} MiB is reached')

    def _say(self, phase: str, force: bool = False) -> bool:
        """Report progress; whether it was time for that."""
        if not force and time.monotonic() - self._began - self._reported < PROGRESS_INTERVAL:
            return False
        self._report(self._progress(phase))
        return True

    def _progress(self, phase: str, improved: Plan | None = None) -> Progress:
        """Where the search stands, to be reported."""
        elapsed = self._reported = time.monotonic() - self._began
        problem, anytime = self._problem, self._anytime
        if problem is None or anytime is None:
            return Progress(phase, elapsed=elapsed)
        statistics = self._statistics
        position = anytime.running.position
        best = self._plans.best if self._plans else None
        return Progress(
            phase,
            sum((goal.name, *goal.args) in anytime.state.facts for goal in problem.goals),
            len(problem.goals),
            statistics.requests,
            statistics.backtracks + statistics.geometric_backtracks,
            position[4] if position else 0,
            position[1].length if position else 0.0,
            best.length if best else inf,
            elapsed,
            best.cost if best else inf,
            improved,
        )
