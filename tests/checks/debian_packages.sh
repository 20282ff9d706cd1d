#!/usr/bin/env bash
# debian_packages.sh [ARCHITECTURE]: makes the Debian packages, reads them as Debian would, and uses those of this machine's processor from
# an empty folder. With --soak it also installs them by apt into a clean Debian 12 that mmdebstrap makes (as root).
set -euo pipefail
machine="$(dpkg --print-architecture)"
architecture="${1:-$machine}"
packages="build/packages/$architecture"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
root="$work/root"

fail() { echo "packages: $*" >&2 && exit 1; }

# The control file is the second list of what a build needs; it says no less and no more than the first.
build_depends_follow_the_list() {
  local wanted listed
  wanted="$(toolchains/install-packages.sh --list libraries foxglove python | cut -d / -f 1 | sort)"
  listed="$(sed -n '/^Build-Depends:/,/^[A-Z].*:/p' debian/control | grep -oE '[a-z0-9.+-]+-dev\b|nlohmann-json3-dev|python3-numpy' | sort)"
  diff <(echo "$wanted") <(echo "$listed") ||
    fail "Build-Depends in debian/control (right) are not the groups [libraries], [foxglove] and [python] of toolchains/packages.txt (left)"
}

has() { grep -qx "\./$2" < <(dpkg --contents "$packages/$1"_*.deb | awk '{print $6}') || fail "$1 has no $2"; }

contents_are_complete() {
  has tactus usr/bin/tactus
  has tactus usr/share/bash-completion/completions/tactus
  has tactus usr/share/zsh/vendor-completions/_tactus
  has tactus usr/share/fish/vendor_completions.d/tactus.fish
  has tactus usr/share/tactus/examples/bunny/scene.toml
  has tactus usr/share/man/man1/tactus-bake.1.gz
  has tactusd usr/bin/tactusd
  has tactusd etc/tactus/tactusd.env
  has tactusd etc/security/limits.d/90-tactus.conf
  has tactusd lib/systemd/system/tactusd.service
  has tactusd lib/udev/rules.d/99-tactus.rules
  has tactusd usr/lib/sysctl.d/90-tactus.conf
  has tactusd usr/lib/sysusers.d/tactus.conf
  has tactusd usr/share/man/man8/tactusd.8.gz
  has libtactus-dev usr/include/tactus/rendering/world/world.h
  has libtactus-dev 'usr/lib/[^/]*/libtactus_rendering.a'
  has libtactus-dev 'usr/lib/[^/]*/cmake/tactus/tactusConfig.cmake'
  if [[ "$architecture" != "$machine" ]]; then return; fi
  has python3-tactus usr/lib/python3/dist-packages/tactus/__init__.py
  has python3-tactus usr/lib/python3/dist-packages/tactus/py.typed
  has python3-tactus 'usr/lib/python3/dist-packages/tactus/_core[.]cpython-.*[.]so'
  has python3-tactus usr/share/doc/python3-tactus/examples/touch_mesh.py
  dpkg-deb --field "$packages"/python3-tactus_*.deb Depends | grep -q 'python3-numpy.*python3 (>= ' || fail "python3-tactus does not say which Python it needs"
}

dependencies_are_found() {
  local package
  for package in tactus tactusd; do
    dpkg-deb --field "$packages/$package"_*.deb Depends | grep -q 'libgpiod3 (>= .*libstdc++6 (>= ' ||
      fail "$package does not say which libraries it needs: $(dpkg-deb --field "$packages/$package"_*.deb Depends)"
  done
  dpkg-deb --field "$packages"/tactusd_*.deb Version | grep -qx "$(sed -n 's/^project(tactus VERSION \([0-9.]*\) .*/\1/p' CMakeLists.txt)" ||
    fail "the version is not that of CMakeLists.txt"
}

