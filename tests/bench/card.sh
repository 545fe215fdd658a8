#!/usr/bin/env bash
# A card of 1200 x 630 with text as PNG, by celspan-web and by satori with resvg, each in a process
# of its own beside an empty one: see card.mjs. From the top of the tree:
#
#   tests/bench/card.sh FOLDER WEB     FOLDER: gets the peers, from npm, and the cards; WEB: of
#                                      ./run web
set -eu
folder=$1 web=$2
PEERS=(satori @resvg/resvg-js@2.6.2)

[ -f "$web/celspan.wasm" ] || { echo "$web has no celspan.wasm: ./run web makes it" >&2 && exit 1; }
mkdir -p "$folder"
npm install -s --no-save --prefix "$folder/card" "${PEERS[@]}" ||
  echo "${PEERS[*]} could not be fetched from npm: they are left out" >&2
tarball=$(npm pack --silent --pack-destination "$folder/card" "$PWD/$web")
printf 'celspan-web: %d bytes packed; unpacked:\n' "$(wc -c <"$folder/card/$tarball")"
du -sb "$web" "$folder/card/node_modules"
printf '%-8s %14s %9s %14s\n' "" "first (ms)" "then" "process (MiB)"
for kind in empty celspan satori; do
  node tests/bench/card.mjs "$kind" "$folder/card" "$web" || echo "$kind: not measured"
done
