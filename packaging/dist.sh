#!/usr/bin/env bash
# Makes what is given to others, in out/dist; `./run dist` calls it:
#
#   packaging/dist.sh [PART...]           the parts, or all: source linux npm root deb
#   packaging/dist.sh --test [SUITE...]   tries them in roots of Debian (packaging/try.sh)
#
#   git --source--> celspan-VERSION.tar.gz --deb--> *.deb
#                                          --linux--> celspan-...-linux-x86_64.tar.gz, .tar.xz
#                                                     celspan-...-lua-x86_64.tar.gz
#       --npm--> celspan-VERSION.tgz, --root--> celspan-...-root-x86_64.tar.gz
#
# Everything after the first step is made from the source archive alone.
set -eu -o pipefail
cd "$(dirname "$0")/.."

say() { printf '== %s\n' "$*"; }
die() {
  printf 'dist: %s\n' "$*" >&2
  exit 1
}
# quietly LOG COMMAND...: with its output in out/dist.work/LOG.log, whose end is shown if it fails.
quietly() {
  local log=$work/$1.log
  shift
  "$@" >"$log" 2>&1 || {
    tail -40 "$log"
    die "failed: $* (all of it: $log)"
  }
}

# shellcheck source=packaging/roots.sh
. packaging/roots.sh

dist=$PWD/out/dist work=$PWD/out/dist.work
release=$(sed -n "s/^  version: '\(.*\)',/\1/p" meson.build)
commit=$(packaging/commit.sh)
# A release is tagged; other versions have their commit in the name.
version=$release+$commit
[ "$(git describe --tags --exact-match 2>/dev/null)" != "v$release" ] || version=$release
name=celspan-$version-linux-x86_64
source=celspan-$release.tar.gz

# unpacked FOLDER: the source archive in a new folder.
unpacked() {
  rm -rf "$1"
  mkdir -p "$1"
  tar -xzf "$dist/$source" -C "$1" --strip-components=1
}

# collected FOLDER NAME: the folder NAME in FOLDER as one file, with the same bytes each time.
collected() {
  tar -C "$1" --sort=name --owner=0 --group=0 --numeric-owner \
    --mtime="@$(git log -1 --format=%ct)" -cf - "$2"
}

# packed FOLDER NAME FILE
packed() { collected "$1" "$2" | gzip -9n >"$3"; }

# as_xz: packs what it reads. Most of it is code, in which jumps are written as where they lead.
as_xz() { xz --check=crc32 --x86 --lzma2=preset=9e,lc=4,pb=0; }

make_source() {
  say "the source archive"
  [ -z "$(git status --porcelain)" ] || say "changes that are not committed are left out"
  rm -rf "$work/plain"
  quietly source meson setup "$work/plain" -Dlua=disabled -Dpictures=disabled -Dtype=disabled \
    -Dcolour=disabled -Dspaces=disabled -Dtests=false
  quietly source meson dist -C "$work/plain" --no-tests --formats gztar --allow-dirty
  mv "$work/plain/meson-dist/$source" "$dist"
  unpacked "$work/source/${source%.tar.gz}" # packed again: with the same bytes each time
  packed "$work/source" "${source%.tar.gz}" "$dist/$source"
}

make_linux() {
  say "the archive for Linux, in a root of Debian 11: takes ten minutes of processor time"
  copy bullseye build || die "the root could not be made"
  unpacked "$roots/build/build/source"
  cp packaging/linux.sh "$roots/build/build"
  quietly linux inside build /build/linux.sh "$(mirror)" "$name"
  packed "$roots/build/build" "$name" "$dist/$name.tar.gz"
  collected "$roots/build/build" "$name" | as_xz >"$dist/$name.tar.xz"
  packed "$roots/build/build/lua" "$name" "$dist/celspan-$version-lua-x86_64.tar.gz"
}

# The file is what `npm pack` would make: needs no npm here.
make_npm() {
  say "the npm package"
  local tree=$work/npm/package
  rm -rf "$tree"
  mkdir -p "$tree"
  tar -xzf "$dist/$name.tar.gz" -C "$tree" --strip-components=1
  sed "s/@VERSION@/$release/" packaging/npm/package.json.in >"$tree/package.json"
  cp packaging/npm/README.md LICENSE "$tree"
  packed "$work/npm" package "$dist/celspan-$release.tgz"
}

make_root() {
  say "the root for a container"
  copy bookworm container || die "the root could not be made"
  tar -xzf "$dist/$name.tar.gz" -C "$roots/container/usr/local" --strip-components=1 --no-same-owner
  # What only installing packages needs.
  rm -rf "$roots/container"/{var/{lib/apt/lists,cache/apt,log},usr/share/{doc,locale}}/*
  tar -C "$roots/container" --sort=name --numeric-owner --exclude='./dev/*' --exclude='./proc/*' \
    -cf - . | gzip -9n >"$dist/celspan-$version-root-x86_64.tar.gz"
  rm -rf "$roots/container"
  sed "s/@VERSION@/$version/" packaging/container/scratch.Dockerfile.in >"$dist/scratch.Dockerfile"
}

make_deb() {
  say "the Debian packages: takes ten minutes of processor time"
  local tree=$work/deb/celspan-$version
  rm -rf "$work/deb"
  unpacked "$tree"
  cp "$dist/$source" "$work/deb/celspan_$version.orig.tar.gz"
  cp -r debian "$tree"
  sed -i "1s/($release-/($version-/" "$tree/debian/changelog"
  (cd "$tree" && export DEB_BUILD_OPTIONS=noautodbgsym &&
    quietly deb dpkg-buildpackage -us -uc "-j$(nproc)")
  # Debian gives the number of the bug that asks for the package.
  lintian --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs \
    "$work/deb"/*.changes || die "lintian has found faults in the packages"
  cp "$work/deb"/*.deb "$dist"
}

# What install.sh, and whoever fetches a file, compares it with.
make_sums() {
  cp packaging/install.sh "$dist"
  rm -f "$dist/SHA256SUMS"
  (cd "$dist" && find . -maxdepth 1 -type f -printf '%f\0' | sort -z | xargs -0 sha256sum) \
    >"$work/sums"
  mv "$work/sums" "$dist/SHA256SUMS"
  say "in out/dist:"
  (cd "$dist" && find . -maxdepth 1 -type f -printf '%9s  %f\n' | sort -k2)
}

if [ "${1:-}" = --test ]; then
  shift
  # shellcheck source=packaging/try.sh
  . packaging/try.sh
  try "$@"
  exit
fi
[ $# -gt 0 ] || {
  rm -rf "$dist"
  set -- source linux npm root deb
}
mkdir -p "$dist" "$work"
for part in "$@"; do
  case $part in
  source | linux | npm | root | deb) "make_$part" ;;
  *) die "unknown part '$part' (source, linux, npm, root, deb)" ;;
  esac
done
make_sums
