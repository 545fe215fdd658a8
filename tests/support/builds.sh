#!/bin/bash
# Builds with fewer parts, and inside another project: each configures, builds and renders a frame.
#
#   tests/support/builds.sh
#
#   the core alone     without C++, by a host in C
#   the library alone  without the program
#   release            is optimized, and has no debugging information; it is only configured
#   without C++        as the subproject of another project, with a host in C that plays a film;
#                      formats that need C++ are refused with a sentence
set -eu

root=$PWD
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
quick=(--werror -Doptimization=0 -Ddebug=false)

# Prints the output of ninja and meson only if they fail.
quietly() { "$@" >"$tree/log" 2>&1 || { cat "$tree/log" >&2 && exit 1; }; }
# absent FOLDER NAME: checks that nothing of that name was built.
absent() {
  if [ -n "$(find "$1" -type f -name "$2" -print -quit)" ]; then
    echo "builds: $2 should not be there" >&2
    exit 1
  fi
}

core_alone() {
  quietly env CXX=/nonexistent/c++ meson setup "$tree/core" "${quick[@]}" \
    -Dkit=disabled -Dtests=false
  quietly ninja -C "$tree/core"
  "$tree/core/examples/example_memory" | grep -q '#'
  absent "$tree/core" 'libcs_svg.a'
  absent "$tree/core" 'libcelspan_lua.a'
  absent "$tree/core" 'celspan'
  absent "$tree/core" 'celspan*.so'
}

library_alone() {
  quietly meson setup "$tree/library" "${quick[@]}" -Ddesk=disabled \
    -Dpictures=disabled -Dtests=false
  quietly ninja -C "$tree/library"
  echo 'print(require "celspan".rect { -3, 0, 6, 6 }:bounds())' >"$tree/rect.lua"
  (cd "$tree/library" && lua5.4 "$tree/rect.lua") | grep -q '^-3'
  absent "$tree/library" 'celspan'
}

release() {
  quietly meson setup "$tree/release" --buildtype=release -Dlua=disabled -Dpictures=disabled \
    -Dtype=disabled -Dcolour=disabled -Dtests=false
  meson introspect --buildoptions "$tree/release" >"$tree/options"
  grep -q '"name": "debug", "value": false' "$tree/options"
  grep -q '"name": "optimization", "value": "3"' "$tree/options"
}

without_cpp_as_subproject() {
  mkdir -p "$tree/outer/subprojects"
  ln -s "$root" "$tree/outer/subprojects/celspan"
  cp examples/host.c "$tree/outer"
  cat >"$tree/outer/meson.build" <<'MESON'
project('outer', 'c', default_options: ['c_std=c11', 'warning_level=2'])
celspan = dependency('celspan-lua', fallback: 'celspan')
executable('host', 'host.c', dependencies: celspan)
MESON
  quietly env CXX=/nonexistent/c++ meson setup "$tree/build" "$tree/outer" "${quick[@]}" \
    --force-fallback-for=celspan-lua -Dcelspan:pictures=disabled -Dcelspan:raster=disabled
  quietly ninja -C "$tree/build"
  absent "$tree/build" 'lua_host*'
  absent "$tree/build" 'example_*'
  absent "$tree/build" 'celspan-picture.so'

  cat >"$tree/dot.lua" <<'LUA'
local celspan = require "celspan"
local dot = celspan.circle { centre = { 12, 6 }, radius = 5, texture = "#ff8800" }
return celspan.film { size = { 24, 12 }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel { dot } }
end }
LUA
  "$tree/build/host" "$tree/dot.lua" 24 12 >"$tree/dot.ppm"
  [ "$(od -An -tx1 -j $((13 + 3 * (24 * 6 + 12))) -N 3 "$tree/dot.ppm" | tr -d ' ')" = ff8800 ]
  program=$tree/build/subprojects/celspan/celspan
  "$program" render "$tree/dot.lua" -o "$tree/dot.png" --progress none
  [ -s "$tree/dot.png" ]
  if "$program" render "$tree/dot.lua" -o "$tree/dot.exr" --progress none 2>"$tree/refused"; then
    echo "builds: an OpenEXR file was written without OpenImageIO" >&2
    exit 1
  fi
  grep -q 'built without OpenImageIO' "$tree/refused"
}

core_alone
library_alone
release
without_cpp_as_subproject
