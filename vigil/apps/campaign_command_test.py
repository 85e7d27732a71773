"""`vigil campaign` as a whole: the same runs whatever happens on the way, and every run can be repeated.

Usage: campaign_command_test.py VIGIL MISSIONS_DIRECTORY MPIRUN   (MPIRUN empty: the program was built without MPI)
"""

import json
import os
import pathlib
import shlex
import signal
import subprocess
import sys
import tempfile
import time
import unittest

VIGIL = sys.argv[1]
MISSIONS = pathlib.Path(sys.argv[2])
MPIRUN = sys.argv[3]
LAB = str(MISSIONS / "lab.yaml")
VARIED = ["--vary", "starts", "targets", "faults=2:land,fail,hold", "safety.margin_m=0.03..0.05", "--seconds", "5"]
# As root, on one machine, without looking for a network.
MPI_ARGUMENTS = ["--allow-run-as-root", "--oversubscribe", "--mca", "btl", "self,vader", "--mca", "oob_tcp_if_include", "lo"]


def run(*arguments, **options):
    return subprocess.run([*map(str, arguments)], capture_output=True, text=True, timeout=300, **options)


def without_clock(record):
    del record["summary"]["tick_us"]
    return record


def records(folder):
    """{run: record}, each without what differs between two flights of the same run: the wall clock, the directory."""
    lines = (folder / "runs.jsonl").read_text().replace(str(folder), "DIR").splitlines()
    found = {json.loads(line)["run"]: without_clock(json.loads(line)) for line in lines}
    assert len(found) == len(lines), "a run was flown twice"
    return found


def summary(folder):
    """The campaign's, without its directory; none of its figures depends on the clock."""
    return json.loads((folder / "summary.json").read_text().replace(str(folder), "DIR"))


