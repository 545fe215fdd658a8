#!/bin/sh
# The animated picture of the front page, docs/pictures/moving.webp: how the last lamp of Little One
# begins to burn, and the town after it, joined by ffmpeg. From the top of the tree:
#
#   docs/pictures/moving.sh FOLDER        FOLDER keeps the parts
set -eu
build/celspan render scripts/film.lua --frames 397-587:2 --size 640x360 --progress none \
  -o "$1/film.####.png"
build/celspan render docs/pictures/moving.lua --allow "$1" --progress none \
  -o "$1/moving.####.png" -- "$1"
ffmpeg -y -loglevel error -framerate 12 -i "$1/moving.%04d.png" -c:v libwebp_anim -quality 70 \
  -compression_level 6 -loop 0 docs/pictures/moving.webp
