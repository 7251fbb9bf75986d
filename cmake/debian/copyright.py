#!/usr/bin/env python3
"""Writes the packages' copyright file in Debian's machine-readable form: our
own sources, what LLVM, PoCL and other libraries have in our programs,
and what the site of the documents has of its theme. Their words are taken from
the files that they come with.

usage: copyright.py POCL_COPYRIGHT OUTPUT
"""
import pathlib
import re
import sys

OWN = """\
Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Vorion
Comment:
 The programs contain code of LLVM, clang and lld (vorion-clang, vorion-compiler, vorion-link,
 vorion-llc, vorion-mc, vorion-opt, vorion-objdump, libdevice.a), of PoCL (libvorion-pocl.so,
 vorion-compiler, poclcc, kernel-vorion.bc) with SLEEF and libclc, of RapidCheck
 (splat-hard-cases), and of the header-only libraries CLI11, JSON for Modern C++, GLM, nanoflann and xxHash. PoCL's paths are those of its
 source package, below pocl/. The site of the documents (html/ of vorion-doc)
 contains scripts and styles of Material for MkDocs, and lunr.js in them.

Files: *
Copyright: The Vorion authors
License: Apache-2.0-with-LLVM-exception

Files: llvm/*
Copyright: 2003-2024 University of Illinois at Urbana-Champaign and LLVM contributors
License: Apache-2.0-with-LLVM-exception
"""

# A library and the paragraph of its package that stands for all of it.
LIBRARIES = {"cli11": "libcli11-dev", "nlohmann": "nlohmann-json3-dev", "glm": "libglm-dev",
             "nanoflann": "libnanoflann-dev", "rapidcheck": "librapidcheck-dev", "xxhash": "libxxhash-dev"}
# The same of what the site is made with; where they are missing, no site is packed.
SITE = {"mkdocs-material": "mkdocs-material", "lunr": "libjs-lunr"}

EXCEPTION = """\
License: Apache-2.0-with-LLVM-exception
 Licensed under the Apache License, Version 2.0. On Debian systems, its text
 is in /usr/share/common-licenses/Apache-2.0.
 .
"""


def paragraphs(path):
    """The paragraphs of a machine-readable file, each as text."""
    text = pathlib.Path(path).read_text(encoding="utf-8")
    return [part.strip("\n") for part in re.split(r"\n(?:[ \t]*\n)+", text) if part.strip()]


def field(paragraph, name):
    found = re.search(rf"^{name}:((?:.*)(?:\n[ \t].*)*)", paragraph, re.M)
    return found.group(1) if found else None


def licence_name(paragraph):
    return field(paragraph, "License").strip().split("\n")[0]


def indented(text):
    return "".join(f" {line}\n" if line.strip() else " .\n" for line in text.strip("\n").split("\n"))


def of_package(source, folder, keep):
    """The paragraphs of files, with their paths below \\p folder, and of licences, under names of
    their own."""
    files, licences = [], {}
    for part in paragraphs(source):
        if field(part, "License") is None:
            continue
        name = licence_name(part)
        own = f"{name}-{folder}"
        renamed = re.sub(r"^License:.*", lambda _: f"License: {own}", part, count=1, flags=re.M)
        if field(part, "Files") is None:
            licences[name] = renamed
            continue
        paths = [path for path in field(part, "Files").split() if keep(path)]
        if not paths:
            continue
        # A text that stands with its files becomes a paragraph of its own.
        head, _, text = renamed.partition(f"License: {own}\n")
        if text:
            licences[name] = f"License: {own}\n{text}"
            renamed = f"{head}License: {own}"
        inside = " ".join(f"{folder}/{path}" for path in paths)
        files.append(re.sub(r"^Files:.*(?:\n[ \t].*)*", lambda _: f"Files: {inside}", renamed, flags=re.M))
    used = {licence_name(part).removesuffix(f"-{folder}") for part in files}
    return files, [text for name, text in licences.items() if name in used]


def main():
    pocl, output = sys.argv[1:]
    licence = (pathlib.Path(__file__).parents[2] / "LICENSE").read_text(encoding="utf-8")
    begin = licence.index("---- LLVM Exceptions")
    exception = licence[begin:].split("\n", 1)[1]
    files, licences = of_package(pocl, "pocl", lambda path: not path.startswith(("debian/", "examples/")))
    installed = {f: p for f, p in SITE.items() if pathlib.Path(f"/usr/share/doc/{p}/copyright").exists()}
    for folder, package in {**LIBRARIES, **installed}.items():
        more, texts = of_package(f"/usr/share/doc/{package}/copyright", folder, lambda path: path == "*")
        files += more
        licences += texts
    parts = [OWN.strip("\n"), *files, (EXCEPTION + indented(exception)).strip("\n"), *licences]
    pathlib.Path(output).write_text("\n\n".join(parts) + "\n", encoding="utf-8")


main()
