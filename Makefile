# Everything a person or CI does with this checkout. `make` alone lists the targets.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
MAKEFLAGS += --no-print-directory

BIN := .venv/bin
RUNTIME := .venv/.installed
DEV := .venv/.installed-dev
ATTACK := .venv/.installed-attack
EXTRAS := .venv/.installed-extras
PAGE := web/dist/index.html
PAGE_DEV := web/node_modules/.pons-dev
PAGE_SOURCES := $(shell find web/src web/index.html web/fleet.html web/vite.config.ts web/package-lock.json -type f)
ARGS ?=
# Tests start hundreds of processes, and packages are installed without bytecode: with this set, as
# some images have it, each process would compile all that it imports anew (empty means: not set).
export PYTHONDONTWRITEBYTECODE :=

.PHONY: help setup extras dev page firmware wheel run fleet test e2e nightly coverage mutants laws seeds enumerate check fmt docs bench bench-long attack train lock audit clean

help: ## list these targets
	@awk -F ':.*## ' '/^[a-z0-9-]+:.*## / { printf "  make %-11s %s\n", $$1, $$2 }' Makefile

setup: $(RUNTIME) $(PAGE) ## make .venv, install what running needs from the locks, build the page

extras: $(EXTRAS) ## add what joins a robot with other programs: fleet, mcp, mqtt, foxglove, traces

dev: $(DEV) $(PAGE_DEV) ## add what testing and checking need

page: $(RUNTIME) ## build the page anew
	@scripts/page.sh build

firmware: ## build the motor controller's firmware (docs/firmware.md); needs gcc-avr and avr-libc
	@$(MAKE) -C firmware all

wheel: $(DEV) $(PAGE) ## build the wheel into dist/: packages, page, prompts, sites, detector, no tools
	@$(BIN)/python -m scripts.wheel dist

run: $(RUNTIME) $(PAGE) ## start simulator, localization, bridge and planner; prints one URL; Ctrl-C ends all
	@exec $(BIN)/pons up $(ARGS)

fleet: $(EXTRAS) $(PAGE) ## start three simulated robots and their fleet; prints one URL; Ctrl-C ends all (docs/fleet.md)
	@exec $(BIN)/pons fleet demo

# Stories run real processes in real time; what needs minutes, a browser or a robot of its own is not
# for `test`. Only the files that tell some are read, for reading all tests costs seconds. Unit tests
# beside them starve them, nice or not: each robot is a session of its own to the scheduler.
# `e2e` tells three rows of files at once, each about as long as the drive through the whole home.
HOME_ROW := tests/e2e/test_home_tour.py tests/e2e/test_external_brain.py tests/e2e/test_bases.py \
  tests/deploy/test_separate_starts.py tests/e2e/test_fleet.py
OWN_ROW := tests/e2e/test_calibrate.py tests/e2e/test_black_box.py tests/e2e/test_fence_changed.py tests/e2e/test_wheel.py \
  tests/e2e/test_model.py tests/e2e/test_finds_at_home.py tests/e2e/test_robot_changed.py tests/e2e/test_stop_anywhere.py \
  tests/e2e/test_smart_home.py tests/e2e/test_tool_servers.py
PAGE_ROW := tests/web
# These go with the two shorter rows: the page's would else be as long as both.
PAGE_BESIDE_HOME := tests/web/test_asked_first.py tests/web/test_missions.py tests/web/test_people.py tests/web/test_points.py
PAGE_BESIDE_OWN := tests/web/test_hand.py
STORIES = $(filter-out $(HOME_ROW) $(OWN_ROW) $(PAGE_ROW)/%,\
  $(shell grep -rl --include='test_*.py' 'pytest\.mark\.e2e' tests))
# ROOM=planner/mission: what lies in that folder of tests; CHANGED=HEAD: what imports a file that differs from it.
CHOSEN = $(addprefix tests/,$(ROOM)) $(if $(CHANGED),$(shell $(BIN)/python -m scripts.changed $(CHANGED)))
# What is marked nightly the gate samples; a chosen room, and the night, run it whole.
GATE = $(if $(WHOLE)$(ROOM)$(CHANGED),,--gate)
TOLD = $(if $(strip $(CHOSEN)),$(filter $(CHOSEN) $(addsuffix /%,$(CHOSEN)),$(STORIES)),$(STORIES))

test: $(DEV) $(PAGE_DEV) $(PAGE) ## run the unit tests and the two-room stories (about 7 min on 2 cores); ROOM=planner/mission or CHANGED=HEAD: those alone
	@$(if $(CHANGED)$(ROOM),$(if $(strip $(CHOSEN)),,echo "no test imports what changed"; exit 0;)) scripts/units.sh $(GATE) $(CHOSEN) $(ARGS)
	@$(if $(CHANGED)$(ROOM),$(if $(strip $(TOLD)),,exit 0;)) exec scripts/stories.sh -m "e2e and not home" $(GATE) $(TOLD) $(ARGS)

