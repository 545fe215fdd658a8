#!/bin/sh
# The pictures of the page of celspan watch, docs/pictures/watch*.png: the film of watch.lua in
# Debian's chromium at double density, with few colours. From the top of the tree:
#
#   docs/pictures/watch.sh FOLDER [PROGRAM]        FOLDER keeps the parts
set -eu
celspan=$(realpath "${2:-build/celspan}")
rm -rf "$1/town" "$1/watch.txt"
mkdir -p "$1"
(cd "$1" && "$celspan" init town >town.txt)
cp docs/pictures/watch.lua "$1/town/town_cut.lua"
(cd "$1/town" && exec "$celspan" watch town_cut.lua) >"$1/watch.txt" &
page=$!
trap 'kill $page' EXIT
until grep -qs http "$1/watch.txt"; do sleep 0.2; done
CELSPAN_BROWSER_SECONDS=300 SHOTS="$(cd "$1" && pwd)" \
  node tests/support/browser.js "$1/browser" \
  "$(sed 's/watching //' "$1/watch.txt")" docs/pictures/watch.js
for name in watch watch_values watch_render; do
  "$celspan" convert "$1/$name.png" docs/pictures/$name.png --size 1344x864
done
pngquant --force --ext .png 80 docs/pictures/watch.png docs/pictures/watch_values.png \
  docs/pictures/watch_render.png
