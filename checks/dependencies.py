"""Checks that docs/dependencies.md has one row for each package of setup/packages.txt: python3 checks/dependencies.py ROOT

Prints one line for each difference, and exits 1 if there is one.
"""

import pathlib
import re
import sys

GROUPS = {"build", "run", "test"}


def listed(root):
    """{package: group} of the list that ./run and ./test install from."""
    lines = (root / "setup/packages.txt").read_text().splitlines()
    rows = [line.split(maxsplit=3) for line in lines if line and not line.startswith("#")]
    return {row[0]: row[1] for row in rows}


def documented(root):
    """{package: group} of the table: its first two columns."""
    rows = re.findall(r"^\| `([^`]+)` +\| (\w+)", (root / "docs/dependencies.md").read_text(), re.MULTILINE)
    return dict(rows)


def complaints(root):
    packages, rows = listed(root), documented(root)
    if not packages:
        yield "setup/packages.txt: no package"
    for package in sorted(packages.keys() | rows.keys()):
        if package not in rows:
            yield f"docs/dependencies.md: no row for {package}"
        elif package not in packages:
            yield f"setup/packages.txt: no line for {package}, which docs/dependencies.md has"
        elif packages[package] != rows[package]:
            yield f"{package}: {packages[package]} in setup/packages.txt, {rows[package]} in docs/dependencies.md"
        elif packages[package] not in GROUPS:
            yield f"{package}: no such group as {packages[package]}"


if __name__ == "__main__":
    found = list(complaints(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "The dependencies are as documented.")
    sys.exit(1 if found else 0)
