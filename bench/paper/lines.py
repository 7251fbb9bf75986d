"""The ten lines of the page, and where it falls short of the paper's size: sentences from figures."""

import collections
import json

import benchmark_set
import changes
import claims
import hypercube
import joint
import machines
import priors
from verdicts import HOLDS, NOT, OPEN, interval_text, place
from writing import paragraph

# Factors by which the draws are split, with what a level is called.
SPLIT = {"method.baseline": {"fastest": "our fastest kernels", "official": "the official algorithm"},
         "machine.core": {core: f"`{core}`" for core in ("vortex-5stage", "forwarding")},
         "method.pipeline": {"serial": "serial", "overlapped": "overlapped"},
         "core.interleaved_stacks": {"0": "a lane's stack in a row", "1": "interleaved stacks"}}


def splits(data):
    """By claim and factor, [held, draws] by level."""
    found = {}
    for claim, _ in claims.of_draws(data):
        for factor, levels in SPLIT.items():
            for level in levels:
                values = [row["figures"][claim.key] for row in data["rows"] if claim.key in row["figures"] and str(row["factors"][factor]) == level]
                found.setdefault(claim.key, {}).setdefault(factor, {})[level] = [sum(map(claim.good, values)), len(values)]
    return found


def followed(data, key):
    """(rank correlation, factor) of the factors with which a figure correlates beyond chance, strongest first. Choices that are words
    rank by their order in the table."""
    rows = [row for row in data["rows"] if key in row["figures"]]
    if len(rows) < 3:
        return []
    found = []
    for name in rows[0]["factors"]:
        values = [row["factors"][name] for row in rows]
        if isinstance(values[0], str):
            domain = priors.BY_KEY[tuple(name.split(".", 1))].domain
            values = [domain.index(value) for value in values]
        found.append((hypercube.rank_correlation(values, [row["figures"][key] for row in rows]), name))
    return sorted((f for f in found if hypercube.is_beyond_chance(f[0], len(rows))), key=lambda f: -abs(f[0]))


def _bytes(names):
    """Hashes of scenes of the benchmark set as they are now."""
    with open(benchmark_set.FILE, encoding="utf-8") as file:
        known = json.load(file)
    return {name: known[name]["scene_fnv1a64"] for name in names if name in known}


def facts(measured):
    """What the lines say beside the claims, of each section that was measured."""
    found = {}
    if data := measured.get("draws"):
        found["draws"] = {"count": len(data["rows"]), "targets": data["targets"], "splits": splits(data), "off": data["off"],
                          "follows": {key: followed(data, key)[:3] for key in ("fps", "times", "gain")},
                          "not_blending": interval_text([row["figures"]["not_blending"] for row in data["rows"]], " %") if data["rows"] else "",
                          "gaussians": sorted({row["gaussians"] for row in data["rows"]}), "scenes": sorted({row["scene"] for row in data["rows"]})}
        found["draws"]["bytes"] = _bytes((*found["draws"]["scenes"], *data["targets"]))
    if rows := [row for row in measured.get("rates", {}).get("rows", ()) if row["machine"] == machines.PROTOTYPES[0]]:
        row = min(rows, key=lambda row: row["serial"]["fps"])
        found["largest"] = {"place": place(row), "ratio": row["serial"]["fps"] / joint.FPS, "scaled": row["serial"]["scaled_fps"] / 152,
                            "not_blending": 100 * (1 - row["blend_cycles"] / row["frame_cycles"])}
    if data := measured.get("changes"):
        sizes = [row["size"] for row in data["rows"] if row["gain"] >= changes.NEAR_LINEAR and row["change"] == changes.FOR_SCALING[0][0]]
        slow = [row for row in data["power"] if changes.energy.against(row["watts"], changes.energy.PAPER_WATTS) == HOLDS and row["change"] == changes.FOR_POWER[0][0]]
        found["changes"] = {"sizes": list(dict.fromkeys(sizes)), "clock": max((row["clock"] for row in slow), default=0)}
    return found


def _named(rows, said):
    return "; ".join(row["short"] for row in rows if row["verdict"] == said)


def _split(facts_of, key, factor):
    """In how many draws of each level a claim holds."""
    of = facts_of["draws"]["splits"].get(key, {}).get(factor, {})
    return ", ".join(f"{held} of {count} with {SPLIT[factor][level]}" for level, (held, count) in of.items() if count)


def _follows(facts_of, key):
    return ", ".join(f"`{name}` ({value:+.2f})" for value, name in facts_of["draws"]["follows"].get(key, ()))


