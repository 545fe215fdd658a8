#!/bin/bash
# Whether other platforms give the same bits: builds celspan for each, asks the questions of
# tests/golden there, and prints a row of the table in docs/trust.md for each.
#
#   tests/portable/run.sh [--sample] [PLATFORM...]
#
#   x86-64     the program in build/
#   musl       another C library, linked statically, without modules
#   aarch64    the same with the GNU C library for another processor, in emulation
#
# --sample: one question in ten.
set -u -o pipefail
cd "$(dirname "$0")/../.." || exit 1
out=$PWD/out/portable
programs=(celspan examples/example_{surface,memory,embed,host})
every=1 outcome=0

# build PLATFORM: quietly, unless it fails.
build() {
  local folder=$out/$1/build log=$out/$1/log
  mkdir -p "$out/$1"
  {
    tests/portable/libraries.sh "$1" "$out" &&
      { [ -f "$folder/build.ninja" ] || meson setup "$folder" \
        --cross-file "tests/portable/$1.txt" --cross-file "$out/$1/libraries.txt" \
        -Dmodules=false -Dpictures=disabled -Dart=disabled -Dcolour=disabled -Dweb=disabled \
        -Dtests=false -Doptimization=1 -Ddebug=false; } &&
      ninja -j2 -C "$folder" "${programs[@]}"
  } >"$log" 2>&1 || {
    tail -40 "$log" >&2
    return 1
  }
}

# ask PLATFORM BUILD EMULATOR: of commands that have the names of the programs, as
# tests/support/golden.lua calls them.
ask() {
  local bin=$out/$1/bin name
  mkdir -p "$bin/examples"
  for name in celspan examples/example_{surface,memory,embed,host,painting,letters}; do
    [ -f "$2/$name" ] || continue
    printf '#!/bin/sh\nexec %s "%s" "$@"\n' "$3" "$2/$name" >"$bin/$name"
    chmod +x "$bin/$name"
  done
  CELSPAN=$bin/celspan CELSPAN_BUILD=$bin lua5.4 tests/portable/digests.lua "$1" "$every"
}

[ "${1:-}" != --sample ] || { every=10 && shift; }
[ $# != 0 ] || set -- x86-64 musl aarch64
echo "| platform | equal | different | not asked |"
echo "|---|---|---|---|"
for platform in "$@"; do
  case $platform in
  x86-64) ask x86-64 "$PWD/build" "" ;;
  musl) build musl && ask musl "$out/musl/build" "" ;;
  *) build "$platform" && ask "$platform" "$out/$platform/build" "qemu-$platform" ;;
  esac || outcome=1
done
exit $outcome
