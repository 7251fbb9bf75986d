#!/usr/bin/env python3
"""Makes, refreshes and verifies our patches to PoCL and LLVM (docs/pocl-patches.md).

A series is a folder of patches and the file `series`, which names them in their order, as quilt has it.
scripts/fetch-source.sh applies it. To change a series, edit commits, not patches:

  scripts/patches.py checkout pocl       a git tree of the source: the commit `pristine`, then one for each patch
  cd build/patches/pocl                  edit; git commit --fixup COMMIT; git rebase -i --autosquash pristine
  scripts/patches.py new pocl KIND/NAME  commits the tree's changes as a new patch, KIND being upstream or vorion
  scripts/patches.py refresh pocl        writes the commits back as patches

  scripts/patches.py verify [pocl|llvm]  checks headers, form, and that the patches apply
  scripts/patches.py port pocl FOLDER    counts the hunks that apply to another version's source
  scripts/patches.py table               writes docs/tables/patches.md; --check only compares

A commit's message is its patch's header, but for the line `Patch: KIND/NAME`.

exit codes: 0 done, 1 `verify` or `--check` found something, 2 usage, 3 no source or no tree,
4 a patch does not apply, 5 the tree cannot be written as patches
"""

import argparse
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SERIES = {"pocl": "runtime/pocl/patches", "llvm": "llvm-backend/patches"}
PAGE = "docs/tables/patches.md"
KINDS = ("upstream", "vorion")
# Lines of context: the fewest that tell `git apply` that a hunk is not at a file's end.
CONTEXT = 1
# What follows the reason in a header: key, whether each patch has it, its form, and what was expected.
FIELDS = {
    "Test": (True, r"\S+( .+)?", "a file of this repository, or `cts GROUP` or `pocl TEST`"),
    "Upstream": (True, r"(no|partly, .+|yes, .+)", "`no`, `partly, VERSION: WHAT` or `yes, VERSION`"),
    "Needs": (False, r"upstream/\S+", "the name of a patch in upstream/"),
}
# git as this tool calls it: without the user's settings, which can change what it prints, and with a name of its own.
ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")} | {
    "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1",
    **{f"GIT_{who}_{what}": value for who in ("AUTHOR", "COMMITTER") for what, value in
       (("NAME", "patches"), ("EMAIL", "patches@localhost"), ("DATE", "2000-01-01T00:00:00Z"))}}


class Failure(Exception):
    """A line for the user, and the exit code."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


class GitFailure(Failure):
    """What git said, all of it."""

    def __init__(self, tree, arguments, said):
        super().__init__(5, f"{tree}: git {arguments[0]}: {(said.strip().splitlines() or ['no reason given'])[0]}")
        self.said = said


def git(tree, *arguments, text="", index=None):
    """What git prints in a tree, or with an index beside that of the tree."""
    done = subprocess.run(["git", "-C", tree, *arguments], input=text.encode(errors="surrogateescape"), capture_output=True,
                          env=ENVIRONMENT | ({"GIT_INDEX_FILE": index} if index else {}), check=False)
    if done.returncode != 0:
        raise GitFailure(tree, arguments, done.stderr.decode(errors="replace"))
    return done.stdout.decode(errors="surrogateescape")


def read(path):
    with open(path, encoding="utf-8", errors="surrogateescape") as file:
        return file.read()


def write(path, text):
    """Writes a file unless it has that text: its time stays."""
    if os.path.exists(path) and read(path) == text:
        return
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8", errors="surrogateescape") as file:
        file.write(text)


class Patch:
    """One patch: its header's parts, and its changes."""

    def __init__(self, name, header, changes):
        self.name, self.changes = name, changes
        self.header = "\n".join(line.rstrip() for line in header.strip().splitlines()) + "\n"
        *reason, last = self.header.rstrip("\n").split("\n\n")
        self.subject = self.header.split("\n", 1)[0]
        self.fields = {key: [] for key in FIELDS}
        lines = last.replace("\n ", " ").splitlines()
        if not all(re.match(r"[A-Z][A-Za-z-]*: ", line) for line in lines):
            reason, lines = [*reason, last], []
        self.reason = "\n\n".join(reason[1:])
        self.unknown = []
        for line in lines:
            key, value = line.split(": ", 1)
            self.fields.get(key, self.unknown).append(value if key in FIELDS else key)

    @classmethod
    def of_file(cls, name, path):
        header, _, changes = read(path).partition("\n---\n")
        return cls(name, header, changes)

    def text(self):
        return f"{self.header}---\n{self.changes}"

    def files(self):
        return sorted({name for name in re.findall(r"^(?:---|\+\+\+) [ab]/(\S+)", self.changes, re.MULTILINE)})

    def problems(self):
        """What is wrong with the header."""
        if not self.changes:
            yield "changes nothing, expected a header, a line '---' and changes"
        if not re.fullmatch(r"[A-Z].*[^.]", self.subject) or len(self.subject) > 100:
            yield f"its first line is '{self.subject}', expected a sentence without its period, at most 100 columns"
        if not self.reason:
            yield "its header gives no reason, expected a paragraph after the first line"
        for key in self.unknown:
            yield f"its header has '{key}:', expected {', '.join(FIELDS)}"
        for key, (needed, form, expected) in FIELDS.items():
            values = self.fields[key]
            if needed and not values:
                yield f"its header has no '{key}:', expected {expected}"
            for value in values:
                if not re.fullmatch(form, value):
                    yield f"its header has '{key}: {value}', expected {expected}"
        for test in self.fields["Test"]:
            file, _, name = test.partition(" ")
            path = os.path.join(ROOT, file)
            if file == "pocl" and name.startswith("corrections/"):
                if f"tests/{name}.c" not in self.files():
                    yield f"its test {test} is not among its files"
            elif file not in ("cts", "pocl") and not (os.path.isfile(path) and name in read(path)):
                yield f"its test {test} does not exist"
        if self.fields["Needs"] and not self.name.startswith("upstream/"):
            yield "its header has 'Needs:', which is for patches of upstream/"


