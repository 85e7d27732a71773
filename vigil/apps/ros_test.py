"""The paper's experiment over ROS topics, seen in the real RViz: ros_test.py PROGRAM SOURCE_FOLDER PICTURES_FOLDER

Starts roscore, RViz on a display of its own (Xvfb), the stand-ins for Crazyswarm and vicon_bridge, and the program; flies,
looks, clicks, records, and breaks one thing after the other. All of it on this machine alone. One flight, in the order of
the tests' numbers, and another one of ten drones.
"""

import contextlib
import functools
import json
import math
import os
import pathlib
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request

PROGRAM, SOURCE, PICTURES = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
MISSION = SOURCE / "missions/paper.yaml"
HOME = pathlib.Path(tempfile.mkdtemp(prefix="vigil-ros-"))
WIDTH, HEIGHT = 1200, 900
VIEW = (370, 1180), (70, 865)  # of RViz' window: where it draws
BORDER = (217, 217, 217)
GREENS = [(0, 255, 0), (0, 191, 31), (0, 128, 61)]
EVERY_TOPIC = (
    "/diagnostics", "/vigil/active_drones", "/vigil/cf1/age_s", "/vigil/cf1/path", "/vigil/density", "/vigil/density_grid",
    "/vigil/drones", "/vigil/metric_percent", "/vigil/oldest_link_s", "/vigil/oldest_position_s",
    "/vigil/smallest_distance_m", "/vigil/targets", "/vigil/trails", "/vicon/cf1/cf1", "/laboratory/bodies",
)  # fmt: skip


TEN_DRONES = """
format: 1
name: ten
field: {size_m: [3.0, 3.0], origin_m: [-1.5, -1.5]}
targets:
  clusters:
    - {name: west, points_m: [[-0.7, 0.5], [-0.5, 0.8]]}
    - {name: east, points_m: [[0.7, -0.2], [0.9, 0.1]]}
drone_grid: {count: 10, prefix: cf}
control: {rate_hz: 200, speed_limit_m_s: 0.3}
safety: {separation_m: 0.2, contact_distance_m: 0.13, wall_distance_m: 0.17}
simulation:
  vehicle: {model: first_order_lag, lag_s: 0.3, altitude_m: 0.5, take_off_s: 1.5, landing_s: 1.5}
"""


def free_port():
    """Below those that the system hands out by itself: nobody takes it meanwhile."""
    for port in range(11400 + os.getpid() % 1000, 20000):
        with socket.socket() as probe, contextlib.suppress(OSError):
            probe.bind(("127.0.0.1", port))
            return port
    raise AssertionError("no port is free")


ROS_PORT, DISPLAY = free_port(), f":{100 + os.getpid() % 400}"
ENVIRONMENT = {
    **os.environ,
    "ROS_MASTER_URI": f"http://127.0.0.1:{ROS_PORT}", "ROS_IP": "127.0.0.1", "HOME": str(HOME), "ROS_HOME": str(HOME / "ros"),
    "ROS_LOG_DIR": str(HOME / "log"), "ROS_PACKAGE_PATH": "/usr/share", "LIBGL_ALWAYS_SOFTWARE": "1", "DISPLAY": DISPLAY,
    "PATH": "/usr/bin:/bin:" + os.environ.get("PATH", ""),
}  # fmt: skip
ENVIRONMENT.pop("ROS_HOSTNAME", None)
RUNNING = {}


def start(name, *command):
    with open(HOME / f"{name}.log", "w") as log:
        RUNNING[name] = subprocess.Popen([str(part) for part in command], env=ENVIRONMENT, stdout=log, stderr=log, start_new_session=True)


