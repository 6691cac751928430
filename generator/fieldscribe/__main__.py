"""`python -m fieldscribe`."""

from fieldscribe.cli import main

raise SystemExit(main())
