#!/usr/bin/env bash
# The page of celspan watch, in a browser: what an animator waits for, with the demo, and how the
# shots of scripts/film.lua play. It prints JSON. From the top of the tree:
#
#   tests/bench/watch.sh FOLDER        FOLDER is deleted first
#
# With CELSPAN_OLD=PROGRAM another build is measured in turns with build/celspan, so that both have
# the same share of what else the machine does: CELSPAN_ROUNDS times, 3 by default. Then a table of
# medians is printed, too, and how many times better the new one is. CELSPAN_NEW: instead of
# build/celspan.
set -u
new=$(realpath "${CELSPAN_NEW:-build/celspan}")
old=${CELSPAN_OLD:+$(realpath "$CELSPAN_OLD")}
rounds=${CELSPAN_ROUNDS:-$([ -n "$old" ] && echo 3 || echo 1)}
rm -rf "$1"
mkdir -p "$1"
folder=$(realpath "$1")

# watched PROGRAM SCRIPT: runs tests/bench/watch.js on the page of a script in $folder/film.
watched() {
  local server
  (cd "$folder/film" && exec "$1" watch "$2" >../said) &
  server=$!
  trap 'kill $server 2>/dev/null' EXIT
  while ! grep -q watching "$folder/said" 2>/dev/null; do
    kill -0 $server 2>/dev/null || { echo "$1 does not serve $2" >&2; return 1; }
    sleep 0.1
  done
  CELSPAN_SHOT=$folder/film/$2 CELSPAN_SERVER=$server CELSPAN_BROWSER_SECONDS=600 \
    node tests/support/browser.js "$folder/chromium" "$(cut -d' ' -f2 "$folder/said")" \
    tests/bench/watch.js
  local code=$?
  kill $server
  trap - EXIT
  wait $server
  rm -f "$folder/said"
  return $code
}

# measured NAME PROGRAM ROUND: measures a program, into files of its name.
measured() {
  rm -rf "$folder/film"
  cp -r scripts "$folder/film"
  cat >"$folder/film/shot.lua" <<'LUA'
local celspan = require "celspan"
celspan.parameters { level = { 0, min = 0, max = 1 } }
return require "demo"
LUA
  watched "$2" shot.lua >"$folder/$1.$3.shot.json" || return 1
  CELSPAN_PLAYED=1 watched "$2" film.lua >"$folder/$1.$3.film.json" || return 1
  cat "$folder/$1.$3".*.json
}

for ((round = 1; round <= rounds; round++)); do
  turns=(new)
  [ -z "$old" ] || turns=(new old)
  [ -z "$old" ] || ((round % 2)) || turns=(old new)
  for name in "${turns[@]}"; do
    echo "round $round of $rounds: $name" >&2
    measured "$name" "${!name}" $round || exit 1
  done
done
[ -z "$old" ] || node tests/bench/watch_ratios.js "$folder"
