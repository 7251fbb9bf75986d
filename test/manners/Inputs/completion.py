#!/usr/bin/env python3
"""completion.py SHELL BUILD FOLDER: what a shell completes on command lines of the tools, in a new folder.

Prints each line that is completed otherwise than expected, and a count.
"""

import os
import pty
import select
import subprocess
import sys

# A command line, and words that it is completed with; "!" stands before one that must not be among them.
CASES = (
    ("splat ren", "render"),
    ("splat --set a=b ren", "render"),
    ("splat --set ", "machine clusters raster.queue_depth !scaled !scene.ply"),
    ("splat --set mach", "machine !clusters"),
    ("splat --set machine=sc", "scaled scaled-forwarding !prototype"),
    ("splat --set=machine=sc", "scaled scaled-forwarding !prototype"),
    ("splat --set clusters=2,mach", "2,machine"),
    ("splat --set clusters=2,machine=sc", "scaled scaled-forwarding !prototype"),
    ("splat render --set machine=", "prototype scaled !clusters"),
    ("splat --set machine=scaled ren", "render"),
    ("vorion-sim --set timing.", "timing.enabled !clusters"),
    ("splat ", "render train doctor !--exp !scene.ply"),
    ("splat render --exp ", "exact table poly2 !scene.ply"),
    ("splat render --exp=ta", "table table32 table64 !exact"),
    ("splat render --exp ta", "table table32 table64 !exact"),
    ("splat render --he", "--heat-map --help !--exp"),
    ("splat render --cameras ", "cameras.json inner/ !scene.ply"),
    ("splat render -o ", "old.png inner/ !scene.ply"),
    ("splat render --output=", "old.png !scene.ply"),
    ("splat render --kernels ", "inner/ !scene.ply"),
    ("splat render --effects sh1,fai", "sh1,faint"),
    ("splat render scene.ply --cameras cameras.json --view ", "front close above all"),
    ("splat render scene.ply --cameras cameras.json --view fr", "front !close"),
    ("splat render scene.ply --cameras=cameras.json --view fr", "front !close"),
    ("splat accuracy scene.ply --cameras cameras.json --view front,cl", "front,close"),
    ("splat info sc", "scene.ply"),
    ("splat train --path ", "raster simt"),
    ("splat train --exp", "!--exp"),
    ("splat train --preset ", "inria gsplat mcmc cameras.json inner/ !scene.ply"),
    ("splat train --preset=gs", "gsplat !inria"),
    ("splat hel", "help"),
    ("splat help re", "render replay !train"),
    ("splat doctor --json ", "cameras.json !scene.ply"),
    ("vorion-sim --check ra", "race"),
    ("vorion-sim --config ", "cameras.json prototype scaled-forwarding !scene.ply"),
    ("vorion-sim --signature-granularity ", "1 2 4 8 16 !scene.ply"),
    ("vorion-objdump --disassemble-a", "--disassemble-all"),
    ("vorion-objdump -d sc", "scene.ply"),
    ("vorion-objdump --disassemble-all ", "scene.ply inner/"),
    ("vorion-clang sc", "scene.ply"),
    ("vorion-clang -fcolor-d", "-fcolor-diagnostics"),
    ("vorion-link --vers", "--version"),
)
# fish offers all files.
CASES_BUT_FISH = (("splat render ", "scene.ply inner/ !old.png !cameras.json"),)
shell, build, folder = sys.argv[1], *map(os.path.abspath, sys.argv[2:])
share = os.path.join(build, "share")
os.makedirs(os.path.join(folder, "inner"))
os.chdir(folder)
subprocess.run(["splat", "demo-scene", "--gaussians", "1000", "-o", "scene.ply", "--cameras", "cameras.json"], check=True,
               stdout=subprocess.DEVNULL)
open("old.png", "w", encoding="utf-8").close()
os.makedirs("home")
ENVIRONMENT = dict(os.environ, HOME=os.path.abspath("home"), TERM="dumb", LC_ALL="C.UTF-8")


