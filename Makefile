# A newcomer needs two commands: `make generate` and `make test`. Each sets up what it needs.
FIELDSCRIBE = .venv/bin/fieldscribe
PYTHON = .venv/bin/python

.PHONY: generate keys test core newer bench mutants prove misra fuzz audit-power corpus check clean

generate:           ## compile all descriptions into generated/
	@sh generator/setup.sh compiler
	$(FIELDSCRIBE) generate descriptions --out generated

keys:               ## write KEYS.md and schema.json from the table of keys, and the export's schema from that of facts
	@sh generator/setup.sh compiler
	$(FIELDSCRIBE) schema > descriptions/schema.json
	$(FIELDSCRIBE) schema --page > descriptions/KEYS.md
	$(FIELDSCRIBE) schema --export > generator/fieldscribe/export/schema.json

# The tests start Python a few hundred times, so its bytecode is kept even if the environment turns that off.
test core newer: export PYTHONPYCACHEPREFIX = $(CURDIR)/.cache/python
test core newer: export PYTHONDONTWRITEBYTECODE =

test:               ## run every test, with more random cases than `core`
	@sh generator/setup.sh tests
	FIELDSCRIBE_EXAMPLES=100 FIELDSCRIBE_MUTANTS=120 $(PYTHON) -m pytest -n auto --dist worksteal

core:               ## run the quick tests only
	@sh generator/setup.sh tests
	$(PYTHON) -m pytest -n auto --dist worksteal -m "not full"

# What a newer Python generates is the same, so that it needs no compiler of other languages.
GENERATED_TWICE = tests/project/test_quality.py::test_generated_is_current_whatever_the_order_of_hashes

newer:              ## run the quick tests, and all tests of generated Python, on a newer Python (NEWER=python3.13)
	@sh generator/setup.sh tests
	$(or $(NEWER),python3.13) -m venv .cache/newer
	.cache/newer/bin/python -m pip install --quiet --disable-pip-version-check --editable ".[test]"
	.cache/newer/bin/python -m pytest -n auto --dist worksteal -m "not full" $(addprefix --ignore=tests/targets/,c rust typescript)
	.cache/newer/bin/python -m pytest -n auto --dist worksteal -m full tests/targets/python $(GENERATED_TWICE)

check:              ## validate the descriptions and list stale files in generated/
	@sh generator/setup.sh compiler
	$(FIELDSCRIBE) check descriptions
	$(FIELDSCRIBE) generate descriptions --out generated --check

bench:              ## measure the compiler and generated Python against cantools and pymodbus in the same run
	@sh generator/setup.sh tests
	$(PYTHON) tests/bench/bench.py

prove:              ## prove that no input causes undefined behaviour in the C cores, parsers and builders (MACHINE=x86_16 LENGTHS=ends)
	@sh generator/setup.sh tests
	$(PYTHON) tests/proofs/prove.py $(if $(MACHINE),--machine $(MACHINE)) $(if $(LENGTHS),--$(LENGTHS))

misra:              ## compare MISRA C:2012 findings in generated headers and runtimes with the table of justified ones
	@sh generator/setup.sh tests
	$(PYTHON) tests/misra/misra.py

fuzz:               ## feed mutated descriptions, frames and words to everything that reads them, spoil answers of lines (SEED=1 COUNT=200000)
	@sh generator/setup.sh tests
	$(PYTHON) tests/fuzz/run.py --seed $(or $(SEED),1)
	PYTHONPATH=tests $(PYTHON) tests/fuzz/soak.py --seed $(or $(SEED),1)
	PYTHONPATH=tests $(PYTHON) tests/fuzz/soak_simulated.py --seed $(or $(SEED),1) --requests $(or $(COUNT),200000)

mutants:            ## change one thing at a time and list what no test notices (SEED=1 COUNT=300 ONLY=c|python|rust|typescript|descriptions|generator ROOM=resolve)
	@sh generator/setup.sh tests
	PYTHONPATH=tests nice $(PYTHON) -m mutants

audit-power:        ## change one fact of each manual at a time and list what the audit misses (MANUALS=folder SEED=1 COUNT=200 ONLY=devices)
	@sh generator/setup.sh tests
	PYTHONPATH=tests $(PYTHON) -m audit_power --manuals $(MANUALS) --seed $(or $(SEED),1) --count $(or $(COUNT),200) $(ONLY)

corpus:             ## measure the importers on a collection of files (FOLDER=templates of wb-mqtt-serial, models of SunSpec, DBC; VALUES=1000000: values)
	@sh generator/setup.sh tests
	PYTHONPATH=tests nice $(PYTHON) -m corpus "$(FOLDER)" $(VALUES)

clean:              ## remove the virtual environment and caches
	rm -rf .venv .cache .mypy_cache .pytest_cache .ruff_cache .hypothesis
