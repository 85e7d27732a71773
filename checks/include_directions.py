"""Checks that includes follow the arrows between the rooms: python3 checks/include_directions.py ROOT

What each room may include is the table below; ARCHITECTURE.md says why. Prints one line for each include that is not
allowed, and exits 1 if there is one.
"""

import pathlib
import re
import sys

CORE = ("core/field", "core/parallel", "core/ergodic", "core/safety", "core/dynamics", "core/guidance")

# room: the other rooms that it may include.
ARROWS = {
    "core/field": (),
    "core/parallel": (),
    "core/ergodic": ("core/field",),
    "core/safety": ("core/field", "core/parallel"),
    "core/dynamics": ("core/field",),
    "core/guidance": ("core/field", "core/safety"),
    "swarm": CORE,
    "runtime": (*CORE, "swarm"),
    "adapters": (*CORE, "swarm", "runtime", "protocol"),  # each adapter is a room of its own: never another one
    "apps": (*CORE, "swarm", "runtime", "adapters", "protocol"),
    "testing": (*CORE, "swarm", "runtime"),
    "bench": (*CORE, "swarm", "runtime", "adapters", "apps", "protocol", "testing"),
    "fuzz": (*CORE, "swarm", "runtime", "adapters", "protocol", "testing"),
}

# room: the libraries beside the standard one that it may include, by the first part of the name in angle brackets.
LIBRARIES = {
    **{room: ("Eigen",) for room in (*CORE, "swarm")},
    "runtime": ("Eigen", "fmt", "yaml-cpp", "nlohmann"),
    "adapters": None,  # any: that is what an adapter is for
    "apps": ("Eigen", "fmt", "CLI", "nlohmann"),
    "testing": ("Eigen", "fmt", "gtest", "rapidcheck", "nlohmann"),
    "bench": ("Eigen", "fmt", "benchmark", "nlohmann"),
    "fuzz": ("Eigen", "boost"),
}
TEST_LIBRARIES = ("gtest", "gmock", "rapidcheck", "nlohmann")

# Pure rooms: no clock, thread, file, log, global random numbers. Who owns threads is what core/parallel is for.
PURE = (*(room for room in CORE if room != "core/parallel"), "swarm")
IMPURE_HEADERS = {
    "atomic", "barrier", "condition_variable", "coroutine", "csignal", "cstdio", "ctime", "filesystem", "fstream",
    "future", "iostream", "latch", "mutex", "random", "semaphore", "shared_mutex", "stop_token", "syncstream", "thread",
}  # fmt: skip
IMPURE_NAMES = re.compile(r"\b(?:system_clock|steady_clock|high_resolution_clock|random_device|s?rand(?=\())")

# C's and the system's headers, which the rooms that meet the world may use.
SYSTEM_FOLDERS = ("arpa", "linux", "net", "netinet", "sys")

# What a processor's vector instructions are called in C: pure arithmetic.
INTRINSICS = ("immintrin.h",)

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def room_of(path):
    """The room of a file or of a quoted include, by its path from the root; None outside of the rooms.

    An adapter's room is "adapters/NAME".
    """
    parts = path.parts
    if parts[:1] == ("vigil",):
        parts = parts[1:]
        depth = 2 if parts[:1] in (("core",), ("adapters",)) else 1
        room = "/".join(parts[:depth])
    else:
        room = parts[0]
    return room if room == "protocol" or kind_of(room) in ARROWS else None


def kind_of(room):
    return "adapters" if room.startswith("adapters/") else room


def is_test(path):
    return path.stem.endswith("_test")


def rooms_ahead(path, room):
    """What `path` in `room` may include, itself aside."""
    rooms = ARROWS[kind_of(room)]
    return (*rooms, "testing") if is_test(path) else rooms


def complaint_about_ours(root, path, room, name):
    target = pathlib.PurePosixPath(name)
    target_room = room_of(target)
    if target_room is None:
        return "is not written from the root, as in \"vigil/core/field/field.hpp\""
    if not (root / target).is_file():
        return "does not exist"
    if is_test(target) and not is_test(path):
        return "is a test's"
    allowed = rooms_ahead(path, room)
    if target_room != room and kind_of(target_room) not in allowed:
        return f"points from {room} to {target_room}; allowed: {', '.join(allowed) or 'none'}"
    return None


def complaint_about_library(path, room, name):
    if name in INTRINSICS:
        return None
    library, slash, _ = name.partition("/")
    pure = room in PURE and not is_test(path)
    if not slash and not name.endswith(".h"):
        return "is not for a pure room" if pure and name in IMPURE_HEADERS else None
    if not slash or library in SYSTEM_FOLDERS:
        return "is not for a pure room" if room in PURE else None
    allowed = LIBRARIES[kind_of(room)]
    if allowed is None or library in allowed or (is_test(path) and library in TEST_LIBRARIES):
        return None
    return f"is a library that {room} does without; allowed: {', '.join(allowed)}"


def complaints_in(root, path):
    """Yields "file:line: what is wrong" for one file, whose path is relative to the root."""
    room = room_of(path)
    if room is None:
        yield f"{path}:1: is in no room; rooms: {', '.join(ARROWS)}"
        return
    for number, line in enumerate((root / path).read_text().splitlines(), start=1):
        if match := INCLUDE.match(line):
            quote, name = match.groups()
            local = room in ("bench", "fuzz") and "/" not in name  # what the build writes beside them
            if quote == "<":
                wrong = complaint_about_library(path, room, name)
            else:
                wrong = None if local else complaint_about_ours(root, path, room, name)
            if wrong:
                yield f"{path}:{number}: {name} {wrong}"
        elif room in PURE and not is_test(path) and (match := IMPURE_NAMES.search(line.partition("//")[0])):
            yield f"{path}:{number}: {match[0]} is not for a pure room"


def complaints(root):
    files = [p for top in ("vigil", "bench", "fuzz") for p in sorted((root / top).rglob("*.[ch]pp"))]
    if not files:
        yield f"{root}: no source found"
    for file in files:
        yield from complaints_in(root, file.relative_to(root))


if __name__ == "__main__":
    found = list(complaints(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "Every include follows the arrows.")
    sys.exit(1 if found else 0)