def with_bash(line):
    """By the function alone, with the words as bash takes them apart."""
    tool = line.split(" ", 1)[0]
    script = f'''
source "{share}/bash-completion/completions/{tool}" || exit
for line; do
  COMP_WORDS=() COMPREPLY=()
  spaced=${{line//=/ = }}
  read -ra COMP_WORDS <<<"$spaced"
  [[ $line != *" " && $line != *= ]] || {{ [[ $line == *= ]] || COMP_WORDS+=(""); }}
  COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))
  "$(complete -p {tool} | sed 's/.*-F \\([^ ]*\\).*/\\1/')"
  for word in "${{COMPREPLY[@]}}"; do [[ -d $word ]] && word+=/; echo "$word"; done
done'''
    return subprocess.run(["bash", "--norc", "-c", script, "bash", line], stdout=subprocess.PIPE, text=True, check=True,
                          env=ENVIRONMENT).stdout.split()


def with_fish(line):
    script = f"set -g fish_complete_path '{share}/fish/vendor_completions.d'; complete -C \"{line}\""
    said = subprocess.run(["fish", "--no-config", "-c", script], stdout=subprocess.PIPE, text=True, check=True,
                          env=ENVIRONMENT).stdout
    # fish gives whole words, without the option of "--option=".
    return [each.split("\t")[0] for each in said.splitlines()]


class Zsh:
    """An interactive zsh on a terminal, whose matches go to a file instead."""

    SETUP = f"""
fpath=('{share}/zsh/site-functions' $fpath); autoload -U compinit; compinit -u -D
compadd() {{
  local -a hits; local separate=$* 
  if [[ " ${{(j: :)@[1,(i)(-|--)]}} " == *" -"[OAD]" "* ]]; then builtin compadd "$@"; return; fi
  builtin compadd -A hits "$@"
  local before=$IPREFIX after=
  local -A marks; zparseopts -E -A marks -- P: S: f
  print -rl -- $hits >>|matches
  builtin compadd "$@"
}}
capture() {{ _main_complete; compstate[insert]=; compstate[list]=; print -r -- END >>|matches; }}
zle -C capture complete-word capture; bindkey '^I' capture; bindkey '^U' kill-buffer
PS1=; unsetopt zle_bracketed_paste; print -r -- READY >matches
"""

    def __init__(self):
        self.child, self.terminal = pty.fork()
        if self.child == 0:
            os.execvpe("zsh", ["zsh", "-f", "-i"], ENVIRONMENT)
        with open("setup.zsh", "w", encoding="utf-8") as file:
            file.write(self.SETUP)
        self.type(". ./setup.zsh\n", "READY")

    def type(self, text, until):
        """What zsh has written to the file once it ends with the word `until`."""
        if os.path.exists("matches"):
            os.truncate("matches", 0)
        os.write(self.terminal, text.encode())
        while True:
            if select.select([self.terminal], [], [], 0.01)[0]:
                os.read(self.terminal, 65536)
            if os.path.exists("matches"):
                with open("matches", encoding="utf-8") as file:
                    lines = file.read().split("\n")
                if until in lines:
                    return [line for line in lines if line not in ("", until)]

    def __call__(self, line):
        matches = self.type("\x15" + line + "\t", "END")
        return [m + "/" if os.path.isdir(m) else m for m in matches]


complete = {"bash": with_bash, "fish": with_fish}.get(shell) or Zsh()
wrong = 0
for line, expected in CASES + (() if shell == "fish" else CASES_BUT_FISH):
    before = line.split(" ")[-1].rpartition("=")[0]
    listed = line.split(" ")[-1].rpartition("=")[2].rpartition(",")[0]
    # zsh and fish give what follows the option's "=", or all of it; the same of lists.
    found = {word.removeprefix(before + "=") for word in complete(line)}
    # Behind a key, some shells have "=" already.
    found |= {word.removesuffix("=") for word in found}
    found |= {f"{listed},{word}" for word in found if listed and "," not in word}
    bad = [word for word in expected.split() if (word[1:] in found if word[0] == "!" else word not in found)]
    # fish orders files by their ending and leaves none out.
    if shell == "fish":
        bad = [word for word in bad if word not in ("!scene.ply", "!cameras.json")]
    if bad:
        wrong += 1
        print(f"{shell}: {line!r}: {' '.join(bad)}: completed with {sorted(found)[:12]}")
print(f"{shell}: {len(CASES)} command lines, {wrong} completed wrongly")
