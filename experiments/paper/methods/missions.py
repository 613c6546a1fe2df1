"""Domains and problems of the three methods: the same photos, with ways among the facts or without."""

from __future__ import annotations

from collections.abc import Sequence

from experiments.paper.methods.graphs import START, Graph

PHOTO = '(rover ?r)(available ?r)(objective ?o)(need_photo_of ?o)(has_camera ?r ?c)'
#: Photos in the order of the text: the methods differ in how the rover gets there.
IN_ORDER = '(:method (photograph ?_ nil) () ())'
ROVER_FACTS = '(rover rover0)(available rover0)(camera cam0)(has_camera rover0 cam0)'
WAY = '(at ?r ?here)(can_traverse ?here ?next)'
PASSED = '(not (passed ?next))'


def symbolic(choice: str, *, marked: bool = True, sighted: bool = False) -> str:
    """A domain that drives from waypoint to waypoint by ``choice``, a condition that binds ?next.

    Args:
        choice: where to go next
        marked: whether the waypoints passed on this way are noted as facts, for ``choice`` to read
        sighted: whether the rover goes straight to an objective that it sees
    """
    see = (
        'in-sight ((at ?r ?here)(can_traverse ?here ?to)) ((!go_to ?r ?here ?to)(navigate ?r ?to))'
    )
    return f"""(defdomain waypoints (
(:operator (!go_to ?r ?from ?to)
  ((at ?r ?from)(can_traverse ?from ?to))
  ((at ?r ?from))
  ((at ?r ?to)))
(:operator (!!pass ?here) () () ((passed ?here)))
(:operator (!!arrive) () ((forall (?p) ((passed ?p)) ((passed ?p)))) ())
(:operator (!take_photo ?r ?o ?c)
  ({PHOTO}(at ?r ?o))
  ()
  ((has_photo_of ?r ?o)))
(:method (navigate ?r ?to)
  there ((at ?r ?to)) ({'(!!arrive)' if marked else ''})
  {see if sighted else ''}
  onwards {choice}
  ({'(!!pass ?here)' if marked else ''}(!go_to ?r ?here ?next)(navigate ?r ?to)))
{IN_ORDER}
(:method (photograph ?r (?o . ?others))
  ((has_camera ?r ?c))
  ((navigate ?r ?o)(!take_photo ?r ?o ?c)(photograph ?r ?others)))
))"""


#: The first waypoint that can be reached from here and was not passed on this way.
BLIND = symbolic(f'({WAY}{PASSED})')

#: The nearest one.
NEAREST = symbolic(f"(:sort-by ?d #'< ({WAY}{PASSED}(distance ?here ?next ?d)))")

#: The first one, unless the objective is in sight: a rule that the paper does not speak of.
SIGHTED = symbolic(f'({WAY}{PASSED})', sighted=True)

#: The first one; that no waypoint is passed twice is left to the search, which knows circles.
UNMARKED = symbolic(f'({WAY})', marked=False)

#: Ways are left to whom the geometric precondition is sent.
HYBRID = f"""(defdomain hybrid (
(Operator (!take_photo ?r ?o ?c)
  ({PHOTO})
  ((agent ?r)(object ?o)(distance(?r, ?o) <= 0))
  ((has_photo_of ?r ?o)))
{IN_ORDER}
(:method (photograph ?r (?o . ?others))
  ((has_camera ?r ?c))
  ((!take_photo ?r ?o ?c)(photograph ?r ?others)))
))"""

#: The paper's operator, in whatever order is best.
ATTITUDES = f"""(defdomain attitudes (
(Operator (!take_photo ?r ?o ?c)
  ({PHOTO})
  ((agent ?r)(object ?o)(distance(?r, ?o) >= 50)(distance(?r, ?o) <= 100)
   (rel_angle(?r, ?o) = cos-and-sin(pi/2)))
  ((has_photo_of ?r ?o)))
{IN_ORDER}
(:method (photograph ?r (?o . ?others))
  ((has_camera ?r ?c))
  (:unordered (!take_photo ?r ?o ?c)(photograph ?r ?others)))
))"""


def problem(goals: Sequence[str], graph: Graph | None = None) -> str:
    """Photos of ``goals``; with a ``graph`` its ways and their lengths are among the facts."""
    facts = [ROVER_FACTS, *(f'(objective {goal})(need_photo_of {goal})' for goal in goals)]
    if graph is not None:
        facts.append(f'(at rover0 {START})')
        facts += [f'(waypoint {label})' for label in graph.points]
        facts += [f'(can_traverse {a} {b})' for a, b in graph.arcs]
        facts += [f'(distance {a} {b} {length:.6f})' for (a, b), length in graph.arcs.items()]
    return f'(defproblem photos () ({" ".join(facts)}) ((photograph rover0 ({" ".join(goals)}))))'
