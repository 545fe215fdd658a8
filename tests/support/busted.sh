#!/bin/sh
# Runs the specs with the program and modules of a build, from the top of the tree:
#   tests/support/busted.sh BUILD ARGUMENT...
folder=$PWD/$1
shift
# --cpath, because the path in .busted would load the module of build/. busted passes its arguments
# to a shell unquoted: one path, without a semicolon.
CELSPAN="$folder/celspan" CELSPAN_BUILD="$folder" LUA_PATH="$PWD/?.lua;;" \
  exec busted --helper=tests/support/checked.lua --lua="$folder/tests/lua_host" \
  --cpath="$(dirname "$(find "$folder" -name celspan.so -print -quit)")/?.so" -o TAP "$@"
