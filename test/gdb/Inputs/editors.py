#!/usr/bin/env python3
"""editors.py FOLDER SOURCE: debugs SOURCE as VS Code does by the files in FOLDER, on a free port."""

import json
import os
import re
import subprocess
import sys

folder, source = sys.argv[1:]
with open(os.path.join(folder, "launch.json")) as f:
    launch = json.load(f)["configurations"][0]
with open(os.path.join(folder, "tasks.json")) as f:
    tasks = {task["label"]: task for task in json.load(f)["tasks"]}
port = launch["miDebuggerServerAddress"].rsplit(":", 1)[1]


def words(task):
    """A task's command; 0 takes a free port."""
    return [task["command"]] + [word.replace("${file}", source).replace(port, "0") for word in task["args"]]


wait = tasks[launch["preLaunchTask"]]
subprocess.run(words(tasks[wait["dependsOn"]]), check=True)
print("compiled")
simulator = subprocess.Popen(words(wait), stderr=subprocess.PIPE, text=True)
said = simulator.stderr.readline()
print("waiting:", "matched" if re.search(wait["problemMatcher"]["background"]["endsPattern"], said) else said)
port = re.search(r"port (\d+)", said)[1]
gdb = subprocess.Popen([launch["miDebuggerPath"], "-nx", "--interpreter=mi"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                       text=True)


def until(pattern):
    for line in gdb.stdout:
        if found := re.search(pattern, line):
            return found
        if line.startswith("^error"):
            sys.exit(line)
    sys.exit("gdb ended")


def tell(command, pattern=r"^\^(\w+)"):
    gdb.stdin.write(command + "\n")
    gdb.stdin.flush()
    return until(pattern)


tell(f"-file-exec-and-symbols {launch['program'].replace('${file}', source)}")
print("setup:", ", ".join(tell(command["text"])[1] for command in launch["setupCommands"]))
print(tell(f"-target-select remote 127.0.0.1:{port}", r"^\^(connected)")[1])
tell("-break-insert square")
stop = tell("-exec-continue", r'^\*stopped,reason="([\w-]+)".*func="(\w+)",args=\[\{name="x",value="(\d+)"\}\],file="([^"]*)".*line="(\d+)"')
print(f"stopped: {stop[1]} in {stop[2]} at {os.path.basename(stop[4])}:{stop[5]}, x = {stop[3]}")
print("threads:", len(tell("-thread-list-ids", r"^\^done,thread-ids=\{(.*?)\}")[1].split(",")))
gdb.stdin.close()
simulator.kill()
gdb.wait()
simulator.wait()
