#!/usr/bin/env bash
# The page of celspan watch, in a browser, with the demo, and how the film plays. It prints JSON.
# From the top of the tree:
#
#   tests/bench/watch.sh FOLDER        FOLDER is deleted first
set -u
root=$PWD
folder=$1

# watched FOLDER SCRIPT: runs tests/bench/watch.js on the page of a script, which lies in FOLDER.
watched() {
  local folder=$1 server
  (cd "$folder" && exec "$root/build/celspan" watch "$2" >said) &
  server=$!
  while ! grep -q watching "$folder/said" 2>/dev/null && kill -0 $server; do sleep 0.1; done
  CELSPAN_SHOT=$folder/$2 CELSPAN_SERVER=$server CELSPAN_BROWSER_SECONDS=600 \
    node tests/support/browser.js "$folder/chromium" "$(cut -d' ' -f2 "$folder/said")" \
    tests/bench/watch.js
  kill $server
  wait $server
}

rm -rf "$folder"
mkdir -p "$folder"
cp -r scripts/. "$folder/"
cat >"$folder/shot.lua" <<'LUA'
local celspan = require "celspan"
celspan.parameters { level = { 0, min = 0, max = 1 } }
return require "demo"
LUA
watched "$folder" shot.lua
CELSPAN_PLAYED=1 watched "$folder" film.lua
