"""How many threads a process takes for sums of arrays: what the libraries under numpy ask of the environment.

They read it once, as numpy is imported. Of a mechanism's small systems one thread is as quick as many, which wait for
each other busily.
"""

from __future__ import annotations

import os

THREAD_COUNT_VARIABLES = "OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"


def prefer_one_thread() -> None:
    """This process, and those that it starts, take one thread for sums of arrays, unless the user has said how many."""
    if not any(name in os.environ for name in THREAD_COUNT_VARIABLES):
        os.environ |= dict.fromkeys(THREAD_COUNT_VARIABLES, "1")
