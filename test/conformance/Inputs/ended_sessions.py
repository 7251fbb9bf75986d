"""Ends sessions while their shells begin processes, at 40 different times, and prints how many processes are left.
usage: ended_sessions.py FOLDER_OF_CONFORMANCE.PY"""

import subprocess
import sys
import time

sys.path.insert(0, sys.argv[1])
from conformance import alive, end_session # pylint: disable=wrong-import-position

left = 0
for number in range(40):
    with subprocess.Popen(["sh", "-c", "sh -c 'sleep 0; sleep 60' & wait"], start_new_session=True) as shell:
        time.sleep(number * 0.0005)
        end_session(shell.pid)
    left += len(list(alive(shell.pid)))
print(f"{left} left")
