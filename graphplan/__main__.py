"""`python -m graphplan` is the command line."""

import sys

from graphplan.commands import main

sys.exit(main())