class Series:
    """The patches of one source package."""

    def __init__(self, package, folder):
        self.package = package
        self.folder = folder or os.path.join(ROOT, SERIES[package])
        self.list = os.path.join(self.folder, "series")

    def shown(self, name=""):
        return os.path.relpath(os.path.join(self.folder, name), ROOT) if self.folder.startswith(ROOT) else \
            os.path.join(self.folder, name)

    def path(self, name):
        return os.path.join(self.folder, name + ".patch")

    def patches(self):
        if not os.path.exists(self.list):
            raise Failure(3, f"{self.shown('series')}: no such file, expected the names of the patches in their order")
        names = [line.removesuffix(".patch") for line in read(self.list).splitlines() if line and not line.startswith("#")]
        for name in names:
            if not os.path.exists(self.path(name)):
                raise Failure(3, f"{self.shown(name + '.patch')}: no such file, expected it from {self.shown('series')}")
        return [Patch.of_file(name, self.path(name)) for name in names]

    def state(self):
        """What a tree was made of."""
        text = "".join(patch.name + patch.text() for patch in self.patches())
        return hashlib.sha256(text.encode(errors="surrogateescape")).hexdigest()

    def write(self, patches):
        for kind in KINDS:
            folder = os.path.join(self.folder, kind)
            for file in os.listdir(folder) if os.path.isdir(folder) else ():
                if f"{kind}/{file}" not in {patch.name + ".patch" for patch in patches}:
                    os.remove(os.path.join(folder, file))
        for patch in patches:
            write(self.path(patch.name), patch.text())
        write(self.list, "".join(patch.name + ".patch\n" for patch in patches))


