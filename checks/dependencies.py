"""Checks that docs/dependencies.md has one row for each package that the project takes: python3 checks/dependencies.py ROOT

Debian's are those of setup/packages.txt, with their group; npm's are those of web/package.json, with their exact version.

Prints one line for each difference, and exits 1 if there is one.
"""

import json
import pathlib
import re
import sys

GROUPS = {"build", "run", "ros", "test"}


def listed(root):
    """{package: group} of the list that ./run and ./test install from."""
    lines = (root / "setup/packages.txt").read_text().splitlines()
    rows = [line.split(maxsplit=3) for line in lines if line and not line.startswith("#")]
    return {row[0]: row[1] for row in rows}


def documented(root):
    """{package: group} of the table of Debian's packages: its first two columns."""
    rows = re.findall(r"^\| `([^`]+)` +\| (\w+)", (root / "docs/dependencies.md").read_text(), re.MULTILINE)
    return {package: group for package, group in rows if group not in ("page", "tool")}


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


def npm_packages(root):
    """{package: (group, version)} of web/package.json: `page` is shipped to browsers, `tool` builds and tests the page."""
    path = root / "web/package.json"
    if not path.is_file():
        return {}
    parsed = json.loads(path.read_text())
    members = (("dependencies", "page"), ("devDependencies", "tool"))
    return {name: (group, version) for member, group in members for name, version in parsed.get(member, {}).items()}


def npm_rows(root):
    """{package: (group, version)} of the table of npm packages: its first three columns."""
    text = (root / "docs/dependencies.md").read_text()
    rows = re.findall(r"^\| `([^`]+)` +\| (page|tool) +\| (\S+)", text, re.MULTILINE)
    return {name: (group, version) for name, group, version in rows}


def npm_complaints(root):
    packages, rows = npm_packages(root), npm_rows(root)
    for package in sorted(packages.keys() | rows.keys()):
        if packages.get(package) != rows.get(package):
            yield f"{package}: {packages.get(package)} in web/package.json, {rows.get(package)} in docs/dependencies.md"
        elif not re.fullmatch(r"\d+\.\d+\.\d+", packages[package][1]):
            yield f"web/package.json: {package} has no exact version: {packages[package][1]}"


if __name__ == "__main__":
    root_folder = pathlib.Path(sys.argv[1])
    found = [*complaints(root_folder), *npm_complaints(root_folder)]
    print("\n".join(found) or "The dependencies are as documented.")
    sys.exit(1 if found else 0)
