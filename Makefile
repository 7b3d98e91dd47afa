# The two commands most people need are "make bench" and "make test"; "make help" lists the rest.
#
#   NATIVE=1     compile for this machine's processor instead of generic x86-64
#   SKIP_DEPS=1  install nothing: everything needed is there already (distributions without apt-get)
#   JOBS=N       build with N processes, and test with N + 2
#   TABLE=NAME   only this experiment in "make bench": rgbd, states, alphabet, random or steps
#   SECONDS=N    how long "make fuzz" searches with each target
#   SUITE=NAME   the Debian of "make test-fresh": bookworm (12) or trixie (13)
#   RUNS="A B"   the runs of "make site", instead of results/reference
#   BASE=REV     what "make bench-gate" compares with, instead of the merge base with the main branch

SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
MAKEFLAGS += --no-print-directory
.DEFAULT_GOAL := help
.NOTPARALLEL:
override SKIP_DEPS := $(filter-out 0,$(SKIP_DEPS))

# One process a core, but no more than there is memory for: a file that includes CGAL takes up to 1.5 GB to compile.
JOBS ?= $(shell awk -v cores="$$(nproc 2>/dev/null || echo 2)" \
  '/^MemAvailable/ { fit = int($$2 / 1500000) } END { print fit < 1 ? 1 : (fit < cores ? fit : cores) }' \
  /proc/meminfo 2>/dev/null || echo 2)
# Some tests wait for a browser, a server or a clock, so two more of them run than there are processes to compile with.
TEST_JOBS = $(shell expr $(JOBS) + 2)
BUILD_LOG := build/log
export NINJA_STATUS := [%f/%t] 

define install
$(if $(SKIP_DEPS),,cmake/install-packages.sh $(1))
endef

# $(call configure,preset,options): cmake's own words only when it fails.
define configure
mkdir -p $(BUILD_LOG); \
if ! cmake --preset $(1) $(2) >$(BUILD_LOG)/configure-$(1).txt 2>&1; then \
  cat $(BUILD_LOG)/configure-$(1).txt >&2; \
  cmake/install-packages.sh --check $(or $(filter tool js,$(1)),build) $(if $(findstring _TESTS=OFF,$(2))$(filter tool js,$(1)),,unit) $(if $(filter clang fuzz,$(1)),lint) || true; \
  echo "error: the build could not be configured: if something is missing, 'make deps' installs it." >&2; exit 1; \
fi
endef

# $(call build,preset,options,targets): configure and compile; everything when no target is named.
define build
$(call configure,$(1),$(2)); \
echo "==> compiling ($(1), $(JOBS) jobs)"; \
cmake --build --preset $(1) --parallel $(JOBS) $(if $(3),--target $(3))
endef

# $(call tests,preset,folder): all tests of a build folder, then why any was skipped.
define tests
folder=$$(tests/temporary_folder.sh); trap 'rm -rf "$$folder"' EXIT; \
TMPDIR=$$folder ctest --preset $(1) --parallel $(TEST_JOBS) && status=0 || status=$$?; \
sed -n '/^skipped: /p' $(2)/Testing/Temporary/LastTest.log | sort | uniq -c >&2; \
exit $$status
endef

NATIVE_OPTION = -DHULLBENCH_NATIVE=$(if $(filter-out 0,$(NATIVE)),ON,OFF)
# What measures needs no test and none of the tests' packages. A build folder that "make test" has configured keeps its
# tests while GoogleTest is there: Ninja forgets targets that are left out once, and would compile all tests again.
WITHOUT_TESTS = $(NATIVE_OPTION) $(shell grep -qs '^HULLBENCH_TESTS:BOOL=ON' build/CMakeCache.txt && \
  [ -d "$$(sed -n 's/^GTest_DIR:PATH=//p' build/CMakeCache.txt)" ] || echo -DHULLBENCH_TESTS=OFF)
WITH_TESTS = $(NATIVE_OPTION) -DHULLBENCH_TESTS=ON

