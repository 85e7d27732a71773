#!/usr/bin/env python3
"""Runs the benchmarks of computation and holds them to their bars: bench/run.py [--build DIR] [--out DIR]

Every benchmark first verifies its answers, then times them. Prints a table with median, 99th percentile, what each figure is
held against and the ratio, with what was built, by what, and on what it ran; writes the same as OUT/bench.json and
OUT/table.md, and OUT/scaling.dat for docs/figures/scaling.gp. Exits 1 where an answer is wrong or a bar is missed.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
REPETITIONS = 15


def run(program, pattern, *options):
    """The context and the runs of the benchmarks whose names match."""
    command = [program, f"--benchmark_filter={pattern}", "--benchmark_format=json", *options]
    print(f"{program.name}: {pattern} ...", file=sys.stderr, flush=True)
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{program}: exit code {done.returncode}\n{done.stderr}")
    report = json.loads(done.stdout)
    runs = [one for one in report["benchmarks"] if one.get("run_type") != "aggregate"]
    wrong = [f"{one['name']}: {one['error_message']}" for one in runs if one.get("error_occurred")]
    if wrong:
        sys.exit("wrong answers: " + "; ".join(wrong))
    return report["context"], runs


def percentile(samples, share):
    ordered = sorted(samples)
    return ordered[int(share * (len(ordered) - 1))]


def repeated(runs, figure):
    """Median and 99th percentile of a figure over the repetitions, by the benchmark's name."""
    samples = {}
    for one in runs:
        samples.setdefault(one["run_name"], []).append(figure(one))
    return {name: (statistics.median(values), percentile(values, 0.99)) for name, values in samples.items()}


class Table:
    """Lines of figures, each held against something."""

    def __init__(self):
        self.lines = []

    def add(self, what, unit, median, p99, against, reference, bar, judged=None):
        """`judged`: what must not exceed the bar; by default the median's ratio to the reference."""
        ratio = median / reference if reference else None
        value = judged if judged is not None else ratio
        is_kept = None if bar is None else value <= bar
        self.lines.append(
            {
                "what": what,
                "unit": unit,
                "median": median,
                "p99": p99,
                "against": against,
                "reference": reference,
                "ratio": ratio,
                "bar": bar,
                "is_kept": is_kept,
            }
        )

    def text(self):
        def number(value):
            return "" if value is None else f"{value:.3g}"

        rows = [["what", "unit", "median", "p99", "held against", "its figure", "ratio", "bar", ""]]
        for line in self.lines:
            kept = {None: "", True: "kept", False: "MISSED"}[line["is_kept"]]
            rows.append(
                [line["what"], line["unit"], number(line["median"]), number(line["p99"]), line["against"]]
                + [number(line["reference"]), number(line["ratio"]), number(line["bar"]), kept]
            )
        rows.insert(1, ["---"] * len(rows[0]))
        return "\n".join("| " + " | ".join(row) + " |" for row in rows) + "\n"


def ergodic_lines(table, program):
    _, runs = run(program, "^(ErgodicStep|GridToCoefficients|MixtureToCoefficients)")
    best = [one["name"] for one in runs if one["name"].startswith("ErgodicStep/")][-1].split("/")[1]
    for one in runs:
        name = one["name"]
        if f"/{best}/" not in name:
            continue
        if name.startswith("ErgodicStep"):
            big = "drones:1000/" in name or "drones:10000/" in name
            small = "drones:3/" in name
            table.add(
                name.split("/iterations")[0], "us", one["median_us"], one["p99_us"], "floor of its operations",
                one["floor_us"], 2.0 if big else 0.5 if small else None,
                one["median_us"] if small else None,
            )  # fmt: skip
        else:
            table.add(name.split("/iterations")[0], "us", one["median_us"], one["p99_us"], "", None, 1000.0, one["median_us"])


def solver_lines(table, program):
    options = (f"--benchmark_repetitions={REPETITIONS}", "--benchmark_min_time=0.05")
    _, runs = run(program, "^Solver(Fast|Batch|Slow)/rows:8", *options)
    times = repeated(runs, lambda one: one["cpu_time"])
    slow = times["SolverSlow/rows:8"][0]
    fast = times["SolverFast/rows:8"]
    table.add("solver, 8 rows, alone", "ns", *fast, "every candidate in turn", slow, 160.0, fast[0])
    for putting, words in ((0, "in batches"), (1, "in batches, with putting them side by side")):
        batch = tuple(value / 8 for value in times[f"SolverBatch/rows:8/putting:{putting}"])
        table.add(f"solver, 8 rows, {words}", "ns", *batch, "alone", fast[0], 30.0 if putting == 0 else None, batch[0])


