#!/usr/bin/env bash
# Builds the fuzz target of strokes with clang's libFuzzer, the address and the undefined sanitizer,
# and runs it, beginning with its corpus. Finds are left in the current folder.
#
#   tests/fuzz/stroke_fuzzer.sh FOLDER [options of libFuzzer]      from the root of the tree
#
# FOLDER gets the program and what it learns. build/ must have been built: what src/stroke stands on,
# and src/scene, are taken from there.
set -e -u
folder=$1
shift
mkdir -p "$folder/learned"
clang -std=c17 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -D_GNU_SOURCE \
  -DCELSPAN_BUILD -ffp-contract=off -Isrc -Isrc/include -I. -o "$folder/fuzz_stroke" \
  tests/fuzz/fuzz_stroke.c src/stroke/*.c src/scene/stroke.c src/scene/inside_stroke.c \
  build/src/libcs_{scene,pictures,colour,geometry,artwork,base}.a -lz -ldl -lpthread -lm
exec "$folder/fuzz_stroke" "$@" "$folder/learned" tests/fuzz/corpus/stroke
