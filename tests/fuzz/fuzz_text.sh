#!/usr/bin/env bash
# Builds the core, and the fuzz target of fonts and text, with clang's libFuzzer, the address and the
# undefined sanitizer, and runs it, beginning with its corpus. Finds are left in the current folder.
#
#   tests/fuzz/fuzz_text.sh FOLDER [options of libFuzzer]      from the root of the tree
#
# FOLDER gets the build, the program and what it learns. The libraries under the art module are those
# that are installed, and are not watched.
set -e -u
folder=$1
shift
mkdir -p "$folder/learned"
[ -f "$folder/build/build.ninja" ] || CC=clang meson setup "$folder/build" -Dlua=disabled \
  -Dpictures=disabled -Dart=enabled -Dtests=false -Db_sanitize=address,undefined -Db_lundef=false \
  -Dc_args=-fsanitize=fuzzer-no-link
ninja -C "$folder/build" src/libcelspan.a src/art/celspan-art.so
clang -std=c17 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -D_GNU_SOURCE \
  -Isrc/include -Isrc -I. -o "$folder/fuzz_text" tests/fuzz/fuzz_text.c "$folder/build/src/libcelspan.a" \
  -lz -ldl -lpthread -lm
export CELSPAN_ART_MODULE=$folder/build/src/art/celspan-art.so
exec "$folder/fuzz_text" "$@" "$folder/learned" tests/fuzz/corpus/text
