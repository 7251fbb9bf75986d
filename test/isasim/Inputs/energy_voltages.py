"""usage: energy_voltages.py SIM PROGRAM PAGE: checks the table of clocks and voltages in PAGE (docs/energy.md) against what
SIM says of PROGRAM at these clocks, at their voltage and at 0.8 V."""
import json
import re
import subprocess
import sys

sim, program, page = sys.argv[1:]


def energy(*options):
    run = subprocess.run([sim, program, "--energy", "--stats", "-", *options], check=True, capture_output=True, text=True)
    return json.loads(run.stdout)["energy"]


def joules(of, unit):
    return next(u["joules"]["value"] for u in of["units"] if u["unit"] == unit)


rows = re.findall(r"^\| (\d+) \| (\d\.\d{3}) \| (\d\.\d\d) \| (\d\.\d\d) \|$", open(page, encoding="utf-8").read(), re.M)
for clock, volts, dynamic, leakage in rows:
    own, base = energy("--clock", clock), energy("--clock", clock, "--voltage", "0.8")
    of_tool = [f"{own['volts']:.3f}", *(f"{joules(own, u) / joules(base, u):.2f}" for u in ("front end", "leakage"))]
    assert of_tool == [volts, dynamic, leakage], (clock, of_tool)
print(f"{len(rows)} rows as the tool has them")