class Tree:
    """A source as git commits: `pristine`, and one for each patch after it."""

    def __init__(self, folder):
        self.folder = folder

    def git(self, *arguments, **options):
        return git(self.folder, *arguments, **options)

    @classmethod
    def make(cls, folder, source, files=None):
        """Of a source, or of some of its files."""
        if not os.path.isdir(source):
            raise Failure(3, f"{source}: no such folder, expected the unpacked source from scripts/fetch-source.sh")
        if files is None:
            shutil.copytree(source, folder, symlinks=True)
        for file in files or ():
            if os.path.isfile(os.path.join(source, file)):
                os.makedirs(os.path.dirname(os.path.join(folder, file)), exist_ok=True)
                shutil.copyfile(os.path.join(source, file), os.path.join(folder, file))
        tree = cls(folder)
        tree.git("init", "-q", "-b", "patches")
        # The source's own attributes must not change a byte of it.
        write(os.path.join(folder, ".git", "info", "attributes"), "* -text -eol -ident -filter\n")
        tree.git("add", "-Af", ".")
        tree.commit("The source without our patches\n")
        tree.git("tag", "pristine")
        return tree

    @classmethod
    def open(cls, folder):
        if not os.path.isdir(os.path.join(folder, ".git")):
            raise Failure(3, f"{folder}: no such tree, expected it from 'scripts/patches.py checkout'")
        return cls(folder)

    def commit(self, message):
        self.git("commit", "-q", "--no-verify", "--cleanup=verbatim", "-F", "-", text=message)

    def apply(self, patch, shown):
        """Applies a patch to the tree."""
        try:
            self.git("apply", "--index", "--whitespace=nowarn", "-", text=patch.changes)
        except GitFailure as failure:
            place = re.search(r"^error: (?:patch failed: )?(\S+?): ?(\d+|[^:]+)$", failure.said, re.MULTILINE)
            where = f" to {place[1]}, line {place[2]}" if place and place[2].isdigit() else ""
            raise Failure(4, f"{shown}: does not apply{where}") from failure

    def applies(self, patches, index):
        """Whether patches apply to the source in their order; tried in an index of their own."""
        self.git("read-tree", "pristine", index=index)
        try:
            for patch in patches:
                self.git("apply", "--cached", "--whitespace=nowarn", "-", text=patch.changes, index=index)
        except GitFailure:
            return False
        return True

    def changes(self, commit, context=CONTEXT):
        """What a commit changes, in the form that patches have: no dates, hashes or names of functions."""
        summary = self.git("diff-tree", "-r", "--no-commit-id", "--no-renames", commit)
        for line in summary.splitlines():
            old, new, *_ = line[1:].split(" ")
            if "000000" not in (old, new) and old != new:
                raise Failure(5, f"{line.split(chr(9))[1]}: its mode changes, which a patch does not say")
        text = self.git("diff-tree", "-p", "--no-commit-id", "--no-renames", "--diff-algorithm=myers", "--no-indent-heuristic",
                        f"-U{context}", commit)
        kept = []
        for line in text.splitlines(keepends=True):
            if line.startswith("Binary files"):
                raise Failure(5, f"{line.strip()}: a patch holds text alone")
            if not line.startswith(("diff --git ", "index ", "new file mode ", "deleted file mode ")):
                kept.append(re.sub(r"^(@@ .* @@).*", r"\1", line))
        return "".join(kept)

    def is_clean(self):
        return not self.git("status", "--porcelain") and not any(
            os.path.isdir(os.path.join(self.folder, ".git", name)) for name in ("rebase-merge", "rebase-apply"))

    def patches(self):
        """The commits after `pristine` as patches."""
        if not self.is_clean():
            raise Failure(5, f"{self.folder}: has changes that are not committed, or a rebase that has not ended")
        found = []
        for commit in self.git("rev-list", "--reverse", "pristine..HEAD").split():
            message = self.git("log", "-1", "--format=%B", commit)
            subject, short = message.split("\n", 1)[0], commit[:10]
            names = re.findall(r"^Patch: (\S+)\n?", message, re.MULTILINE)
            if len(names) != 1 or subject.startswith(("fixup!", "squash!", "amend!")):
                raise Failure(5, f"commit {short} '{subject}': has no line 'Patch: KIND/NAME'; squash it "
                              "(git rebase -i --autosquash pristine) or make it a patch ('new')")
            check_name(names[0], 5)
            patch = Patch(names[0], re.sub(r"^Patch: .*\n?", "", message, flags=re.MULTILINE), self.changes(commit))
            if not patch.changes:
                raise Failure(5, f"commit {short} '{subject}': changes nothing")
            if any(patch.name == other.name for other in found):
                raise Failure(5, f"commit {short} '{subject}': is the second one of {patch.name}")
            if patch.name.startswith("upstream/") and found and found[-1].name.startswith("vorion/"):
                raise Failure(5, f"commit {short} '{subject}': follows one of vorion/, expected those of upstream/ first")
            found.append(patch)
        return found


def check_name(name, code):
    if not re.fullmatch(rf"({'|'.join(KINDS)})/[a-z0-9-]+", name):
        raise Failure(code, f"{name}: expected upstream/ or vorion/ and a name of small letters, digits and hyphens")


def with_patches(series, tree):
    """Adds the series to a tree."""
    for patch in series.patches():
        tree.apply(patch, series.shown(patch.name + ".patch"))
        tree.commit(patch.header + f"Patch: {patch.name}\n")


def checkout(series, options):
    if os.path.exists(options.tree):
        raise Failure(3, f"{options.tree}: is there already; use it, or remove it first")
    os.makedirs(os.path.dirname(options.tree), exist_ok=True)
    try:
        with_patches(series, Tree.make(options.tree, options.source))
    except Failure:
        shutil.rmtree(options.tree, ignore_errors=True)
        raise
    git(options.tree, "config", "patches.state", series.state())
    print(f"{options.tree}: {len(series.patches())} patches as commits")


