# Two commands are all a newcomer needs: `make generate` and `make test`. Each sets up what it needs first.
FIELDSCRIBE = .venv/bin/fieldscribe
PYTHON = .venv/bin/python

.PHONY: generate keys test core bench mutants prove misra fuzz audit-power check clean

generate:           ## compile all descriptions into generated/
	@sh generator/setup.sh compiler
	$(FIELDSCRIBE) generate descriptions --out generated

keys:               ## write the page and the schema of the description language, which follow from its table of keys
	@sh generator/setup.sh compiler
	$(FIELDSCRIBE) schema > descriptions/schema.json
	$(FIELDSCRIBE) schema --page > descriptions/KEYS.md

# Python starts a few hundred times: what it compiled is kept aside, also where the environment says that nothing is kept.
test core: export PYTHONPYCACHEPREFIX = $(CURDIR)/.cache/python
test core: export PYTHONDONTWRITEBYTECODE =

test:               ## run every test, with more random cases than `core` has
	@sh generator/setup.sh tests
	FIELDSCRIBE_EXAMPLES=150 FIELDSCRIBE_MUTANTS=240 $(PYTHON) -m pytest -n auto --dist worksteal

core:               ## run the quick tests only
	@sh generator/setup.sh tests
	$(PYTHON) -m pytest -n auto --dist worksteal -m "not full"

check:              ## validate the descriptions, and say what in generated/ is stale
	@sh generator/setup.sh compiler
	$(FIELDSCRIBE) check descriptions
	$(FIELDSCRIBE) generate descriptions --out generated --check

bench:              ## measure the compiler and generated Python beside cantools in the same run
	@sh generator/setup.sh tests
	$(PYTHON) tests/bench/bench.py

prove:              ## prove that no input makes the cores, parsers and builders in C do anything undefined
	@sh generator/setup.sh tests
	$(PYTHON) tests/proofs/prove.py

misra:              ## say which rules of MISRA C:2012 generated headers and their runtimes break, and whether the table knows why
	@sh generator/setup.sh tests
	$(PYTHON) tests/misra/misra.py

fuzz:               ## throw mutated descriptions, frames and words at everything that reads them (SEED=1)
	@sh generator/setup.sh tests
	$(PYTHON) tests/fuzz/run.py --seed $(or $(SEED),1)

mutants:            ## change one thing at a time, say what nothing notices (SEED=1 COUNT=300 ONLY=c|python|rust|descriptions|generator ROOM=resolve)
	@sh generator/setup.sh tests
	PYTHONPATH=tests nice $(PYTHON) -m mutants

audit-power:        ## change one fact of each manual at a time, say what the audit does not report (MANUALS=folder SEED=1 COUNT=200 ONLY=devices)
	@sh generator/setup.sh tests
	PYTHONPATH=tests $(PYTHON) -m audit_power --manuals $(MANUALS) --seed $(or $(SEED),1) --count $(or $(COUNT),200) $(ONLY)

clean:              ## remove the virtual environment and caches
	rm -rf .venv .cache .mypy_cache .pytest_cache .ruff_cache .hypothesis
