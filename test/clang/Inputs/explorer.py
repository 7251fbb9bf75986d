"""What a page of vorion-clang --explorer holds: usage explorer.py timed PAGE PROFILE | unit PAGE | narrow PAGE | follow KERNEL"""
import collections
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "Inputs"))
import browser


def data_of(page):
    text = re.search(r'id="data">(.*?)</script>', open(page).read(), re.S).group(1)
    return json.loads(text.replace("<\\/", "</"))


def timed(page, profile):
    """The cycles of each line are those of the simulator's own listing."""
    data = data_of(page)
    mine = collections.Counter()
    for entry in data["assembly"]:
        mine[entry.get("line", 0)] += entry.get("cost", 0)
    listed, columns = {}, 0
    for words in map(str.split, open(profile)):
        if words[:2] == ["cycles", "%"]:
            columns = len(words)
        elif columns and len(words) > columns and words[0].isdigit() and re.fullmatch(r"\d{1,6}", words[columns]):
            listed[int(words[columns])] = int(words[0])
    assert listed == {line: cost for line, cost in mine.items() if line and cost}, (listed, mine)
    assert data["profile"]["total"] >= sum(mine.values()) > 0
    print("lines as in the profile:", len(listed))
    print("IR of lines", *sorted({entry["line"] for entry in data["ir"]} - {0}))


def unit(page):
    print(data_of(page)["profile"]["unit"])


def narrow(page):
    with tempfile.TemporaryDirectory() as scratch:
        shown = browser.Browser(scratch, reaches=())
        shown.shape(400, 900)
        shown.open("file://" + os.path.abspath(page))
        shown.wait("document.readyState === 'complete' && document.querySelector('#ir td') !== null")
        print("as wide as the window:", shown.value("document.documentElement.scrollWidth <= innerWidth"))
        shown.close()


def follow(kernel):
    tool = subprocess.Popen(["vorion-clang", "--explorer", kernel, "-DTIMES=3"], stdout=subprocess.PIPE,
                            stderr=subprocess.DEVNULL, text=True)
    print(tool.stdout.readline(), end="")
    script = kernel.replace(".cl", ".html.js")

    def after(change):
        """The data once the kernel is what `change` makes of it."""
        def newest():
            return json.loads(open(script).read().removeprefix("explorerData(").removesuffix(");\n"))
        before = newest()
        text = open(kernel).read()
        open(kernel + ".new", "w").write(change(text))
        os.replace(kernel + ".new", kernel)
        for _ in range(200):
            if newest()["serial"] != before["serial"]:
                return before, newest()
            time.sleep(0.05)
        raise AssertionError("no new page")
    _, now = after(lambda text: text.replace("TIMES +", "TIMES * 2 +"))
    print("after the change:", re.search(r"TIMES \* 2", "\n".join(now["source"]))[0])
    before, now = after(lambda text: text.replace("TIMES *", "TIME *"))
    assert now["assembly"] == before["assembly"]
    print("after a fault:", len(before["source"]) - len(now["source"]), "lines of source less,", now["log"].split()[0])
    tool.send_signal(signal.SIGINT)
    tool.wait()
    print("nothing left:", *(name for name in os.listdir(".") if name.startswith("k.html")))


globals()[sys.argv[1]](*sys.argv[2:])
