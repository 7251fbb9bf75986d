"""Whether bench/processor_time.py counts a process whose parent has ended: it works for 0.3 s of processor time."""

import subprocess
import sys

sys.path.insert(0, sys.argv[1])
import processor_time  # noqa: E402

WORKS = "import time\nwhile time.process_time() < 0.3: pass"
LEAVES = f"import subprocess, sys; subprocess.Popen([sys.executable, '-c', {WORKS!r}], start_new_session=True)"

processor_time.adopt_orphans()
before = sum(processor_time.of_ended())
subprocess.run([sys.executable, "-c", LEAVES], check=True)
spent = sum(processor_time.of_ended(wait=True)) - before
print("counted" if spent >= 0.3 else f"{spent} s, expected 0.3 at least")
