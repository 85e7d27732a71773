"""The command line as other programs rely on it: exit codes, one line on stderr, nothing half-done.

Usage: command_line_test.py VIGIL MISSIONS_DIRECTORY
"""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

VIGIL = sys.argv[1]
MISSIONS = pathlib.Path(sys.argv[2])
LONGER_THAN_ITS_TABLES = 1_000_000  # bytes of a bag: ticks have been flown
PAPER = str(MISSIONS / "paper.yaml")


def run(*arguments, **options):
    return subprocess.run([VIGIL, *map(str, arguments)], capture_output=True, text=True, timeout=120, **options)


def files_of(directory):
    return {p.relative_to(directory): p.read_bytes() for p in sorted(directory.rglob("*")) if p.is_file()}


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.out = pathlib.Path(self.folder.name) / "out"

    def tearDown(self):
        self.folder.cleanup()

    def refused(self, *arguments, code=2):
        result = run(*arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.assertTrue(result.stderr.startswith("vigil: "), result.stderr)
        return result.stderr

    def test_a_flight_leaves_a_recording_and_a_summary_with_every_promised_key(self):
        result = run("simulate", PAPER, "--out", self.out, "--seconds", 25)
        self.assertEqual(result.returncode, 0, result.stderr)
        summary = json.loads((self.out / "summary.json").read_text())
        for key in ("mission seed duration_s ticks drones metric min_separation_m min_wall_distance_m max_speed_m_s "
                    "separation_violations wall_violations speed_violations fallback_ticks worst_revisit_s active "
                    "tick_us accounting controller barrier").split():
            self.assertIn(key, summary)
        self.assertEqual(summary["ticks"], 1250)
        self.assertEqual(summary["drones"], 3)
        self.assertTrue(summary["complete"])
        self.assertEqual(summary["active"], [[0.0, 3], [23.0, 2]])
        self.assertIn("23", summary["metric"]["percent_at"])
        self.assertTrue((self.out / "recording" / "metadata.yaml").is_file())

    def test_json_is_the_summary_and_nothing_else(self):
        result = run("simulate", PAPER, "--out", self.out, "--seconds", 1, "--json")
        self.assertEqual(json.loads(result.stdout), json.loads((self.out / "summary.json").read_text()))

    def test_the_same_seed_gives_the_same_bytes(self):
        lab = MISSIONS / "lab.yaml"
        others = [self.out.with_name(name) for name in ("one", "two", "other-seed")]
        for out, seed in zip(others, (7, 7, 8)):
            self.assertEqual(run("simulate", lab, "--out", out, "--seconds", 10, "--seed", seed).returncode, 0)
        one, two, other = (files_of(out / "recording") for out in others)
        self.assertEqual(one, two)
        self.assertNotEqual(one, other)
        summaries = [json.loads((out / "summary.json").read_text()) for out in others[:2]]
        for summary in summaries:
            del summary["tick_us"]  # wall-clock
        self.assertEqual(*summaries)

    def test_an_existing_out_is_refused_and_left_alone(self):
        self.out.mkdir()
        (self.out / "precious").write_text("x")
        message = self.refused("simulate", PAPER, "--out", self.out)
        self.assertIn(str(self.out), message)
        self.assertEqual([p.name for p in self.out.iterdir()], ["precious"])

    def test_an_out_that_cannot_be_made_is_refused(self):
        (self.out.with_name("file")).write_text("x")
        self.refused("simulate", PAPER, "--out", self.out.with_name("file") / "below")

    def test_nothing_is_made_for_a_mission_that_is_refused(self):
        bad = self.out.with_name("bad.yaml")
        bad.write_text("format: 1\n")
        message = self.refused("simulate", bad, "--out", self.out)
        self.assertIn(str(bad), message)
        self.assertFalse(self.out.exists())

    def test_bad_arguments_are_refused_with_one_line(self):
        self.refused("simulate")
        self.refused("simulate", PAPER)
        self.refused("fly", PAPER)
        self.refused("simulate", PAPER, "--out", self.out, "--seconds", "long")
        self.refused("simulate", PAPER, "--out", self.out, "--seconds", -1)
        self.refused("simulate", PAPER, "--out", self.out, "--set", "control.fade")
        self.refused("simulate", PAPER, "--out", self.out, "--set", "control.fadde=1")
        self.refused("simulate", PAPER, "--out", self.out, "--set", "safety.separation_m=-0.2")
        self.refused("check", self.out / "nowhere.yaml")
        self.assertFalse(self.out.exists())

    def test_numbers_are_refused_as_written_in_the_name_of_their_option(self):
        simulate = ("simulate", PAPER, "--out", self.out)
        self.assertTrue(self.refused(*simulate, "--seed", "-1").startswith("vigil: --seed: simulation.seed = -1: "))
        self.assertTrue(self.refused(*simulate, "--seconds", "1e-9").startswith("vigil: --seconds: "))
        self.assertIn("1e-300: is shorter than one tick; must be in [0.02, 1000000] s",
                      self.refused(*simulate, "--set", "simulation.duration_s=1e-300"))
        self.assertIn("--seconds: ", self.refused(*simulate, "--seconds", "none"))
        self.assertIn("given twice", self.refused(*simulate, "--seed", 1, "--set", "simulation.seed=2"))
        self.assertIn("given twice", self.refused(*simulate, "--seconds", 1, "--set", "simulation.duration_s=2"))
        campaign = ("campaign", PAPER, "--runs", 1, "--out", self.out)
        self.assertIn("--seed", self.refused(*campaign, "--seed", "-1"))
        self.assertIn("--seconds: ", self.refused(*campaign, "--seconds", "1e-9"))
        self.assertFalse(self.out.exists())

    def test_options_without_their_values_are_refused(self):
        for option in ("--seed", "--seconds"):
            self.assertIn(f"{option}: has no value", self.refused("simulate", PAPER, "--out", self.out, option, ""))
        self.assertIn("--out", self.refused("simulate", PAPER, "--out", ""))
        self.assertIn("--out", self.refused("campaign", PAPER, "--runs", 1, "--out", ""))
        self.assertFalse(self.out.exists())

    def test_a_path_with_control_characters_or_without_end_is_told_on_one_short_line(self):
        file = self.out.with_name("file")
        file.write_text("x")
        strange = file / "a\nb\x1b[2J"
        for message in (self.refused("simulate", PAPER, "--out", strange),
                        self.refused("campaign", PAPER, "--runs", 1, "--out", strange)):
            self.assertIn("a\\nb\\x1b[2J", message)
        self.assertLess(len(self.refused("simulate", PAPER, "--out", file / ("x" * 100_000))), 500)

    def test_output_that_nobody_gets_is_no_success(self):
        commands = (("schema",), ("check", PAPER), ("check", PAPER, "--json"), ("--help",), ("--version",),
                    ("simulate", PAPER, "--seconds", 1, "--json", "--out", self.out),
                    ("simulate", PAPER, "--seconds", 1, "--out", self.out.with_name("other")))
        for command in commands:
            with self.subTest(command), open("/dev/full", "w") as full:
                result = subprocess.run([VIGIL, *map(str, command)], stdout=full, stderr=subprocess.PIPE, text=True,
                                        timeout=120)
                self.assertEqual(result.returncode, 3, result.stderr)
                self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
                self.assertIn("standard output", result.stderr)
        self.assertTrue((self.out / "summary.json").is_file())

    def test_help_says_what_every_exit_means(self):
        whole = run("--help").stdout
        self.assertIn("./run simulate", whole)
        for code in ("0 done", "1 a run", "2 bad", "3 a component", "130 interrupted"):
            self.assertIn(code, whole)
        for command in ("simulate", "campaign", "check", "margins", "report"):
            text = run(command, "--help").stdout
            self.assertIn("Exit codes: 0 done", text)
            self.assertNotIn("Start with", text)
            self.assertEqual("1 a run broke a rule" in text, command == "campaign")
            self.assertEqual("130 interrupted" in text, command in ("simulate", "campaign"))

    def test_without_a_command_the_program_says_what_there_is(self):
        result = run()
        self.assertEqual(result.returncode, 2)
        self.assertIn("simulate", result.stdout)

    def test_margins_are_the_sum_of_their_parts_and_the_lines_to_paste_fly_with_them(self):
        mission = MISSIONS / "lab.yaml"
        said = json.loads(run("margins", mission, "--json").stdout)
        for boundary, key in (("pair", "pair_margin_m"), ("wall", "margin_m")):
            parts = dict(said[boundary])
            total = parts.pop("total_m")
            self.assertAlmostEqual(sum(parts.values()), total)
            self.assertGreater(parts["noise_m"], 0)
            self.assertEqual(said["flown"][key], total)
        text = run("margins", mission).stdout
        lines = [line.strip() for line in text.split("safety:")[1].splitlines()[1:]]
        pasted = [f"safety.{line.replace(': ', '=')}" for line in lines]
        self.assertEqual(len(pasted), 7)
        again = run("check", mission, "--set", *pasted)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertNotIn("less than", again.stdout)

    def test_the_papers_barrier_has_no_margins(self):
        self.refused("margins", PAPER)

    def test_check_explains_every_mission_of_the_project(self):
        for mission in sorted(MISSIONS.glob("*.yaml")):
            result = run("check", mission)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(mission.stem, result.stdout)
            self.assertEqual(run("check", mission, "--json").returncode, 0)

    def test_the_schema_is_the_published_one(self):
        result = run("schema")
        self.assertEqual(json.loads(result.stdout), json.loads((MISSIONS / "mission.schema.json").read_text()))

    def test_interrupting_leaves_a_valid_partial_result_that_says_so(self):
        for signal_number in (signal.SIGINT, signal.SIGTERM):
            out = self.out.with_name(f"out-{signal_number}")
            flight = subprocess.Popen([VIGIL, "simulate", PAPER, "--out", out, "--seconds", "100000"],
                                      stderr=subprocess.PIPE, text=True)
            bag = out / "recording" / "recording_0.db3"
            deadline = time.monotonic() + 60
            while not (bag.exists() and bag.stat().st_size > LONGER_THAN_ITS_TABLES):
                self.assertLess(time.monotonic(), deadline)
                self.assertIsNone(flight.poll())
            flight.send_signal(signal_number)
            _, message = flight.communicate(timeout=60)
            self.assertEqual(flight.returncode, 130)
            self.assertIn("stopped at", message)
            summary = json.loads((out / "summary.json").read_text())
            self.assertFalse(summary["complete"])
            self.assertGreater(summary["ticks"], 0)
            self.assertLess(summary["duration_s"], 100000)

    def test_a_full_disk_ends_with_a_reason_and_not_with_a_crash(self):
        def limit_files():
            import resource
            resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))

        result = run("simulate", PAPER, "--out", self.out, preexec_fn=limit_files)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("recording", result.stderr)


if __name__ == "__main__":
    os.environ["LC_ALL"] = "C"
    unittest.main(argv=[sys.argv[0], "-v"])
