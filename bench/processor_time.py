"""Processor time of programs and of all processes that they start, including orphaned ones, as the compiler's are
(runtime/pocl/README.md)."""

import ctypes
import os
import resource

PR_SET_CHILD_SUBREAPER = 36  # linux/prctl.h


def adopt_orphans():
    """From now on this process is the parent of what its children leave behind."""
    if ctypes.CDLL(None, use_errno=True).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0):
        raise OSError(ctypes.get_errno(), "prctl(PR_SET_CHILD_SUBREAPER)")


def of_ended(wait=False):
    """User and system seconds of all children that have ended; with `wait`, none is left that has not."""
    try:
        while os.waitpid(-1, 0 if wait else os.WNOHANG)[0]:
            pass
    except ChildProcessError: # there is none
        pass
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime, used.ru_stime