e2e: $(DEV) $(PAGE_DEV) $(PAGE) ## drive through the whole default home, and from a wheel; try models, calibration, fence, black box, systemd units, and the page in Chromium
	@exec $(BIN)/python scripts/at_once.py \
	  scripts/stories.sh -n 0 -m "e2e or home" $(GATE) $(HOME_ROW) $(PAGE_BESIDE_HOME) $(ARGS) \
	  ++ scripts/stories.sh -n 0 -m "e2e or home" $(GATE) $(OWN_ROW) $(PAGE_BESIDE_OWN) $(ARGS) \
	  ++ scripts/stories.sh -n 0 -m "e2e or home" $(GATE) $(PAGE_ROW) $(addprefix --ignore=,$(PAGE_BESIDE_HOME) $(PAGE_BESIDE_OWN)) $(ARGS)

nightly: ## what `make test` and `make e2e` leave out, and all else of both; most of an hour on 2 cores
	@$(MAKE) test WHOLE=1
	@$(MAKE) e2e WHOLE=1

# Every line and branch of what guards a motor, on the plain source. The tests left out walk no line
# that the others don't.
BRANCHES := --cov=bridge.core --cov=wire --cov-branch --cov-report=term-missing:skip-covered \
  --cov-fail-under=100 --hypothesis-profile=coverage -m "not slow and not e2e" -n logical \
  --ignore=tests/bridge/core/laws/test_enumerated.py \
  --ignore=tests/bridge/core/laws/test_hostile_machine.py
coverage: $(DEV) ## branch coverage of wire and bridge/core; fails under 100 % and names what is missing
	@$(BIN)/python -m pytest -q tests/bridge/core tests/wire tests/bridge/test_link.py \
	  tests/bridge/test_message_orders.py $(BRANCHES) $(ARGS)

mutants: $(DEV) ## change bridge/core one thing at a time: do tests notice? hours; resumable; ARGS="--sample 20"
	@exec nice -n 10 $(BIN)/python -m tools.mutants $(ARGS)

laws: $(DEV) ## every law with 2 000 fresh examples, where `make test` tries 50; minutes
	@HYPOTHESIS_PROFILE=laws $(BIN)/python -m pytest -q -n logical -m "hypothesis and not e2e" --timeout 600 $(ARGS)

seeds: $(DEV) ## the laws of the step under 200 000 hostile scripts of 60 ticks; an hour on 2 idle cores
	@SEEDS=$${SEEDS:-200000} nice -n 10 $(BIN)/python -m pytest -v -n logical --timeout 600 \
	  tests/bridge/core/laws/test_step_laws.py -k so_many $(ARGS)

enumerate: $(DEV) ## what `make test` takes samples of: every mode by all sets of up to three rows, every scripted goal by each manner of model; minutes
	@ENUMERATE=all $(BIN)/python -m pytest -q -n logical tests/bridge/core/laws/test_enumerated.py \
	  tests/planner/mission/test_told_truly.py $(ARGS)

check: $(DEV) $(PAGE_DEV) ## run all that CI runs but e2e: format, lint, types, page, test; with seconds
	@exec $(BIN)/python scripts/check.py

fmt: $(DEV) ## format the code and mend what the linter can mend
	@$(BIN)/ruff format . && $(BIN)/ruff check --fix .

docs: $(DEV) ## write the generated files anew (wire.md, openapi.json, AGENTS.md …), then build the docs as a site
	@$(BIN)/python scripts/generated.py --write
	@$(BIN)/python -m scripts.docs_site

bench: $(RUNTIME) ## measure and print a table (at most 10 min)
	@exec $(BIN)/python -m tools.bench $(ARGS)

bench-long: $(RUNTIME) ## measure what takes longer; resumable, appends to one file
	@exec $(BIN)/python -m tools.bench --long $(ARGS)

attack: $(ATTACK) ## attack the API, files and decoders; fails where a goal is missed (at most 10 min); ARGS=--long
	@exec $(BIN)/python -m tools.attack $(ARGS)

train: $(RUNTIME) ## draw homes, fit the default detector anew and score it (two hours; tools/train/README.md)
	@exec nice -n 10 $(BIN)/python -m tools.train $(ARGS)

lock: $(DEV) ## resolve the dependencies into requirements.lock and its companions; ARGS=--upgrade takes the newest
	@scripts/lock.sh $(ARGS)

audit: $(DEV) ## ask for known vulnerabilities of the locked packages; says aloud when it can't
	@scripts/audit.sh

clean: ## remove .venv and caches; keeps .pons (recordings, missions, keys)
	@rm -rf .venv firmware/build web/node_modules web/dist build dist *.egg-info .coverage .coverage.* htmlcov
	@rm -rf .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache .mutants
	@find . -name __pycache__ -type d -not -path '*/node_modules/*' -prune -exec rm -rf {} +

$(RUNTIME): requirements.lock pyproject.toml scripts/venv.sh scripts/install.sh
	@scripts/venv.sh .venv
	@scripts/install.sh requirements.lock --self
	@touch $@

$(DEV): requirements-dev.lock $(RUNTIME)
	@scripts/install.sh requirements-dev.lock
	@touch $@

$(EXTRAS): requirements-extras.lock $(RUNTIME)
	@scripts/install.sh requirements-extras.lock
	@touch $@

$(ATTACK): requirements-attack.lock $(RUNTIME)
	@scripts/install.sh requirements-attack.lock
	@touch $@

$(PAGE): $(PAGE_SOURCES) scripts/page.sh | $(RUNTIME)
	@scripts/page.sh build

$(PAGE_DEV): web/package-lock.json scripts/page.sh | $(RUNTIME)
	@scripts/page.sh dev
