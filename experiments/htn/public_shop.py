"""Reads and solves the SHOP domains and problems below a folder, as in the repository of SHOP3.

Nothing of such a repository is shipped: clone it and name the folder.  A problem belongs to the nearest definition of
the domain that it names: in its own file, else in its folder, else in one above.

    python -m experiments.htn.public_shop FOLDER [--solve SECONDS]
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from experiments.htn import ours
from task_planner_node.errors import MissionError
from task_planner_node.language import load_source
from task_planner_node.language.reader import ListNode, Node, Symbol, first_word, read
from task_planner_node.outcomes import Options


@dataclass(frozen=True)
class Definition:
    """One ``defdomain`` or ``defproblem``: its name, the domain of a problem, and its text."""

    path: Path
    name: str
    domain: str
    text: str


def definitions(folder: Path, word: str) -> Iterator[Definition]:
    """All definitions that begin with ``word``; a file that cannot be read is left out."""
    for path in sorted(folder.rglob('*.lisp')):
        try:
            source = load_source('domain', str(path), '')
            nodes = read(source)
        except MissionError:
            continue
        for node in _forms(nodes, word):
            name, *others = (_name(child) for child in node.children[1:3])
            given = len(node.children) > 2 and isinstance(node.children[2], Symbol)
            text = source.text[node.start : node.end]
            yield Definition(path, name, others[0] if given else '', text)


def _forms(nodes: Sequence[Node], word: str) -> Iterator[ListNode]:
    """The definitions among ``nodes``, and those inside of other forms, such as ``(let () ...)``."""
    for node in nodes:
        if isinstance(node, ListNode) and first_word(node) == word and len(node.children) > 1:
            yield node
        elif isinstance(node, ListNode):
            yield from _forms(node.children, word)


def _name(node: Node) -> str:
    if isinstance(node, ListNode):
        return _name(node.children[0]) if node.children else ''
    return node.text.lower()


def domain_of(problem: Definition, domains: list[Definition]) -> Definition | None:
    """The nearest domain of that name, or any where none is named."""
    fitting = [domain for domain in domains if problem.domain in ('', domain.name)]
    for place in (problem.path, *problem.path.parents):
        for domain in fitting:
            if domain.path == place or place in domain.path.parents:
                return domain
    return None


def main() -> None:
    """Print a line for each folder, and the sum."""
    parser = argparse.ArgumentParser(description=(__doc__ or '').partition('\n')[0])
    parser.add_argument('folder', type=Path)
    parser.add_argument('--solve', type=float, default=2.0, metavar='SECONDS')
    options = parser.parse_args()
    domains = list(definitions(options.folder, 'defdomain'))
    counts: dict[Path, Counter[str]] = {}
    for problem in definitions(options.folder, 'defproblem'):
        count = counts.setdefault(problem.path.parent, Counter())
        count['problems'] += 1
        domain = domain_of(problem, domains)
        if domain is None:
            count['without a domain'] += 1
            continue
        run = ours.plan(domain.text, problem.text, Options(time_budget=options.solve))
        count[run.result.outcome.name] += 1
        if run.result.diagnostics and run.result.outcome.name == 'INVALID':
            print(f'  {problem.path.name} {problem.name}: {run.result.diagnostics[0]}')
    total: Counter[str] = sum(counts.values(), Counter())
    print(f'{len(domains)} domains')
    for folder, count in [*counts.items(), (options.folder, total)]:
        print(f'{folder.name}: ' + ', '.join(f'{number} {what}' for what, number in count.items()))


if __name__ == '__main__':
    main()
