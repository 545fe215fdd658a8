#!/bin/bash
# Builds zlib and Lua for another platform from Debian's source packages, with the compiler of its
# cross file.
#
#   tests/portable/libraries.sh NAME FOLDER     FOLDER/NAME gets include, lib and libraries.txt
set -eu
here=$(cd "$(dirname "$0")" && pwd)
name=$1
mkdir -p "$2/sources" "$2/$name"
folder=$(cd "$2" && pwd)
out=$folder/$name

# The source packages of this machine's Debian, from where its packages come; nothing is written
# outside the folder.
fetch_sources() {
  local apt=$folder/apt
  [ -z "$(find "$folder/sources" -maxdepth 1 -name 'lua5.4-*')" ] || return 0
  mkdir -p "$apt/lists/partial"
  # shellcheck disable=SC2016
  apt-get indextargets --format \
    'deb-src $(SITE) $(RELEASE) $(COMPONENT)' \
    'Created-By: Packages' 'Origin: Debian' | sort -u >"$apt/sources.list"
  local options=(-o "Dir::Etc::SourceList=$apt/sources.list" -o Dir::Etc::SourceParts=/dev/null
    -o "Dir::State::Lists=$apt/lists" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache=)
  apt-get "${options[@]}" update
  (cd "$folder/sources" && apt-get "${options[@]}" source zlib lua5.4)
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

fetch_sources
[ ! -f "$out/libraries.txt" ] || exit 0
mkdir -p "$out/include" "$out/lib/pkgconfig" "$out/objects"
cd "$folder"/sources/zlib-*/
build z adler32.c compress.c crc32.c deflate.c infback.c inffast.c inflate.c inftrees.c trees.c \
  uncompr.c zutil.c
cp zlib.h zconf.h "$out/include"
describe zlib 1.2.13 z
cd "$folder"/sources/lua5.4-*/src
echo '#define DEB_HOST_MULTIARCH "other"' >"$out/include/lua5.4-deb-multiarch.h" # of Debian's patch
shopt -s extglob
build lua5.4 !(lua|luac).c
cp lua.h luaconf.h lualib.h lauxlib.h "$out/include"
describe lua5.4 5.4.4 lua5.4
printf "[properties]\npkg_config_libdir = '%s'\n" "$out/lib/pkgconfig" >"$out/libraries.txt"
