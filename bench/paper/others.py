"""Results that other documents hold: their scripts, called by the same command, and what each printed."""

import os
import subprocess
import sys

import scenes
from writing import paragraph, table

TITLE = "Results of other documents"
GUITAR = ("{scenes}/guitar.compressed.ply", "--cameras", "{scenes}/cameras/guitar.json")
FRONT = (*GUITAR, "--view", "front")
DESK = ("--downscale", "8", "--max-gaussians", "8000", "--densify-interval", "50", "--densify-after", "100", "--exclude", "input_0001")
# Name, document, commands one after the other; {scenes} and {captures} are folders of ../shared, {out} one of the result's own.
RESULTS = (
    ("accuracy", "tables/accuracy.md", (("splat", "accuracy", *GUITAR, "--min-db", "50", "-o", "{out}"), ("bench/accuracy_table.py", "{out}/accuracy.json"))),
    ("effects", "tables/effects.md", (("bench/effects.py", "--clock", "--out", "{out}"),
                                      ("bench/effects.py", "--clock", "--out", "{out}/simt", "--", "--path", "simt"))),
    ("ideas", "tables/ideas.md", (("bench/ideas.py", *FRONT), ("bench/warps.py", *FRONT), ("bench/dealing.py",), ("bench/order_between_frames.py",))),
    ("explore", "tables/explore.md", (("splat", "explore", *FRONT, "--machines", "2000", "-o", "{out}"),)),
    ("training", "tables/training.md", (("bench/training_methods.py", "{captures}/desk_colmap", "--results", "{out}", "--", *DESK),
                                        ("bench/train_spread.py", "{captures}/carving_colmap", "--folder", "{out}/spread"))),
    ("energy", "tables/energy-frames.md", (("bench/energy_table.py",),)),
    ("cameras", "tables/cameras.md", (("bench/cameras.py", *FRONT),)),
    ("dram", "tables/dram.md", (("bench/dram_frames.py", *FRONT, "--config", "scaled"),)),
)


def words_of(command, out):
    folders = {"scenes": scenes.SHARED, "captures": os.path.join("..", "shared", "data", "captures"), "out": out}
    return [word.format(**folders) for word in command]


def measure(store, _scenes, _every_view):
    """Runs what has not ended yet. Scripts keep their own frames, so one that is broken off goes on."""
    rows = []
    for name, document, commands in RESULTS:
        out = os.path.join(store.folder, "others", name)
        os.makedirs(out, exist_ok=True)
        for number, command in enumerate(commands):
            file, words = os.path.join(out, f"printed-{number}.md"), words_of(command, os.path.abspath(out))
            if not os.path.exists(file) and not store.only_kept:
                with open(file + ".new", "w", encoding="utf-8") as f:
                    done = subprocess.run([sys.executable] * words[0].endswith(".py") + words, cwd=scenes.ROOT, stdout=f, check=False)
                if done.returncode:
                    sys.exit(f"paper.sh: error: {words[0]} failed with {done.returncode}, expected the tables of docs/{document}")
                os.replace(file + ".new", file)
            if os.path.exists(file):
                rows.append({"document": document, "command": " ".join(words_of(command, f"build/{name}")), "printed": os.path.relpath(file, store.folder)})
    return {"rows": rows}


def text(data):
    out = [paragraph("""What these commands print is in files of the results' folder, from where the documents have their tables."""), ""]
    return out + table(("document", "command", "printed"), [(f"[{row['document'].split('/')[1]}](../{row['document']})", f"`{row['command']}`", f"`{row['printed']}`")
                                                            for row in data["rows"]])


def charts(_data):
    return {}
