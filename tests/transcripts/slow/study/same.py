"""Says what of a study is what other commands say, and shows the place of each hard case."""
import json
import re
import subprocess

study, verify, cost, plan, once = (json.load(open(f"{name}.json")) for name in ("study", "verify", "cost", "plan", "once"))


def counted(groups):
    """The choices without what is a time, or depends on times."""
    times = ("time_ns", "times", "wall_ns")
    return [{key: choice[key] for key in choice if key not in times} for group in groups for choice in group["choices"]]


def lost(effects):
    return {effect["effect"]: effect["wrong_without"] for effect in effects}


print("hard cases:", study["hard_cases"] == verify["hard_cases"], "pieces:", study["pieces"] == verify["pieces"])
print("choices:", counted(study["costs"]) == counted(cost), "effects:", lost(study["effects"]["effects"]) == lost(plan["measured"]["effects"]))
# Of one round no more is said than that the ratio is near this one.
times = {choice["name"]: choice["time_ns"][1] for choice in once["costs"][-1]["choices"]}
low, high = map(float, re.search(r"\(?([\d.]+) to ([\d.]+) times", once["answers"][2]["sentence"]).groups())
ratio = times["scanline all"] / times["scanline planned"]
print("times:", low < high, low * 0.99 < ratio < high * 1.01)
for case in study["hard_cases"]["cases"]:
    for face in case["faces"][:1]:
        shown = subprocess.run(face["command"], shell=True, capture_output=True, text=True).stdout
        print(case["kind"], "is shown" if case["kind"] in shown else f"is not shown by {face['command']}")
