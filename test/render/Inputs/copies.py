"""Checks what reports of a machine with DMA engines say of copies: APART.json OVERLAPPED.json."""
import json
import sys

apart, beside = (json.load(open(f)) for f in sys.argv[1:])
PICTURE_BYTES = 16 * 150 * 100
for report in apart, beside:
    time = report["time"]
    # Nothing is beside the cycles.
    assert abs(time["total_ms"] - time["kernel_ms"]) < 1e-6 * time["total_ms"], (time["total_ms"], time["kernel_ms"])
    assert time["sum"]["host"]["copy_mbps"] == 0
    copied = sum(engine["bytes"] for engine in time["sum"]["dma_engines"])
    # The first picture is on the host before the last one is drawn.
    assert copied >= PICTURE_BYTES, copied
    assert time["sum"]["command_processors"][0]["commands"] > 30
waited = lambda r: sum(core["launch"] for core in r["time"]["sum"]["cores"])
assert waited(beside) < waited(apart), (waited(beside), waited(apart))
assert "command processor and DMA" in json.dumps(beside["energy"])