def new(_, options):
    check_name(options.name, 2)
    tree = Tree.open(options.tree)
    if tree.is_clean():
        raise Failure(5, f"{options.tree}: has no changes, expected those of the new patch")
    tree.git("add", "-A", ".")
    words = os.path.basename(options.name).replace("-", " ")
    tree.commit(f"{words.capitalize()}\n\nWhat was wrong, and for whom.\n\nTest: FILE\nUpstream: no\nPatch: {options.name}\n")
    print(f"{options.name} is the last commit; write its header with git commit --amend")


def refresh(series, options):
    tree = Tree.open(options.tree)
    patches = tree.patches()
    if tree.git("config", "patches.state").strip() != series.state():
        raise Failure(5, f"{options.tree}: is of other patches than those in {series.shown()}; check these out beside it, and "
                      "pick its commits")
    series.write(patches)
    tree.git("config", "patches.state", series.state())
    print(f"{series.shown()}: {len(patches)} patches")


def problems(series, source):
    """What is wrong with a series."""
    patches = series.patches()
    for patch in patches:
        yield from ((patch.name, problem) for problem in patch.problems())
    listed = [patch.name for patch in patches]
    for kind in KINDS:
        folder = os.path.join(series.folder, kind)
        for file in sorted(os.listdir(folder) if os.path.isdir(folder) else ()):
            if f"{kind}/{file}".removesuffix(".patch") not in listed:
                yield f"{kind}/{file}".removesuffix(".patch"), f"is not in {series.shown('series')}"
    with tempfile.TemporaryDirectory() as scratch:
        tree = Tree.make(os.path.join(scratch, "tree"), source, {file for patch in patches for file in patch.files()})
        with_patches(series, tree)
        for patch, commit in zip(patches, tree.patches()):
            if patch.text() != commit.text():
                yield patch.name, "is not as 'refresh' writes it"
        for at, patch in enumerate(patches):
            if patch.name.startswith("upstream/"):
                yield from ((patch.name, problem) for problem in alone(tree, patch, patches[:at], os.path.join(scratch, "index")))


def alone(tree, patch, before, index):
    """What is wrong with the statement that a patch applies to the source with what it needs, and nothing else."""
    needs = patch.fields["Needs"]
    needed = [other for other in before if other.name in needs]
    for name in set(needs) - {other.name for other in needed}:
        yield f"needs {name}, which is not before it"
    if not tree.applies([*needed, patch], index):
        yield f"does not apply {'with ' + ', '.join(needs) if needs else 'alone'}, expected what it needs in 'Needs:'"
    for name in needs:
        if tree.applies([other for other in needed if other.name != name] + [patch], index):
            yield f"applies without {name}, which it says it needs"


def verify(series, options):
    """Whether nothing is wrong with a series."""
    count = 0
    for count, (name, problem) in enumerate(problems(series, options.source), 1):
        print(f"patches: error: {series.shown(name + '.patch')}: {problem}", file=sys.stderr)
    patches = series.patches()
    counts = ", ".join(f"{sum(patch.name.startswith(kind) for patch in patches)} in {kind}/" for kind in KINDS)
    print(f"{series.package}: {counts}; {count} problem{'' if count == 1 else 's'}")
    return count == 0


