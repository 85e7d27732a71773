#!/usr/bin/env python3
"""Flies the project's campaigns and holds them to their bars: campaigns/run.py --vigil PROGRAM [--share N] [NAME ...]

What each campaign flies and what must come of it is the table CAMPAIGNS; docs/campaign.md says why. With --share 50 each
flies a fiftieth of its runs, the first ones. Prints a table, writes it to OUT/table.md, and exits 1 where a bar is missed.
An interrupted campaign goes on where it was when it is started again with the same --out.
"""

import argparse
import dataclasses
import json
import math
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FAILURES = "faults=3:land,fail,lose_tracking,hold"
WITH_SILENCE = FAILURES + ",lose_link"  # where a failsafe ends the flight of one that hears nothing


@dataclasses.dataclass(frozen=True)
class Campaign:
    """One campaign: `vigil campaign missions/MISSION --runs RUNS --vary VARY --set SETTINGS`, and its bar."""

    name: str
    mission: str
    runs: int
    vary: tuple
    settings: tuple = ()
    bar: str = "safe"  # safe: no violation; solved:P: and at least P % with everybody at the goal; broken: of the paper


CAMPAIGNS = (
    Campaign("crowd", "crowd.yaml", 1000, ("starts",), bar="safe"),
    Campaign(
        "crowd-paper",
        "crowd.yaml",
        1000,
        ("starts",),
        ("safety.barrier=paper", "safety.lag_s=0", "safety.margin_m=0"),
        bar="broken",
    ),
    Campaign("crowd-lost", "crowd.yaml", 500, ("starts", "faults=10:lose_tracking")),
    Campaign("swap-8", "crossings/swap_8.yaml", 100, ("seed",), bar="solved:99"),
    Campaign("swap-16", "crossings/swap_16.yaml", 100, ("seed",), bar="solved:99"),
    Campaign("places-10", "crossings/places_10.yaml", 100, ("starts",), bar="solved:91"),
    Campaign("places-30", "crossings/places_30.yaml", 100, ("starts",), bar="solved:77"),
    *(
        Campaign(
            f"{vehicle}-{drones}",
            f"vehicles/{vehicle}.yaml",
            1000,
            ("starts", "targets", incidents),
            (f"drone_grid.count={drones}",),
        )
        for vehicle, incidents in (
            ("ideal", FAILURES),
            ("first_order_lag", FAILURES),
            ("crazyflie", WITH_SILENCE),
            ("arducopter", WITH_SILENCE),
            ("px4", WITH_SILENCE),
        )
        for drones in (3, 10)
    ),
    # Four hours with wind, batteries of any age and a station that fails, at any time.
    Campaign(
        "charging",
        "wildfire_day.yaml",
        1000,
        (
            "seed",
            "simulation.battery.health=0.7..1",
            "simulation.wind.gust_m_s=0..1.5",
            "simulation.wind.mean_m_s=[0,0]|[4,1]|[-4,2]|[0,-5]|[3,-3]",
            "simulation.events[0].at_s=100..14000",
            "simulation.events[0].station=west|east",
        ),
        ("simulation.duration_s=14400", "simulation.events=[{at_s: 5000, do: fail_station, station: west}]"),
    ),
)


def fly(campaign, vigil, out, runs):
    """Flies what is missing of the campaign; its summary and its runs' summaries."""
    folder = out / campaign.name
    command = [str(vigil), "campaign", f"missions/{campaign.mission}", "--runs", str(runs), "--out", str(folder)]
    command += ["--vary", *campaign.vary]
    if campaign.settings:
        command += ["--set", *campaign.settings]
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.DEVNULL, check=False)
    if done.returncode not in (0, 1):  # 1: a run broke a rule
        sys.exit(f"{' '.join(command)}: exit code {done.returncode}")
    summary = json.loads((folder / "summary.json").read_text())
    with open(folder / "runs.jsonl", encoding="utf-8") as lines:
        return summary, [json.loads(line)["summary"] for line in lines]


