#!/bin/sh
# Compares the drawings of a folder with other renderers' pictures of them: how many pass, and the
# rest with the cause. From the top of the tree:
#
#   tests/svg/compare.sh BUILD MATERIAL
set -eu
export LUA_PATH="$PWD/?.lua;;" LUA_CPATH
LUA_CPATH="$(dirname "$(find "$PWD/$1" -name celspan.so -print -quit)")/?.so"
echo "drawings compared with other renderers' pictures of them"
"$1/tests/lua_host" tests/svg/compare.lua "$2"
echo "artwork compared with librsvg, six times larger and averaged"
"$1/tests/lua_host" tests/svg/clipart.lua "$2"
