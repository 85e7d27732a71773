"""Kills `vigil serve` and starts it again: python3 serve_restart_test.py VIGIL MISSIONS"""

import pathlib
import sys
import tempfile
import unittest

from console_client import Program, WebSocket

VIGIL, MISSIONS = sys.argv[1], pathlib.Path(sys.argv[2])
EAST = {"op": "set_weight", "kind": "cluster", "name": "east", "weight": 3}


def paper(*arguments):
    return Program(VIGIL, MISSIONS / "paper.yaml", *arguments)


def wait_for_activities(program, client, expected):
    """Until the drones are in these, in the mission's order."""
    def are_there(message):
        drones = program.json("GET", "/api/state")[1]["drones"] if message["type"] == "frame" else []
        return [drone["activity"] for drone in drones] == expected

    client.wait_for(are_there)


class Restart(unittest.TestCase):
    def test_after_kill_9_it_goes_on_with_targets_and_coverage_and_drones_that_hold(self):
        with tempfile.TemporaryDirectory() as folder:
            with paper("--state", folder) as program:
                client = WebSocket(program.port)
                client.hello()
                client.ask(type="set_speed", id=1, factor=20)
                client.ask(type="edit", id=2, based_on=1, edits=[EAST])
                client.wait_for_event("grounded", "cf2")
                reached = client.snapshot()["tick"]
                while client.snapshot()["tick"] < reached + 3000:  # a save of what has happened, at the least
                    pass
                program.kill()
            with paper("--state", folder) as program:
                client = WebSocket(program.port)
                client.hello()
                targets = client.wait_for_type("targets")
                self.assertEqual((targets["revision"], targets["by"]), (2, "restored"))
                self.assertIn(3.0, [entry["weight"] for entry in targets["clusters"]])
                self.assertGreater(client.snapshot()["tick"], reached)
                _, state = program.json("GET", "/api/state")
                self.assertTrue(state["waits_for_resume"])
                self.assertEqual([one["activity"] for one in state["drones"]], ["held", "grounded", "held"])
                self.assertLess(state["metric_percent"], 50)
                self.assertEqual(client.ask(type="resume", id=1, drones="all")["type"], "ack")
                wait_for_activities(program, client, ["active", "grounded", "active"])
            with self.assertRaisesRegex(RuntimeError, "(?s)keeps a flight of the mission paper.* another folder .* --afresh"):
                Program(VIGIL, MISSIONS / "lab.yaml", "--state", folder)

    def test_a_change_that_was_acknowledged_survives_a_kill_right_after_it(self):
        with tempfile.TemporaryDirectory() as folder:
            for revision in range(1, 6):
                with paper("--state", folder) as program:
                    client = WebSocket(program.port)
                    client.hello()
                    self.assertEqual(client.wait_for_type("targets")["revision"], revision)
                    edit = {**EAST, "weight": revision + 1}
                    self.assertEqual(client.ask(type="edit", id=1, based_on=revision, edits=[edit])["type"], "ack")
                    program.kill()

    def test_an_order_that_was_acknowledged_survives_a_kill_right_after_it(self):
        with tempfile.TemporaryDirectory() as folder:
            orders = [("mark_failed", "cf1", "marked_failed"), ("emergency_stop", "cf2", "emergency_stop"),
                      ("land", "cf3", "grounded")]
            for order, drone, _ in orders:
                with paper("--state", folder) as program:
                    client = WebSocket(program.port)
                    client.hello()
                    client.snapshot()
                    self.assertEqual(client.ask(type=order, id=1, drones=[drone])["type"], "ack")
                    program.kill()
            with paper("--state", folder) as program:
                client = WebSocket(program.port)
                client.hello()
                client.ask(type="set_speed", id=1, factor=20)
                after = [activity for _, _, activity in orders]
                wait_for_activities(program, client, after)
                began = client.snapshot()["tick"]
                while client.snapshot()["tick"] < began + 1000:  # nothing takes off by itself
                    pass
                wait_for_activities(program, client, after)

    def test_after_land_all_and_a_kill_every_drone_comes_down(self):
        with tempfile.TemporaryDirectory() as folder:
            with paper("--state", folder) as program:
                client = WebSocket(program.port)
                client.hello()
                client.snapshot()
                self.assertEqual(client.ask(type="land_all", id=1)["type"], "ack")
                program.kill()
            with paper("--state", folder) as program:
                client = WebSocket(program.port)
                client.hello()
                wait_for_activities(program, client, ["grounded"] * 3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
