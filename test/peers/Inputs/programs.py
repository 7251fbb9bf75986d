"""Runs programs of others, and splat."""

import subprocess
import sys


def run(*words):
    """What the program printed; ends the script where it fails."""
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(words)}: {done.stdout}{done.stderr}")
    return done.stdout + done.stderr
