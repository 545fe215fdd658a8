#!/bin/sh
# The animated picture of the front page, docs/pictures/moving.webp: how the last lamp of Little One
# begins to burn, and the town after it. From the top of the tree:
#
#   docs/pictures/moving.sh FOLDER        FOLDER keeps the parts
set -eu
build/celspan render scripts/film.lua --frames 397-587:2 --size 640x360 --progress none \
  -o "$1/film.####.png"
build/celspan render docs/pictures/moving.lua --allow "$1" --progress none --quality 50 \
  --no-dither -o docs/pictures/moving.webp -- "$1"
