#!/bin/sh
# The picture of the page of celspan watch, docs/pictures/watch.png: the film of `celspan init` in
# Debian's chromium. From the top of the tree:
#
#   docs/pictures/watch.sh FOLDER        FOLDER keeps the parts
set -eu
rm -rf "$1/first"
build/celspan init "$1/first"
build/celspan watch "$1/first/film.lua" >"$1/watch.txt" &
page=$!
trap 'kill $page' EXIT
until grep -q http "$1/watch.txt"; do sleep 0.2; done
CELSPAN_BROWSER_SECONDS=300 SHOT="$(cd "$1" && pwd)/page.png" \
  node tests/support/browser.js "$1/browser" \
  "$(sed 's/watching //' "$1/watch.txt")" docs/pictures/watch.js
build/celspan convert "$1/page.png" docs/pictures/watch.png --size 960x570