def children_of(pid):
    return [int(child) for child in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def stop(name, how=signal.SIGINT):
    process = RUNNING.pop(name, None)
    if process is None:
        return
    family = children_of(process.pid)
    os.killpg(process.pid, how)
    if how == signal.SIGKILL:  # roscore's children, which it can no longer end, have groups of their own
        for child in family:
            with contextlib.suppress(ProcessLookupError):
                os.kill(child, how)
    try:
        process.wait(15)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def until(condition, seconds, what):
    """Waits for a condition of the running system; the last resort of a test that must not guess how long."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        with contextlib.suppress(OSError, KeyError, IndexError, TypeError, ValueError):
            if found := condition():
                return found
        time.sleep(0.1)
    raise AssertionError(f"{what}: not within {seconds} s; drones: {drones()}")


def console():
    """The address that the program printed."""
    return (HOME / "vigil.log").read_text().split(" at ")[1].split()[0]


def state():
    with urllib.request.urlopen(console() + "api/state", timeout=5) as answer:
        return json.load(answer)


def drones():
    with contextlib.suppress(OSError, KeyError, IndexError, TypeError):
        return {drone["id"]: (drone["activity"], drone["mode"]) for drone in state()["drones"]}
    return {}


def are(activity, *ids):
    now = drones()
    return bool(now) and all(now[one][0] == activity for one in ids)


def distance_m(one, other):
    places = {drone["id"]: drone["position_m"] for drone in state()["drones"]}
    return math.dist(places[one], places[other])


def tool(*command, seconds=30):
    done = subprocess.run(
        [str(part) for part in command], env=ENVIRONMENT, capture_output=True, text=True, timeout=seconds, check=False
    )
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.stdout}{done.stderr}")
    return done.stdout


def service(name):
    answer = tool("rosservice", "call", name)
    assert "success: True" in answer, answer
    return answer


def publish(topic, kind, value):
    """By rostopic, a node of its own, as anybody outside of the program would."""
    tool("rostopic", "pub", "-1", topic, kind, value)


@functools.cache
def faults():
    """A publisher that is there already when it is needed: drones that are lost for five seconds land."""
    import rospy  # of ROS' packages in Debian
    from std_msgs.msg import String

    os.environ.update(ENVIRONMENT)
    rospy.init_node("faults", disable_signals=True)
    return rospy.Publisher("/laboratory/fault", String, queue_size=1, latch=True)


def fault(what):
    faults().publish(what)


class Picture:
    """The display as it is now; places in metres of the mission's world."""

    def __init__(self, name):
        path = PICTURES / f"{name}.png"
        tool("import", "-window", "root", path)
        self.bytes = subprocess.run(
            ["convert", str(path), "-depth", "8", "rgb:-"], env=ENVIRONMENT, capture_output=True, check=True
        ).stdout
        across, down = range(*VIEW[0]), range(*VIEW[1])
        rows = [y for y in down if sum(self.is_like(x, y, BORDER) for x in across) > 300]
        columns = [x for x in across if sum(self.is_like(x, y, BORDER) for y in down) > 300]
        assert rows and columns, "the field's border is not in the picture"
        self.left, self.right, self.top, self.bottom = columns[0], columns[-1], rows[0], rows[-1]

    def at(self, x, y):
        begin = 3 * (y * WIDTH + x)
        return tuple(self.bytes[begin : begin + 3])

    def is_like(self, x, y, colour, tolerance=3):
        return all(abs(a - b) <= tolerance for a, b in zip(self.at(x, y), colour))

    def pixel(self, place_m):
        x = self.left + (place_m[0] + 1.5) / 3.0 * (self.right - self.left)
        y = self.bottom - (place_m[1] + 1.5) / 3.0 * (self.bottom - self.top)
        return round(x), round(y)

    def count(self, colour):
        return sum(
            self.is_like(x, y, colour)
            for y in range(self.top, self.bottom)
            for x in range(self.left, self.right)
        )

    def redness(self, place_m, within_px=6):
        """The median red of the pixels around a place on which nothing but the density is drawn."""
        cx, cy = self.pixel(place_m)
        box = [
            self.at(x, y)
            for x in range(cx - within_px, cx + within_px + 1)
            for y in range(cy - within_px, cy + within_px + 1)
        ]
        reds = sorted(red for red, green, blue in box if green < 40 and blue < 45)
        return reds[len(reds) // 2] if len(reds) > 10 else None


def end_everything():
    for name in reversed(list(RUNNING)):
        stop(name)
    print(f"logs of the {len(list(HOME.glob('*.log')))} programs: {HOME}", file=sys.stderr)


def start_roscore():
    start("roscore", "roscore", "-p", ROS_PORT)

    def answers():
        return "/rosout" in tool("rostopic", "list", seconds=10)

    end = time.monotonic() + 30
    while True:
        with contextlib.suppress(AssertionError, subprocess.TimeoutExpired):
            if answers():
                return
        assert time.monotonic() < end, "roscore does not come up"
        time.sleep(0.3)


class TheLaboratory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.addClassCleanup(end_everything)
        PICTURES.mkdir(parents=True, exist_ok=True)
        start("xvfb", "Xvfb", DISPLAY, "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-nolisten", "tcp")
        start_roscore()
        start("crazyswarm", PROGRAM, "laboratory", MISSION, "--only", "crazyswarm", "--out", HOME / "judgement.json")
        start("vicon", PROGRAM, "laboratory", MISSION, "--only", "vicon")
        start("vigil", PROGRAM, "serve", MISSION, "--fleet", "ros", "--port", "0")
        start("rviz", "rviz", "-d", SOURCE / "rviz/vigil.rviz")
        until(lambda: are("grounded", "cf1", "cf2", "cf3"), 30, "three drones on the ground")

    def test_01_the_papers_experiment_flies_over_topics(self):
        service("/vigil/take_off_all")
        until(lambda: are("active", "cf1", "cf2", "cf3"), 15, "three drones cover")
        service("/vigil/start_afresh")
        cls = type(self)
        cls.began_s = state()["time_s"]
        start("rosbag", "rosbag", "record", "-a", "-O", HOME / "flight.bag")
        until(lambda: state()["time_s"] - cls.began_s >= 22.5, 60, "23 s")
        publish("/vigil/land", "std_msgs/String", "data: cf2")
        until(lambda: are("grounded", "cf2"), 5, "cf2 on the ground")
        cls.landed = Picture("landed")
        self.assertTrue(are("active", "cf1", "cf3"), drones())

    def test_02_every_topic_can_be_echoed(self):
        waiting = {
            topic: subprocess.Popen(
                ["rostopic", "echo", "-n", "1", topic], env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE
            )
            for topic in EVERY_TOPIC
        }
        for topic, process in waiting.items():
            out, error = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 0, f"{topic}: {error}")
            self.assertIn(b"---", out, topic)

    def test_03_the_metric_comes_down_to_five_percent(self):
        until(lambda: state()["time_s"] - self.began_s >= 120, 150, "120 s")
        stop("rosbag")
        percent = state()["metric_percent"]
        print(f"metric: {percent:.2f} % of its first value", file=sys.stderr)
        self.assertLess(percent, 5.0)

    def test_04_the_picture_is_the_papers(self):
        picture = Picture("paper")
        for colour in GREENS:
            self.assertGreater(picture.count(colour), 150, colour)
        # The landed drone's trail has ended, the others' go on.
        self.assertLessEqual(picture.count(GREENS[1]), 1.05 * self.landed.count(GREENS[1]))
        self.assertGreater(picture.count(GREENS[0]), 1.2 * self.landed.count(GREENS[0]))

    def test_05_red_fades_with_the_density(self):
        near, far = [], []
        for mean in ((-0.74, 0.77), (0.81, 0.32), (-0.08, -0.82)):
            for dx in (-1, 0, 1):
                for dy in (-1, 0, 1):
                    near.append(self.landed.redness((mean[0] + 0.1 * dx, mean[1] + 0.1 * dy)))
                    far.append(self.landed.redness((mean[0] + 0.42 * dx, mean[1] + 0.42 * dy)) if dx or dy else None)
        nowhere = self.landed.redness((0.0, 1.35))
        near = sorted(red for red in near if red is not None)
        far = sorted(red for red in far if red is not None)
        self.assertGreater(near[len(near) // 2], 150)
        self.assertGreater(near[len(near) // 2], 2 * far[len(far) // 2])
        self.assertGreater(far[len(far) // 2], nowhere)

    def test_06_a_click_becomes_a_target(self):
        place_m = (1.15, -1.1)
        before = Picture("before-click")
        x, y = before.pixel(place_m)
        tool("xdotool", "mousemove", 272, 42, "click", 1)
        time.sleep(0.5)  # RViz changes its tool
        tool("xdotool", "mousemove", x - 1, y)
        time.sleep(0.3)  # and looks where the mouse is, once a frame
        tool("xdotool", "mousemove", x, y)
        time.sleep(0.3)
        tool("xdotool", "click", 1)
        until(lambda: any(area["name"] == "rviz-1" for area in state()["areas"]), 10, "a cluster of the clicked target")
        until(lambda: (Picture("clicked").redness(place_m) or 0) > before.redness(place_m) + 15, 10, "red at the click")

    def test_07_what_was_recorded_can_be_looked_at_and_played(self):
        info = tool("rosbag", "info", HOME / "flight.bag")
        for topic in (*EVERY_TOPIC, "/cf1/cmd_velocity_world"):
            self.assertIn(topic + " ", info)
        playing = subprocess.Popen(
            ["rosbag", "play", "--quiet", "-u", "10", str(HOME / "flight.bag"), "--topics", "/vigil/metric_percent",
             "/vigil/metric_percent:=/played"], env=ENVIRONMENT, stdout=subprocess.DEVNULL)  # fmt: skip
        self.assertIn("data:", tool("rostopic", "echo", "-n", "1", "/played"))
        playing.terminate()
        playing.wait(10)

    def recovers(self):
        until(lambda: are("active", "cf1", "cf3"), 15, "both drones cover again")

    def test_08_drones_hover_while_nobody_sees_them_and_go_on(self):
        stop("vicon", signal.SIGKILL)
        until(lambda: are("tracking_lost", "cf1", "cf3"), 3, "both drones are lost")
        start("vicon", PROGRAM, "laboratory", MISSION, "--only", "vicon")
        self.recovers()

    def test_09_a_tracker_that_repeats_itself_is_noticed(self):
        fault("freeze")
        until(lambda: are("tracking_lost", "cf1", "cf3"), 3, "both drones are lost")
        fault("none")
        self.recovers()

    def test_10_bodies_that_swap_their_names_are_noticed(self):
        until(lambda: distance_m("cf1", "cf3") > 0.8, 60, "two drones so far apart that a swap can be told from flying")
        fault("swap cf1 cf3")
        until(lambda: are("tracking_lost", "cf1", "cf3"), 3, "both drones are lost")
        fault("none")
        self.recovers()

    def test_11_positions_that_are_late_are_noticed(self):
        fault("delay 0.3")
        until(lambda: are("tracking_lost", "cf1", "cf3"), 3, "both drones are lost")
        fault("none")
        self.recovers()

    def test_12_a_new_roscore_finds_everybody(self):
        stop("roscore", signal.SIGKILL)
        time.sleep(3)  # for so long there is none
        self.assertTrue(are("active", "cf1", "cf3"), drones())
        start_roscore()
        until(lambda: "/vigil/density" in tool("rostopic", "list"), 15, "the program's topics")
        until(lambda: "/cf1/land" in tool("rosservice", "list"), 15, "the stand-in's services")
        stop("vicon", signal.SIGKILL)
        start("vicon", PROGRAM, "laboratory", MISSION, "--only", "vicon")
        time.sleep(1)  # until the old one is missed
        self.recovers()

    def test_13_nobody_came_too_close_and_the_stream_never_paused(self):
        service("/vigil/land_all")
        until(lambda: are("grounded", "cf1", "cf2", "cf3"), 15, "all on the ground")
        stop("crazyswarm")
        judgement = json.loads((HOME / "judgement.json").read_text())
        print(judgement, file=sys.stderr)
        for rule in ("separation", "wall", "no_fly", "speed"):
            self.assertEqual(judgement[f"{rule}_violations"], 0, judgement)
        self.assertGreater(judgement["setpoints"], 120 * 45)
        self.assertLess(judgement["longest_silence_s"], 0.25)

    def test_14_the_program_is_alive_and_ends_when_asked(self):
        process = RUNNING["vigil"]
        self.assertIsNone(process.poll())
        stop("vigil")
        self.assertEqual(process.returncode, 0)


def z_of(message, has_child):
    """The third number behind the header (and the child's frame) of a message's bytes: its height, or vertical velocity."""
    at = 12
    for _ in range(2 if has_child else 1):
        at += 4 + struct.unpack_from("<I", message, at)[0]
    return struct.unpack_from("<3d", message, at)[2]


def latencies_ms(bag, altitude_m):
    """From each position to the first velocity that was made of it: the vertical velocity is the altitude less the height
    that it was made of, and heights have noise by which they are known."""
    import rosbag  # of ROS' packages in Debian

    seen, latencies = {}, []
    for topic, message, when in rosbag.Bag(str(bag)).read_messages(raw=True):
        is_position = topic.startswith("/vicon")
        drone = topic.split("/")[-1 if is_position else 1]
        if is_position:
            seen[drone, round(z_of(message[1], True), 9)] = when.to_sec()
            continue
        made_of = (drone, round(altitude_m - z_of(message[1], False), 9))
        if made_of in seen:
            latencies.append(1e3 * (when.to_sec() - seen.pop(made_of)))
    return sorted(latencies)


class TenDrones(unittest.TestCase):
    """Positions by tf, a hundred a second; two hundred ticks."""

    @classmethod
    def setUpClass(cls):
        cls.addClassCleanup(end_everything)
        mission = HOME / "ten.yaml"
        mission.write_text(TEN_DRONES)
        start_roscore()
        start("laboratory", PROGRAM, "laboratory", mission)
        start("vigil", PROGRAM, "serve", mission, "--fleet", "ros", "--ros-tf", "--port", "0")
        cls.ids = [f"cf{number}" for number in range(1, 11)]
        until(lambda: are("grounded", *cls.ids), 30, "ten drones on the ground")

    def test_half_of_all_velocities_follow_their_positions_within_ten_milliseconds(self):
        service("/vigil/take_off_all")
        until(lambda: are("active", *self.ids), 20, "ten drones cover")
        bag = HOME / "ten.bag"
        topics = [f"/vicon/{one}/{one}" for one in self.ids] + [f"/{one}/cmd_velocity_world" for one in self.ids]
        start("rosbag", "rosbag", "record", "-O", bag, *topics)
        began_s = state()["time_s"]
        until(lambda: state()["time_s"] - began_s > 15, 30, "15 s of flight")
        stop("rosbag")
        found = latencies_ms(bag, altitude_m=0.5)
        median, p99 = found[len(found) // 2], found[len(found) * 99 // 100]
        print(f"position to velocity: {len(found)}, median {median:.2f} ms, p99 {p99:.2f} ms", file=sys.stderr)
        self.assertGreater(len(found), 10 * 100 * 10)
        # The slowest are those for which stand-in and recorder waited on a busy machine: they are printed, not judged.
        self.assertLess(median, 10.0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:], verbosity=2, failfast=True)
