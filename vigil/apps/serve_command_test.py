"""Tests `vigil serve` over real sockets of this machine: python3 serve_command_test.py VIGIL MISSIONS PROTOCOL"""

import json
import pathlib
import socket
import struct
import subprocess
import sys
import tempfile
import unittest

from console_client import PATIENCE_S, Program, WebSocket
from json_schema import complaints

VIGIL, MISSIONS, PROTOCOL = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
EAST = {"op": "set_weight", "kind": "cluster", "name": "east", "weight": 3}


def paper(*arguments):
    return Program(VIGIL, MISSIONS / "paper.yaml", *arguments)


class Console(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.program = paper()

    @classmethod
    def tearDownClass(cls):
        cls.program.__exit__()

    def client(self, **hello):
        client = WebSocket(self.program.port)
        self.addCleanup(client.close)
        client.greeting = client.hello(**hello)
        return client

    def test_a_newcomer_is_told_everything(self):
        client = WebSocket(self.program.port)
        self.addCleanup(client.close)
        client.send({"type": "hello", "name": "Ana"})
        kinds, frames = [], set()
        while len(frames) < 6:
            message = client.wait_for(lambda _: True)
            if message["type"] == "frame":
                frames.add(message["bytes"][4])
            elif message["type"] not in kinds:
                kinds.append(message["type"])
        self.assertEqual(kinds[:3], ["hello", "mission", "targets"])
        self.assertLessEqual({"events", "presence"}, set(kinds))
        self.assertEqual(frames, {1, 2, 3, 4, 5, 6})

    def test_the_flight_goes_on_by_itself(self):
        client = self.client()
        first = client.snapshot()
        later = client.wait_for(lambda m: m["type"] == "frame" and m["bytes"][4] == 1
                                and struct.unpack_from("<d", m["bytes"], 16)[0] > first["tick"] + 25)
        self.assertEqual(first["drones"], 3)
        self.assertIsNotNone(later)

    def test_a_command_is_answered_and_everybody_is_told(self):
        ana, ben = self.client(name="Ana"), self.client(name="Ben")
        while ana.snapshot()["tick"] == 0:  # the first tick is when drones are seen at all
            pass
        answer = ana.ask(type="hold", id=1, drones=["cf1"])
        self.assertEqual(answer["type"], "ack")
        event = ben.wait_for_event("held", "cf1")
        self.assertEqual(event["was"], "active")
        self.assertEqual(ana.ask(type="take_off", id=2, drones=["cf1"])["code"], "not_now")
        self.assertEqual(ana.ask(type="hold", id=3, drones=["nobody"])["code"], "unknown_drone")
        self.assertEqual(ana.ask(type="resume", id=4, drones=["cf1"])["type"], "ack")
        ben.wait_for_event("active", "cf1")

    def test_two_people_see_each_others_edits_and_can_undo_them(self):
        ana, ben = self.client(name="Ana"), self.client(name="Ben")
        revision = ben.wait_for_type("targets")["revision"]
        answer = ana.ask(type="edit", id=1, based_on=revision, edits=[EAST])
        self.assertEqual((answer["type"], answer["revision"]), ("ack", revision + 1))
        seen = ben.wait_for(lambda m: m["type"] == "targets" and m["revision"] > revision)
        self.assertEqual((seen["by"], seen["what"], seen["can_undo"]), ("Ana", "east: weight 3", True))
        stale = ben.ask(type="edit", id=1, based_on=revision, edits=[EAST])
        self.assertEqual(stale["code"], "stale")
        self.assertIn("Ana", stale["reason"])
        self.assertEqual(ben.ask(type="undo", id=2, based_on=answer["revision"])["type"], "ack")
        undone = ana.wait_for(lambda m: m["type"] == "targets" and m["by"] == "Ben")
        self.assertEqual({entry["weight"] for entry in undone["clusters"]}, {1.0})

    def test_a_preview_is_a_density_for_who_asked_alone(self):
        ana = self.client()
        revision = ana.wait_for_type("targets")["revision"]
        edits = [{"op": "add_point", "kind": "cluster", "name": "new", "point_m": [0.5, 0.5]}]
        ana.send({"type": "preview_density", "id": 77, "based_on": revision, "edits": edits})
        frame = ana.wait_for(lambda m: m["type"] == "frame" and m["bytes"][4] == 2 and m["bytes"][5] & 1)["bytes"]
        self.assertEqual(struct.unpack_from("<d", frame, 40)[0], 77)
        self.assertEqual(self.client().wait_for_type("targets")["revision"], revision)

    def test_a_look_ahead_answers_with_what_would_be_and_changes_nothing(self):
        ana = self.client()
        revision = ana.wait_for_type("targets")["revision"]
        ana.snapshot()
        edits = [{"op": "add_point", "kind": "cluster", "name": "new", "point_m": [0.5, 0.5]}]
        ana.send({"type": "preview", "id": 78, "seconds": 30, "based_on": revision, "edits": edits, "without": ["cf1"]})
        answer = ana.wait_for(lambda m: m.get("id") == 78)
        self.assertEqual(answer["type"], "preview")
        self.assertEqual(len(answer["as_is"]["areas"]) + 1, len(answer["what_if"]["areas"]))
        self.assertEqual(answer["what_if"]["active"] + 1, answer["as_is"]["active"])
        self.assertEqual([len(places) for places in answer["ghosts"]["xy_m"]], [62] * 3)
        self.assertEqual(answer["as_is"]["in_s"][-1], 30)
        self.assertEqual(self.client().wait_for_type("targets")["revision"], revision)

    def test_a_newer_look_ahead_supersedes_the_same_persons_older_one(self):
        ana = self.client()
        ana.snapshot()
        for request in range(20):
            ana.send({"type": "preview", "id": request, "seconds": 600})
        answers = [ana.wait_for(lambda m, n=request: m.get("id") == n) for request in range(20)]
        self.assertEqual(answers[-1]["type"], "preview")
        self.assertIn("superseded", [answer.get("code") for answer in answers])

    def test_who_edits_what_is_shown(self):
        ana, ben = self.client(name="Ana"), self.client(name="Ben")
        ana.ask(type="editing", id=1, what=[{"kind": "cluster", "name": "east"}])
        present = ben.wait_for(lambda m: m["type"] == "presence"
                               and any(one["editing"] for one in m["operators"]))["operators"]
        self.assertIn([{"kind": "cluster", "name": "east"}], [one["editing"] for one in present])

    def test_a_pause_holds_the_clock_and_commands_are_pending(self):
        ana = self.client()
        self.assertEqual(ana.ask(type="set_speed", id=1, factor=2)["type"], "ack")
        self.assertEqual(ana.ask(type="set_speed", id=2, factor=21)["code"], "invalid")
        self.assertEqual(ana.ask(type="pause", id=3)["type"], "ack")
        paused = ana.wait_for(lambda m: m["type"] == "frame" and m["bytes"][4] == 1 and m["bytes"][5] & 1)
        self.assertIsNotNone(paused)
        self.assertTrue(ana.ask(type="start_afresh", id=4)["pending"])
        self.assertEqual(ana.ask(type="resume_clock", id=5)["type"], "ack")
        self.assertEqual(ana.ask(type="set_speed", id=6, factor=1)["type"], "ack")

    def test_nonsense_is_refused_with_a_reason_and_hurts_nobody(self):
        client = self.client()
        for text, code in [(b"", "malformed"), (b"{", "malformed"), (b"[]", "malformed"), (b"[" * 100_000, "malformed"),
                           (b'{"type":"hold"}', "malformed"), (b'{"type":"hold","id":-1,"drones":"all"}', "malformed"),
                           (b'{"type":"hold","id":1,"drones":"all","x":1}', "malformed"),
                           (b'{"type":"fly","id":1}', "unknown_type")]:  # fmt: skip
            client.send(text)
            answer = client.wait_for_type("refused")
            self.assertEqual(answer["code"], code, text[:40])
            self.assertTrue(answer["reason"])
        client.send(b"\0\1\2", 2)
        self.assertEqual(client.wait_for_type("refused")["code"], "malformed")
        self.assertEqual(client.ask(type="ping", id=9)["type"], "pong")
        client.send(b'"\xff"')  # what is not UTF-8 ends a WebSocket, says its standard
        self.assertTrue(client.is_closed())

    def test_a_flood_is_slowed_down(self):
        client = self.client()
        for number in range(400):
            client.send({"type": "ping", "id": number})
        self.assertEqual(client.wait_for_type("refused")["code"], "too_fast")

    def test_who_says_no_hello_or_too_much_is_shown_the_door(self):
        client = WebSocket(self.program.port)
        client.send({"type": "land_all", "id": 1})
        self.assertEqual(client.wait_for_type("bye")["code"], "no_hello")
        self.assertTrue(client.is_closed())
        large = self.client()
        try:
            large.send(b" " * 10_000_000)
        except ConnectionError:
            pass
        self.assertTrue(large.is_closed())

    def test_pages_of_other_sites_and_other_names_stay_outside(self):
        port = self.program.port
        self.assertEqual(WebSocket(port, headers=["Origin: http://evil.example"]).status, 403)
        self.assertEqual(WebSocket(port, headers=["Origin: null"]).status, 403)
        self.assertEqual(WebSocket(port, headers=[f"Origin: http://127.0.0.1:{port}"]).status, 101)
        self.assertEqual(WebSocket(port, host="evil.example").status, 421)
        self.assertEqual(WebSocket(port, protocol="vigil.v9").status, 400)
        self.assertEqual(WebSocket(port, protocol=None).status, 400)
        self.assertEqual(WebSocket(port, path="/other").status, 404)
        land = {"type": "land_all", "id": 1}
        self.assertEqual(self.program.json("POST", "/api/commands", land, Origin="http://evil.example")[0], 403)
        self.assertEqual(self.program.json("POST", "/api/commands", land, Content_Type="text/plain")[0], 415)
        self.assertEqual(self.program.json("GET", "/api/state", Host="evil.example")[0], 421)

    def test_who_stops_reading_costs_a_bounded_memory_and_others_nothing(self):
        slow = [WebSocket(self.program.port, receive_buffer=4096) for _ in range(10)]
        for one in slow:
            self.addCleanup(one.close)
            one.send({"type": "hello"})
        before = self.program.memory_kib()
        watcher = self.client()
        first = watcher.snapshot()["tick"]
        while watcher.snapshot()["tick"] < first + 150:
            pass
        self.assertLess(self.program.memory_kib() - before, 30_000)

    def test_a_thousand_connections_are_bounded_and_lock_nobody_out(self):
        operator = self.client()
        idle = []
        try:
            for _ in range(1000):
                idle.append(socket.create_connection(("127.0.0.1", self.program.port), PATIENCE_S))
        except OSError:
            pass
        self.assertEqual(operator.ask(type="ping", id=1)["type"], "pong")
        self.assertEqual(self.client().ask(type="ping", id=1)["type"], "pong")
        for one in idle:
            one.close()
        self.assertLess(self.program.memory_kib(), 300_000)


class Rest(unittest.TestCase):
    """The interface of protocol/openapi.json, against that file."""

    @classmethod
    def setUpClass(cls):
        cls.program = paper()
        cls.openapi = json.loads((PROTOCOL / "openapi.json").read_text())
        client = WebSocket(cls.program.port)
        client.hello()
        client.snapshot()
        client.close()

    @classmethod
    def tearDownClass(cls):
        cls.program.__exit__()

    def ask(self, method, path, body=None, **headers):
        """The answer's JSON, held to what the file says of its status."""
        if body is not None:
            headers.setdefault("Content_Type", "application/json")
        status, got, data = self.program.request(method, path, body, **headers)
        responses = self.openapi["paths"][path.partition("?")[0]][method.lower()]["responses"]
        self.assertIn(str(status), responses)
        content = responses[str(status)]["content"]
        kind = got["Content-Type"]
        self.assertIn(kind, content)
        if kind == "application/yaml":
            return status, data.decode()
        found = json.loads(data)
        self.assertEqual(list(complaints(found, content[kind]["schema"], self.openapi)), [])
        return status, found

    def test_every_answer_is_as_described(self):
        self.assertEqual(self.ask("GET", "/api/version")[1]["protocols"], ["vigil.v1"])
        self.assertEqual(len(self.ask("GET", "/api/state")[1]["drones"]), 3)
        self.assertEqual(self.ask("GET", "/api/mission")[1]["name"], "paper")
        self.assertEqual(self.ask("POST", "/api/commands", {"type": "ping", "id": 1})[1]["type"], "pong")
        self.assertEqual(self.ask("POST", "/api/commands", {"type": "hold", "id": 2, "drones": ["cf3"]})[0], 200)
        self.assertEqual(self.ask("POST", "/api/commands", {"type": "hold", "id": 3, "drones": ["x"]})[0], 404)
        self.assertEqual(self.ask("POST", "/api/commands", {"type": "hold"})[0], 400)
        self.assertEqual(self.ask("POST", "/api/commands", b"{")[0], 400)
        self.assertEqual(self.ask("POST", "/api/commands", {"type": "take_off", "id": 4, "drones": ["cf3"]})[0], 409)

    def test_a_look_ahead_is_as_described_and_nonsense_is_refused(self):
        ask = lambda body: self.ask("POST", "/api/preview", body)  # noqa: E731
        self.assertIsNone(ask({})[1]["what_if"])
        self.assertEqual(ask({"seconds": 12})[1]["as_is"]["in_s"], list(range(13)))
        self.assertEqual(len(ask({"without": ["cf1", "cf3"]})[1]["what_if"]["areas"]), 3)
        self.assertEqual(ask({"without": ["x"]})[0], 404)
        point = {"op": "add_point", "kind": "cluster", "name": "new", "point_m": [0.5, 0.5]}
        self.assertEqual(ask({"based_on": 99, "edits": [point]})[0], 409)
        outside = {**point, "point_m": [1e6, 0]}
        for body in [{"seconds": 0}, {"seconds": 601}, {"edits": []}, {"based_on": 1}, {"id": 1}, {"with": []}, [], b"{"]:
            self.assertEqual(ask(body)[0], 400, body)
        self.assertEqual(ask({"based_on": self.ask("GET", "/api/state")[1]["revision"], "edits": [outside]})[0], 400)

    def test_why_a_drone_flies_as_it_does_is_as_described(self):
        status, why = self.ask("GET", "/api/why?drone=cf2")
        self.assertEqual((status, why["drone"]), (200, "cf2"))
        self.assertEqual(self.ask("GET", "/api/why?drone=x")[0], 404)
        self.assertEqual(self.ask("GET", "/api/why")[0], 400)

    def test_the_mission_that_is_saved_is_one(self):
        status, text = self.ask("GET", "/api/mission?format=yaml")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "saved.yaml")
            path.write_text(text)
            check = subprocess.run([VIGIL, "check", path], capture_output=True, text=True, check=False)
        self.assertEqual((status, check.returncode), (200, 0), check.stderr)

    def test_areas_go_out_and_come_in_again(self):
        _, areas = self.ask("GET", "/api/areas")
        areas["features"][0]["properties"]["weight"] = 4
        areas["features"].append({"type": "Feature", "properties": {"name": "hall", "revisit_s": 30}, "geometry": {
            "type": "Polygon", "coordinates": [[[0, 0], [0.5, 0], [0.5, 0.5], [0, 0]]]}})  # fmt: skip
        self.assertEqual(self.ask("POST", "/api/areas", areas)[0], 200)
        _, after = self.ask("GET", "/api/areas")
        self.assertEqual(after["features"][0]["properties"]["weight"], 4)
        self.assertEqual(after["features"][-1]["properties"]["name"], "hall")
        polygons = [[[[x, 0.2], [x + 0.1, 0.2], [x, 0.3], [x, 0.2]]] for x in (0.2, 0.4)]
        wood = {"type": "Feature", "properties": {"name": "wood"},
                "geometry": {"type": "MultiPolygon", "coordinates": polygons}}
        for _ in range(2):  # the second time it replaces what the first one added
            self.assertEqual(self.ask("POST", "/api/areas", {**areas, "features": [wood]})[0], 200)
        names = [one["properties"]["name"] for one in self.ask("GET", "/api/areas")[1]["features"]]
        self.assertEqual([name for name in names if name.startswith("wood")], ["wood-1", "wood-2"])
        self.assertEqual(self.ask("POST", "/api/areas", {**areas, "features": []})[0], 400)

    def test_pages_carry_what_keeps_browsers_careful(self):
        status, headers, _ = self.program.request("GET", "/")
        self.assertEqual(status, 200)
        self.assertIn("frame-ancestors 'none'", headers["Content-Security-Policy"])
        self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
        self.assertEqual(self.program.request("GET", "/../../../etc/passwd")[0], 404)
        self.assertEqual(self.program.request("DELETE", "/")[0], 405)


