"""Forty and more malformed missions: each is refused with exit code 2 and one line that names the place, and nothing is made.

Usage: malformed_missions_test.py VIGIL MISSIONS_DIRECTORY
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

VIGIL = sys.argv[1]
PAPER = (pathlib.Path(sys.argv[2]) / "paper.yaml").read_text()

# What is wrong: (text of paper.yaml, what stands there instead, what the message must name).
EDITS = {
    "a word for a number": ("speed_limit_m_s: 0.3", "speed_limit_m_s: fast", "control.speed_limit_m_s"),
    "a quoted number": ("speed_limit_m_s: 0.3", 'speed_limit_m_s: "0.3"', "control.speed_limit_m_s"),
    "a unit in the value": ("speed_limit_m_s: 0.3", "speed_limit_m_s: 0.3 m/s", "control.speed_limit_m_s"),
    "not a number": ("separation_m: 0.2 ", "separation_m: .nan ", "safety.separation_m"),
    "infinite": ("wall_distance_m: 0.17", "wall_distance_m: .inf", "safety.wall_distance_m"),
    "beyond any double": ("wall_distance_m: 0.17", "wall_distance_m: 1e999", "safety.wall_distance_m"),
    "negative separation": ("separation_m: 0.2 ", "separation_m: -0.2 ", "safety.separation_m"),
    "no separation": ("separation_m: 0.2 ", "separation_m: 0 ", "safety.separation_m"),
    "separation larger than the field": ("separation_m: 0.2 ", "separation_m: 4 ", "safety.separation_m"),
    "sensing below R_s + 2 u_max dt": ("sensing_range_m: 0.4", "sensing_range_m: 0.21", "safety.sensing_range_m"),
    "walls felt too late": ("wall_range_m: 0.6", "wall_range_m: 0.17", "safety.wall_range_m"),
    "walls that meet": ("wall_distance_m: 0.17", "wall_distance_m: 1.6", "safety.wall_distance_m"),
    "contact beyond separation": ("contact_distance_m: 0.13", "contact_distance_m: 0.3", "safety.contact_distance_m"),
    "a negative gain": ("pair_gain: 10", "pair_gain: -10", "safety.pair_gain"),
    "a negative speed": ("speed_limit_m_s: 0.3", "speed_limit_m_s: -0.3", "control.speed_limit_m_s"),
    "no rate": ("rate_hz: 50", "rate_hz: 0", "control.rate_hz"),
    "a negative fade": ("fade: 0 ", "fade: -1 ", "control.fade"),
    "an unknown controller": ("controller: gradient", "controller: magic", "control.controller"),
    "an unknown accounting": ("accounting: drone_time", "accounting: dronetime", "control.accounting"),
    "an unknown barrier": ("barrier: paper", "barrier: brick", "safety.barrier"),
    "an unknown key": ("rate_hz: 50", "rate_hertz: 50", "rate_hz"),
    "a key without its unit": ("speed_limit_m_s: 0.3", "speed_limit: 0.3", "speed_limit_m_s"),
    "an unknown section": ("sensor:", "sensors:", "sensor"),
    "a key twice": ("rate_hz: 50", "rate_hz: 50\n  rate_hz: 20", "rate_hz"),
    "two drones of one name": ("{id: cf2,", "{id: cf1,", "drones[1].id"),
    "a drone called all": ("{id: cf2,", "{id: all,", "drones[1].id"),
    "overlapping starts": ("start_m: [0.0, 0.0]", "start_m: [-0.9, -1.0]", "start_m"),
    "a start outside the field": ("start_m: [0.0, 0.0]", "start_m: [0.0, 1.6]", "drones[1].start_m"),
    "a start in the wall's reach": ("start_m: [0.0, 0.0]", "start_m: [0.0, 1.4]", "drones[1].start_m"),
    "a start with one coordinate": ("start_m: [0.0, 0.0]", "start_m: [0.0]", "drones[1].start_m"),
    "a target outside the field": ("[-0.85, 0.70]", "[-1.85, 0.70]", "targets.clusters[0].points_m[0]"),
    "a cluster without points": ("[[0.70, 0.25], [0.90, 0.45], [0.85, 0.10], [0.60, 0.50], [1.00, 0.30]]", "[]",
                                 "targets.clusters[1].points_m"),
    "two clusters of one name": ("name: east", "name: north-west", "targets.clusters[1].name"),
    "a field without width": ("size_m: [3.0, 3.0]", "size_m: [0, 3.0]", "field.size_m"),
    "a field of three sides": ("size_m: [3.0, 3.0]", "size_m: [3.0, 3.0, 3.0]", "field.size_m"),
    "an event for nobody": ("do: land, drone: cf2", "do: land, drone: cf9", "simulation.events[0].drone"),
    "an event that is none": ("do: land,", "do: dance,", "simulation.events[0].do"),
    "an event after the end": ("at_s: 23", "at_s: 1000", "simulation.events[0].at_s"),
    "an event before the beginning": ("at_s: 23", "at_s: -1", "simulation.events[0].at_s"),
    "an event without its drone": ("do: land, drone: cf2", "do: land", "simulation.events[0]"),
    "a target that is not there": ("do: land, drone: cf2", "do: remove_target, cluster: east, target: 9",
                                   "simulation.events[0].target"),
    "no duration": ("duration_s: 120", "duration_s: 0", "simulation.duration_s"),
    "half a seed": ("seed: 1", "seed: 1.5", "simulation.seed"),
    "another format": ("format: 1", "format: 2", "format"),
    "a list for a section": ("sensor:\n  footprint_radius_m: 0.3", "sensor: [0.3]", "sensor"),
    "an anchor and its alias": ("points_m: [[-0.85, 0.70],", "points_m: &a [*a, [-0.85, 0.70],", "alias"),
    "a tag": ("rate_hz: 50", "rate_hz: !!int 50", "tag"),
    "a bracket that stays open": ("size_m: [3.0, 3.0]", "size_m: [3.0, 3.0", ""),
    "a no-fly polygon over a start": ("drones:", "no_fly:\n  - {name: n, outline_m: [[-0.2, -0.2], [0.2, -0.2], "
                                      "[0, 0.2]]}\n\ndrones:", "drones[1].start_m"),
    "a no-fly outline that crosses itself": ("drones:", "no_fly:\n  - {name: n, outline_m: [[0.5, 0.5], [1, 1], [1, 0.5],"
                                             " [0.5, 1]]}\n\ndrones:", "no_fly[0].outline_m"),
}

FILES = {
    "an empty file": b"",
    "only a comment": b"# nothing\n",
    "binary": bytes(range(256)) * 16,
    "not UTF-8": PAPER.encode().replace(b"Three", b"Thr\xe9\xe9"),
    "a NUL": PAPER.encode().replace(b"Three", b"Thr\0ee"),
    "two documents": (PAPER + "---\n" + PAPER).encode(),
    "deep nesting": b"format: " + b"[" * 100_000,
    "an alias bomb": b"a: &a [x,x]\nb: &b [*a,*a]\nc: &c [*b,*b]\nd: [*c,*c]\n",
}


class MalformedMissions(unittest.TestCase):
    def refuse(self, mission, names=""):
        out = mission.with_suffix(".out")
        result = subprocess.run([VIGIL, "simulate", str(mission), "--out", str(out)], capture_output=True, text=True,
                                errors="replace", timeout=20)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(len(result.stderr.strip().split("\n")), 1, result.stderr)
        self.assertTrue(result.stderr.startswith(f"vigil: {mission}"), result.stderr)
        self.assertIn(names, result.stderr)
        self.assertGreater(len(result.stderr), len(f"vigil: {mission}: ") + 15, result.stderr)
        self.assertFalse(out.exists())

    def test_every_edit_of_a_sound_mission_is_refused_by_name(self):
        with tempfile.TemporaryDirectory() as folder:
            for number, (what, (sound, malformed, names)) in enumerate(EDITS.items()):
                with self.subTest(what):
                    self.assertEqual(PAPER.count(sound), 1, f"{sound!r} is not in paper.yaml once")
                    mission = pathlib.Path(folder) / f"edit-{number}.yaml"
                    mission.write_text(PAPER.replace(sound, malformed))
                    self.refuse(mission, names)

    def test_files_that_are_no_mission_at_all_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            for number, (what, content) in enumerate(FILES.items()):
                with self.subTest(what):
                    mission = pathlib.Path(folder) / f"file-{number}.yaml"
                    mission.write_bytes(content)
                    self.refuse(mission)

    def test_what_is_no_ordinary_file_of_a_missions_size_is_refused_at_once(self):
        with tempfile.TemporaryDirectory() as folder:
            huge = pathlib.Path(folder) / "huge.yaml"
            huge.write_bytes(PAPER.encode())
            os.truncate(huge, 100_000_000)
            self.refuse(huge)
            pipe = pathlib.Path(folder) / "pipe.yaml"
            os.mkfifo(pipe)
            self.refuse(pipe)
            self.refuse(pathlib.Path(folder))
            self.refuse(pathlib.Path(folder) / "nowhere.yaml")

    def test_there_are_forty_of_them(self):
        self.assertGreaterEqual(len(EDITS) + len(FILES), 40)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
