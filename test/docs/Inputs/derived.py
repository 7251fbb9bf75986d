"""usage: derived.py DOCS: checks figures of DOCS' pages that follow from a table: the claims on watts and our rows of
tables/prior-art.md from the frames of tables/energy-frames.md, the costs of cameras.md from tables/cameras.md, and the README's verdicts on the
paper from paper-results.md."""

import re
import sys

docs = sys.argv[1]


def read(page):
    with open(f"{docs}/{page}", encoding="utf-8") as file:
        return file.read()


def cells(line):
    return [cell.strip() for cell in line.strip().split("|")[1:-1]]


def want(page, text):
    if text not in read(page):
        sys.exit(f"{docs}/{page} has no '{text}', which follows from a table")


def triple(cell):
    """VALUE (LOW-HIGH) as texts."""
    return re.fullmatch(r"(\S+) \((\S+)-(\S+)\)", cell).groups()


def span(texts):
    """The least and the largest of numbers, as they were written."""
    return min(texts, key=float), max(texts, key=float)


energy = read("tables/energy-frames.md").split("## What frames take")[1].split("\n## ")[0]
frames = [cells(line) for line in energy.splitlines() if line.startswith("| ")][1:]


def watts(rows, column):
    values = [triple(row[column]) for row in rows]
    least, largest = span([value for value, _, _ in values])
    return f"{least} to {largest} W, intervals from {span([v[1] for v in values])[0]} to {span([v[2] for v in values])[1]}"


chips = [row for row in frames if row[1].startswith("`prototype") and "simt" not in row[0]]
fast = [row for row in chips if "100 MHz" not in row[0]]
slow = [row for row in chips if "100 MHz" in row[0]]
assert fast and slow
want("tables/energy-frames.md", f"{watts(fast, 5)}, on {len(fast)} views and machines")
want("tables/energy-frames.md", watts(fast, 6))
want("tables/energy-frames.md", watts(slow, 5))


def short(text):
    return f"{float(text):#.2g}".rstrip(".")


def shorts(cell):
    value, low, high = map(short, triple(cell))
    return f"{value} ({low}-{high})"


for machine in ("`prototype`", "`prototype-forwarding`", "`scaled`"):
    rows = [next(row for row in frames if row[:2] == [view, machine]) for view in ("guitar front", "truck overview")]
    rates = [str(int(float(row[2]) + 0.5)) for row in rows]
    power, joules = ([shorts(row[column]) for row in rows] for column in (5, 3))
    want("tables/prior-art.md", f"{' and '.join(power)} W | {' and '.join(rates)} | {' and '.join(joules)} |")

costs = {}
for line in read("tables/cameras.md").split("## Errors")[0].splitlines():
    row = cells(line) if line.startswith("| ") else []
    if len(row) == 7 and row[4].endswith("%"):
        costs.setdefault(row[0], []).append(float(row[4].split()[0]))
assert costs
sentence = " ".join(read("cameras.md").split("## What each costs")[1].split())
for camera in ("OpenCV's distortion", "OpenCV's fisheye", "equirectangular", "pinhole, unscented"):
    both = f"{min(costs[camera]):.0f} to {max(costs[camera]):.0f} %"
    if both not in sentence:
        sys.exit(f"{docs}/cameras.md has no '{both}' for {camera}, which follows from a table")

with open(f"{docs}/../README.md", encoding="utf-8") as file:
    verdicts = file.read().split("| the paper | verdict | measured here |")[1].split("\n\n")[0]
FIGURE = re.compile(r"\d+(?:\.\d+)?")
claims = set(FIGURE.findall(read("paper-results.md")))
rows = [cells(line) for line in verdicts.splitlines() if line.startswith("| ")]
assert len(rows) == 10
for row in rows:
    for figure in FIGURE.findall(" ".join(row)):
        if figure not in claims:
            sys.exit(f"README.md has '{figure}' in '{row[0]}', which paper-results.md has not")
