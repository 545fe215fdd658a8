#!/usr/bin/env bash
# Builds the fuzz target of drawings with clang's libFuzzer, the address and the undefined sanitizer,
# and runs it, beginning with its corpus. Finds are left in the current folder.
#
#   tests/fuzz/svg_fuzzer.sh FOLDER [options of libFuzzer]      from the root of the tree
#
# FOLDER gets the program and what it learns. build/ must have been built, with the art module: what
# src/svg stands on is taken from there.
set -e -u
folder=$1
shift
mkdir -p "$folder/learned"
clang -std=c17 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -D_GNU_SOURCE \
  -DCELSPAN_BUILD -ffp-contract=off -Isrc -Isrc/include -I. -o "$folder/fuzz_svg" \
  tests/fuzz/fuzz_svg.c src/svg/*.c build/src/libcs_{scene,pictures,colour,geometry,artwork,base}.a \
  -lz -ldl -lpthread -lm
export CELSPAN_ART_MODULE=${CELSPAN_ART_MODULE:-$PWD/build/src/art/celspan-art.so}
exec "$folder/fuzz_svg" "$@" "$folder/learned" tests/fuzz/corpus/svg
