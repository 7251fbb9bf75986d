#!/usr/bin/env python3
"""Counts the tests of JUnit files, names the failed, groups the skipped by
reason, and prints `N passed, N failed, N skipped` last.

usage: count-tests.py RESULT.xml...
"""

import collections
import os
import re
import sys
import xml.etree.ElementTree as ET


def reason(case, skipped):
    text = (skipped.get("message") or skipped.text or "").strip()
    output = case.findtext("system-out") or ""
    # GoogleTest prints the text of GTEST_SKIP() on the line after the place.
    found = re.search(r"Skipped\n(.+)", output)
    return (found.group(1) if found else text or "no reason given").strip()


def main(files):
    passed = failed = 0
    skips = collections.Counter()
    for file in files:
        suite = os.path.splitext(os.path.basename(file))[0]
        for case in ET.parse(file).getroot().iter("testcase"):
            name = f"{suite}: {case.get('classname', '')} {case.get('name')}"
            skipped = case.find("skipped")
            if skipped is not None or case.get("status") in ("disabled", "notrun"):
                skips[reason(case, skipped) if skipped is not None else "not run"] += 1
            elif case.find("failure") is not None or case.find("error") is not None or case.get("status") == "fail":
                failed += 1
                print(f"FAILED {name}")
            else:
                passed += 1
    for text, count in sorted(skips.items()):
        print(f"skipped {count}: {text}")
    print(f"{passed} passed, {failed} failed, {sum(skips.values())} skipped")


if __name__ == "__main__":
    main(sys.argv[1:])