def ten(rows, facts_of):
    """What holds, what does not, why, and what would make it hold."""
    by_key = {row["key"]: row for row in rows}
    count = collections.Counter(row["verdict"] for row in rows)
    drawn = sum(row["section"] == "draws" for row in rows)
    of_draws = f"; {drawn} of the {len(rows)} are judged by their share of {facts_of['draws']['count']} draws of what the paper leaves open" if "draws" in facts_of else ""
    said = [f"**{count[HOLDS]} of {len(rows)} claims hold, {count[NOT]} do not, {count[OPEN]} are open**{of_draws}."]
    said += [f"**{said_of[0].upper()}{said_of[1:]}**: {named}." for said_of in (HOLDS, NOT, OPEN) if (named := _named(rows, said_of))]
    if "fps" in by_key and "draws" in facts_of:
        size = "At the paper's size" if facts_of["draws"]["targets"] else "Of the scenes that were drawn"
        said.append(f"**Rates**: {size} a prototype has {by_key['fps']['ours']} frames/s for 19: {facts_of['draws']['not_blending']} of a frame is not blending, "
                    "which no rasterizer makes faster.")
        if follows := _follows(facts_of, "fps"):
            said.append(f"**What would make rates hold**: they follow most {follows} (rank correlation); fewer Gaussians or a faster sort would do it, too.")
    if "times" in by_key and "draws" in facts_of and (split := _split(facts_of, "times", "method.baseline")):
        said.append(f"**The factor over kernels** depends on the kernels: it holds in {split}; of blending alone in {_split(facts_of, 'blending', 'method.baseline')}.")
    if "linear" in by_key:
        made = f" It is near-linear at {facts_of['changes']['sizes'][0]} and above on some scenes." if facts_of.get("changes", {}).get("sizes") else ""
        said.append(f"**Scaling**: 16 rasterizers blend {by_key['linear']['ours']} as fast as one, because a tile is the smallest job and the longest list decides.{made}")
    if "quarter" in by_key:
        said.append(f"**The pixel unit**: the last quarter of the lists holds {by_key['quarter']['ours']} of the rasterizers' time, not 45.2 %, because tiles end when "
                    "their pixels are opaque; only lists that are blended to their end would have it.")
    if power := [row for row in rows if row["group"] == "power and area"]:
        slower = f" At {facts_of['changes']['clock']} MHz the power holds." if facts_of.get("changes", {}).get("clock") else ""
        said.append("**Power and area** are estimates: " + "; ".join(f"{row['short']} {row['verdict']}" for row in power) + f".{slower}")
    return [f"- {paragraph(line)}" for line in said[:10]]


def short_of_size(facts_of):
    """Where the measurements are smaller than the paper's."""
    out = ["## Where this falls short of the paper's size", ""]
    if largest := facts_of.get("largest"):
        out += [f"- The slowest frame that was measured whole, {largest['place']}, has {largest['ratio']:.2f} of the paper's rate on `{machines.PROTOTYPES[0]}` and "
                f"{largest['scaled']:.2f} on `{machines.SCALED[machines.PROTOTYPES[0]]}`; {largest['not_blending']:.0f} % of it is not blending."]
    if draws := facts_of.get("draws"):
        of = f"{draws['gaussians'][0]:,} to {draws['gaussians'][-1]:,}" if len(draws["gaussians"]) > 1 else ", ".join(map(str, draws["gaussians"]))
        small = ("; the command without options draws larger ones, which take hours" if draws["gaussians"][-1] < claims.LARGE else "")
        out += [f"- The frames of the draws have {of} Gaussians ({', '.join(draws['scenes'])}){small}."]
        if draws["targets"]:
            out += [f"- Their rates are scaled, stage by stage, to {', '.join(draws['targets'])} by counts; corrected by whole frames of that size this is within a factor "
                    f"of {draws['off']:.2f}, which is drawn, too ([check](paper/draws.md#how-far-a-sample-is-off))."]
        drawn = draws.get("bytes", {})
        if other := [name for name, now in _bytes(drawn).items() if now != drawn[name]]:
            out += [f"- Since the draws {', '.join(other)} {'was' if len(other) == 1 else 'were'} fitted again ([the match](tables/benchmark-set.md#the-match)): the next draws are of other bytes."]
    out += ["- Kernels alone are measured on crops, and their blending is scaled by blends.",
            "- Training was measured on the captures that [its page](paper/training.md) names, and is not drawn."]
    return [*out, ""]
