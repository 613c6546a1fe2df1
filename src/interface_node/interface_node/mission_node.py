"""One mission from its three texts to the global plan: the interface of the paper's Figure 1."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf
from time import monotonic

from builtin_interfaces.msg import Time
from geohtn_msgs.action import PlanMission, PlanTasks
from geohtn_msgs.msg import (
    GlobalPlan,
    Outcome,
    PlanningProgress,
    PlanningStatistics,
    SourceText,
    Step,
    World,
)
from geohtn_msgs.srv import SetWorld

from interface_node.continuity import faults
from interface_node.conversions import diagnostic_to_message, plan_from_messages
from interface_node.display_conversions import header
from interface_node.history import History
from interface_node.outputs_node import TREES, Outputs
from interface_node.parameters import Parameters
from interface_node.peers_node import Peers, Unavailable
from interface_node.plan import Diagnostic, Plan
from interface_node.sources import SourceError, directory_of, read_source
from interface_node.waiting import Cancelled, repeating

#: [s] between two words on how a mission is getting on, at most.
HEARTBEAT = 0.5
#: What ``show`` is asked to publish: the plan, its message (None while there is no plan yet).
Show = Callable[[Plan, 'GlobalPlan | None', Time], 'dict[str, object]']


@dataclass(frozen=True)
class Surroundings:
    """What a mission needs of its node: clocks, progress, display, and when to stop."""

    peers: Peers
    parameters: Parameters
    now: Callable[[], Time]
    report: Callable[[PlanningProgress], None]
    show: Show
    should_stop: Callable[[], bool]


class Mission:
    """One mission; `run` never raises but for faults of the program itself."""

    def __init__(
        self,
        goal: PlanMission.Goal,
        mission_id: str,
        outputs: Outputs,
        surroundings: Surroundings,
    ):
        self._goal = goal
        self._id = mission_id
        self._outputs = outputs
        self._around = surroundings
        self._started = self._sent = monotonic()
        self._world = World()
        self._steps: list[Step] = []
        self._statistics = PlanningStatistics()
        self._progress = PlanningProgress(best_length=inf, best_cost=inf)
        self._history = History()

    def run(self) -> PlanMission.Result:
        """Plan, publish and record the mission, and keep telling that it is being worked on."""
        with repeating(HEARTBEAT, lambda: self._forward(self._progress)):
            return self._plan()

    def _plan(self) -> PlanMission.Result:
        self._report('loading')
        try:
            outcome = self._search(*self._read_sources())
        except SourceError as error:
            outcome = Outcome(
                value=Outcome.INVALID,
                explanation=str(error),
                diagnostics=[diagnostic_to_message(error.diagnostic)],
            )
        except Unavailable as error:
            outcome = Outcome(value=Outcome.UNAVAILABLE, explanation=str(error))
        except Cancelled:
            outcome = Outcome(value=Outcome.CANCELLED, explanation='the mission was cancelled')
        return self._finish(outcome)

    def _read_sources(self) -> tuple[SourceText, SourceText, SourceText]:
        goal = self._goal
        texts = []
        for kind, source in (
            ('domain', goal.domain),
            ('problem', goal.problem),
            ('world', goal.world),
        ):
            text = SourceText(path=source.path, text=read_source(kind, source.path, source.text))
            self._record(f'/mission/{kind}', text)
            texts.append(text)
        self._record('/mission/options', goal.options)
        return texts[0], texts[1], texts[2]

    def _search(self, domain: SourceText, problem: SourceText, world: SourceText) -> Outcome:
        around, parameters = self._around, self._around.parameters
        around.peers.check(parameters.peer_timeout, around.should_stop)
        self._report('checking')
        accepted = around.peers.set_world(
            SetWorld.Request(
                source=world.path or 'world',
                yaml=world.text,
                directory=directory_of(world.path),
            ),
            parameters.service_timeout,
            around.should_stop,
        )
        if not accepted.accepted:
            return Outcome(
                value=Outcome.INVALID,
                explanation='the motion planner refuses the world',
                diagnostics=accepted.diagnostics,
            )
        held = around.peers.get_world(parameters.service_timeout, around.should_stop)
        self._world = held.world
        self._display(None, Outcome())
        self._sent = monotonic()
        result = around.peers.plan_tasks(
            PlanTasks.Goal(
                mission=self._id,
                domain=domain,
                problem=problem,
                world_revision=accepted.revision,
                options=self._goal.options,
            ),
            accept_timeout=parameters.peer_timeout,
            cancel_timeout=parameters.cancel_timeout,
            should_stop=around.should_stop,
            on_feedback=lambda feedback: self._hear(feedback.progress),
        )
        self._statistics = result.statistics
        outcome: Outcome = result.outcome
        outcome.diagnostics = [*accepted.diagnostics, *outcome.diagnostics]
        if outcome.value == Outcome.SOLVED:
            self._steps = result.steps
        # Feedback that comes after the result is lost, but all of it is in the result once more.
        for progress in result.improvements:
            self._note(progress)
            self._progress.best_length = progress.best_length
            self._progress.best_cost = progress.best_cost
        return outcome

    def _finish(self, outcome: Outcome) -> PlanMission.Result:
        cancelled = outcome.value == Outcome.CANCELLED
        if outcome.value == Outcome.SOLVED:
            wrong = list(faults(self._plain(self._message(), outcome)))
            if wrong:
                outcome.value = Outcome.FAILED
                outcome.explanation = 'the steps of the plan do not fit together: ' + '\n'.join(
                    wrong
                )
                self._steps = []
        self._report('writing')
        message = self._message()
        if outcome.value == Outcome.SOLVED:
            self._display(message, outcome)
        if not cancelled:
            self._outputs.await_events(self._statistics, self._around.parameters.recording_timeout)
        self._record('/mission/outcome', outcome)
        self._record('/mission/statistics', self._statistics)
        plain = self._plain(message, outcome)
        self._outputs.write(plain, self._trees(), picture=not cancelled)
        for remark in self._outputs.trouble:
            outcome.explanation = '\n'.join(filter(None, (outcome.explanation, str(remark))))
            outcome.diagnostics = [*outcome.diagnostics, diagnostic_to_message(remark)]
        return PlanMission.Result(
            outcome=outcome,
            plan=message,
            statistics=self._statistics,
            files=self._outputs.files,
        )

    def _trees(self) -> dict[str, str]:
        """How the tasks were decomposed into the plan, if there is one and it is to be written."""
        around = self._around
        if not self._steps or not self._outputs.wanted:
            return {}
        timeout = around.parameters.service_timeout
        try:
            return {
                form: around.peers.tree(self._id, form, timeout, around.should_stop)
                for form in TREES
            }
        except (Unavailable, Cancelled) as error:
            missing = str(error) or 'cancelled before the decomposition tree was written'
            self._outputs.trouble.append(Diagnostic(missing, warning=True))
            return {}

    def _message(self) -> GlobalPlan:
        lengths = [step.answer[0].length for step in self._steps if step.answer]
        return GlobalPlan(
            header=header(self._around.now()),
            mission=self._goal.mission,
            world=self._world,
            steps=self._steps,
            length=float(sum(lengths)),
            planning_time=self._statistics.planning_time,
        )

    def _plain(self, message: GlobalPlan, outcome: Outcome) -> Plan:
        plan = plan_from_messages(
            message,
            outcome,
            self._statistics,
            world_path=self._goal.world.path,
            seed=self._goal.options.seed,
        )
        return replace(plan, improvements=self._history.improvements)

    def _display(self, message: GlobalPlan | None, outcome: Outcome) -> None:
        plan = self._plain(message or self._message(), outcome)
        shown = self._around.show(plan, message, self._around.now())
        for topic, published in shown.items():
            self._record(topic, published)

    def _record(self, topic: str, message: object) -> None:
        now = self._around.now()
        self._outputs.record(topic, message, now.sec * 1_000_000_000 + now.nanosec)

    def _report(self, phase: str) -> None:
        self._progress.phase = phase
        self._forward(self._progress)

    def _hear(self, progress: PlanningProgress) -> None:
        """Pass on how the task planner is getting on."""
        self._note(progress)
        self._forward(progress)

    def _note(self, progress: PlanningProgress) -> None:
        """Record what is told of a better plan."""
        progress.elapsed += self._sent - self._started
        if self._history.note(progress.elapsed, progress.best_length, progress.best_cost):
            self._record('/mission/progress', progress)

    def _forward(self, progress: PlanningProgress) -> None:
        progress.elapsed = monotonic() - self._started
        self._progress = progress
        self._around.report(progress)
