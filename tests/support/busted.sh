#!/bin/sh
# Runs the specs with what a build holds, from the top of the tree:
#   tests/support/busted.sh BUILD ARGUMENT...
folder=$PWD/$1
shift
# --cpath, because that of .busted would load the module of build/. busted hands its arguments to a
# shell as they are: one path, without a semicolon.
CELSPAN="$folder/celspan" CELSPAN_BUILD="$folder" LUA_PATH="$PWD/lua/?.lua;$PWD/?.lua;;" \
  exec busted --lua="$folder/tests/lua_host" \
  --cpath="$(dirname "$(find "$folder" -name celspan.so -print -quit)")/?.so" -o TAP "$@"