def goals_per_drone_minute(runs):
    """The mean of the runs that have goals; None without any."""
    figures = [run["goals_per_drone_minute"] for run in runs if "goals_per_drone_minute" in run]
    return statistics.fmean(figures) if figures else None


def solved(runs):
    """How many runs ended with everybody at the goal at once."""
    return sum(run.get("goals_all_there_s") is not None for run in runs)


def faults_of(campaign, summary, runs):
    """What of the campaign's bar was missed, in words."""
    broken = summary["violations"]["runs"]
    if campaign.bar == "broken":
        if broken == 0:
            yield "no run broke a rule: the campaign proves nothing"
        return
    if broken > 0:
        yield f"{broken} runs broke a rule: {summary['violations']}"
    if campaign.bar.startswith("solved:"):
        share = int(campaign.bar.split(":")[1])
        needed = math.ceil(share * len(runs) / 100)
        if solved(runs) < needed:
            yield f"{solved(runs)} of {len(runs)} solved, {needed} needed"


def row(campaign, summary, runs):
    """The campaign's line of the table."""
    figures = summary["figures"]

    def worst(key):
        return f"{figures[key]['worst']:.3f}" if key in figures else "–"

    goals = goals_per_drone_minute(runs)
    cells = [
        campaign.name,
        str(len(runs)),
        str(summary["violations"]["runs"]),
        worst("min_separation_airborne_m"),
        worst("min_wall_distance_m"),
        worst("min_no_fly_distance_m"),
        f"{figures['metric_percent_last']['median']:.2f}" if goals is None else "–",
        "–" if goals is None or campaign.bar.startswith("solved") else f"{goals:.2f}",
        f"{solved(runs)}" if campaign.bar.startswith("solved") else "–",
    ]
    return "| " + " | ".join(cells) + " |"


HEAD = (
    "| campaign | runs | runs with a violation | least separation m | least wall m | least no-fly m | metric % (median) "
    "| goals/drone/min | all arrived |"
)


def crowd_fault(results):
    """The crowd must be four times as quick as with the paper's barrier."""
    if not {"crowd", "crowd-paper"} <= results.keys():
        return None
    ratio = goals_per_drone_minute(results["crowd"][1]) / goals_per_drone_minute(results["crowd-paper"][1])
    print(f"crowd: {ratio:.2f} times the goals of the paper's barrier")
    return f"crowd: {ratio:.2f} times the goals of the paper's barrier, 4 needed" if ratio < 4.0 else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="of the table; default all")
    parser.add_argument("--vigil", required=True, type=pathlib.Path, help="the program")
    parser.add_argument("--share", type=int, default=1, metavar="N", help="fly an N-th of the runs")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out" / "campaigns", help="default out/campaigns")
    arguments = parser.parse_args()
    known = {campaign.name for campaign in CAMPAIGNS}
    if unknown := set(arguments.names) - known:
        parser.error(f"unknown: {', '.join(sorted(unknown))}; there are {', '.join(sorted(known))}")
    if arguments.share < 1:
        parser.error("--share must be at least 1")

    arguments.out.mkdir(parents=True, exist_ok=True)
    results, faults, lines = {}, [], [HEAD, "|" + " --- |" * (HEAD.count("|") - 1)]
    for campaign in CAMPAIGNS:
        if arguments.names and campaign.name not in arguments.names:
            continue
        runs = math.ceil(campaign.runs / arguments.share)
        results[campaign.name] = fly(campaign, arguments.vigil.resolve(), arguments.out.resolve(), runs)
        lines.append(row(campaign, *results[campaign.name]))
        print(lines[-1], flush=True)
        faults += [f"{campaign.name}: {fault}" for fault in faults_of(campaign, *results[campaign.name])]
    if fault := crowd_fault(results):
        faults.append(fault)
    (arguments.out / "table.md").write_text("\n".join(lines) + "\n")
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