def tick_lines(table, program):
    _, runs = run(program, "^Tick/", "--benchmark_min_time=2")
    bars = {10_000: 2.0, 100_000: 20.0, 1_000_000: 200.0}
    ticks = {}
    for one in runs:
        arguments = dict(part.split(":") for part in one["name"].split("/")[1:] if ":" in part)
        key = tuple(int(arguments[name]) for name in ("drones", "K", "threads", "spacing_mm"))
        ticks[key] = one
    for (drones, k, threads, spacing_mm), one in ticks.items():
        if k != 10 or spacing_mm != 300:
            continue
        bar = bars.get(drones) if threads == 2 else None
        table.add(
            f"tick of {drones} drones, {threads} threads", "ms", one["median_ms"], one["p99_ms"],
            "one thread", ticks[(drones, 10, 1, 300)]["median_ms"], bar, one["p99_ms"],
        )  # fmt: skip
    for threads in (1, 2):
        costs = [ticks[(drones, 10, threads, 300)]["ns_per_drone"] for drones in (1_000, 10_000, 100_000, 1_000_000)]
        bar = 1.3 if threads == 1 else None
        table.add(f"dearest drone of 1 000 to 1 000 000, {threads} threads", "ns", max(costs), None, "cheapest", min(costs), bar)
    # In a process of its own: what another size gave back would count as nothing.
    _, alone = run(program, "^Tick/drones:100000/K:10/threads:1/spacing_mm:300/", "--benchmark_min_time=0.1")
    memory = alone[0]["bytes_per_drone"]
    table.add("memory a drone", "bytes", memory, None, "", None, 1024.0, memory)
    return ticks


def write_scaling(path, ticks):
    """Blocks for docs/figures/scaling.gp: by drones with one thread and with two, by K, by neighbours."""
    def line(x, one):
        parts = [one["ns_per_drone"]] + [1e6 * one[part] / drones_of(one) for part in ("filter_ms", "kernel_ms")]
        return " ".join(f"{value:.6g}" for value in [x, *parts])

    def drones_of(one):
        return int(one["name"].split("drones:")[1].split("/")[0])

    def block(title, chosen):
        return f"# {title}: x, ns a drone of the whole tick, of the filter, of the ergodic step\n" + "".join(
            line(x, one) + "\n" for x, one in sorted(chosen)
        )

    blocks = [
        block("drones, one thread", [(key[0], one) for key, one in ticks.items() if key[1:] == (10, 1, 300)]),
        block("drones, two threads", [(key[0], one) for key, one in ticks.items() if key[1:] == (10, 2, 300)]),
        block("K", [(key[1], one) for key, one in ticks.items() if key[0] == 10_000 and key[2:] == (1, 300)]),
        block(
            "neighbours within 0.61 m",
            [(3.14159 * 610.0**2 / key[3] ** 2, one) for key, one in ticks.items() if key[:3] == (10_000, 10, 1)],
        ),
    ]
    path.write_text("\n\n".join(blocks), encoding="utf-8")


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return "unknown"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="default build/release")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out/bench", help="default out/bench")
    options = parser.parse_args()
    programs = {name: (options.build / "bench" / name).resolve() for name in ("kernel_benchmark", "tick_benchmark")}
    for program in programs.values():
        if not program.exists():
            sys.exit(f"{program} is not there; build it: cmake --build --preset release --target {program.name}")
    context, _ = run(programs["kernel_benchmark"], "^SolverFast/rows:2$", "--benchmark_min_time=0.01")
    built = {key: context[key] for key in ("commit", "compiler", "flags")}
    table = Table()
    ergodic_lines(table, programs["kernel_benchmark"])
    solver_lines(table, programs["kernel_benchmark"])
    ticks = tick_lines(table, programs["tick_benchmark"])
    options.out.mkdir(parents=True, exist_ok=True)
    about = {**built, "processor": processor(), "cores": context["num_cpus"], "seeds": "fixed in the sources"}
    (options.out / "bench.json").write_text(json.dumps({"about": about, "lines": table.lines}, indent=2) + "\n")
    write_scaling(options.out / "scaling.dat", ticks)
    heading = "".join(f"{key}: {value}\n" for key, value in about.items())
    (options.out / "table.md").write_text(heading + "\n" + table.text(), encoding="utf-8")
    print(heading + "\n" + table.text(), end="")
    return 1 if any(line["is_kept"] is False for line in table.lines) else 0


if __name__ == "__main__":
    sys.exit(main())
