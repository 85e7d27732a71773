"""Tests who may look at a recording, with tokens over TLS: python3 replay_doors_test.py VIGIL MISSIONS"""

import http.client
import json
import pathlib
import ssl
import subprocess
import sys
import tempfile
import unittest

from console_client import PATIENCE_S, Program, WebSocket

VIGIL, MISSIONS = sys.argv[1], pathlib.Path(sys.argv[2])
VIEWER, OPERATOR = "viewer-token-0123456789", "operator-token-012345"


def make_certificate(folder):
    """key.pem and certificate.pem, for this machine alone."""
    options = "req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 1 -subj /CN=127.0.0.1".split()
    files = ["-addext", "subjectAltName=IP:127.0.0.1", "-keyout", "key.pem", "-out", "certificate.pem"]
    subprocess.run(["openssl", *options, *files], cwd=folder, check=True, capture_output=True)


class RecordingOverTls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.folder.name)
        make_certificate(folder)
        (folder / "tokens").write_text(f"viewer {VIEWER}\noperator {OPERATOR}\n")
        flight = folder / "flight"
        fly = [VIGIL, "simulate", MISSIONS / "paper.yaml", "--out", flight, "--seconds", "5"]
        subprocess.run(fly, check=True, stdout=subprocess.DEVNULL)
        doors = ["--tokens", folder / "tokens", "--certificate", folder / "certificate.pem", "--key", folder / "key.pem"]
        cls.trust = ssl.create_default_context(cafile=folder / "certificate.pem")
        cls.program = Program(VIGIL, flight, *doors, command="replay")

    @classmethod
    def tearDownClass(cls):
        cls.program.__exit__()
        cls.folder.cleanup()

    def get(self, path, token=None):
        """(status, JSON) of an answer over TLS."""
        connection = http.client.HTTPSConnection("127.0.0.1", self.program.port, timeout=PATIENCE_S, context=self.trust)
        connection.request("GET", path, headers={"Authorization": f"Bearer {token}"} if token else {})
        answer = connection.getresponse()
        found = answer.status, json.loads(answer.read())
        connection.close()
        return found

    def client(self, **hello):
        client = WebSocket(self.program.port, tls=self.trust)
        self.addCleanup(client.close)
        client.send({"type": "hello", **hello})
        return client

    def test_without_a_token_nothing_is_shown(self):
        self.assertEqual(self.client().wait_for_type("bye")["code"], "bad_token")
        for path in ("/api/state", "/api/mission", "/api/why?drone=cf1"):
            self.assertEqual(self.get(path)[0], 401, path)

    def test_a_viewer_looks_and_asks_why_and_does_not_move_the_clock(self):
        viewer = self.client(token=VIEWER)
        self.assertEqual(viewer.wait_for_type("mission")["fleet"], "REPLAY")
        self.assertEqual(viewer.ask(type="why", id=1, drone="cf1")["type"], "why")
        self.assertEqual(self.get("/api/why?drone=cf1", VIEWER)[0], 200)
        for command in ({"type": "resume_clock"}, {"type": "seek", "time_s": 3}, {"type": "step", "ticks": 1}):
            self.assertEqual(viewer.ask(id=2, **command)["code"], "not_allowed")
        self.assertEqual(self.get("/api/state", VIEWER)[1]["tick"], 0)

    def test_an_operator_moves_the_clock_and_changes_nothing_else(self):
        operator = self.client(token=OPERATOR)
        self.assertEqual(operator.ask(type="seek", id=1, time_s=2)["type"], "ack")
        self.assertEqual(operator.ask(type="land_all", id=2)["code"], "not_now")
        while operator.snapshot()["tick"] != 100:
            pass
        self.assertEqual(operator.ask(type="seek", id=3, time_s=0)["type"], "ack")
        while operator.snapshot()["tick"] != 0:
            pass

    def test_who_speaks_without_tls_hears_nothing(self):
        with self.assertRaises((EOFError, OSError)):
            WebSocket(self.program.port)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
