"""Checks the few rules of the source tree that a program can check: python3 checks/tree_rules.py ROOT

Prints one line for each place that breaks one, and exits 1 if there is one.
"""

import pathlib
import re
import sys

MAX_LINES = 500
CODE = {".hpp", ".cpp", ".py", ".sh", ".cmake", ".ts", ".tsx", ".mjs", ".css"}
TEXT = CODE | {".md", ".txt", ".yaml", ".json", ".svg", ".html", ".gp", ""}
NOT_OURS = {".git", "build", "out", "node_modules", "dist", "artefacts"}
NOT_TEXT = ("fuzz", "corpus")  # seeds: any bytes

VAGUE_NAMES = {"utils", "util", "common", "helpers", "helper", "manager", "misc"}
UNFINISHED = re.compile(r"\b(?:TODO|FIXME|XXX|HACK)\b")
# A path that holds on one machine only. Web addresses may have such parts: they have no quote or space before them.
ONE_MACHINE = re.compile(r"""(?:^|[\s"'=(`])/(?:work|root|home)/\w""")
MACHINE_PATHS_ALLOWED = {"checks/tree_rules_test.py"}
UNFINISHED_ALLOWED = {"checks/tree_rules.py", "checks/tree_rules_test.py"}


def files_of(root):
    for path in sorted(root.rglob("*")):
        relative = path.relative_to(root)
        if path.is_file() and not NOT_OURS.intersection(relative.parts):
            yield relative


def complaints_about_name(path):
    for word in (*path.parts[:-1], *re.split(r"[_.]", path.name)):
        if word in VAGUE_NAMES:
            yield f"{path}: \"{word}\" does not say what is in it"


def complaints_about_text(path, text):
    lines = text.splitlines()
    if path.suffix in CODE and len(lines) > MAX_LINES:
        yield f"{path}: {len(lines)} lines; at most {MAX_LINES}"
    if path.suffix == ".hpp" and "#pragma once" not in lines:
        yield f"{path}: no #pragma once"
    for number, line in enumerate(lines, start=1):
        if (match := UNFINISHED.search(line)) and str(path) not in UNFINISHED_ALLOWED:
            yield f"{path}:{number}: {match[0]}: finish it, or file it"
        if ONE_MACHINE.search(line) and str(path) not in MACHINE_PATHS_ALLOWED:
            yield f"{path}:{number}: a path of one machine: {line.strip()}"


def complaints_about_test(root, path):
    """A test that no CMakeLists.txt beside it names is never built, and fails nobody."""
    if not path.name.endswith("_test.cpp"):
        return
    lists = root / path.parent / "CMakeLists.txt"
    if not lists.is_file() or not re.search(rf"\b{re.escape(path.name)}\b", lists.read_text()):
        yield f"{path}: no CMakeLists.txt beside it builds this test"


def complaints(root):
    seen = 0
    for path in files_of(root):
        seen += 1
        yield from complaints_about_test(root, path)
        yield from complaints_about_name(path)
        if path.suffix in TEXT and path.parts[:2] != NOT_TEXT:
            yield from complaints_about_text(path, (root / path).read_text())
    if seen == 0:
        yield f"{root}: no file found"


if __name__ == "__main__":
    found = list(complaints(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "The tree keeps its rules.")
    sys.exit(1 if found else 0)
