# shellcheck shell=bash
# Sourced by ./run and ./test: installs what is missing, configures and builds.
# Everything said here goes to stderr; stdout belongs to the program that is run.
# Expects `root`, the project's folder.
: "${root:?}"

say() { printf '%s\n' "$*" >&2; }

# Exit code 3: a component is missing or failed.
give_up() {
  say "$*"
  exit 3
}

# The lines of setup/packages.txt whose group is one of the arguments.
wanted() {
  local groups=" $* " package group command purpose
  while read -r package group command purpose; do
    [[ -z $package || $package == '#'* ]] && continue
    [[ $groups == *" $group "* ]] && printf '%s %s %s\n' "$package" "$command" "$purpose"
  done <"$root/setup/packages.txt"
  return 0
}

on_debian_12() {
  [[ -r /etc/os-release ]] && (
    # shellcheck source=/dev/null
    . /etc/os-release
    [[ ${ID:-} == debian && ${VERSION_ID:-} == 12 ]]
  )
}

# Of the lines of `wanted` on stdin, those whose package Debian's package manager does not have.
not_installed() {
  local -a lines packages
  mapfile -t lines
  packages=("${lines[@]%% *}")
  local installed
  # dpkg-query fails when it does not know a package: that package is then among the missing.
  installed=$(dpkg-query -W -f='|${Package} ${db:Status-Status}|' "${packages[@]}" 2>/dev/null) || true
  local line
  for line in "${lines[@]}"; do
    [[ $installed == *"|${line%% *} installed|"* ]] || came_with_node "$line" || printf '%s\n' "$line"
  done
}

# Packages of Node from elsewhere than Debian bring their npm, and cannot be installed beside Debian's.
came_with_node() { [[ $1 == npm\ * ]] && command -v npm >/dev/null; }

# Of the lines of `wanted` on stdin, those whose command is not there.
without_command() {
  local package command purpose
  while read -r package command purpose; do
    [[ $command == - ]] || command -v "$command" >/dev/null || printf '%s %s %s\n' "$package" "$command" "$purpose"
  done
}

describe() {
  local package command purpose
  while read -r package command purpose; do
    printf '  %-20s %s\n' "$package" "$purpose" >&2
  done
}

# install_missing GROUP...: on Debian 12 installs what is not there; elsewhere checks the programs, and leaves the
# libraries to CMake.
install_missing() {
  groups=("$@")
  if ! on_debian_12; then
    local absent
    absent=$(wanted "$@" | without_command)
    [[ -z $absent ]] || explain_other_system "$absent"
    return 0
  fi
  local missing
  missing=$(wanted "$@" | not_installed)
  [[ -z $missing ]] && return 0
  install_packages "$missing"
}

install_packages() {
  local -a packages become_root=()
  mapfile -t packages <<<"$1"
  packages=("${packages[@]%% *}")
  say "Missing on this system, to be installed with apt-get:"
  describe <<<"$1"
  if ((EUID != 0)); then
    command -v sudo >/dev/null || give_up "Not root, and no sudo here. As root: apt-get install ${packages[*]}"
    become_root=(sudo)
  fi
  quietly install "Installing" "${become_root[@]}" apt-get update
  quietly install "Installing" "${become_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${packages[@]}"
}

# explain_other_system [LINES]: what this system, not Debian 12, has to be given by hand; LINES: what it surely lacks.
explain_other_system() {
  say "This is not Debian 12, so nothing is installed here."
  if (($#)); then
    say "Missing programs (by Debian's package names):"
    describe <<<"$1"
  fi
  say "All that is needed (by Debian's package names):"
  wanted "${groups[@]}" | describe
  give_up "Install these with your system's package manager, then start this again."
}

# quietly NAME LABEL COMMAND...: runs it with its output in build/NAME.log; on a terminal one line shows how far it is.
# If it fails: the log, and exit code 3.
quietly() {
  local log="$root/build/$1.log" label=$2
  shift 2
  mkdir -p "$root/build"
  if ! "$@" </dev/null 2>&1 | tee "$log" | show_progress "$label"; then
    # A compiler's first error says most; other failures say it last.
    { grep -m 1 -A 30 '^FAILED: ' "$log" || tail -n 40 "$log"; } >&2
    give_up "Failed: $* (all of its output: $log)"
  fi
}

show_progress() {
  if [[ ! -t 2 ]]; then
    cat >/dev/null
    return
  fi
  local line shown=no
  while IFS= read -r line; do
    [[ $line == 'ninja: no work to do.' ]] && continue
    [[ $line =~ ^\[([0-9]+/[0-9]+)\] ]] && line=${BASH_REMATCH[1]}
    printf '\r\033[K%s: %.60s' "$1" "$line" >&2
    shown=yes
  done
  [[ $shown == no ]] || printf '\r\033[K' >&2
}

# configured PRESET: whether its build folder is ready, and was made for this very place.
configured() {
  [[ -f $root/build/$1/build.ninja ]] &&
    grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$root/build/$1/CMakeCache.txt"
}

# configure PRESET [CMAKE ARGUMENTS]
configure() {
  local preset=$1
  shift
  configured "$preset" || rm -rf "$root/build/$preset"
  local status=0
  (cd "$root" && quietly "configure-$preset" "Configuring" cmake --preset "$preset" "$@") || status=$?
  ((status == 0)) && return
  on_debian_12 || explain_other_system
  exit "$status"
}

# build PRESET TARGET...
build() {
  local preset=$1
  shift
  quietly "build-$preset" "Building" cmake --build "$root/build/$preset" --target "$@"
}

# The tools of the page, at the versions of its lock file: fetched when that file has changed.
fetch_page_tools() {
  [[ $root/web/node_modules/.package-lock.json -nt $root/web/package-lock.json ]] ||
    quietly page-tools "Fetching the tools of the console's page" npm --prefix "$root/web" ci
}

# The Python that reads recordings in the tests, with the packages of setup/bag-reader.txt: made when that has changed.
fetch_bag_reader() {
  local reader="$root/build/bag-reader"
  [[ $reader/made -nt $root/setup/bag-reader.txt ]] && return
  rm -rf "$reader"
  quietly bag-reader "Fetching the reader of recordings" python3 -m venv "$reader"
  quietly bag-reader "Fetching the reader of recordings" "$reader/bin/python3" -m pip install --disable-pip-version-check \
    --require-hashes --only-binary :all: --requirement "$root/setup/bag-reader.txt"
  touch "$reader/made"
}

# The console's page, web/dist: built when something below web/ is newer than it.
build_page() {
  fetch_page_tools
  local page="$root/web/dist/index.html"
  [[ -f $page && -z $(find "$root/web" -mindepth 1 \( -path "$root/web/node_modules" -o -path "$root/web/dist" \
    -o -path "$root/web/artefacts" \) -prune -o -newer "$page" -print -quit) ]] ||
    quietly page "Building the console's page" npm --prefix "$root/web" run build
}
