"""Runs a command, interrupts it after its first iteration, and prints its errors and exit code.

usage: interrupted.py COMMAND...
"""
import signal
import subprocess
import sys

process = subprocess.Popen(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
for line in process.stderr:
    if line.startswith("iteration 1/"):
        process.send_signal(signal.SIGINT)
    if "error" in line:
        print(line, end="")
print(f"ended with {process.wait()}")
