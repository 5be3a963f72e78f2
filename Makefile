# The habits. Each target does its own set-up; `make help` says what there is.
.DEFAULT_GOAL := help
.PHONY: help setup ready build demo test install bench check clean

PREFIX ?= /usr/local
BUILD := build
CTEST := ctest --test-dir $(BUILD) --output-on-failure --timeout 600

help: ## show this list
	@awk -F ':.*## ' '/^[a-z]+:.*## / {printf "  make %-9s %s\n", $$1, $$2}' Makefile

setup: ## install what the build needs (system packages, HiGHS and Pinocchio from PyPI)
	@scripts/setup --retry

ready:
	@scripts/setup

build: ready ## build everything; leaves build/bin/switchyard and its plugins
	@scripts/build

demo: ready ## build, solve four problems with every backend, plan a way through a building
	@scripts/build products
	@scripts/demo

test: build ## build, and run the tests
	@$(CTEST) -j "$$(scripts/jobs)"

install: ready ## install to PREFIX (/usr/local unless given)
	@scripts/build products
	@scripts/install "$(PREFIX)"

bench: build ## build, and measure (INSTANCES=folder: against known optima too)
	@scripts/bench "$(INSTANCES)"

check: ## the format and the include rules, without a build
	@scripts/check

clean: ## remove what was built; what setup fetched stays
	@scripts/clean
