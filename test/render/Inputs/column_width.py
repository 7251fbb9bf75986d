"""Checks that LaTeX tables fit into a paper's column: usage column_width.py FOLDER..."""

import glob
import re
import sys

COLUMN = 84 / 25.4 * 72.27  # points
SIZES = {"": 10, "\\footnotesize": 8, "\\scriptsize": 7}

for file in (f for folder in sys.argv[1:] for f in glob.glob(folder + "/*.tex")):
    with open(file, encoding="utf-8") as f:
        text = f.read()
    size, separation = re.search(r"\\begingroup(\\\w+)\\setlength\{\\tabcolsep\}\{([\d.]+)pt\}", text).groups() if "\\begingroup" in text else ("", 6)
    for row in re.findall(r"^(?![%\\]).* \\\\$|^\\parbox.* \\\\$", text, re.M):
        cells = row.removesuffix(" \\\\").split(" & ")
        boxes = [re.match(r"\\parbox\[t\]\{([\d.]+)pt\}", cell) for cell in cells]
        lines = [re.sub(r"\\begin\{tabular\}\[b\]\{@\{\}.@\{\}\}|\\end\{tabular\}", "", cell).split("\\\\") for cell in cells]
        # A letter is about half as wide as high.
        width = sum(float(box[1]) if box else SIZES[size] * max(len(re.sub(r"\\(\w+\{\})?", "", one)) for one in some) / 2 for box, some in zip(boxes, lines))
        width += 2 * float(separation) * (len(cells) - 1)
        assert width < 1.05 * COLUMN, (file, width, row)
    print(file, "fits")
