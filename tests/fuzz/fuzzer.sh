#!/usr/bin/env bash
# Builds the fuzz target of paintings with clang's libFuzzer, the address and the undefined sanitizer,
# and runs it, beginning with its corpus. Finds are left in the current folder.
#
#   tests/fuzz/fuzzer.sh zip|ora|kra|psd FOLDER [options of libFuzzer]      from the root of the tree
#
# FOLDER gets the program and what it learns. build/ must have the art module.
set -e -u
kind=$1 folder=$2
shift 2
mkdir -p "$folder/$kind.learned"
clang -std=c17 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -D_GNU_SOURCE \
  -DCELSPAN_BUILD "-DFUZZ_KIND=${kind^^}" -Isrc -Isrc/include -I. -o "$folder/fuzz_$kind" \
  tests/fuzz/fuzz_painting.c src/painting/*.c src/pictures/surface.c src/artwork/*.c src/base/*.c \
  -lz -ldl -lpthread -lm
export CELSPAN_ART_MODULE=${CELSPAN_ART_MODULE:-$PWD/build/src/art/celspan-art.so}
exec "$folder/fuzz_$kind" "$@" "$folder/$kind.learned" "tests/fuzz/corpus/$kind"
