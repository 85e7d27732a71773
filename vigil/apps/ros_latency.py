"""How long velocities take after the positions that they are made of, over real topics: ros_latency.py PROGRAM SOURCE_FOLDER

Ten drones behind the stand-ins, a hundred positions a second each, two hundred ticks. It prints the median and the 99th
percentile with the bar that they are held to; a busy machine, on which the stand-ins wait for each other, misses it."""

import os
import shutil
import struct
import sys

from ros_graph import HOME, PROGRAM, are, end_everything, service, start, start_roscore, state, stop, until

BAR_MS = 10
SECONDS = 15
ROOM = """
format: 1
field: {size_m: [3.0, 3.0], origin_m: [-1.5, -1.5]}
safety: {separation_m: 0.2, contact_distance_m: 0.13, wall_distance_m: 0.17}
"""
# What comes late on a busy machine (0.05 s at 0.3 m/s, of two drones) is no part of the simulated vehicle.
TEN_DRONES = ROOM.replace("wall_distance_m: 0.17", "wall_distance_m: 0.17, pair_margin_m: 0.03") + """
name: ten
targets:
  clusters:
    - {name: west, points_m: [[-0.7, 0.5], [-0.5, 0.8]]}
    - {name: east, points_m: [[0.7, -0.2], [0.9, 0.1]]}
drone_grid: {count: 10, prefix: cf}
control: {rate_hz: 200, speed_limit_m_s: 0.3}
simulation:
  vehicle: {model: first_order_lag, lag_s: 0.3, altitude_m: 0.5, take_off_s: 1.5, landing_s: 1.5}
"""
TEN_IDS = [f"cf{number}" for number in range(1, 11)]


def stamp_s(message):
    seconds, nanoseconds = struct.unpack_from("<II", message, 4)
    return seconds + 1e-9 * nanoseconds


def z_of(message, has_child):
    """The third number behind the header (and the child's frame) of a message's bytes: its height, or vertical velocity."""
    at = 12
    for _ in range(2 if has_child else 1):
        at += 4 + struct.unpack_from("<I", message, at)[0]
    return struct.unpack_from("<3d", message, at)[2]


def latencies_ms(bag, altitude_m):
    """From each position to the first velocity that was made of it, as (by their stamps, by when the recorder got them):
    the vertical velocity is the altitude less the height that it was made of, and heights have noise by which they are
    known."""
    import rosbag  # of ROS' packages in Debian

    seen, latencies = {}, []
    for topic, (_, message, *_), when in rosbag.Bag(str(bag)).read_messages(raw=True):
        is_position = topic.startswith("/vicon")
        drone = topic.split("/")[-1 if is_position else 1]
        if is_position:
            seen[drone, round(z_of(message, True), 9)] = stamp_s(message), when.to_sec()
            continue
        made_of = (drone, round(altitude_m - z_of(message, False), 9))
        if made_of in seen:
            measured_s, recorded_s = seen.pop(made_of)
            latencies.append((1e3 * (stamp_s(message) - measured_s), 1e3 * (when.to_sec() - recorded_s)))
    return latencies


def figures(latencies):
    ordered = sorted(latencies)
    return ordered[len(ordered) // 2], ordered[len(ordered) * 99 // 100]


def start_ten_drones():
    """On the ground, with all that flies them; their mission is in HOME / "ten.yaml"."""
    mission = HOME / "ten.yaml"
    mission.write_text(TEN_DRONES)
    start_roscore()
    start("laboratory", PROGRAM, "laboratory", mission, "--out", HOME / "ten.json")
    start("vigil", PROGRAM, "serve", mission, "--fleet", "ros", "--ros-tf", "--port", "0")
    until(lambda: are("grounded", *TEN_IDS), 30, "ten drones on the ground")


def measured():
    """Latencies of ten drones that take off now, and are left in the air."""
    service("/vigil/take_off_all")
    until(lambda: are("active", *TEN_IDS), 20, "ten drones cover")
    bag = HOME / "ten.bag"
    topics = [f"/vicon/{one}/{one}" for one in TEN_IDS] + [f"/{one}/cmd_velocity_world" for one in TEN_IDS]
    start("rosbag", "rosbag", "record", "-O", bag, *topics)
    began_s = state()["time_s"]
    until(lambda: state()["time_s"] - began_s > SECONDS, 2 * SECONDS, f"{SECONDS} s of flight")
    stop("rosbag")
    return latencies_ms(bag, altitude_m=0.5)


def tell(latencies):
    sent = figures([by_stamps for by_stamps, _ in latencies])
    recorded = figures([as_recorded for _, as_recorded in latencies])
    print(
        f"position in to velocity out, {len(latencies)} of ten drones: median {sent[0]:.1f} ms, p99 {sent[1]:.1f} ms"
        f" (asked: p99 {BAR_MS} ms); as a recorder saw it {recorded[0]:.1f} ms, {recorded[1]:.1f} ms;"
        f" load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores",
        file=sys.stderr,
    )


if __name__ == "__main__":
    try:
        start_ten_drones()
        tell(measured())
    finally:
        end_everything()
        shutil.rmtree(HOME, ignore_errors=True)
