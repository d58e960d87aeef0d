#!/bin/bash
# A second Debian with another FreeCAD, in a directory, to try the add-on there: trixie has FreeCAD 1.0, sid 1.1.
#
#   tests/chroot.sh create DIR [trixie|sid]   make it (needs root, network, 3 GB; a few minutes)
#   tests/chroot.sh build  DIR                build the native modules inside, from this checkout
#   tests/chroot.sh test   DIR [ARGS...]      run the FreeCAD and window tests inside (ARGS go to pytest)
#   tests/chroot.sh remove DIR                unmount and delete it
#
# The checkout is copied into DIR/mpm, so that the inner build never touches the outer one.
set -eu

here=$(cd "$(dirname "$0")/.." && pwd)
word=${1:-}
root=${2:-}

# TBB: OpenCASCADE's CMake targets of trixie link it. No make: the presets use ninja.
packages="freecad g++ cmake ninja-build libtbb-dev libeigen3-dev pybind11-dev python3-pybind11 python3-dev
  python3-pytest python3-numpy python3-matplotlib python3-pivy
  libocct-foundation-dev libocct-modeling-data-dev libocct-modeling-algorithms-dev libocct-data-exchange-dev
  libocct-ocaf-dev libocct-visualization-dev
  xvfb xauth xdotool imagemagick x11-apps openbox libgl1-mesa-dri"

fail() { echo "tests/chroot.sh: $*" >&2; exit 2; }

inside() { chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 \
  DEBIAN_FRONTEND=noninteractive "$@"; }

mount_kernel() {
  mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
  mountpoint -q "$root/sys" || mount -t sysfs sys "$root/sys"
  mountpoint -q "$root/dev" || { mount --rbind /dev "$root/dev"; mount --make-rslave "$root/dev"; }
}

unmount_kernel() {
  for place in dev proc sys; do
    if mountpoint -q "$root/$place"; then umount -R "$root/$place"; fi
  done
}

create() {
  suite=${3:-trixie}
  [ -e "$root/etc/debian_version" ] || debootstrap --variant=minbase --include=ca-certificates "$suite" "$root"
  mount_kernel
  printf '#!/bin/bash\nexit 101\n' > "$root/usr/sbin/policy-rc.d"  # no services are started inside
  chmod +x "$root/usr/sbin/policy-rc.d"
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  echo 'path-exclude=/usr/share/doc/*' > "$root/etc/dpkg/dpkg.cfg.d/nodoc"
  # A mirror may lag behind the days for which its index says it is good; its signature is checked all the same.
  inside apt-get -o Acquire::Check-Valid-Until=false update
  # shellcheck disable=SC2086  # a list of words
  inside apt-get install -y --no-install-recommends $packages
  inside apt-get clean
}

copy_checkout() {
  mkdir -p "$root/mpm"
  (cd "$here" && git ls-files -z --cached --others --exclude-standard \
    | while IFS= read -r -d '' file; do [ -f "$file" ] && printf '%s\0' "$file"; done \
    | tar -c --null -T -) | tar -x -C "$root/mpm"
}

build() {
  mount_kernel
  copy_checkout
  inside sh -c 'cd /mpm/native && cmake --preset release -DMPM_TESTS=OFF && nice cmake --build --preset release -j2'
}

# What ./dev test does for FreeCAD, without installing anything.
run_tests() {
  mount_kernel
  copy_checkout
  shift 2
  status=0
  # shellcheck disable=SC2016  # "$@" is the inner shell's
  inside sh -c 'cd /mpm && exec env PYTHONPATH=/mpm MPM_REQUIRE_FREECAD=1 \
    MPM_IN_FREECAD="$(printf "%s\n" pytest -W ignore::DeprecationWarning "$@" tests/document)" freecadcmd scripts/in_freecad.py </dev/null' sh "$@" \
    || status=$?
  inside sh -c 'cd /mpm && exec xvfb-run -a -s "-screen 0 1600x1000x24 -dpi 96 +extension GLX" \
    /usr/bin/python3 -m pytest "$@" tests/gui' sh "$@" || status=$?
  return $status
}

remove() {
  unmount_kernel
  rm -rf --one-file-system "$root"
}

case "$word" in
  create | build | test | remove) [ -n "$root" ] || fail "$word: the directory is missing" ;;
  *) fail "unknown word '$word': create, build, test or remove" ;;
esac
case "$word" in
  create) create "$@" ;;
  build) build ;;
  test) run_tests "$@" ;;
  remove) remove ;;
esac
