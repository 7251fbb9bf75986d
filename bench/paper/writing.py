"""Markdown tables and charts."""

import math
import textwrap
from html import escape

WIDEST = 100  # columns of a line of prose
WIDTH, HEIGHT = 760, 440
LEFT, RIGHT, TOP, BOTTOM = 70, 745, 76, 350
# Okabe and Ito's colours, which the colour-blind can tell apart; as apps/splat/analyze/Chart.cpp draws.
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9")
DASHES = ("none", "7 3", "2 3", "9 3 2 3", "1 2", "12 3", "4 4")


def table(heads, rows):
    """Lines of a table, with an empty line behind; columns of numbers are right-aligned."""
    number = {*"0123456789+-", ""}
    words = [any(str(row[k])[:1] not in number for row in rows) for k in range(len(heads))]
    rule = "|" + "".join("---|" if w else "--:|" for w in words)
    return ["| " + " | ".join(heads) + " |", rule, *("| " + " | ".join(map(str, row)) + " |" for row in rows), ""]


def paragraph(text):
    """One line of Markdown from a text that is broken into lines."""
    return " ".join(text.split())


def wrapped(lines):
    """The lines, with prose of more than WIDEST columns broken; tables, commands and headings stay."""
    out, code = [], False
    for line in lines:
        code ^= line.startswith("```")
        begin = line[:len(line) - len(line.lstrip(" -"))]
        if code or len(line) <= WIDEST or line.strip().startswith(("|", "#", "!", "`")):
            out.append(line)
        else:
            out += textwrap.wrap(line[len(begin):], WIDEST, initial_indent=begin, subsequent_indent=" " * len(begin),
                                 break_long_words=False, break_on_hyphens=False)
    return out


def mega(cycles):
    return f"{cycles / 1e6:.2f}"


def _step(largest):
    """A round number of which five or fewer reach the largest value."""
    if largest <= 0:
        return 1
    power = 10 ** math.floor(math.log10(largest / 5))
    return next(f * power for f in (1, 2, 2.5, 5, 10) if f * power * 5 >= largest)


def chart(title, x_label, y_label, places, series, bars=False):
    """An SVG document: values by place, as lines or bars."""
    step = _step(max(max(values) for values in series.values()))
    steps = max(1, math.ceil(max(max(values) for values in series.values()) / step - 1e-9))
    pitch = (RIGHT - LEFT) / len(places)

    def x(k):
        return LEFT + (k + 0.5) * pitch

    def y(value):
        return BOTTOM - value / (step * steps) * (BOTTOM - TOP)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
           'font-size="11">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           f'<text x="{WIDTH / 2}" y="18" text-anchor="middle" font-size="14">{escape(title)}</text>',
           f'<text x="{(LEFT + RIGHT) / 2}" y="{HEIGHT - 6}" text-anchor="middle">{escape(x_label)}</text>',
           f'<text transform="translate(16 {(TOP + BOTTOM) / 2}) rotate(-90)" text-anchor="middle">'
           f'{escape(y_label)}</text>']
    for k in range(steps + 1):
        stroke = "#d0d0d0" if k else "#000000"
        out += [f'<line x1="{LEFT}" y1="{y(k * step):.1f}" x2="{RIGHT}" y2="{y(k * step):.1f}" stroke="{stroke}"/>',
                f'<text x="{LEFT - 6}" y="{y(k * step) + 4:.1f}" text-anchor="end">{k * step:.6g}</text>']
    slanted = max(map(len, places)) * 7 > pitch
    for k, place in enumerate(places):
        where = f'transform="translate({x(k):.1f} {BOTTOM + 14}) rotate(-40)" text-anchor="end"' if slanted \
            else f'x="{x(k):.1f}" y="{BOTTOM + 18}" text-anchor="middle"'
        out.append(f"<text {where}>{escape(place)}</text>")
    legend, legend_y = LEFT, 32
    for number, (name, values) in enumerate(series.items()):
        colour = COLOURS[number % len(COLOURS)]
        if bars:
            width = 0.8 * pitch / len(series)
            out += [f'<rect x="{x(k) - 0.4 * pitch + number * width:.1f}" y="{y(v):.1f}" width="{width:.1f}" '
                    f'height="{BOTTOM - y(v):.1f}" fill="{colour}"/>' for k, v in enumerate(values)]
        else:
            points = " ".join(f"{x(k):.1f},{y(v):.1f}" for k, v in enumerate(values))
            dashes = DASHES[number % len(DASHES)]
            out.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2" '
                       f'stroke-dasharray="{dashes}"/>')
        wide = 30 + 6.4 * len(name)
        if legend + wide > RIGHT:
            legend, legend_y = LEFT, legend_y + 15
        out += [f'<rect x="{legend:.1f}" y="{legend_y}" width="12" height="10" fill="{colour}"/>',
                f'<text x="{legend + 16:.1f}" y="{legend_y + 9}">{escape(name)}</text>']
        legend += wide
    return "\n".join([*out, "</svg>", ""])
