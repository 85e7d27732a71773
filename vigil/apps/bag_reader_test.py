"""What others make of recordings: every message of a flight, read by an independent reader of rosbag2 directories.

python bag_reader_test.py VIGIL MISSIONS, with the Python that setup/bag-reader.txt was installed for.
"""

import collections
import contextlib
import json
import math
import pathlib
import sqlite3
import subprocess
import sys
import tempfile
import unittest

from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore

VIGIL, MISSIONS = sys.argv[1], pathlib.Path(sys.argv[2])
STANDARD = get_typestore(Stores.ROS2_HUMBLE)  # its own idea of ROS 2's messages, not the bag's


def fly(mission, out, *more):
    subprocess.run([VIGIL, "simulate", MISSIONS / mission, "--out", out, *map(str, more)], check=True,
                   capture_output=True)
    return out / "recording"


def ticks_flown(bag):
    return json.loads((bag.parent / "summary.json").read_text())["ticks"]


class RecordingsReadByOthers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        root = pathlib.Path(cls.folder.name)
        cls.bags = {name: fly(f"{name}.yaml", root / name, "--seconds", 40)
                    for name in ("paper", "wildfire", "vehicles/px4")}

    def test_every_standard_message_is_one_by_the_readers_own_definitions(self):
        for bag in self.bags.values():
            kinds = collections.Counter()
            with Reader(bag) as reader:
                for connection, _, raw in reader.messages():
                    if connection.msgtype.startswith("vigil_msgs/"):
                        continue
                    message = STANDARD.deserialize_cdr(raw, connection.msgtype)
                    self.assertEqual(bytes(STANDARD.serialize_cdr(message, connection.msgtype)), bytes(raw))
                    kinds[connection.msgtype] += 1
            for kind in ("geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/TwistStamped", "nav_msgs/msg/Path",
                         "nav_msgs/msg/OccupancyGrid", "diagnostic_msgs/msg/DiagnosticArray",
                         "visualization_msgs/msg/MarkerArray", "std_msgs/msg/Float64"):
                self.assertGreater(kinds[kind], 0, kind)

    def test_the_definitions_in_the_bag_are_enough_to_read_all_of_it(self):
        for bag in self.bags.values():
            with AnyReader([bag]) as reader:
                counts = collections.Counter()
                for connection, _, raw in reader.messages():
                    reader.deserialize(raw, connection.msgtype)
                    counts[connection.topic] += 1
                self.assertEqual(counts, {c.topic: c.msgcount for c in reader.connections if c.msgcount})
                self.assertEqual(sum(counts.values()), reader.message_count)
                self.assertEqual(counts["/vigil/tick"], ticks_flown(bag))

    def test_poses_are_what_the_controller_knew_in_the_world_frame(self):
        bag = self.bags["paper"]
        with AnyReader([bag]) as reader:
            ticks, poses = {}, []
            for connection, stamp, raw in reader.messages():
                message = reader.deserialize(raw, connection.msgtype)
                if connection.topic == "/vigil/tick":
                    ticks[stamp] = message
                elif connection.topic == "/cf2/pose":
                    poses.append((stamp, message))
        self.assertAlmostEqual(len(poses), 400, delta=1)  # 10 Hz
        for stamp, message in poses:
            self.assertEqual(message.header.frame_id, "map")
            self.assertEqual(message.header.stamp.sec * 10**9 + message.header.stamp.nanosec, stamp)
            observed = ticks[stamp].observed[8:16]  # of the second drone
            position = message.pose.position
            self.assertAlmostEqual(position.x, observed[0] - 1.5, places=12)  # the paper's origin
            self.assertAlmostEqual(position.y, observed[1] - 1.5, places=12)
            turn = message.pose.orientation
            self.assertAlmostEqual(math.hypot(turn.x, turn.y, turn.z, turn.w), 1.0)

    def test_the_density_is_a_grid_of_the_field(self):
        for bag in self.bags.values():
            with AnyReader([bag]) as reader:
                connections = [c for c in reader.connections if c.topic == "/vigil/density"]
                for connection, _, raw in reader.messages(connections):
                    grid = reader.deserialize(raw, connection.msgtype)
                    self.assertEqual(len(grid.data), grid.info.width * grid.info.height)
                    self.assertEqual(max(grid.data), 100)
                    self.assertGreaterEqual(min(grid.data), 0)

    def test_the_files_are_sound_databases(self):
        for bag in self.bags.values():
            for file in bag.glob("*.db3"):
                with contextlib.closing(sqlite3.connect(file)) as database:
                    self.assertEqual(database.execute("PRAGMA integrity_check").fetchall(), [("ok",)])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