programs_run() {
  local picture scene="$work/ramp.tactus"
  "$root/usr/bin/tactus" --version
  "$root/usr/bin/tactusd" --version
  "$root/usr/bin/tactus" bake "$root/usr/share/tactus/examples/heart/scene.toml" -o "$scene"
  "$root/usr/bin/tactus" touch "$scene" --path "$root/usr/share/tactus/examples/heart/stroke.csv" --output "$work/touch.csv"
  [[ "$(wc -l <"$work/touch.csv")" -gt 100 ]] || fail "tactus touch wrote no run"
  mkdir "$work/empty" "$work/bunny"
  (cd "$work/empty" && "$root/usr/bin/tactus" demo)
  for picture in run_path run_force; do
    [[ "$(head -c 4 "$work/empty/tactus-demo/$picture.png" | tail -c 3)" == PNG ]] || fail "tactus demo drew no $picture.png"
  done
  host_tools/bunny_mesh.sh "$work/bunny/bunny00.off"
  cp "$root"/usr/share/tactus/examples/bunny/* "$work/bunny"
  "$root/usr/bin/tactus" demo "$work/bunny"
}

# The module touches a scene as the program does, and an example of the package draws its figure.
module_works() {
  local examples="$root/usr/share/doc/python3-tactus/examples" hashes="$work/hashes.csv"
  in_python() { PYTHONPATH="$root/usr/lib/python3/dist-packages" TACTUS_EXAMPLES="$root/usr/share/tactus/examples" /usr/bin/python3 "$@"; }
  "$root/usr/bin/tactus" touch "$work/ramp.tactus" --path "$root/usr/share/tactus/examples/heart/stroke.csv" --output "$work/touch.csv" --hashes "$hashes"
  in_python - "$work/ramp.tactus" "$root/usr/share/tactus/examples/heart/stroke.csv" "$hashes" <<'END' || fail "import tactus touches otherwise"
import sys
import numpy
import tactus
path = numpy.genfromtxt(sys.argv[2], delimiter=",", names=True)
touch = tactus.Scene(sys.argv[1]).touch(numpy.column_stack([path[axis] for axis in ("x_m", "y_m", "z_m")]), t_s=path["t_s"])
assert f"{touch.state_hash[-1]:016x}" == open(sys.argv[3]).read().split(",")[-1].strip()
END
  in_python "$examples/touch_mesh.py" "$work"
  [[ -s "$work/touch_mesh.png" ]] || fail "the example touch_mesh.py drew no picture"
}

# Every page formats without a warning, and has a name, a synopsis and, for a verb that --help lists, its options.
pages_read_well() {
  local page text verb
  for page in "$root"/usr/share/man/man?/*.gz; do
    text="$(MANROFFSEQ='' MANWIDTH=100 man --warnings --local-file "$page" 2>"$work/warnings" | col -bx | tr -s " ")"
    [[ ! -s "$work/warnings" ]] || fail "$page: $(cat "$work/warnings")"
    for section in NAME SYNOPSIS OPTIONS; do
      grep -q "^$section" <<<"$text" || fail "$page has no $section"
    done
    grep -q "^ *$(basename "$page" | cut -d . -f 1) - [A-Za-z]" <<<"$text" || fail "$page does not say what the program does"
  done
  for verb in $("$root/usr/bin/tactus" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\)  .*/\1/p'); do
    [[ -f "$root/usr/share/man/man1/tactus-$verb.1.gz" ]] || fail "there is no page of tactus $verb"
  done
}

