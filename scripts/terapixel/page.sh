#!/bin/sh
# The page of scripts/terapixel.lua: the whole at low resolution, and the places of its list down to
# single pixels. From the top of the tree, after a build:
#
#   scripts/terapixel/page.sh FOLDER
build/celspan tiles scripts/terapixel.lua --size 1000000x1000000 --levels 0-12 \
  --places scripts/terapixel/places.txt -o "$1" && echo "   $1/index.html opens in a browser"