.PHONY: help deps deps-extra deps-real deps-legacy build tool package package-tool bench bench-quick figures figures-core figures-default report paper site report-compare fit-default fit-rules evaluate bench-core bench-footprint bench-gate bench-gate-instructions reference test test-sanitize build-clang test-clang test-fresh test-slurm test-gate fuzz lint format docs js js-bench clean clean-legacy

help: ## list the targets (the default)
	@awk 'BEGIN { FS = ":.*## " } /^[a-z-]+:.*## / { printf "  make %-23s %s\n", $$1, $$2 }' Makefile
	@echo "  with NATIVE=1 (compile for this processor), SKIP_DEPS=1 (install nothing), JOBS=N (N processes)"

deps: ## install what building, tests and development need and is missing (not what deps-extra, deps-real and paper need)
	@cmake/install-packages.sh build bench unit test docs python plots lint gate js gdal
	@echo "==> nothing is missing"

deps-extra: ## install what the other methods need: those in JavaScript, Python and Java, PCL, the paper's PostGIS
	@$(call install,extra)
	@$(if $(SKIP_DEPS),,cmake/install-npm.sh adapters/manifests)
	@$(if $(SKIP_DEPS),,cmake/install-legacy.sh)
	@$(if $(SKIP_DEPS),,echo "==> nothing is missing for the other methods")

deps-real: ## install Debian's packages with the real points of "hullbench run real"
	@$(call install,real)
	@$(if $(SKIP_DEPS),,echo "==> nothing is missing for the real points")

deps-legacy: ## get the paper's PostGIS (3.1, from Debian 11) into a folder of caches, without root
	@cmake/install-legacy.sh
	@echo "==> nothing is missing for postgis_legacy"

build: ## only build: build/hullbench, build/polylidar and build/core_benchmarks
	@$(call build,release,$(WITHOUT_TESTS),hullbench polylidar core_benchmarks)
	@echo "==> built build/hullbench, build/polylidar and build/core_benchmarks"

tool: ## build only polylidar, the program for your own points, as build-tool/polylidar (GDAL=1: with GeoPackage and what else GDAL has)
	@$(call install,tool $(if $(filter-out 0,$(GDAL)),gdal))
	@$(call build,tool,$(NATIVE_OPTION) -DPOLYLIDAR_WITH_GDAL=$(if $(filter-out 0,$(GDAL)),ON,OFF))
	@echo "==> built build-tool/polylidar"

package: ## make Debian packages of the library, the Python module and the programs in build/packages
	@$(call install,build python package)
	@$(call build,release,$(WITHOUT_TESTS),debs)

package-tool: ## make the Debian package of polylidar alone in build-tool/packages, without the harness (GDAL=1: with what GDAL has)
	@$(call install,tool package $(if $(filter-out 0,$(GDAL)),gdal))
	@$(call build,tool,$(NATIVE_OPTION) -DPOLYLIDAR_WITH_GDAL=$(if $(filter-out 0,$(GDAL)),ON,OFF),deb_polylidar-tools)

bench: ## install, build and run the experiments in three passes (TABLE=states: only this one); an interrupted run is continued
	@$(call install,build bench)
	@$(MAKE) build
	@build/hullbench run $(or $(TABLE),rgbd states alphabet random steps) --passes 3

