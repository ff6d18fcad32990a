"""`python -m grammarbt` is the command `grammarbt`."""

from grammarbt.cli import main

raise SystemExit(main())
