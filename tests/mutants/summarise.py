#!/usr/bin/env python3
"""Sums up what cargo-mutants has left in DIR (see `run`) in reference/reliability/mutants.json. What stands there of areas
of which nothing is in DIR stays.

    tests/mutants/summarise.py DIR

Fails, naming the mutant, if one has survived for no reason that survivors.toml gives, or if a reason there belongs to
no survivor.
"""

import collections
import datetime
import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path, PurePosixPath

ROOT = Path(__file__).resolve().parents[2]
HERE = ROOT / "tests" / "mutants"
RESULT = ROOT / "reference" / "reliability" / "mutants.json"
NAMES = {"CaughtMutant": "caught", "MissedMutant": "survived", "Timeout": "timeout", "Unviable": "unviable"}


def outcomes(directory):
    """What became of each mutant, by its full name, and the version of cargo-mutants; what was caught once is caught, else
    the last word counts. cargo-mutants also tries deleted fields that it was not asked for, with whatever tests it is given.
    """
    results = [json.loads(path.read_text()) for path in directory.glob("*/mutants.out/outcomes.json")]
    results.sort(key=lambda result: result["start_time"])
    last = {}
    for result in results:
        for outcome in result["outcomes"]:
            if outcome["scenario"] == "Baseline":
                assert outcome["summary"] == "Success", "the tests fail without a mutant"
            else:
                name = outcome["scenario"]["Mutant"]["name"]
                if last.get(name) != "caught":
                    last[name] = NAMES[outcome["summary"]]
    return last, results[-1]["cargo_mutants_version"]


def all_mutants(areas):
    """All mutants of the files of the areas, by their full names."""
    files = [argument for area in areas for file in area["files"] for argument in ("--file", file)]
    command = ["cargo", "mutants", "--workspace", "--no-config", "--list", *files]
    listed = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True)
    return listed.stdout.splitlines()


def without_place(name):
    """A name that outlives moved lines: `file: description`."""
    return re.sub(r"^([^:]+):\d+:\d+: ", r"\1: ", name)


def commit_path(area, directory):
    """The file in which `run` notes the sources that were mutated."""
    return directory / f"{area['name'].replace(' ', '-')}-0-first" / "commit"


def belongs(name, area):
    """Whether a mutant is in a file of `area`."""
    return any(PurePosixPath(name.split(":")[0]).match(file) for file in area["files"])


def row(area, mutants, last, directory):
    """Counts of one area."""
    own = [name for name in mutants if belongs(name, area)]
    count = collections.Counter(last.get(name, "not_run") for name in own)
    kinds = ["caught", "timeout", "unviable", "survived", "not_run"]
    sources = commit_path(area, directory).read_text().strip()
    about = {"area": area["name"], "files": area["files"], "commit": sources, "mutants": len(own)}
    return about | {kind: count[kind] for kind in kinds}


def judge(survivors, reasons, not_run):
    """Complaints about survivors without a reason, and reasons without a survivor among those that were run."""
    counted = {entry["mutant"]: entry.get("count", 1) for entry in reasons}
    for name, count in survivors.items():
        if counted.get(name, 0) != count:
            yield f"{name}: {count} survived, survivors.toml gives a reason for {counted.get(name, 0)}"
    for name in counted.keys() - survivors.keys() - not_run:
        yield f"{name}: survivors.toml gives a reason, but it does not survive"


def main():
    directory = Path(sys.argv[1])
    last, version = outcomes(directory)
    areas = tomllib.loads((HERE / "areas.toml").read_text())["area"]
    tried = [area for area in areas if commit_path(area, directory).exists()]
    before = json.loads(RESULT.read_text())
    kept = {row["area"]: row for row in before["areas"]}
    mutants = all_mutants(tried)
    is_tried = lambda entry: any(belongs(entry["mutant"], area) for area in tried)
    reasons = tomllib.loads((HERE / "survivors.toml").read_text())["survivor"]
    kept_areas = [area for area in areas if area not in tried]
    untried = [
        entry for entry in before["survivors"] if any(belongs(entry["mutant"], area) for area in kept_areas)
    ]
    reasons = [entry for entry in reasons if is_tried(entry)]
    survivors = collections.Counter(
        without_place(name) for name in mutants if last.get(name) == "survived"
    )
    summary = {
        "command": "tests/mutants/run",
        "date": datetime.datetime.now(datetime.timezone.utc).date().isoformat(),
        "cargo_mutants_version": version,
        "not_run": collections.Counter(name.split(":")[0] for name in mutants if name not in last),
        "areas": [row(area, mutants, last, directory) if area in tried else kept[area["name"]] for area in areas],
        "survivors": [entry for entry in reasons if entry["mutant"] in survivors] + untried,
    }
    RESULT.parent.mkdir(parents=True, exist_ok=True)
    RESULT.write_text(json.dumps(summary, indent=2, ensure_ascii=False) + "\n")
    for line in summary["areas"]:
        print(", ".join(f"{key} {value}" for key, value in line.items() if key != "files"))
    not_run = {without_place(name) for name in mutants if name not in last}
    complaints = sorted(judge(survivors, reasons, not_run))
    if complaints:
        sys.exit("\n".join(complaints))


if __name__ == "__main__":
    main()
