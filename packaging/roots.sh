# shellcheck shell=bash
# Roots of Debian's releases, in out/roots; for the other scripts here, which source this file.

roots=$PWD/out/roots

# The mirror that this machine's own apt uses.
mirror() {
  # shellcheck disable=SC2016
  apt-get indextargets --format '$(REPO_URI)' 'Identifier: Packages' 'Label: Debian' | head -1
}

# base SUITE: makes out/roots/SUITE, once: the least that Debian can be.
base() {
  [ ! -d "$roots/$1" ] || return 0
  [ "$(id -u)" = 0 ] || die "a root of $1 can be made by root alone"
  say "making a root of $1 in out/roots/$1"
  mkdir -p "$roots"
  rm -rf "$roots/$1.part"
  debootstrap --variant=minbase "$1" "$roots/$1.part" "$(mirror)" >"$roots/$1.log" 2>&1 || {
    tail -5 "$roots/$1.log"
    return 1
  }
  rm -rf "$roots/$1.part"/var/cache/apt/archives/*.deb
  mv "$roots/$1.part" "$roots/$1"
}

# copy SUITE NAME: a root of a suite to work in, out/roots/NAME.
copy() {
  base "$1" || return 1
  rm -rf "${roots:?}/$2"
  cp -a "$roots/$1" "$roots/$2"
}

# inside NAME COMMAND...: runs a command in a root, with /proc; the mounts end with it.
inside() {
  local root=$roots/$1
  shift
  # shellcheck disable=SC2016
  unshare --mount --propagation private bash -c 'mount -t proc proc "$0/proc" &&
    mount --bind /dev "$0/dev" && root=$0 &&
    exec env -i LC_ALL=C.UTF-8 HOME=/root TERM=dumb DEBIAN_FRONTEND=noninteractive \
      PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
      chroot "$root" "$@"' "$root" "$@"
}
