"""A ROS graph for tests: roscore, the program and whatever else is started here, all of it on this machine alone.

The command line of the test that imports this: PROGRAM SOURCE_FOLDER PICTURES_FOLDER [unittest's arguments]
"""

import concurrent.futures
import contextlib
import ctypes
import functools
import json
import math
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request
import xmlrpc.client

PROGRAM, SOURCE = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
HOME = pathlib.Path(tempfile.mkdtemp(prefix="vigil-ros-"))


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
PR_SET_PDEATHSIG = 1  # of linux/prctl.h


def end_with_this():
    """In a child: if the test is killed, it is told to end as well."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)


def start(name, *command):
    with open(HOME / f"{name}.log", "w") as log:
        RUNNING[name] = subprocess.Popen(
            [str(part) for part in command], env=ENVIRONMENT, stdout=log, stderr=log, start_new_session=True,
            preexec_fn=end_with_this)  # fmt: skip


def children_of(pid):
    return [int(child) for child in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def is_over(process):
    """The program and whatever it started in its group: `rosbag record` returns before the bag is written."""
    process.poll()
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, 0)
        return False
    return True


def stop(name, how=signal.SIGINT):
    process = RUNNING.pop(name, None)
    if process is None:
        return
    family = children_of(process.pid) if process.poll() is None else []
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, how)
    if how == signal.SIGKILL:  # roscore's children, which it can no longer end, have groups of their own
        for child in family:
            with contextlib.suppress(ProcessLookupError):
                os.kill(child, how)
    end = time.monotonic() + 15
    while not is_over(process):
        if time.monotonic() > end:
            os.killpg(process.pid, signal.SIGKILL)
        time.sleep(0.05)
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


def command(kind, **members):
    body = json.dumps({"id": 1, "type": kind, **members}).encode()
    request = urllib.request.Request(console() + "api/commands", body, {"Content-Type": "application/json"})
    with urllib.request.urlopen(request, timeout=5) as answer:
        assert json.load(answer)["type"] == "ack", answer


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


def end_everything():
    for name in reversed(list(RUNNING)):
        stop(name)


def run_tests():
    """Those of the file that is run, in order; what the programs wrote is kept where one of them fails."""
    done = unittest.main(argv=sys.argv[:1] + sys.argv[4:], verbosity=2, failfast=True, exit=False).result
    if not done.wasSuccessful():
        sys.exit(f"logs of the {len(list(HOME.glob('*.log')))} programs: {HOME}")
    shutil.rmtree(HOME, ignore_errors=True)


def registered():
    """(topic: its publishers, service: its servers), by the master's word; OSError where there is none."""
    with xmlrpc.client.ServerProxy(ENVIRONMENT["ROS_MASTER_URI"]) as master:
        _, _, (publishers, _, services) = master.getSystemState("/ros_test")
    return dict(publishers), dict(services)


def start_roscore():
    start("roscore", "roscore", "-p", ROS_PORT)
    until(lambda: "/rosout_agg" in registered()[0], 60, "roscore")


def echoes(topics):
    """Shows one message of each by `rostopic echo`, a few at a time."""

    def show(topic):
        assert "---" in tool("rostopic", "echo", "-n", "1", topic, seconds=60), topic

    with concurrent.futures.ThreadPoolExecutor(4) as few:
        list(few.map(show, sorted(topics)))


def judge(test, judgement):
    """By what the drones really did, and by the setpoints that they got."""
    print(judgement, file=sys.stderr)
    for rule in ("separation", "wall", "no_fly", "speed"):
        test.assertEqual(judgement[f"{rule}_violations"], 0, judgement)
    # What the program sent, by its stamps; and what came, wherever it waited on this machine: a Crazyflie levels after
    # half a second without a setpoint.
    test.assertLess(judgement["longest_pause_s"], 0.25, judgement)
    test.assertLess(judgement["longest_silence_s"], 0.5, judgement)
    # A Crazyflie without setpoints stops its motors; one on the ground is started by them.
    test.assertEqual(judgement["falls"], 0, judgement)
    test.assertEqual(judgement["starts_by_setpoints"], 0, judgement)
