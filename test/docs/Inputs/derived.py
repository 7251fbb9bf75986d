"""usage: derived.py DOCS: checks figures of DOCS' pages that follow from a table: the claims of energy.md on watts and our rows of
prior-art.md from the frames of energy.md, and the costs of cameras.md from tables/cameras.md."""

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


energy = read("energy.md").split("## What frames take")[1].split("\n## ")[0]
frames = [cells(line) for line in energy.splitlines() if line.startswith("| ")][1:]


def watts(rows, column):
    values = [triple(row[column]) for row in rows]
    least, largest = span([value for value, _, _ in values])
    return f"{least} to {largest} W, intervals from {span([v[1] for v in values])[0]} to {span([v[2] for v in values])[1]}"


chips = [row for row in frames if row[1].startswith("`prototype") and "simt" not in row[0]]
fast = [row for row in chips if "100 MHz" not in row[0]]
slow = [row for row in chips if "100 MHz" in row[0]]
assert fast and slow
want("energy.md", f"{watts(fast, 5)}, on {len(fast)} views and machines")
want("energy.md", watts(fast, 6))
want("energy.md", watts(slow, 5))


def short(text):
    return f"{float(text):#.2g}".rstrip(".")


def shorts(cell):
    value, low, high = map(short, triple(cell))
    return f"{value} ({low}-{high})"


for machine in ("`prototype`", "`prototype-forwarding`", "`scaled`"):
    rows = [next(row for row in frames if row[:2] == [view, machine]) for view in ("guitar front", "truck overview")]
    rates = [str(int(float(row[2]) + 0.5)) for row in rows]
    power, joules = ([shorts(row[column]) for row in rows] for column in (5, 3))
    want("prior-art.md", f"{' and '.join(power)} W | {' and '.join(rates)} | {' and '.join(joules)} |")

costs = {}
for line in read("tables/cameras.md").split("## Errors")[0].splitlines():
    row = cells(line) if line.startswith("| ") else []
    if len(row) == 7 and row[4].endswith("%"):
        costs.setdefault(row[0], []).append(float(row[4].split()[0]))
assert costs
for camera, more in costs.items():
    low, high = (f"{x:.0f}" if max(more) >= 100 else f"{x:.1f}" for x in (min(more), max(more)))
    page = read("cameras.md")
    line = next((line for line in page.splitlines() if re.match(rf"\| {re.escape(camera)}\b.* % \|$", line)), "")
    both = low if low == high else f"{low} to {high}"
    if not line.endswith(f"| {both} % |"):
        sys.exit(f"{docs}/cameras.md has no '| {camera} | {both} % |', which follows from a table")
