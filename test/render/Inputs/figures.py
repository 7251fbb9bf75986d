"""Checks the figures in a folder against the page that they are of, which saves the same in a browser, and against the report.

usage: figures.py PAGE.html FOLDER REPORT.json
"""

import csv
import json
import os
import struct
import sys
import tempfile
import xml.etree.ElementTree as xml

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "Inputs"))
import browser

page, folder, report = sys.argv[1:]
with open(report, encoding="utf-8") as f:
    report = json.load(f)


def content(name):
    with open(os.path.join(folder, name), encoding="utf-8") as f:
        return f.read()


def rows(name):
    """Of a CSV file, without its comments."""
    return list(csv.reader(line for line in content(name).splitlines() if not line.startswith("# ")))


with tempfile.TemporaryDirectory() as scratch:
    shown = browser.Browser(scratch, reaches=())
    shown.shape(1000, 900, scheme="dark")
    shown.open("file://" + os.path.abspath(page))
    shown.wait("document.readyState == 'complete'")
    saved = json.loads(shown.value("JSON.stringify(figuresOfAllChoices())"))
    # A click on a button saves a file; here it is only looked at.
    shown.value("""(async () => {
      window.clicked = [];
      HTMLAnchorElement.prototype.click = function() { window.clicked.push([this.download, fetch(this.href).then(r => r.arrayBuffer())]); };
      for (const button of document.querySelectorAll('.save button')) if (isShown(button)) button.click();
    })()""")
    shown.wait("clicked.length == [...document.querySelectorAll('.save button')].filter(isShown).length")
    clicked = shown.value("Promise.all(clicked.map(async ([name, bytes]) => [name, [...new Uint8Array((await bytes).slice(0, 64))]]))")
    shown.close()

names = {name for figure in saved for name in (figure["name"] + end for end in (".svg", ".csv", ".png") + ((".tex",) if "latex" in figure else ()))}
assert names == set(os.listdir(folder)), names ^ set(os.listdir(folder))
for figure in saved:
    for end, text in ((".svg", figure["svg"]), (".csv", figure["csv"]), (".tex", figure.get("latex"))):
        assert text is None or text == content(figure["name"] + end), figure["name"] + end
for name, start in clicked:
    assert name in names, name
    if name.endswith(".png"):
        assert bytes(start[:8]) == b"\x89PNG\r\n\x1a\n" and bytes(start[37:41]) == b"pHYs", (name, start)

# What made it, its size, and text that is text.
command = "splat render s.ply --cameras c.json --view front"
for name in names:
    if name.endswith(".png"):
        with open(os.path.join(folder, name), "rb") as f:
            png = f.read()
        width, _ = struct.unpack(">II", png[16:24])
        assert png[37:41] == b"pHYs" and struct.unpack(">I", png[41:45])[0] == 11811, name
        assert command.encode() in png and width >= 990, name
    else:
        assert command in content(name), name
for figure in saved:
    root = xml.fromstring(figure["svg"])
    width = float(root.get("width")[:-2])
    assert root.get("width").endswith("mm") and 83.9 < width < 178.1, (figure["name"], width)
    texts = [text.text for text in root.findall("{http://www.w3.org/2000/svg}text")]
    if figure["name"].startswith("map0"):  # the scale of its colours
        most = max(float(row[2]) for row in rows(figure["name"] + ".csv")[1:])
        end = float(texts[1].split()[0].replace(",", ""))
        assert texts[0] == "0" and end == (100 if "saturation" in figure["name"] else most), (figure["name"], texts, most)
    else:
        assert len(texts) > 3, figure["name"]

# The numbers are those of the report.
stages = {s["name"]: s["time"]["cycles"] for s in report["time"]["stages"] if s["of_the_frame"] and "time" in s}
table = {row[0]: row[1] for row in rows("stages.csv")[1:]}
assert {name: int(table[name]) for name in stages} == stages, table
timeline = {row[0]: float(row[1]) for row in rows("timeline.csv")[1:]}
assert abs(sum(timeline.values()) - report["time"]["frame_ms"]) < 1e-6 * report["time"]["frame_ms"], timeline
(other,) = report["what_if"]
what_ifs = {row[0]: float(row[1]) for row in rows("what-ifs.csv")[1:]}
assert abs(what_ifs[other["set"]] - other["time"]["frame_ms"]) < 5e-4 and other["same_picture"], what_ifs
assert [b["stage"] for b in report["bounds"]] == list(stages), report["bounds"]
assert {row[0] for row in rows("bounds.csv")[1:]} == set(stages)
assert {f"map0-heat-{key}" for key in ("blends", "cycles", "saturation")} <= {f["name"] for f in saved}
print(len(saved), "figures")
