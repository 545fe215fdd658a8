#!/usr/bin/env bash
# Makes the npm package of the player, celspan-film; `./run player` calls it:
#
#   packaging/player.sh CELSPAN FOLDER        FOLDER is deleted first
#
# Its README is docs/player.md, without the links to other pages.
set -eu -o pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
celspan=$1 folder=$2
version=$(sed -n "s/^  version: '\(.*\)',/\1/p" "$top/meson.build")

rm -rf "$folder"
mkdir -p "$folder"
"$celspan" plane -o "$folder/celspan-film.js"
sed "s/@VERSION@/$version/" "$top/packaging/player/package.json.in" >"$folder/package.json"
sed 's/\[\([^]]*\)\]([^)]*)/\1/g; 1s/.*/# celspan-film/' "$top/docs/player.md" >"$folder/README.md"
cp "$top/packaging/player/celspan-film.d.ts" "$top/LICENSE" "$folder/"
