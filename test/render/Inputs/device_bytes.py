"""Checks that a picture alone and the first of a sequence say the same of the device's memory: ONE.json SEVERAL.json."""
import json
import sys

one, several = (json.load(open(f)) for f in sys.argv[1:])
first, second = several["pictures"]
assert first["view"] == one["view"], first["view"]
counts = [r["counts"]["device_bytes"] for r in (one, first, second)]
assert counts[0] == counts[1], counts
# The most that was there at once: buffers of the picture before are gone, or used again.
assert counts[1] <= counts[2] < 2 * counts[1], counts
assert counts[0] > 16 * one["resolution"][0] * one["resolution"][1], counts
