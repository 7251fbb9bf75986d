#!/usr/bin/env python3
"""schemas.py SCHEMAS FOLDER PYTHON-OF-TESTS ROOT: makes a report of each kind in a new folder, and checks each by its schema.

Prints what is wrong, the schemas that no report was made of, and a count.
"""

import json
import os
import subprocess
import sys

import jsonschema
import numpy

schemas, folder, python, root = sys.argv[1:]
os.makedirs(folder)
os.chdir(folder)
checked, wrong = set(), 0


def run(*command):
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def check(report, source, name=None):
    global wrong
    name = name or report["schema"]["name"]
    path = os.path.join(schemas, name + ".json")
    with open(path, encoding="utf-8") as file:
        schema = json.load(file)
    jsonschema.Draft202012Validator.check_schema(schema)
    resolver = jsonschema.RefResolver("file://" + path, schema)
    for error in jsonschema.Draft202012Validator(schema, resolver=resolver).iter_errors(report):
        wrong += 1
        print(f"{source}: {name}: {'/'.join(map(str, error.absolute_path))}: {error.message[:200]}")
    checked.add(name)


def check_file(name, schema=None):
    with open(name, encoding="utf-8") as file:
        check(json.load(file), name, schema)


def splat(*words, report="report.json"):
    run("splat", *words, *(["--json", report] if report == "report.json" else []))
    check_file(report)


inputs = os.path.join(root, "test", "render", "Inputs")
run(python, os.path.join(inputs, "scene.py"), "one", "s.ply", "c.json")
run("splat", "demo-scene", "--gaussians", "1000", "-o", "demo.ply", "--cameras", "demo.json")
for part in ("seeds", "captures"):
    os.makedirs(part)
run("splat-capture-samples", ".")
capture = os.path.join("captures", "colmap-binary")
view = ("s.ply", "--cameras", "c.json", "--view", "front")

splat("info", "demo.ply")
splat("info", capture)
splat("analyze", "demo.ply", "--cameras", "demo.json", "--view", "front", "--size", "32", "--order-beside", "close")
splat("render", *view, "-o", "a.npz", "--explain")
splat("render", *view, "-o", "b.npz", "--path", "simt")
splat("compare", "a.npz", "b.npz")
run(python, os.path.join(inputs, "mesh.py"), "ball", "m.obj")
splat("render", *view, "-o", "m.npz", "--mesh", "m.obj")
splat("render", *view, "-o", "a.npz", "--time", "--energy", "--heat-map", "heat")
check_file("heat.json")
os.rename("report.json", "time.json")
splat("compare", "time.json", "time.json", "--times")
splat("render", "s.ply", "--cameras", "c.json", "--view", "all", "-o", "v.pfm", "--time", "--energy")
with open("c.json", encoding="utf-8") as file:
    camera = json.load(file)[0]
size = camera["height"], camera["width"]
numpy.savez("upstream.npz", in_v_render=numpy.ones((*size, 3), "f"), in_v_alpha=numpy.zeros(size, "f"))
splat("effects", *view, "--runs", "1", "--each")
splat("hard-cases", "needles", report="hard-cases/hard-cases.json")
splat("convert", "demo.ply", "s.ply", "--drop-faint", "0.1", "--sh-degree", "1", "-o", "joined.spz")
splat("demo-scene", "--gaussians", "1000", "-o", "again.ply")
os.rename("report.json", "made.json")
splat("replay", "made.json")
for path in ("raster", "simt"):
    run("splat", "render", *view, "-o", "a.npz", "--path", path, "--pairs", path + ".npz")
splat("compare", "--pairs", "raster.npz", "raster.npz")
splat("gradients", *view, "--upstream", "upstream.npz", "-o", "g.npz")
splat("train", capture, "-o", "t.ply", "--iterations", "2", "--time", "--time-every", "1", "--score-every", "1")
splat("eval", "t.ply", capture)
splat("accuracy", *view[:3], "-o", "accuracy", "--knobs", "sh-degree", "--no-cores", "--no-host", report="accuracy/accuracy.json")
splat("accuracy", "--train", capture, "-o", "training", "--iterations", "1", "--seeds", "1", "--score-every", "1",
      "--time-every", "1", report="training/training.json")
with open("space.json", "w", encoding="utf-8") as file:
    json.dump({"parameters": {"lanes": {"key": "timing.raster.lanes", "values": [8]}, "simt": {"option": "--simt-group", "values": [16]},
                              "tile": {"option": "--tile", "values": [32]}}}, file)
splat("explore", *view[:3], "-o", "machines", "--space", "space.json", "--machines", "5", "--finalists", "1", "--checks", "2", "--small-width", "16",
      report="machines/explore.json")
with open("workload.json", "w", encoding="utf-8") as file:
    json.dump({"scenes": [{"scene": "s.ply", "cameras": "c.json", "view": ["front"], "size": "20x20"},
                          {"name": "two", "scene": "s.ply", "cameras": "c.json", "antialiased": True, "weight": 0.5}],
               "training": [{"capture": capture, "iterations": 1}]}, file)
check_file("workload.json", "splat-workload")
splat("explore", "--workload", "workload.json", "-o", "together", "--space", "space.json", "--machines", "5", "--finalists", "1", "--checks", "2",
      "--small-width", "32", report="together/explore.json")
splat("doctor")
run("vorion-clang", "--resources=resources.json", os.path.join(root, "test", "clang", "Inputs", "slow.cl"), "-o", "slow.elf")
check_file("resources.json")
for tool in ("splat", "vorion-sim"):
    text = subprocess.run([tool, "--print-definition"], check=True, stdout=subprocess.PIPE, text=True).stdout
    check(json.loads(text), tool)
kinds = {name.removesuffix(".json") for name in os.listdir(schemas) if name.endswith(".json")} - {"common"}
for name in sorted(kinds - checked):
    wrong += 1
    print(f"{name}: no report was made")
for name in sorted(kinds):
    with open(os.path.join(schemas, name + ".json"), encoding="utf-8") as file:
        if not json.load(file).get("title"):
            wrong += 1
            print(f"{name}: no title")
print(f"{len(checked)} kinds of reports, {wrong or 'nothing'} wrong")
