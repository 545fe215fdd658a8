#!/usr/bin/env bash
# Builds the core, and a fuzz target on it, with clang's libFuzzer, the address and the undefined
# sanitizer, and runs it, beginning with its corpus. Finds are left in the current folder.
#
#   tests/fuzz/fuzzer.sh zip|ora|kra|psd|stroke|svg|text FOLDER [options of libFuzzer]
#
# From the root of the tree. FOLDER gets the build, the program and what it learns; targets may share
# it. The libraries under the art module are those that are installed, and are not watched.
set -e -u
usage() {
  sed -n '2,8s/^# \{0,1\}//p' "$0" >&2
  exit 2
}
[ $# -ge 2 ] || usage
kind=$1 folder=$2
shift 2
case $kind in
zip | ora | kra | psd) source=painting ;;
stroke | svg | text) source=$kind ;;
*) usage ;;
esac
mkdir -p "$folder/$kind.learned"
folder=$(cd "$folder" && pwd)
[ -f "$folder/build/build.ninja" ] || CC=clang meson setup "$folder/build" -Dlua=disabled \
  -Dpictures=disabled -Dart=enabled -Dtests=false -Db_sanitize=address,undefined -Db_lundef=false \
  -Dc_args=-fsanitize=fuzzer-no-link
ninja -C "$folder/build" src/libcelspan.a src/art/celspan-art.so
clang -std=c17 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -D_GNU_SOURCE \
  -DCELSPAN_BUILD "-DFUZZ_KIND=${kind^^}" -ffp-contract=off -Isrc/include -Isrc -I. \
  -o "$folder/fuzz_$kind" "tests/fuzz/fuzz_$source.c" "$folder/build/src/libcelspan.a" \
  -lz -ldl -lpthread -lm
export CELSPAN_ART_MODULE=$folder/build/src/art/celspan-art.so
exec "$folder/fuzz_$kind" "$@" "$folder/$kind.learned" "tests/fuzz/corpus/$kind"
