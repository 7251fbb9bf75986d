"""Ends a run by one signal after the other while its subtest hangs, and prints how the run ended and what it left.
usage: ended_runs.py CONFORMANCE.PY SUITE RESULTS"""

import signal
import subprocess
import sys
import time

SLEEP = ["pgrep", "-fx", "sleep 987651"] # of the subtest


def hanging():
    return subprocess.run(SLEEP, stdout=subprocess.DEVNULL, check=False).returncode == 0


program, suite, results = sys.argv[1:]
for name in ("SIGTERM", "SIGINT"):
    command = [sys.executable, program, suite, "--only", "hangs", "--results", results]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as run:
        while not hanging():
            time.sleep(0.05)
        while run.poll() is None:
            run.send_signal(signal.Signals[name])
            time.sleep(0.001)
    print(f"{name}: exit code {run.returncode}, {'it hangs' if hanging() else 'nothing'} left")
