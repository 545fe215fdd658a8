#!/bin/sh
# The pictures of the page of celspan watch, docs/pictures/watch*.png: the film of watch.lua in
# Debian's chromium, with at most 200 colours. From the top of the tree:
#
#   docs/pictures/watch.sh FOLDER [PROGRAM]        FOLDER keeps the parts
set -eu
celspan=$(realpath "${2:-build/celspan}")
rm -rf "$1/hours"
mkdir -p "$1/hours"
cp docs/pictures/watch.lua "$1/hours/hours.lua"
ffmpeg -v error -y -f lavfi -i "aevalsrc=.5*sin(523*t)*max(0\,1-mod(t\,1.5)):d=12" \
  "$1/hours/tune.wav"
(cd "$1/hours" && exec "$celspan" watch hours.lua) >"$1/watch.txt" &
page=$!
trap 'kill $page' EXIT
until grep -q http "$1/watch.txt"; do sleep 0.2; done
CELSPAN_BROWSER_SECONDS=300 SHOTS="$(cd "$1" && pwd)" \
  node tests/support/browser.js "$1/browser" \
  "$(sed 's/watching //' "$1/watch.txt")" docs/pictures/watch.js
"$celspan" convert "$1/watch.png" docs/pictures/watch.png --size 960x600
for name in values render; do
  "$celspan" convert "$1/watch_$name.png" docs/pictures/watch_$name.png --size 800x500
done
pngquant --force --ext .png 200 docs/pictures/watch.png docs/pictures/watch_values.png \
  docs/pictures/watch_render.png
