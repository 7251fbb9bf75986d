#!/usr/bin/env python3
"""Counts the tests of JUnit files, names the failed with the end of their
output, groups the skipped by reason, and prints `N passed, N failed, N skipped`
last.

usage: count-tests.py [--skips REGEX] [--times] RESULT.xml...
--times: also the seconds that the tests of each layer took one by one, those
that took most first. A layer is a folder of test/, or a component.
--skips: what may be skipped, matched against the start of `file: reason`,
where file is RESULT; other skipped tests count as failed.
Exit codes: 0 none failed, 1 some did.
"""

import argparse
import collections
import os
import re
import sys
import xml.etree.ElementTree as ET


def reason(case, skipped):
    text = (skipped.get("message") or skipped.text or "").strip() if skipped is not None else "not run"
    if text == "Unable to find executable":  # CTest's words
        return "programs that are not built"
    output = case.findtext("system-out") or ""
    # GoogleTest prints the text of GTEST_SKIP() on the line after the place.
    found = re.search(r"Skipped\n(.+)", output)
    why = (found.group(1) if found else text or "no reason given").strip()
    return re.sub(r"(\.\./shared/data)\S*", r"\1", why)  # one group, not one a file


def layer(suite, case):
    """lit's tests are called vorion.LAYER, a program's LAYER.Unit.What or LAYER_Unit_test."""
    name = case.get("classname") or case.get("name")
    parts = re.split(r"[._]", name.removeprefix("vorion."))
    return f"{suite}: {parts[0]}"


def excerpt(case, most=12):
    """The last command of a test of lit, the last failure of a GoogleTest, or the last lines of another test."""
    element = case.find("failure")
    text = (element.text if element is not None else "") or case.findtext("system-out") or ""
    lines = [line for line in text.splitlines() if line.strip()]
    begins = [i for i, line in enumerate(lines) if line.startswith("# RUN: ") or line.endswith(": Failure")]
    return lines[begins[-1] if begins else -most:][:most]


def print_times(seconds, counts):
    print("seconds of each layer's tests, one by one:")
    for name, taken in sorted(seconds.items(), key=lambda each: -each[1]):
        print(f"{taken:8.0f}  {name} ({counts[name]} tests)")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--skips", default="")
    parser.add_argument("--times", action="store_true")
    parser.add_argument("files", nargs="+")
    args = parser.parse_args()
    passed = failed = 0
    skips, seconds, counts = collections.Counter(), collections.Counter(), collections.Counter()
    for file in args.files:
        suite = os.path.splitext(os.path.basename(file))[0]
        for case in ET.parse(file).getroot().iter("testcase"):
            name = f"{suite}: {case.get('classname', '')} {case.get('name')}"
            counts[layer(suite, case)] += 1
            seconds[layer(suite, case)] += float(case.get("time") or 0)
            skipped = case.find("skipped")
            if skipped is not None or case.get("status") in ("disabled", "notrun"):
                why = f"{suite}: {reason(case, skipped)}"
                if re.match(args.skips, why):
                    skips[why] += 1
                else:
                    failed += 1
                    print(f"FAILED {name}: skipped, and should not be ({why})")
            elif case.find("failure") is not None or case.find("error") is not None or case.get("status") == "fail":
                failed += 1
                print(f"FAILED {name}", *excerpt(case), sep="\n    ")
            else:
                passed += 1
    if args.times:
        print_times(seconds, counts)
    for text, count in sorted(skips.items()):
        print(f"skipped {count}: {text}")
    print(f"{passed} passed, {failed} failed, {sum(skips.values())} skipped")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
