"""Markdown tables and charts."""

import glob
import json
import os
import re
import subprocess
import tempfile
import textwrap

WIDEST = 100  # columns of a line of prose


def table(heads, rows):
    """Lines of a table, with an empty line behind; columns of numbers are right-aligned."""
    number = {*"0123456789+-", ""}
    words = [any(str(row[k])[:1] not in number for row in rows) for k in range(len(heads))]
    rule = "|" + "".join("---|" if w else "--:|" for w in words)
    return ["| " + " | ".join(heads) + " |", rule, *("| " + " | ".join(map(str, row)) + " |" for row in rows), ""]


def terms(rows):
    """What words of a page mean, as a table."""
    return table(("word", "meaning"), [(word, paragraph(meaning)) for word, meaning in rows])


def paragraph(text):
    """One line of Markdown from a text that is broken into lines."""
    return " ".join(text.split())


def wrapped(lines):
    """The lines, with prose of more than WIDEST columns broken; tables, commands and headings stay."""
    out, code = [], False
    for line in lines:
        code ^= line.startswith("```")
        begin = line[:len(line) - len(line.lstrip(" -"))]
        if code or len(line) <= WIDEST or line.strip().startswith(("|", "#", "!")) or re.fullmatch(r"\s*`[^`]*`", line):
            out.append(line)
        else:
            out += textwrap.wrap(line[len(begin):], WIDEST, initial_indent=begin, subsequent_indent=" " * len(begin),
                                 break_long_words=False, break_on_hyphens=False)
    return out


def mega(cycles):
    return f"{cycles / 1e6:.2f}"


def chart(title, x_label, y_label, places, series, bars=False):
    """Values by place, as lines or bars: what svg_of() draws."""
    return {"title": title, "x_label": x_label, "y_label": y_label, "places": places, "series": series, "bars": bars}


def svg_of(described, made):
    """An SVG document, drawn as the charts of splat's pages; made: lines that say what made it."""
    text = json.dumps({**described, "places": list(described["places"]), "made": made})
    with tempfile.TemporaryDirectory() as folder:
        page = os.path.join(folder, "page.html")
        with open(page, "w", encoding="utf-8") as out:
            subprocess.run(["splat-chart"], input=text, stdout=out, check=True, text=True)
        subprocess.run(["splat-figures", page, folder], check=True)
        [file] = glob.glob(os.path.join(folder, "*.svg"))
        with open(file, encoding="utf-8") as svg:
            return svg.read()