class Doors(unittest.TestCase):
    def test_tokens_open_roles(self):
        with tempfile.TemporaryDirectory() as folder:
            tokens = pathlib.Path(folder, "tokens")
            tokens.write_text("# who\nviewer viewer-token-0123456789\noperator operator-token-012345\n")
            with paper("--tokens", tokens) as program:
                stranger = WebSocket(program.port)
                stranger.send({"type": "hello", "token": "operator-token-012346"})
                self.assertEqual(stranger.wait_for_type("bye")["code"], "bad_token")
                viewer = WebSocket(program.port)
                self.assertEqual(viewer.hello(token="viewer-token-0123456789")["role"], "viewer")
                self.assertEqual(viewer.ask(type="land_all", id=1)["code"], "not_allowed")
                operator = WebSocket(program.port)
                self.assertEqual(operator.hello(token="operator-token-012345")["role"], "operator")
                self.assertEqual(operator.ask(type="land_all", id=1)["type"], "ack")
                self.assertEqual(operator.ask(type="emergency_stop", id=2, drones="all")["code"], "not_allowed")
                self.assertEqual(program.json("GET", "/api/state")[0], 401)
                bearer = {"Authorization": "Bearer viewer-token-0123456789"}
                self.assertEqual(program.json("GET", "/api/state", **bearer)[0], 200)
                command = {"type": "land_all", "id": 1}
                self.assertEqual(program.json("POST", "/api/commands", command, **bearer)[0], 403)

    def test_tokens_that_can_be_read_on_the_way_are_warned_of(self):
        with tempfile.TemporaryDirectory() as folder:
            tokens = pathlib.Path(folder, "tokens")
            tokens.write_text("viewer viewer-token-0123456789\n")
            for address, is_warned_of in [("0.0.0.0", True), ("127.0.0.1", False)]:
                with paper("--tokens", tokens, "--address", address) as program:
                    program.process.terminate()
                    said = program.process.stdout.read()
                    self.assertEqual("warning: without TLS" in said, is_warned_of, address)

    def test_whoever_has_the_viewers_token_fills_the_console_for_viewers_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            tokens = pathlib.Path(folder, "tokens")
            tokens.write_text("viewer viewer-token-0123456789\nsafety_pilot pilot-token-0123456789\n")
            with paper("--tokens", tokens) as program:
                crowd = [WebSocket(program.port) for _ in range(256)]
                for one in crowd:
                    one.send({"type": "hello", "token": "viewer-token-0123456789"})
                told = [one.wait_for(lambda m: m["type"] in ("hello", "bye")) for one in crowd]
                self.assertEqual(sum(message["type"] == "hello" for message in told), 192)
                self.assertEqual({one["code"] for one in told if one["type"] == "bye"}, {"too_many"})
                pilot = WebSocket(program.port)
                self.assertEqual(pilot.hello(token="pilot-token-0123456789")["role"], "safety_pilot")
                self.assertEqual(pilot.ask(type="emergency_stop", id=1, drones="all")["type"], "ack")
                bearer = {"Authorization": "bearer pilot-token-0123456789"}
                self.assertEqual(program.json("GET", "/api/state", **bearer)[0], 200)

    def test_a_request_for_two_hosts_is_refused(self):
        with paper() as program:
            for target, more in [("/api/state", ""), ("/live", "Upgrade: websocket\r\nConnection: Upgrade\r\n")]:
                with socket.create_connection(("127.0.0.1", program.port), PATIENCE_S) as one:
                    hosts = f"Host: 127.0.0.1:{program.port}\r\nHost: evil.example\r\n"
                    one.sendall(f"GET {target} HTTP/1.1\r\n{hosts}{more}\r\n".encode())
                    self.assertIn(b" 400 ", one.recv(64))

    def test_a_mission_of_the_greatest_size_is_flown_however_json_writes_it(self):
        text = (MISSIONS / "paper.yaml").read_text()
        with paper() as program:
            client = WebSocket(program.port)
            client.hello()
            largest = text + "#" + '"' * ((1 << 20) - len(text.encode()) - 2) + "\n"
            self.assertEqual(client.ask(type="load_mission", id=1, yaml=largest)["type"], "ack")
            answer = client.ask(type="load_mission", id=2, yaml=largest + "#")
            self.assertEqual((answer["type"], answer["code"]), ("refused", "malformed"))

    def refused(self, *arguments):
        command = [VIGIL, "serve", str(MISSIONS / "paper.yaml"), *map(str, arguments)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        self.assertEqual(done.stderr.count("\n"), 1)
        return done.returncode, done.stderr

    def test_what_cannot_be_served_is_refused_with_advice(self):
        code, line = self.refused("--address", "0.0.0.0")
        self.assertEqual(code, 2)
        self.assertIn("--tokens FILE", line)
        self.assertEqual(self.refused("--fleet", "kites")[0], 2)
        self.assertEqual(self.refused("--certificate", "x")[0], 2)
        self.assertEqual(self.refused("--tokens", "/nonexistent")[0], 2)
        with tempfile.TemporaryDirectory() as folder, paper("--state", folder):
            code, line = self.refused("--state", folder)
            self.assertEqual(code, 3)
            self.assertIn(f"{folder}: another vigil keeps its state there; end that one first", line)
        with paper() as program:
            self.assertIn("cannot listen", self.refused("--port", program.port)[1])


class Flights(unittest.TestCase):
    def test_who_knows_the_address_can_ask_for_the_state(self):
        for _ in range(5):
            with paper() as program:
                self.assertEqual(program.json("GET", "/api/state")[0], 200)

    def test_another_mission_can_be_loaded(self):
        with paper() as program:
            client = WebSocket(program.port)
            client.hello()
            text = (MISSIONS / "lab.yaml").read_text()
            self.assertEqual(client.ask(type="load_mission", id=1, yaml="format: 2")["code"], "invalid")
            client.send({"type": "load_mission", "id": 2, "yaml": text})
            mission = client.wait_for(lambda m: m["type"] == "mission" and m["epoch"] == 2)
            self.assertEqual(mission["mission"]["name"], "lab")
            self.assertEqual(client.wait_for(lambda m: m["type"] == "ack")["id"], 2)
            while client.snapshot()["epoch"] != 2:
                pass

    def test_a_recording_is_one_that_a_report_reads(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder, "flight")
            with paper("--record", out) as program:
                client = WebSocket(program.port)
                client.hello()
                client.ask(type="set_speed", id=1, factor=20)
                while client.snapshot()["tick"] < 1500:
                    pass
                self.assertEqual(client.wait_for_type("status")["recording"]["lost_ticks"], 0)
            report = subprocess.run([VIGIL, "report", out], capture_output=True, text=True, check=False)
            self.assertEqual(report.returncode, 0, report.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
