#!/bin/bash
# The installed files are sufficient: the examples are compiled against them as a user would do it,
# plain Lua loads the module, and the program renders a picture.
#
#   tests/support/installed.sh BUILD
set -eu

tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
meson install -C "$1" --no-rebuild --quiet --destdir "$tree"

# installed NAME: checks that a file is installed, exactly once.
installed() {
  local found
  found=$(find "$tree" -name "$1")
  if [ -z "$found" ] || [ "$(wc -l <<<"$found")" != 1 ]; then
    echo "installed: $1 is not installed exactly once: $found" >&2
    return 1
  fi
  echo "$found"
}

settings=$(dirname "$(installed celspan.pc)")
libraries=$(dirname "$settings")
export LD_LIBRARY_PATH=$libraries

# flags PACKAGE: compiler flags, with folders of the installed tree; Lua is in its usual place.
flags() {
  PKG_CONFIG_SYSROOT_DIR=$tree PKG_CONFIG_PATH=$settings pkg-config --cflags --libs "$1"
  pkg-config --cflags --libs lua5.4
}

read -ra of_c <<<"$(flags celspan | tr '\n' ' ')"
read -ra of_lua <<<"$(flags celspan-lua | tr '\n' ' ')"
"${CC:-cc}" examples/memory.c -o "$tree/memory" "${of_c[@]}"
"${CC:-cc}" examples/surface.c -o "$tree/surface" "${of_c[@]}" -lm
"${CC:-cc}" examples/embed.c -o "$tree/embed" "${of_lua[@]}"
"${CC:-cc}" examples/host.c -o "$tree/host" "${of_lua[@]}"
"$tree/memory" >/dev/null
"$tree/surface" | grep -q '80000 pixels'
"$tree/host" scripts/booleans.lua 32 18 | head -c 2 | grep -q P6
installed celspan.d.lua >/dev/null
"$tree/embed" | grep -q '#'

module=$(dirname "$(installed celspan.so)")
LUA_PATH="" LUA_CPATH="$module/?.so" lua5.4 - "$(find "$tree" -name 'celspan-type.so')" <<'LUA'
local celspan, ease = require "celspan", require "celspan.ease"
assert(celspan._VERSION and ease "inOutSine")
local dot = celspan.circle{ centre = {12, 6}, radius = 5, texture = "#ff8800" }
local image = assert(celspan.pixels(celspan.rostrum{ celspan.cel{ dot } }, { size = {24, 12} }))
assert(select(4, image:get(12, 6)) == 1 and select(4, image:get(0, 0)) == 0)
local set, message = pcall(celspan.text, { "A", font = "scripts/type/block.ttf", size = 9 })
assert(set or ... == "", message) -- the module is found in a tree that has another prefix
LUA

program=$(find "$tree" -path '*/bin/celspan')
"$program" --man | cmp - "$(installed celspan.1)"
cat >"$tree/dot.lua" <<'LUA'
local celspan = require "celspan"
return celspan.film{ size = {24, 12}, frames = 1, frame = function()
  return celspan.rostrum{ celspan.cel{ celspan.circle{ centre = {12, 6}, radius = 5 } } }
end }
LUA
"$program" render "$tree/dot.lua" -o "$tree/dot.png" --progress none
[ -s "$tree/dot.png" ]
# To read a picture, the program needs a module, which has another place in the tree.
[ -z "$(find "$tree" -name celspan-picture.so)" ] ||
  "$program" info scripts/pictures/canal.png >/dev/null
