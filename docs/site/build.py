#!/usr/bin/env python3
"""Builds the documents as a site that needs no server and no network.

usage: build.py SITE [TOOLS]    (scripts/site.sh calls it)
SITE is made anew; beside it SITE-pages holds what the site is made of. TOOLS is the folder of the tools, which give the
pages of their options; without it these pages are missing.
Exit codes: 0 done, 1 a page has an error, 2 usage.
"""

import os
import shutil
import subprocess
import sys

import reference

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


# Folders of the repository that hold no pages.
NO_PAGES = {"build", "shared"}


def stage(root, pages):
    """Shows the documents of the repository in the folder pages, under the paths that they have, and nothing else."""
    shutil.rmtree(pages, ignore_errors=True)
    for folder, folders, files in os.walk(root):
        if folder == root:
            folders[:] = sorted(set(folders) - NO_PAGES)
        # The inputs of tests are no documents.
        folders[:] = [f for f in folders if f[0] not in "._" and f != "Inputs"]
        for name in files:
            path = os.path.relpath(os.path.join(folder, name), root)
            if name.endswith(".md") or path in ("LICENSE", "CITATION.cff") or path.startswith("docs/images/"):
                copy = os.path.join(pages, path)
                os.makedirs(os.path.dirname(copy), exist_ok=True)
                shutil.copyfile(os.path.join(root, path), copy)


def main():
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    site = os.path.abspath(sys.argv[1])
    stage(ROOT, site + "-pages")
    reference.write(ROOT, sys.argv[2] if len(sys.argv) == 3 else "", site + "-pages")
    told = dict(os.environ, VORION_SITE=site, VORION_SITE_PAGES=site + "-pages")
    config = os.path.join(ROOT, "docs", "site", "mkdocs.yml")
    done = subprocess.run(["mkdocs", "build", "--strict", "-f", config], env=told, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    if not done.returncode:
        return 0
    # --quiet would hide the warnings, too, which --strict makes errors.
    print("\n".join(line for line in done.stdout.splitlines() if not line.startswith("INFO")), file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