def port(series, options):
    """Prints how many hunks of each patch apply to another source: as they are; reversed, because the source has them; and
    with three lines of context, up to two of which may differ."""
    if not os.path.isdir(options.folder):
        raise Failure(3, f"{options.folder}: no such folder, expected an unpacked source")
    patches = series.patches()
    sums = {kind: [0] * 6 for kind in KINDS}
    print("| patch | hunks | apply | there | hunks with 3 lines | apply with fuzz 2 | unchanged |\n|---|--:|--:|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as scratch:
        tree = Tree.make(os.path.join(scratch, "tree"), options.source, {file for patch in patches for file in patch.files()})
        with_patches(series, tree)
        for patch, commit in zip(patches, tree.git("rev-list", "--reverse", "pristine..HEAD").split()):
            hunks, applied = applying(options.folder, patch.changes, "-F0")
            _, there = applying(options.folder, patch.changes, "-F0", "-R")
            counts = [hunks, applied, there, *applying(options.folder, tree.changes(commit, context=3), "-F2"), hunks == applied]
            kind = patch.name.split("/")[0]
            sums[kind] = [a + b for a, b in zip(sums[kind], counts)]
            print("|", " | ".join([f"`{patch.name}`", *map(str, counts[:-1]), "yes" if counts[-1] else ""]), "|")
    for kind, counts in sums.items():
        print("|", " | ".join([f"all of `{kind}/`", *map(str, counts)]), "|")


def applying(folder, changes, *how):
    """How many hunks there are, and how many apply to a folder, which stays as it is."""
    done = subprocess.run(["patch", "-p1", "--dry-run", "-f", "-d", folder, *how], input=changes.encode(errors="surrogateescape"),
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    hunks = len(re.findall(r"^@@ ", changes, re.MULTILINE))
    return hunks, hunks - sum(int(count) for count in re.findall(rb"(\d+) out of \d+ hunks? (?:FAILED|ignored)", done.stdout))


def tables():
    """The tables of the page, by the names of their places."""
    made = {}
    for package in SERIES:
        patches = Series(package, None).patches()
        for kind in KINDS:
            rows = ["| patch | lines | what it does | tests | upstream |" + (" applies |" if kind == "upstream" else ""),
                    "|---|--:|---|---|---|" + ("---|" if kind == "upstream" else "")]
            total = 0
            for patch in (patch for patch in patches if patch.name.startswith(kind)):
                name = os.path.basename(patch.name)
                lines = patch.text().count("\n")
                total += lines
                row = f"| `{name}` | {lines} | {patch.subject} " \
                    f"| {', '.join(f'`{test}`' for test in patch.fields['Test'])} | {'; '.join(patch.fields['Upstream'])} |"
                if kind == "upstream":
                    needs = [f"`{os.path.basename(name)}`" for name in patch.fields["Needs"]]
                    row += f" {'after ' + ', '.join(needs) if needs else 'alone'} |"
                rows.append(row)
            rows.append(f"| {len(rows) - 2} patches | {total:,} | | | |" + (" |" if kind == "upstream" else ""))
            made[f"{package} {kind}"] = "\n".join(rows)
    return made


def table(options):
    """Writes the page's tables, or compares them."""
    page = options.page or os.path.join(ROOT, PAGE)
    old = text = read(page)
    for name, rows in tables().items():
        begin, end = f"<!-- {name} -->\n", f"<!-- /{name} -->\n"
        if text.count(begin) != 1 or text.count(end) != 1:
            raise Failure(3, f"{page}: has no place '{begin.strip()}' for a table")
        text = text[:text.index(begin) + len(begin)] + f"\n{rows}\n\n" + text[text.index(end):]
    if not options.check:
        write(page, text)
    elif text != old:
        raise Failure(1, f"{page}: has other tables than the headers make, expected what 'scripts/patches.py table' writes")
    known = {patch.name for package in SERIES for patch in Series(package, None).patches()}
    for name in re.findall(r"`((?:upstream|vorion)/[a-z0-9-]+)`", text):
        if name not in known:
            raise Failure(1, f"{page}: names {name}, which is no patch")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for action, what in ((checkout, "makes the tree"), (new, "commits a new patch"), (refresh, "writes the patches"),
                         (verify, "checks a series, or both"), (port, "counts hunks that apply to another version")):
        command = commands.add_parser(action.__name__, help=what)
        command.set_defaults(action=action)
        command.add_argument("package", choices=SERIES, nargs="?" if action is verify else None)
        if action is new:
            command.add_argument("name", metavar="KIND/NAME")
        if action is port:
            command.add_argument("folder", metavar="FOLDER", help="the other version's source")
        if action in (checkout, new, refresh):
            command.add_argument("--tree", help="the tree's folder (default: build/patches/PACKAGE)")
        if action is not new:
            command.add_argument("--series", help="another folder of patches")
        if action in (checkout, verify, port):
            command.add_argument("--source", help="another unpacked source (default: fetch-source.sh's, without our patches)")
    command = commands.add_parser("table", help="writes the tables of the page")
    command.add_argument("page", nargs="?", help=f"another page (default: {PAGE})")
    command.add_argument("--check", action="store_true", help="writes nothing, and compares")
    options = parser.parse_args()
    try:
        if options.command == "table":
            table(options)
            return
        good = True
        for package in [options.package] if options.package else SERIES:
            run = argparse.Namespace(**vars(options))
            sources = os.environ.get("VORION_SOURCES") or os.path.join(ROOT, "build", "sources")
            run.source = getattr(options, "source", None) or os.path.join(sources, ".pristine", package)
            run.tree = os.path.abspath(getattr(options, "tree", None) or os.path.join(ROOT, "build", "patches", package))
            series = Series(package, getattr(options, "series", None) and os.path.abspath(options.series))
            good = options.action(series, run) is not False and good
        sys.exit(0 if good else 1)
    except Failure as failure:
        print(f"patches: error: {failure}", file=sys.stderr)
        sys.exit(failure.code)


if __name__ == "__main__":
    main()
