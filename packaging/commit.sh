#!/bin/sh
# Prints the commit of this tree: git knows it in a checkout, and a source archive has a file with
# it, which this script writes for `meson dist`.
cd "$(dirname "$0")/.." || exit 1
if [ -f packaging/commit ]; then
  commit=$(cat packaging/commit)
elif [ -e .git ]; then
  commit=$(git rev-parse --short=9 HEAD 2>/dev/null)
fi
if [ -n "${MESON_DIST_ROOT:-}" ]; then
  echo "${commit:-unknown}" >"$MESON_DIST_ROOT/packaging/commit"
else
  echo "${commit:-unknown}"
fi
