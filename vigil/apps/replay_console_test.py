"""Tests the console on a recording over real sockets: python3 replay_console_test.py VIGIL MISSIONS PROTOCOL"""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

from console_client import Program, WebSocket
from json_schema import complaints

VIGIL, MISSIONS, PROTOCOL = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
SECONDS = 30
LANDS_AT_S = 23


def simulate(folder):
    command = [VIGIL, "simulate", MISSIONS / "paper.yaml", "--out", folder, "--seconds", str(SECONDS)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


class Replay(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        recorded = pathlib.Path(cls.folder.name) / "flight"
        simulate(recorded)
        cls.recorded = recorded
        cls.program = Program(VIGIL, recorded, command="replay")

    @classmethod
    def tearDownClass(cls):
        cls.program.__exit__()
        cls.folder.cleanup()

    def setUp(self):
        self.client = WebSocket(self.program.port)
        self.addCleanup(self.client.close)
        self.greeting = self.client.hello(name="Ana")
        self.next_id = 0

    def ask(self, kind, **members):
        self.next_id += 1
        return self.client.ask(type=kind, id=self.next_id, **members)

    def state(self):
        return self.program.json("GET", "/api/state")[1]

    def go_to(self, time_s):
        """Stands at a moment; what the program shows of it."""
        self.assertEqual(self.ask("pause")["type"], "ack")
        self.assertEqual(self.ask("seek", time_s=time_s)["type"], "ack")
        return self.wait_for_snapshot(lambda s: abs(s["time_s"] - time_s) < 0.02)

    def wait_for_snapshot(self, wanted):
        while not wanted(shown := self.client.snapshot()):
            pass
        return shown

    def test_a_newcomer_is_told_that_it_is_a_recording(self):
        mission = self.client.wait_for_type("mission")
        self.assertEqual(mission["fleet"], "REPLAY")
        self.assertEqual(mission["recording"]["incomplete"], "")
        self.assertAlmostEqual(mission["recording"]["end_s"], SECONDS, delta=0.03)
        self.assertEqual((mission["display"]["least_speed"], mission["display"]["most_speed"]), (0.1, 100.0))

    def test_seeking_shows_the_drones_where_they_were(self):
        first = self.go_to(0.0)
        later = self.go_to(12.0)
        again = self.go_to(0.0)
        self.assertEqual(first["positions"], again["positions"])
        self.assertNotEqual(first["positions"], later["positions"])

    def test_events_are_those_until_that_moment(self):
        self.go_to(LANDS_AT_S - 1)
        self.client.send({"type": "seek", "id": 100, "time_s": LANDS_AT_S + 2})
        after = self.client.wait_for(lambda m: m["type"] == "events" and m.get("afresh")
                                     and any(e["what"] == "landing" for e in m["events"]))
        self.assertTrue(all(event["time_s"] <= LANDS_AT_S + 2 for event in after["events"]))
        self.client.send({"type": "seek", "id": 101, "time_s": LANDS_AT_S - 2})
        before = self.client.wait_for(lambda m: m["type"] == "events" and m.get("afresh"))
        self.assertNotIn("landing", [event["what"] for event in before["events"]])

    def test_trails_of_a_moment_end_at_that_moment(self):
        self.go_to(1.0)
        self.client.send({"type": "seek", "id": 100, "time_s": 20.0})
        trails = self.client.wait_for(lambda m: m["type"] == "frame" and m["bytes"][4] == 5
                                      and struct.unpack_from("<d", m["bytes"], 24)[0] > 19.5)["bytes"]
        points, spacing_s = struct.unpack_from("<If", trails, 16)
        self.assertAlmostEqual(points * spacing_s, 20.0, delta=0.6)

    def test_a_step_is_one_tick(self):
        here = self.go_to(5.0)["tick"]
        self.ask("step", ticks=1)
        self.wait_for_snapshot(lambda s: s["tick"] == here + 1)
        self.ask("step", ticks=-2)
        self.wait_for_snapshot(lambda s: s["tick"] == here - 1)

    def test_it_plays_to_its_end_and_says_so(self):
        self.go_to(10.0)
        self.assertEqual(self.ask("set_speed", factor=100)["type"], "ack")
        self.assertEqual(self.ask("resume_clock")["type"], "ack")
        status = self.client.wait_for(lambda m: m["type"] == "status" and m["replay"]["is_at_end"])
        self.assertTrue(status["replay"]["is_recomputed"])
        self.assertEqual(status["replay"]["difference"], "")
        state = self.state()
        self.assertTrue(state["is_paused"])
        self.assertAlmostEqual(state["time_s"], SECONDS, delta=0.03)

    def test_what_happened_cannot_be_changed(self):
        revision = self.client.wait_for_type("targets")["revision"]
        edits = [{"op": "set_weight", "kind": "cluster", "name": "east", "weight": 3}]
        for command in ({"type": "edit", "based_on": revision, "edits": edits}, {"type": "land_all"},
                        {"type": "emergency_stop", "drones": "all"}, {"type": "undo", "based_on": 1}, {"type": "preview"},
                        {"type": "load_mission", "yaml": "format: 1"}, {"type": "start_afresh"}):
            kind = command.pop("type")
            refused = self.ask(kind, **command)
            self.assertEqual((refused["type"], refused["code"]), ("refused", "not_now"), kind)
            self.assertIn("this is a recording", refused["reason"])
        self.assertEqual(self.ask("set_speed", factor=0.01)["code"], "invalid")
        status, refused = self.program.json("POST", "/api/commands", {"type": "land_all", "id": 1})
        self.assertEqual((status, refused["code"]), (409, "not_now"))

    def test_why_is_what_the_command_prints(self):
        for time_s in (18.0, 3.5):
            self.go_to(time_s)
            command = [VIGIL, "replay", self.recorded, "--why", "cf2", "--at", str(time_s), "--json"]
            printed = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
            told = self.ask("why", drone="cf2")
            by_http = self.program.json("GET", "/api/why?drone=cf2")[1]
            for answer in (told, by_http):
                self.assertEqual({key: answer[key] for key in printed}, printed)
                self.assertEqual(set(answer) - set(printed), {"type", "id", "epoch"})
        self.assertEqual(self.ask("why", drone="x")["code"], "unknown_drone")
        self.assertEqual(self.ask("why")["code"], "malformed")

    def test_the_clock_is_one_for_everybody(self):
        other = WebSocket(self.program.port)
        self.addCleanup(other.close)
        other.hello()
        self.go_to(7.0)
        while abs(other.snapshot()["time_s"] - 7.0) > 0.02:
            pass

    def test_the_state_is_as_the_description_says(self):
        api = json.loads((PROTOCOL / "openapi.json").read_text())
        schemas = api["components"]["schemas"]
        self.assertEqual(list(complaints(self.state(), schemas["State"], api)), [])
        why = self.program.json("GET", "/api/why?drone=cf1")[1]
        self.assertEqual(list(complaints(why, schemas["Why"], api)), [])


class CommandLine(unittest.TestCase):
    def refused(self, *arguments):
        done = subprocess.run([VIGIL, "replay", *arguments], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        return done.stderr

    def test_what_makes_no_sense_is_refused(self):
        self.assertIn("no recording here", self.refused("/"))
        self.assertIn("--from", self.refused("/", "--json"))
        self.assertIn("--tokens", self.refused("/", "--address", "0.0.0.0"))

    def test_a_flight_refuses_to_be_sought(self):
        with Program(VIGIL, MISSIONS / "paper.yaml") as program:
            _, refused = program.json("POST", "/api/commands", {"type": "seek", "id": 1, "time_s": 3})
            self.assertEqual(refused["code"], "not_now")
            self.assertIn("not a recording", refused["reason"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
