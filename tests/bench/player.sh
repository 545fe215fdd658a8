#!/usr/bin/env bash
# The player of plane files, in a browser: see player.js. It prints JSON. From the top of the tree:
#
#   tests/bench/player.sh FOLDER        FOLDER is deleted first
set -eu
folder=$1 celspan=$PWD/build/celspan

rm -rf "$folder"
mkdir -p "$folder"
awk '/^-- moonrise.lua$/ { is_in = 1 } is_in && /^```$/ { exit } is_in' docs/player.md \
  >"$folder/moonrise.lua"
cp tests/bench/scripts/thousand.lua "$folder/"
cd "$folder"
for name in moonrise thousand; do
  "$celspan" render "$name.lua" -o "$name.plane" --progress none
done
"$celspan" plane -o celspan-film.js
cd "$OLDPWD"
CELSPAN_PLAYED=$folder CELSPAN_BROWSER_SECONDS=300 \
  node tests/support/browser.js "$folder/chromium" about:blank tests/bench/player.js