RUN ?= results/latest
# A run's own name. The checkout's path may have blanks, at which make would split it.
run_name = $(notdir $(subst $(CURDIR)/,,$(realpath $(1))))
# Named like the run, as the pages say it.
drawn_folder = build/drawn/records/$(2)$(run_name)
# Where the drawing goes: beside the records. Of a kept reference run, which has no report.json, into a folder of its own:
# what is kept beside its records was drawn with the pictures.
drawn_into = $(if $(wildcard $(1)/report.json $(1)/*/report.json),$(1),build/drawn/$(run_name))

# $(call drawn,run,folder): what is drawn of a run, written anew as a reference run has its records compressed.
define drawn
{ [ -d $(1) ] || { echo "error: there is no folder $(1): name that of a run, as in RUN=results/reference." >&2; exit 2; }; } && \
rm -rf $(2) && mkdir -p $(call drawn_into,$(1)) && build/hullbench report $(1) --out $(2) >/dev/null && \
{ build/hullbench league $(1) --all-cases --csv $(2)/cases.csv >/dev/null || true; } && \
for extra in suite.json tables core.json league.json league.csv tune.json tune.json.xz; do [ ! -e $(1)/$$extra ] || cp -r $(1)/$$extra $(2) || exit 1; done && \
{ [ ! -e $(1)/report.html.gz ] || zcat $(1)/report.html.gz >$(2)/report.html; } && \
{ [ ! -e $(1)/league/suite.json ] || build/hullbench league $(1)/league --csv $(2)/league.csv >/dev/null; }
endef

figures: figures-default ## draw the paper's figures from results/latest, into its folder (RUN=FOLDER: from any run), and the picture of core/AUTOMATIC.md
	@$(call install,build plots)
	@$(MAKE) build
	@$(call drawn,$(RUN),$(call drawn_folder,$(RUN)))
	@/usr/bin/python3 plots/make_figures.py $(call drawn_folder,$(RUN)) --out $(call drawn_into,$(RUN))/figures

figures-core: ## measure the core from 1000 to 10 million points for the figures, into core.json of RUN=
	@$(call install,build)
	@$(call build,release,$(WITHOUT_TESTS),core_benchmarks)
	@build/core_benchmarks --benchmark_repetitions=3 --benchmark_min_time=0.05 \
	  --benchmark_enable_random_interleaving=true --benchmark_out_format=json --benchmark_out=$(RUN)/core.json \
	  --benchmark_filter='^(concave_hull|concave_hull_2_threads|triangulation|cgal_alpha_shape|cgal_delaunay|geos_concave_hull_with_holes|geos_delaunay)/uniform/'

report: ## write results/latest/report.html, one file with everything about the run (RUN=FOLDER: any run)
	@$(call install,build plots)
	@$(if $(SKIP_DEPS),,cmake/install-npm.sh plots)
	@$(MAKE) build
	@$(call drawn,$(RUN),$(call drawn_folder,$(RUN)))
	@/usr/bin/python3 plots/make_report.py $(call drawn_folder,$(RUN)) --out $(call drawn_into,$(RUN))/report.html

paper: ## write results/latest/paper.pdf, all figures and tables in a journal's column widths (RUN=FOLDER: any run)
	@$(call install,build plots paper)
	@$(MAKE) build
	@$(call drawn,$(RUN),$(call drawn_folder,$(RUN)))
	@/usr/bin/python3 plots/make_paper.py $(call drawn_folder,$(RUN)) --out $(call drawn_into,$(RUN))/paper.pdf

RUNS ?= results/reference
# Whether "make js" can be made here.
HAS_WASM = $(shell command -v clang++ >/dev/null && command -v wasm-ld >/dev/null && [ -d /usr/include/wasm32-wasi/c++ ] && echo yes)

site: ## write build/site, static pages of the reference run for any web server (RUNS="FOLDER...": of these runs)
	@$(call install,build plots)
	@$(if $(SKIP_DEPS),,cmake/install-npm.sh plots)
	@$(MAKE) build
	@$(if $(HAS_WASM),$(MAKE) js)
	@$(foreach run,$(RUNS),$(call drawn,$(run),$(call drawn_folder,$(run),site/)) && \
	  { [ ! -e $(run)/report.html ] || cp $(run)/report.html $(call drawn_folder,$(run),site/); } &&) true
	@build/hullbench list --json >build/drawn/listing.json
	@/usr/bin/python3 plots/make_site.py $(foreach run,$(RUNS),$(call drawn_folder,$(run),site/)) --out build/site \
	  --listing build/drawn/listing.json $$([ ! -e build-js/demo.html ] || echo --demo build-js/demo.html)

report-compare: ## write B/comparison.html, a page with two runs side by side (A=FOLDER B=FOLDER)
	@test -n "$(A)" -a -n "$(B)" || { echo "error: give two runs: make report-compare A=FOLDER B=FOLDER" >&2; exit 2; }
	@$(call install,build plots)
	@$(if $(SKIP_DEPS),,cmake/install-npm.sh plots)
	@$(MAKE) build
	@$(call drawn,$(A),$(call drawn_folder,$(A),a/))
	@$(call drawn,$(B),$(call drawn_folder,$(B),b/))
	@build/hullbench compare $(A) $(B) --format json >build/drawn/compared.json
	@/usr/bin/python3 plots/make_comparison.py $(call drawn_folder,$(A),a/) $(call drawn_folder,$(B),b/) \
	  --compared build/drawn/compared.json --out $(B)/comparison.html

fit-default: ## fit the numbers of the core's automatic limit on the training side, and say what it gives on the test side
	@$(call install,build)
	@$(call build,release,$(WITHOUT_TESTS),fit_default)
	@build/fit_default --tries 100 --ablation

figures-default: ## draw the picture of core/AUTOMATIC.md: the core's default and the former one under every way to sample
	@$(call install,build plots)
	@$(call build,release,$(WITHOUT_TESTS),fit_default)
	@build/fit_default --pictures build/default_hulls.json
	@/usr/bin/python3 plots/make_default_pictures.py build/default_hulls.json --out core/automatic.png

fit-rules: ## fit the shares of the rules from the points on the training side
	@$(call install,build)
	@$(call build,release,$(WITHOUT_TESTS),fit_rules)
	@build/fit_rules

evaluate: ## search every method's parameter on the plans of the world and rank the methods, on all cores (OUT=results/evaluation)
	@$(call install,build bench)
	@$(MAKE) build
	@benchmarks/league/evaluate.sh build/hullbench $(or $(OUT),results/evaluation)

reference: ## draw results/latest, keep it as the reference run and write its tables into the README (a build of HEAD must have measured it)
	@$(call install,build test)
	@results/check_reference.py results/latest
	@$(MAKE) build
	@for part in league.json league.csv tune/tune.json; do \
	  [ ! -e results/evaluation/$$part ] || cp results/evaluation/$$part results/latest; done
	@$(MAKE) figures report RUN=results/latest
	@results/keep_reference.sh results/latest
	@build/hullbench tables results/reference --write >/dev/null
	@build/hullbench readme results/reference README.md

# The paper's methods and the fastest rivals up to 8000 points, the others at 2000.
QUICK = ^(polylidar|cgal_alpha_shape|cgal_delaunay|delaunator|spatialite|postgis|postgis_legacy)/.*/n:[48]000/|/n:2000/

bench-quick: ## the state shapes' tables for n <= 8000 and 3 repetitions, in about two minutes
	@$(call install,build bench)
	@$(call build,release,$(WITHOUT_TESTS),hullbench)
	@build/hullbench run states --filter '$(QUICK)' --repetitions 3

bench-core: ## the core's speed beside CGAL and GEOS: ratios with goal and verdict
	@$(call install,build)
	@$(call build,release,$(WITHOUT_TESTS),core_benchmarks)
	@build/core_benchmarks --verdicts

export JOBS

bench-footprint: ## footprints of an airborne tile beside a hexbin, GEOS and the convex hull: area error and time
	@$(call install,build)
	@$(call build,release,$(WITHOUT_TESTS),hullbench polylidar bench_footprint)
	@build/bench_footprint

bench-gate: ## whether the core is slower than BASE (default: the merge base with main) or gives other results
	@$(call install,build)
	@benchmarks/gate/gate.sh $(if $(BASE),--base "$(BASE)")

bench-gate-instructions: ## the same with counted instructions instead of times, for shared machines
	@$(call install,build gate)
	@benchmarks/gate/gate.sh --instructions $(if $(BASE),--base "$(BASE)")

test: ## install, build and run all tests
	@$(call install,build bench unit test docs python plots js gdal)
	@$(MAKE) deps-extra
	@$(if $(SKIP_DEPS),,cmake/install-npm.sh plots)
	@$(if $(SKIP_DEPS),,cmake/install-npm.sh tests/report)
	@$(call build,release,$(WITH_TESTS))
	@echo "==> all tests"
	@$(call tests,release,build)

test-sanitize: ## install, build and run the core's tests with address, undefined-behaviour and thread sanitizers
	@$(call install,build unit)
	@# GCC's sanitizers take no memory map as random as that of Ubuntu 24.04 (vm.mmap_rnd_bits=32).
	@$(shell setarch -R true 2>/dev/null && echo setarch -R) $(MAKE) --no-print-directory test-sanitizers

# Of test-sanitize; no target by itself, so that "make help" does not list it.
test-sanitizers:
	@$(call build,sanitize)
	@echo "==> the core's tests with sanitizers"
	@ctest --preset sanitize --parallel $(JOBS)
	@$(call build,sanitize-threads)
	@ctest --preset sanitize-threads

build-clang: ## build everything with clang, the second compiler, in build-clang, each file alone (TOGETHER=1: several at once, in half the time)
	@$(call install,build unit python lint)
	@$(call build,clang,$(WITH_TESTS) $(if $(filter-out 0,$(TOGETHER)),-DCMAKE_DISABLE_PRECOMPILE_HEADERS=OFF -DHULLBENCH_COMPILE_TOGETHER=ON))

test-clang: ## the tests of the clang build
	@$(call install,build bench unit test docs python lint gdal)
	@$(MAKE) build-clang
	@echo "==> all tests, built with clang"
	@$(call tests,clang,build-clang)

test-fresh: ## run bench-quick and test from nothing in a bare Debian 12 (SUITE=trixie: 13; needs root, 10 GB, over an hour)
	@SUITE=$(or $(SUITE),bookworm) tests/fresh/run.sh

test-slurm: ## try the Slurm scripts on a real Slurm of one node, made for the test (needs root)
	@$(call install,build bench slurm)
	@$(call build,release,$(WITHOUT_TESTS),hullbench polylidar)
	@tests/slurm/run.sh build/hullbench build/polylidar

test-gate: ## prove that the gate finds what it must and nothing else, in 30 minutes (GATES=N, SLOW_GATES=N)
	@$(call install,build gate)
	@$(call build,release,$(WITHOUT_TESTS),bench_gate)
	@tests/gate/run.sh

# For each of a dozen targets.
SECONDS ?= 20

fuzz: ## search for inputs that break the core or a reader of files, for 20 seconds each (SECONDS=N)
	@$(call install,build unit lint)
	@$(call build,fuzz)
	@tests/fuzz/run.sh build-fuzz $(SECONDS) $(JOBS)

lint: ## clang-tidy, and the formatting check on all our C++, Python and JavaScript
	@$(call install,build unit python lint)
	@$(if $(SKIP_DEPS),,cmake/install-npm.sh tests/report)
	@$(call configure,clang,$(WITH_TESTS))
	@for language in format python javascript; do tests/style/check.sh $$language || [ $$? = 77 ] || exit 1; done
	@tests/style/check.sh tidy $(JOBS)

format: ## format all our sources with clang-format 14, black 23 and prettier
	@for language in format python javascript; do tests/style/check.sh $$language --fix || [ $$? = 77 ] || exit 1; done

docs: ## the core's reference as HTML in build/docs/core; fails when something public has no comment
	@$(call install,build docs)
	@$(call build,release,$(WITHOUT_TESTS),docs)
	@echo "==> build/docs/core/html/index.html"

js: ## build the npm package polylidar, the core as WebAssembly, and the page that tries it, in build-js
	@$(call install,js)
	@$(if $(SKIP_DEPS),,cmake/install-npm.sh adapters/manifests)
	@$(call build,js)
	@reason=$$(sed -n 's/^-- \(demo.html: not built.*\)/\1/p' $(BUILD_LOG)/configure-js.txt); \
	if [ -z "$$reason" ]; then echo "==> build-js/polylidar and build-js/demo.html"; \
	else echo "==> build-js/polylidar"; echo "==> $$reason"; fi

js-bench: js ## measure the npm package beside concaveman and delaunator, and write the table of core/js/README.md
	@node core/js/bench.mjs build-js/polylidar --write core/js/README.md

clean: ## remove what was built; results stay
	@rm -rf build build-clang build-sanitize build-sanitize-threads build-fuzz build-gate build-js build-python build-tool build-core
	@echo "==> removed build and build-*"

clean-legacy: ## remove the paper's PostGIS
	@cmake/install-legacy.sh --remove
