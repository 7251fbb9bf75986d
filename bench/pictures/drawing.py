"""What pictures that splat-chart cannot draw share: a command line, an SVG in the look of its charts, a colour for each reason."""

import argparse
import os
import sys
from xml.sax.saxutils import escape
from generators import clock

# By reason of cores, rasterizers and pixel units, in the order in which they are stacked.
COLOURS = clock.colours()
LEGEND_ROW = 20


def parser(document, source):
    """Takes the file that is drawn, called source, and the picture's."""
    found = argparse.ArgumentParser(description=document, formatter_class=argparse.RawDescriptionHelpFormatter)
    found.add_argument(source)
    found.add_argument("output")
    found.add_argument("--made", action="append", default=[], help="a line below the picture; may be given several times")
    return found


def fail(file, what, expected):
    print(f"{os.path.basename(sys.argv[0])}: error: {file}: {what}, expected {expected}", file=sys.stderr)
    sys.exit(3)


def shortened(text, letters):
    return text if len(text) <= letters else text[:letters - 1] + "…"


def colour(reason):
    return COLOURS[reason]


def stacked(by_reason):
    """The reasons and their values, in the order of COLOURS."""
    order = list(COLOURS)
    return sorted(by_reason.items(), key=lambda item: order.index(item[0]))


class Drawing:
    """Elements of an SVG, top down; write() closes it under a legend, of the reasons that were used if no other is given."""

    def __init__(self, width, title, subtitle):
        self.width, self.elements, self.used = width, [], set()
        self.text(16, 26, title, "title ink")
        self.text(16, 44, subtitle, "soft")
        self.y = 58

    def text(self, x, y, what, kind="ink", anchor="start"):
        self.elements.append(f'<text x="{x:g}" y="{y:g}" text-anchor="{anchor}" class="{kind}">{escape(what)}</text>')

    def box(self, x, y, width, height, fill, hint=""):
        hint = f"<title>{escape(hint)}</title>" if hint else ""
        self.elements.append(f'<rect x="{x:.1f}" y="{y:g}" width="{width:.1f}" height="{height:g}" fill="{fill}">{hint}</rect>')

    def path(self, commands, fill):
        self.elements.append(f'<path d="{commands}" fill="{fill}"/>')

    def write(self, file, made, legend=None):
        x = 16
        self.y += 18
        for name, fill in (legend or {name: colour(name) for name in COLOURS if name in self.used}).items():
            width = 26 + 7.2 * len(name)
            if x + width > self.width:
                x, self.y = 16, self.y + LEGEND_ROW
            self.box(x, self.y - 10, 11, 11, fill)
            self.text(x + 16, self.y, name)
            x += width + 8
        self.y += 24
        for line in made:
            self.text(16, self.y, line, "made soft")
            self.y += 15
        with open(file, "w", encoding="utf-8") as out:
            out.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.y}" width="{self.width}" height="{self.y}">\n'
                      "<style>\n"
                      'text { font: 12px system-ui, "DejaVu Sans", sans-serif; white-space: pre; }\n'
                      ".title { font-size: 15px; font-weight: 600; }\n.made { font-size: 11px; }\n"
                      '.code { font: 11px ui-monospace, "DejaVu Sans Mono", monospace; }\n'
                      ".panel { fill: #f6f8fa; stroke: #d0d7de; }\n.ink { fill: #1b1f24; }\n.soft { fill: #57606a; }\n"
                      "@media (prefers-color-scheme: dark) {\n"
                      ".panel { fill: #161b22; stroke: #30363d; }\n.ink { fill: #e6edf3; }\n.soft { fill: #9aa4af; }\n}\n"
                      "</style>\n"
                      f'<rect x="0.5" y="0.5" width="{self.width - 1}" height="{self.y - 1}" rx="6" class="panel"/>\n')
            out.write("\n".join(self.elements) + "\n</svg>\n")
