# GeoHTN's commands. Every target sets up what it needs; what is set up already costs a fraction of a second.

PYTHON ?= python3
RUN := ros2_ws/run
TYPECHECKS := mypy $(foreach file,$(wildcard src/*/test/conftest.py),'mypy $(file)')

.DEFAULT_GOAL := help
.PHONY: help setup mission test format lint typecheck experiments experiment-constraints \
  experiment-motion experiment-htn experiment-ordering experiment-paper experiment-packages fuzz clean

help: ## List the targets
	@echo 'make TARGET [PYTHON=python3.12]'
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/\1\t\2/p' $(MAKEFILE_LIST) | \
	  while IFS="$$(printf '\t')" read -r target text; do printf '  %-20s %s\n' "$$target" "$$text"; done

setup: ## Install ROS 2 Jazzy (where none is sourced) and the Python packages, and build the nodes
	@command -v $(PYTHON) >/dev/null || \
	  { echo 'set-up: $(PYTHON) is missing: sudo apt install python3 python3-venv python3-dev' >&2; exit 2; }
	@$(PYTHON) ros2_ws/set_up.py

mission: setup ## Plan the paper's rover mission with the three nodes; results in out/rover
	@$(RUN) geohtn run rover

test: setup ## Check format, lint and types, then run all tests
	@status=0; \
	for check in 'ruff format --check .' 'ruff check .' $(TYPECHECKS) 'pytest --hypothesis-profile=ci'; do \
	  echo "== $$check"; $(RUN) $$check || status=1; \
	done; exit $$status

format: setup ## Format the sources, and mend what the linter can
	@$(RUN) ruff format .
	@$(RUN) ruff check --fix .

lint: setup ## Check format and lint
	@$(RUN) ruff format --check .
	@$(RUN) ruff check .

typecheck: setup ## Check the types
	@status=0; for check in $(TYPECHECKS); do $(RUN) $$check || status=1; done; exit $$status

experiments: experiment-constraints experiment-motion experiment-htn experiment-ordering experiment-paper ## Run all experiments; results in out/experiments

experiment-constraints: experiment-packages ## Measure the solver of constraints beside scipy and CasADi
	@$(RUN) python -m experiments.constraints.run

experiment-motion: setup ## Measure motions beside an exhaustive reference and OMPL (some 15 minutes)
	@$(RUN) python -m experiments.motion.run

experiment-htn: experiment-packages ## Measure the task planner beside GTPyhop and Aries
	@$(RUN) python -m experiments.htn.run

experiment-ordering: experiment-packages ## Measure the local search of tours beside PyVRP and OR-Tools
	@$(RUN) python -m experiments.ordering.run

experiment-paper: setup ## Measure what the paper claims, part by part, and what goes beyond it
	@$(RUN) python -m experiments.paper.run

experiment-packages: setup
	@$(RUN) python -m pip install --quiet --disable-pip-version-check --no-deps -r ros2_ws/requirements/experiments.txt

fuzz: setup ## Read 100,000 broken texts of geometric preconditions (some minutes)
	@$(RUN) python -m experiments.fuzz --texts 100000

clean: ## Remove what the set-up made and all caches, but not out/
	rm -rf .venv ros2_ws/build ros2_ws/install ros2_ws/log .mypy_cache .pytest_cache .ruff_cache .hypothesis
	find src tests experiments ros2_ws msgs -name __pycache__ -type d -prune -exec rm -rf {} +