class Campaign(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def campaign(self, name, *arguments, codes=(0, 1)):
        out = self.folder / name
        result = run(VIGIL, "campaign", "--out", out, *arguments)
        self.assertIn(result.returncode, codes, result.stderr)
        return out

    def refused(self, *arguments, code=2):
        result = run(VIGIL, "campaign", *arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.assertTrue(result.stderr.startswith("vigil: "), result.stderr)
        return result.stderr

    def test_the_runs_do_not_depend_on_the_number_of_threads(self):
        one = self.campaign("one", LAB, "--runs", 12, "--threads", 1, *VARIED)
        three = self.campaign("three", LAB, "--runs", 12, "--threads", 3, *VARIED)
        self.assertEqual(records(one), records(three))
        self.assertEqual(sorted(records(one)), list(range(12)))
        self.assertEqual(summary(one), summary(three))
        self.assertEqual(len({record["seed"] for record in records(one).values()}), 12)

    def test_the_command_of_a_run_repeats_it(self):
        out = self.campaign("a folder with blanks", LAB, "--runs", 4, *VARIED)
        crowd = self.campaign("crowd", MISSIONS / "crowd.yaml", "--runs", 1, "--seconds", 1, "--vary", "starts")
        for record in [*map(json.loads, (out / "runs.jsonl").read_text().splitlines()),
                       json.loads((crowd / "runs.jsonl").read_text())]:
            words = shlex.split(record["command"])
            self.assertEqual(words[0], "vigil")
            self.assertEqual(run(VIGIL, *words[1:]).returncode, 0)
            again = json.loads((pathlib.Path(words[-1]) / "summary.json").read_text())
            del again["tick_us"]
            self.assertEqual(again, without_clock(record)["summary"])

    def test_another_seed_has_other_runs(self):
        one = self.campaign("one", LAB, "--runs", 2, "--seconds", 1)
        two = self.campaign("two", LAB, "--runs", 2, "--seconds", 1, "--seed", 2)
        self.assertNotEqual(records(one), records(two))

    def test_a_killed_campaign_goes_on_where_it_was(self):
        arguments = ["--runs", "300", "--threads", "2", *VARIED]
        whole = self.campaign("whole", LAB, *arguments)
        out = self.folder / "killed"
        for kill_at in (1, 10_000, 40_000):
            campaign = subprocess.Popen([VIGIL, "campaign", LAB, "--out", out, *arguments], stdout=subprocess.DEVNULL)
            runs = out / "runs.jsonl"
            deadline = time.monotonic() + 60
            while campaign.poll() is None and not (runs.exists() and runs.stat().st_size >= kill_at):
                self.assertLess(time.monotonic(), deadline)
            campaign.kill()
            campaign.wait()
        self.assertFalse((out / "summary.json").exists(), "it was too fast to be killed")
        flown = len(records(out))
        self.assertGreater(flown, 0)
        self.assertLess(flown, 300)
        with (out / "runs.jsonl").open("a") as file:
            file.write('{"run":299,"seed":12')  # as if it had been killed within a line
        self.campaign("killed", LAB, *arguments)
        self.assertEqual(records(out), records(whole))
        self.assertEqual(summary(out), summary(whole))

    def test_a_finished_campaign_is_not_flown_again(self):
        out = self.campaign("out", LAB, "--runs", 3, "--seconds", 1)
        before = (out / "runs.jsonl").read_bytes()
        self.campaign("out", LAB, "--runs", 3, "--seconds", 1)
        self.assertEqual((out / "runs.jsonl").read_bytes(), before)

    def test_a_directory_with_another_plan_or_other_things_is_refused_and_left_alone(self):
        out = self.campaign("out", LAB, "--runs", 2, "--seconds", 1)
        before = {path: path.read_bytes() for path in out.iterdir()}
        for other in (["--runs", 3], ["--runs", 2, "--seed", 2], ["--runs", 2, "--vary", "starts"],
                      ["--runs", 2, "--set", "control.fade=0.5"]):
            message = self.refused(LAB, "--out", out, "--seconds", 1, *other)
            self.assertIn("another plan", message)
        self.assertEqual({path: path.read_bytes() for path in out.iterdir()}, before)
        (self.folder / "other").mkdir()
        (self.folder / "other" / "precious").write_text("x")
        self.refused(LAB, "--out", self.folder / "other", "--runs", 2)
        self.assertEqual([path.name for path in (self.folder / "other").iterdir()], ["precious"])

    def test_a_damaged_line_is_named(self):
        out = self.campaign("out", LAB, "--runs", 2, "--seconds", 1)
        with (out / "runs.jsonl").open("a") as file:
            file.write("not a run\n")
        message = self.refused(LAB, "--out", out, "--runs", 2, "--seconds", 1, code=3)
        self.assertIn("runs.jsonl:3", message)

    def test_bad_arguments_are_refused_before_anything_is_written(self):
        out = self.folder / "out"
        self.refused(LAB, "--out", out)
        self.refused(LAB, "--runs", 3)
        self.refused(LAB, "--out", out, "--runs", 0)
        self.refused(LAB, "--out", out, "--runs", 3, "--threads", 0)
        self.refused(LAB, "--out", out, "--runs", 3, "--vary", "weather")
        self.refused(LAB, "--out", out, "--runs", 3, "--vary", "control.fadde=0..1")
        self.refused(LAB, "--out", out, "--runs", 3, "--set", "control.fadde=1")
        self.assertIn("no free place", self.refused(MISSIONS / "crowd.yaml", "--out", out, "--runs", 3, "--vary", "starts",
                                                    "--set", "safety.separation_m=0.45"))
        self.refused(self.folder / "nowhere.yaml", "--out", out, "--runs", 3)
        self.assertFalse(out.exists())

    def test_the_exit_code_says_whether_a_run_broke_a_rule(self):
        safe = run(VIGIL, "campaign", LAB, "--out", self.folder / "safe", "--runs", 2, "--seconds", 1, "--json")
        self.assertEqual(safe.returncode, 0, safe.stderr)
        self.assertEqual(json.loads(safe.stdout), json.loads((self.folder / "safe" / "summary.json").read_text()))
        # Drones that react a second late to a tracker that errs by 30 cm, under a barrier that knows of neither.
        paper = ["safety.barrier=paper", "safety.lag_s=0", "safety.margin_m=0", "simulation.vehicle.command_delay_s=1",
                 "simulation.tracker.noise_m=0.3"]
        rash = run(VIGIL, "campaign", LAB, "--out", self.folder / "rash", "--runs", 4, "--seconds", 60, "--set", *paper,
                   "--vary", "starts")
        self.assertEqual(rash.returncode, 1, rash.stdout + rash.stderr)
        found = json.loads((self.folder / "rash" / "summary.json").read_text())
        self.assertGreater(found["violations"]["runs"], 0)
        self.assertIn(f"{found['violations']['runs']} of 4", rash.stdout)

    def test_interrupting_keeps_the_runs_under_way_and_says_partial(self):
        out = self.folder / "out"
        campaign = subprocess.Popen([VIGIL, "campaign", LAB, "--out", out, "--runs", "100000"],
                                    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while not ((out / "runs.jsonl").exists() and (out / "runs.jsonl").stat().st_size > 0):
            self.assertLess(time.monotonic(), deadline)
            self.assertIsNone(campaign.poll())
        busy = run(VIGIL, "campaign", LAB, "--out", out, "--runs", 100000)
        self.assertEqual(busy.returncode, 2)
        self.assertIn("in use", busy.stderr)
        campaign.send_signal(signal.SIGINT)
        _, message = campaign.communicate(timeout=60)
        self.assertEqual(campaign.returncode, 130)
        self.assertIn("goes on", message)
        found = json.loads((out / "summary.json").read_text())
        self.assertFalse(found["complete"])
        self.assertEqual(found["flown"], len(records(out)))

    def test_a_full_disk_ends_with_a_reason_and_can_be_gone_on_from(self):
        def limit_files():
            import resource
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

        arguments = ["--out", self.folder / "out", "--runs", "30", "--seconds", "1"]
        result = run(VIGIL, "campaign", LAB, *arguments, preexec_fn=limit_files)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("runs.jsonl", result.stderr)
        self.campaign("out", LAB, "--runs", 30, "--seconds", 1)
        self.assertEqual(len(records(self.folder / "out")), 30)

    @unittest.skipIf(MPIRUN, "this program has MPI")
    def test_without_mpi_the_program_says_what_is_missing(self):
        message = self.refused(LAB, "--out", self.folder / "out", "--runs", 3, "--mpi", code=3)
        self.assertIn("libopenmpi-dev", message)

    @unittest.skipUnless(MPIRUN, "this program has no MPI")
    def test_two_processes_under_mpirun_fly_the_same_runs(self):
        alone = self.campaign("alone", LAB, "--runs", 13, *VARIED)
        out = self.folder / "shared"
        arguments = [MPIRUN, *MPI_ARGUMENTS, "-np", 2, VIGIL, "campaign", LAB, "--out", out, "--mpi", *VARIED]
        result = run(*arguments, "--runs", 13)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        self.assertEqual(records(out), records(alone))
        self.assertEqual(summary(out), summary(alone))
        other_plan = run(*arguments, "--runs", 14)
        self.assertEqual(other_plan.returncode, 2, other_plan.stderr)
        self.assertIn("another plan", other_plan.stderr)

    @unittest.skipUnless(MPIRUN, "this program has no MPI")
    def test_mpi_without_mpirun_is_a_campaign_alone(self):
        alone = self.campaign("alone", LAB, "--runs", 3, "--seconds", 1)
        out = self.campaign("mpi", LAB, "--runs", 3, "--seconds", 1, "--mpi")
        self.assertEqual(records(out), records(alone))


if __name__ == "__main__":
    os.environ["LC_ALL"] = "C"
    unittest.main(argv=[sys.argv[0], "-v"])
