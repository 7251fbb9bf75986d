"""The verdicts of the page before draws, and why one may be another now: what the list of changed verdicts compares with."""

HEAD = """The page before had version 3 of the clock, one machine without uncertainty, and these words: *holds if*, for some views; *depends on the
core*; *not comparable*, for every rate. Those words are gone: a share of draws takes their place."""
_RATE = "a rate is taken at the paper's size now, 1 M Gaussians on 980x545, by the counts of each stage"
_BOTH = "the two baselines, pipelines and cores were rows; they are drawn now"
_SMALL = "of a rate, iterations with fewer than half a million Gaussians decide nothing"
_DRAWN = "machines and views are drawn"
_CHIP = "estimates are given what is published of the chip"
_VIEWS = "*holds if* is gone: the share of the views decides"

# By key of a claim: the verdict, why it may be another, and how the page had it if that was in more words.
VERDICTS = {
    "fps": ("not comparable", _RATE), "slow_fps": ("not comparable", _RATE), "figure_fps": ("not comparable", _RATE),
    "scaled_fps": ("not comparable", _RATE), "mcycles": ("not comparable", _RATE), "fixed_ms": ("not comparable", _RATE),
    "gain": ("does not hold", _BOTH, "does not hold serial, depends on the core overlapped"),
    "clocks": ("holds if the view is any on `prototype`, or 5 of 9 on `prototype-forwarding`", "the link, which keeps its rate, is drawn"),
    "blend_share": ("holds", "the kernels that one compares with are drawn, and so is the machine"),
    "times": ("depends on the core with our fastest kernels; holds on 12 of 15 views with the official algorithm", _BOTH),
    "blending": ("depends on the core with our fastest kernels; holds with the official algorithm", _BOTH),
    "joint": ("3 of 120 combinations", _BOTH),
    "lanes": ("holds if the view is one of 9 of 15", _VIEWS), "linear": ("does not hold", "the picture's size and the machine are drawn"),
    "memory": ("holds if the view is one of 3", "caches, core and DRAM's addresses are drawn"),
    "invocations": ("holds on 2 to 31 of 39 views, by size and support", "size and support are drawn"),
    "occlusion": ("holds if the view is one of 39", _VIEWS),
    "quarter_gain": ("does not hold", _DRAWN), "quarter": ("does not hold", _DRAWN), "ztiles": ("does not hold", _DRAWN), "pixel_unit": ("holds", _DRAWN),
    "same": ("holds if lists are not stopped early", "views with and without a stop are counted alike"),
    "accumulation": ("holds on 5 of 8 views", _VIEWS), "forward": ("holds", _DRAWN), "train_times": ("does not hold", "ways to sum gradients are pooled"),
    "back_times": ("from holds, over atomics, to does not hold", "ways to sum gradients are pooled"),
    "its": ("not comparable", _SMALL), "slow_its": ("not comparable", _SMALL), "figure_its": ("not comparable", _SMALL),
    "scaled_its": ("not comparable", _SMALL),
    "seconds": ("does not hold", _SMALL),
    "under 600 mW at 530 MHz, mean of a frame": ("open", _CHIP, "does not hold on 1, open on 17 of 18"),
    "the same, of the stage with the most power": ("open", _CHIP, "does not hold on 14, open on 4 of 18"),
    "under 600 mW at 100 MHz, mean of a frame": ("holds", _CHIP),
    "cores and rasterizers take 1.6 mm2": ("does not hold", _CHIP),
}
