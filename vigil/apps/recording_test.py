"""Tests recordings as a whole: python3 recording_test.py VIGIL MISSIONS

What was flown can be flown again, bit for bit; one byte that is not as it was written is found; and whenever a live
program is killed, what it had written is sound.
"""

import contextlib
import csv
import json
import math
import pathlib
import random
import resource
import sqlite3
import statistics
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree

from console_client import Program, WebSocket

VIGIL, MISSIONS = sys.argv[1], pathlib.Path(sys.argv[2])
KILLS = 50
SEED = 20261122
FLOWN = "/vigil/tick"


def run(*arguments):
    return subprocess.run([VIGIL, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False)


def verified(directory):
    result = run("replay", directory, "--verify", "--json")
    return result.returncode, json.loads(result.stdout) if result.stdout else result.stderr


def ticks_in(database):
    """[(id, message)] of a bag's ticks."""
    return database.execute("SELECT messages.id, data FROM messages JOIN topics ON topics.id = topic_id "
                            "WHERE topics.name = ? ORDER BY messages.id", (FLOWN,)).fetchall()


def metres_from_datum(longitude_deg, latitude_deg, datum=(6.12, 44.05)):
    """To the east and to the north of wildfire.yaml's datum, by the radii of curvature of WGS 84."""
    equator_m, eccentricity_squared = 6378137.0, 0.00669437999
    bend = 1 - eccentricity_squared * math.sin(math.radians(datum[1])) ** 2
    across_m = equator_m / math.sqrt(bend) * math.cos(math.radians(datum[1]))
    along_m = equator_m * (1 - eccentricity_squared) / bend ** 1.5
    return across_m * math.radians(longitude_deg - datum[0]), along_m * math.radians(latitude_deg - datum[1])


class Place:
    """Where a tick's numbers stand in its message: protocol/vigil_msgs/msg/Tick.msg, after CDR's rules."""

    OBSERVED = 100  # encapsulation, what concerns the whole tick, the sequence's length and its alignment

    def __init__(self, drones):
        modes = self.OBSERVED + 64 * drones
        self.decided = -(-(modes + 4 + drones - 4) // 4) * 4 + 4 + 4  # after the modes, their length and its own
        self.decided = 4 + -(-(self.decided - 4) // 8) * 8

    def observed(self, drone, number):
        return self.OBSERVED + 64 * drone + 8 * number

    def velocity(self, drone, axis):
        return self.decided + 72 * drone + 16 + 8 * axis


class Recordings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.random = random.Random(SEED)

    def simulated(self, mission, *more):
        out = self.folder / "flight"
        result = run("simulate", MISSIONS / mission, "--out", out, *more)
        self.assertEqual(result.returncode, 0, result.stderr)
        return out

    def test_one_flipped_byte_of_a_velocity_or_observation_is_found_with_its_tick_and_drone(self):
        out = self.simulated("paper.yaml", "--seconds", 10)
        drones, place = 3, Place(3)
        with contextlib.closing(sqlite3.connect(out / "recording" / "recording_0.db3")) as database:
            ticks = ticks_in(database)
            for _ in range(20):
                tick, drone = self.random.randrange(len(ticks)), self.random.randrange(drones)
                is_velocity = self.random.random() < 0.5
                at = (place.velocity(drone, self.random.randrange(2)) if is_velocity
                      else place.observed(drone, self.random.randrange(8))) + self.random.randrange(8)
                number, message = ticks[tick]
                changed = bytearray(message)
                changed[at] ^= 1 << self.random.randrange(8)
                database.execute("UPDATE messages SET data = ? WHERE id = ?", (bytes(changed), number))
                database.commit()
                code, verdict = verified(out)
                self.assertEqual(code, 1, verdict)
                self.assertEqual(verdict["difference"]["tick"], tick)
                self.assertEqual(verdict["difference"]["drone"], f"cf{drone + 1}")
                self.assertEqual("velocity asked for" in verdict["difference"]["what"], is_velocity)
                self.assertEqual(verdict["same"], tick)
                database.execute("UPDATE messages SET data = ? WHERE id = ?", (message, number))
                database.commit()
        self.assertEqual(verified(out)[0], 0)

    def test_flying_on_without_a_change_leads_to_what_happened_and_with_one_elsewhere(self):
        out = self.simulated("paper.yaml", "--seconds", 20, "--set", "control.controller=gradient")

        def flown_on(*more):
            result = run("replay", out, "--from", 5, "--json", *more)
            self.assertEqual(result.returncode, 0, result.stderr)
            return json.loads(result.stdout)

        same = flown_on()
        self.assertEqual(same["from_s"], 5)
        self.assertEqual(same["happened"]["metric"]["last"], same["would_have"]["metric"]["last"])
        other = flown_on("--set", "control.speed_limit_m_s=0.15", "--out", self.folder / "other")
        self.assertEqual(other["happened"]["metric"]["last"], same["happened"]["metric"]["last"])
        self.assertNotEqual(other["would_have"]["metric"]["last"], other["happened"]["metric"]["last"])
        code, verdict = verified(self.folder / "other")
        self.assertEqual((code, verdict["same"]), (0, 750), verdict)
        for wrong in ((30,), (-5,), ("nan",), ("inf",), (5, "--set", "control.rate_hz=20"), (5, "--port", 18123)):
            result = run("replay", out, "--from", *wrong)
            self.assertEqual((result.returncode, len(result.stderr.splitlines())), (2, 1), result.stderr)
            self.assertNotIn("cannot be recomputed", result.stderr)
        self.assertEqual(run("replay", out, "--verify", "--port", 8080).returncode, 2)
        summary = json.loads((out / "summary.json").read_text())
        for part in (same["happened"], same["would_have"]):
            self.assertEqual(part["metric"]["first"], summary["metric"]["first"])
            self.assertEqual((part["metric"]["percent_last"], part["complete"]), (summary["metric"]["percent_last"], True))
            late = {at: percent for at, percent in summary["metric"]["percent_at"].items() if float(at) >= 5}
            self.assertEqual(part["metric"]["percent_at"], late)
            self.assertFalse({"tick_us", "worst_revisit_s"} & set(part))

    def test_a_velocity_is_explained_by_the_rows_that_made_it(self):
        out = self.simulated("crowd.yaml", "--seconds", 10)
        result = run("replay", out, "--why", "cf7", "--at", 5, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        why = json.loads(result.stdout)
        self.assertEqual((why["drone"], why["tick"]), ("cf7", 250))
        self.assertTrue(why["rows"])
        self.assertEqual(run("export", out, "--out", self.folder / "tables").returncode, 0)
        with (self.folder / "tables" / "drones.csv").open() as table:
            row = next(r for r in csv.DictReader(table) if r["drone"] == "cf7" and float(r["t_s"]) == 5)
        for told, column in (("u_nom_m_s", "nominal"), ("u_m_s", "command")):
            self.assertEqual(why[told], [float(row[f"{column}_x_m_s"]), float(row[f"{column}_y_m_s"])])
        self.assertIn("cf7", run("replay", out, "--why", "cf7").stdout)
        for wrong in (("--why", "nobody"), ("--why", "cf7", "--at", 60), ("--why", "cf7", "--at", -1), ("--at", 5), ("--why", "cf7", "--verify")):
            result = run("replay", out, *wrong)
            self.assertEqual((result.returncode, len(result.stderr.splitlines())), (2, 1), result.stderr)

    def test_a_mission_file_that_was_edited_beside_its_recording_is_told_and_not_used(self):
        with tempfile.TemporaryDirectory() as folder:
            flown = pathlib.Path(folder) / "flown"
            self.assertEqual(run("simulate", MISSIONS / "paper.yaml", "--out", flown, "--set", "simulation.duration_s=2").returncode, 0)
            self.assertEqual(run("replay", flown, "--verify").stderr, "")
            mission = flown / "recording" / "mission.yaml"
            mission.write_text(mission.read_text().replace("name: paper", "name: other"))
            for command in (("replay", flown, "--verify"), ("report", flown)):
                result = run(*command)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn("mission.yaml is not the mission that was flown any more", result.stderr)
            self.assertIn("paper: 100 of 100 ticks", run("replay", flown, "--verify").stdout)

    def test_ticks_that_are_taken_away_from_the_end_are_missed(self):
        out = self.simulated("paper.yaml", "--seconds", 10)
        with contextlib.closing(sqlite3.connect(out / "recording" / "recording_0.db3")) as database:
            database.executemany("DELETE FROM messages WHERE id = ?", [(n,) for n, _ in ticks_in(database)[-50:]])
            database.commit()
        code, verdict = verified(out)
        self.assertEqual((code, verdict["same"]), (1, 450))
        self.assertIn("50", verdict["cannot"])

    def test_tables_have_a_line_of_every_tick(self):
        out = self.simulated("paper.yaml", "--seconds", 10)
        result = run("export", out, "--out", self.folder / "tables")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len((self.folder / "tables" / "ticks.csv").read_text().splitlines()), 501)
        self.assertEqual(len((self.folder / "tables" / "drones.csv").read_text().splitlines()), 1501)
        self.assertEqual(run("export", out, "--out", self.folder / "tables").returncode, 2)

    def test_maps_show_the_places_of_the_tables_on_the_earth(self):
        out = self.simulated("wildfire.yaml", "--seconds", 20)
        self.assertEqual(run("export", out, "--out", self.folder / "maps").returncode, 0)
        features = json.loads((self.folder / "maps" / "tracks.geojson").read_text())["features"]
        tracks = {f["properties"]["drone"]: f for f in features if f["properties"]["kind"] == "track"}
        self.assertEqual(len(tracks), 6)
        with (self.folder / "maps" / "drones.csv").open() as table:
            rows = [row for row in csv.DictReader(table) if float(row["t_s"]) == 10]
        for row in rows:
            track = tracks[row["drone"]]
            at = track["properties"]["times_s"][0].index(10)
            east, north = metres_from_datum(*track["geometry"]["coordinates"][0][at])
            self.assertAlmostEqual(east, float(row["x_m"]), delta=0.1)
            self.assertAlmostEqual(north, float(row["y_m"]), delta=0.1)
        kml = xml.etree.ElementTree.parse(self.folder / "maps" / "tracks.kml")
        coordinates = kml.findall(".//{http://www.google.com/kml/ext/2.2}coord")
        self.assertEqual(len(coordinates), sum(len(f["properties"]["times_s"][0]) for f in tracks.values()))

    def test_a_mission_without_a_datum_has_no_maps_and_says_why(self):
        out = self.simulated("paper.yaml", "--seconds", 2)
        result = run("export", out, "--out", self.folder / "tables")
        self.assertEqual(result.returncode, 0)
        self.assertIn("field.datum", result.stderr)
        self.assertFalse((self.folder / "tables" / "tracks.kml").exists())

    def test_a_disk_that_takes_no_more_is_told_at_once_and_the_flight_goes_on(self):
        out = self.folder / "live"
        with Program(VIGIL, MISSIONS / "paper.yaml", "--record", out) as program:
            client = WebSocket(program.port)
            self.addCleanup(client.close)
            client.hello()
            while client.snapshot()["tick"] < 25:
                pass
            log = out / "recording" / "recording_0.db3-wal"
            resource.prlimit(program.process.pid, resource.RLIMIT_FSIZE, (log.stat().st_size + 20_000,) * 2)
            event = client.wait_for_event("recording")
            self.assertEqual((event["source"], event["severity"]), ("program", "alarm"))
            self.assertIn("recording_0.db3", event["text"])
            before = client.snapshot()["tick"]
            while client.snapshot()["tick"] < before + 50:
                pass
        code, verdict = verified(out)
        self.assertEqual(code, 0, verdict)
        self.assertGreater(verdict["ticks"], 10)
        self.assertNotEqual(verdict["incomplete"], "")

    def test_whenever_a_live_program_is_killed_its_recording_is_sound_and_can_be_flown_again(self):
        lost_s, ticks = [], 0
        for number in range(KILLS):
            out = self.folder / f"live-{number}"
            mission = ("paper.yaml", "wildfire.yaml")[number % 2]
            program = Program(VIGIL, MISSIONS / mission, "--record", out)
            deadline = time.monotonic() + 60
            while not (out / "recording" / "metadata.yaml").exists():  # the recording has begun
                self.assertLess(time.monotonic(), deadline)
            time.sleep(self.random.uniform(0.0, 0.8))  # the moment is what is drawn
            program.process.kill()
            killed_ns = time.time_ns()
            program.process.communicate()
            code, verdict = verified(out)
            self.assertEqual(code, 0, (number, verdict))
            self.assertEqual(verdict["same"], verdict["ticks"])
            self.assertNotEqual(verdict["incomplete"], "")
            with contextlib.closing(sqlite3.connect(out / "recording" / "recording_0.db3")) as database:
                self.assertEqual(database.execute("PRAGMA integrity_check").fetchall(), [("ok",)])
                newest_ns, = database.execute("SELECT max(timestamp) FROM messages").fetchone()
            lost_s.append((killed_ns - newest_ns) / 1e9)
            ticks += verdict["ticks"]
        self.assertGreater(ticks, KILLS)
        print(f"{KILLS} kills, seed {SEED}: {ticks} ticks flown again; between the newest message and the kill: median "
              f"{statistics.median(lost_s):.3f} s, most {max(lost_s):.3f} s", flush=True)
        self.assertLess(statistics.median(lost_s), 0.1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
