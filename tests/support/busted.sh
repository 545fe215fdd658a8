#!/bin/sh
# Runs the specs with the program and modules of a build, from the top of the tree:
#   tests/support/busted.sh BUILD ARGUMENT...
# With CELSPAN_PART, without the tests that are tagged #full.
command -v busted >/dev/null || { echo "1..0 # SKIP busted is not installed" && exit 0; }
folder=$(cd "$1" && pwd)
shift
[ -z "${CELSPAN_PART:-}" ] || set -- --exclude-tags=full "$@"
# --cpath, because the path in .busted would load the module of build/.
modules=$(dirname "$(find "$folder" -name celspan.so -print -quit)")
CELSPAN="$folder/celspan" CELSPAN_BUILD="$folder" LUA_PATH="$PWD/?.lua;;" \
CELSPAN_SEED="${CELSPAN_SEED:-$(cat tests/seed)}" \
  exec "$folder/tests/lua_host" tests/support/busted.lua --ignore-lua \
  --helper=tests/support/checked.lua --cpath="$modules/?.so" -o TAP "$@"
