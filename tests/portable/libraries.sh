#!/bin/bash
# What celspan is linked with on another platform, with the compiler of its cross file: zlib and
# Lua, built from Debian's source packages, and for a processor that Debian has, its packages of
# what the modules need, unpacked. This machine's own packages stay as they are.
#
#   tests/portable/libraries.sh NAME FOLDER     FOLDER/NAME gets include, lib and libraries.txt
set -eu
here=$(cd "$(dirname "$0")" && pwd)
name=$1
mkdir -p "$2/sources" "$2/$name"
folder=$(cd "$2" && pwd)
out=$folder/$name
MODULE_PACKAGES=(libexpat1-dev libharfbuzz-dev libfribidi-dev libunibreak-dev libpng-dev
  libjpeg62-turbo-dev libopenexr-dev libtiff-dev libwebp-dev)

# What Debian calls the processor, and the folder of its libraries; nothing: it has no such.
case $name in
aarch64) debian=arm64 triplet=aarch64-linux-gnu ;;
armhf) debian=armhf triplet=arm-linux-gnueabihf ;;
i386) debian=i386 triplet=i386-linux-gnu ;;
*) debian='' triplet='' ;;
esac

# apt_get KIND ARCHITECTURE ARGUMENT...: of this machine's Debian, from where its packages come; it
# writes into the folder alone, and takes nothing for installed. KIND: deb or deb-src.
apt_get() {
  local apt=$folder/apt/$1-$2
  mkdir -p "$apt/lists/partial" "$apt/archives/partial"
  touch "$apt/status"
  # shellcheck disable=SC2016
  [ -s "$apt/sources.list" ] || apt-get indextargets \
    --format "$1"' $(SITE) $(RELEASE) $(COMPONENT)' \
    'Created-By: Packages' 'Origin: Debian' | sort -u >"$apt/sources.list"
  apt-get -y --no-install-recommends -o "APT::Architecture=$2" -o "APT::Architectures::=$2" \
    -o "Dir::Etc::SourceList=$apt/sources.list" -o Dir::Etc::SourceParts=/dev/null \
    -o "Dir::State::Lists=$apt/lists" -o "Dir::State::status=$apt/status" \
    -o "Dir::Cache::archives=$apt/archives" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= \
    "${@:3}"
}

fetch_sources() {
  [ -z "$(find "$folder/sources" -maxdepth 1 -name 'lua5.4-*')" ] || return 0
  local own
  own=$(dpkg --print-architecture)
  apt_get deb-src "$own" update
  (cd "$folder/sources" && apt_get deb-src "$own" source zlib lua5.4)
}

unpack_packages() {
  local package
  apt_get deb "$debian" update || echo "not all lists are new: the versions may be older"
  apt_get deb "$debian" install --download-only "${MODULE_PACKAGES[@]}"
  for package in "$folder/apt/deb-$debian"/archives/*.deb; do
    dpkg-deb --extract "$package" "$out"
  done
}

# in_cross_file NAME: the words of a list or a text in the cross file.
in_cross_file() { sed -n "s/^$1 = //p" "$here/$name.txt" | tr -d "[],'"; }

# build NAME FILE...: an archive of these sources, in the current folder.
build() {
  local archive=$out/lib/lib$1.a file objects=()
  shift
  for file in "$@"; do
    objects+=("$out/objects/$(basename "$file" .c).o")
    # shellcheck disable=SC2046
    $(in_cross_file c) -O2 -ffp-contract=off $(in_cross_file c_args) -fPIC -I. "-I$out/include" \
      -c "$file" -o "${objects[-1]}"
  done
  $(in_cross_file ar) rcs "$archive" "${objects[@]}"
}

# describe NAME VERSION LIBRARY
describe() {
  printf 'Name: %s\nDescription: %s\nVersion: %s\nCflags: -I%s\nLibs: -L%s -l%s\n' \
    "$1" "$1" "$2" "$out/include" "$out/lib" "$3" >"$out/lib/pkgconfig/$1.pc"
}

build_libraries() {
  mkdir -p "$out/include" "$out/lib/pkgconfig" "$out/objects"
  cd "$folder"/sources/zlib-*/
  build z adler32.c compress.c crc32.c deflate.c infback.c inffast.c inflate.c inftrees.c trees.c \
    uncompr.c zutil.c
  cp zlib.h zconf.h "$out/include"
  describe zlib 1.2.13 z
  cd "$folder"/sources/lua5.4-*/src
  # Of Debian's patch.
  echo '#define DEB_HOST_MULTIARCH "other"' >"$out/include/lua5.4-deb-multiarch.h"
  build lua5.4 l[!u]*.c lu[!a]*.c # all but the interpreter and the compiler
  cp lua.h luaconf.h lualib.h lauxlib.h "$out/include"
  describe lua5.4 5.4.4 lua5.4
}

# The folder is the root of the unpacked packages, and what is built in it comes first.
write_properties() {
  local own=$out/lib/pkgconfig
  if [ -z "$debian" ]; then
    printf "[properties]\npkg_config_libdir = '%s'\n" "$own"
  else
    printf "[properties]\nsys_root = '%s'\npkg_config_libdir = ['%s', '%s', '%s', '%s']\n" "$out" \
      "$own" "$out"/usr/{"lib/$triplet",lib,share}/pkgconfig
    printf "[built-in options]\nc_link_args = ['-Wl,-rpath-link,%s', '-Wl,-rpath-link,%s']\n" \
      "$out/usr/lib/$triplet" "$out/lib/$triplet"
  fi
}

[ ! -f "$out/libraries.txt" ] || exit 0
fetch_sources
build_libraries
[ -z "$debian" ] || unpack_packages
write_properties >"$out/libraries.txt"