# Prints what bash offers for the last word of the command line.
offered() {
  # shellcheck disable=SC2016  # the inner shell's own
  PATH="$root/usr/bin:$PATH" bash --norc --noprofile -c '
    source /usr/share/bash-completion/bash_completion
    source "$1" && shift
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMP_LINE="$*" COMP_POINT=${#COMP_LINE}
    [[ "$(complete -p "$1")" =~ -F\ ([a-z_]+) ]] && "${BASH_REMATCH[1]}" "$1" "${!#}" "${COMP_WORDS[-2]}"
    echo "${COMPREPLY[*]}"' bash "$root/usr/share/bash-completion/completions/tactus" "$@"
}

completes() {
  local wanted="$1"
  shift
  [[ "$(offered "$@")" == "$wanted" ]] || fail "bash offers '$(offered "$@")' for '$*', not '$wanted'"
}

# Prints what fish offers for the last word of the command line, and what zsh does.
offered_by_fish() {
  PATH="$root/usr/bin:$PATH" fish --no-config -c "source '$root/usr/share/fish/vendor_completions.d/tactus.fish'; complete --do-complete '$*'"
}
# zsh completes in its line editor alone; here a function takes what the file would offer there.
offered_by_zsh() {
  # shellcheck disable=SC2016  # the inner shell's own
  PATH="$root/usr/bin:$PATH" zsh -fc '
    compadd() { print -l -- "${(@P)2}"; }
    _files() { print "(files)"; }
    file="$1" && shift
    words=("$@") CURRENT=$#
    source "$file"' zsh "$root/usr/share/zsh/vendor-completions/_tactus" "$@"
}
other_shells_complete() {
  local shell="$1" wanted="$2" found
  shift 2
  found="$("offered_by_$shell" "$@" | paste -sd' ')"
  [[ "$found" == "$wanted" ]] || fail "$shell offers '$found' for '$*', not '$wanted'"
}

shell_completes() {
  other_shells_complete fish bench tactus be
  other_shells_complete fish '--json' tactus bake --j
  other_shells_complete fish 'off on' tactus record ''
  other_shells_complete zsh bench tactus be
  other_shells_complete zsh 'on off' tactus record ''
  other_shells_complete zsh '(files)' tactus bake sce
  completes bench tactus be
  completes odrive tactus emulate o
  completes '--json' tactus bake --j
  completes 'on off' tactus record ''
  completes 'svg' tactus plot run.csv --format s
  completes 'elasto_plastic' tactus friction --model el
  completes '' tactus bake sce
  completes '--flight-dir' tactusd --fl
}

# Prints the apt sources of a clean Debian 12 with backports, from this machine's mirror.
bookworm_sources() {
  local uri
  # shellcheck disable=SC2016  # apt fills it in
  uri="$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' | head -n 1)"
  printf 'deb %s %s main\n' "$uri" bookworm "$uri" bookworm-backports
}

# apt resolves the packages and what they need; the program runs on an example, and the service knows that there is nothing to run yet.
apt_installs_on_a_clean_debian() {
  local clean="$work/clean"
  if [[ $EUID -ne 0 ]]; then
    echo "SKIPPED: only root can install packages into a clean Debian 12"
    return
  fi
  bookworm_sources | mmdebstrap --variant=apt --quiet bookworm "$clean" -
  cp "$packages"/*.deb "$clean/tmp/"
  cp /etc/resolv.conf "$clean/etc/"
  in_clean() { chroot "$clean" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"; }
  in_clean sh -c 'apt-get -qq update && apt-get -q --yes --no-install-recommends install /tmp/*.deb' || fail "apt cannot install the packages"
  in_clean sh -c 'cd /tmp && tactus bake /usr/share/tactus/examples/heart/scene.toml -o scene.tactus &&
    tactus touch scene.tactus --path /usr/share/tactus/examples/heart/stroke.csv --output touch.csv && wc -l touch.csv'
  in_clean python3 -c 'import tactus; print(tactus.Scene("/tmp/scene.tactus"))'
  in_clean sh -c 'getent passwd tactus && systemctl is-enabled tactusd && tactusd --version'
  in_clean sh -c 'apt-get -qq --yes purge tactusd tactus libtactus-dev python3-tactus && ! test -e /etc/tactus' || fail "apt cannot remove the packages"
}

build_depends_follow_the_list
toolchains/debian-packages.sh "$architecture"
# A search for misspelt words in programs takes machine code for text.
lintian --allow-root --display-info --fail-on error,warning,info --suppress-tags spelling-error-in-binary "$packages"/*.changes
contents_are_complete
dependencies_are_found
if [[ "$architecture" == "$machine" ]]; then
  for package in "$packages"/*.deb; do dpkg --extract "$package" "$root"; done
  programs_run
  module_works
  pages_read_well
  shell_completes
  tests/checks/embedding.sh "$root/usr"
  if [[ -n "${TACTUS_SOAK:-}" ]]; then apt_installs_on_a_clean_debian; fi
fi
echo "packages: those for $architecture are complete"
