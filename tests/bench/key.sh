#!/usr/bin/env bash
# The cost of a chroma key at 1920 x 1080 with one thread, beside that of ffmpeg's chromakey.
#
#   tests/bench/key.sh
#
# Each is the time of a frame with the key less that of the frame without it: of celspan's rows, and
# of 60 frames of ffmpeg, which decodes the picture once. They take turns for ROUNDS rounds (9); the
# least times count.
set -u -o pipefail
cd "$(dirname "$0")/../.." || exit 1

celspan=${CELSPAN:-$PWD/build/celspan}
script=tests/bench/scripts/key.lua
rounds=${ROUNDS:-9}
count=60
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

die() {
  printf 'key.sh: %s\n' "$*" >&2
  exit 1
}

command -v ffmpeg >/dev/null || die "install the package ffmpeg"
"$celspan" render "$script" -o "$folder/take.png" --progress none || die "celspan failed"

# The milliseconds of a frame.
rows() {
  "$celspan" spans "$script" --stats --pixels 8 --workers 1 --allow "$folder" \
    -- "$1" "$folder/take.png" | awk 'NR == 1 { print 1000 * $NF }'
}
filtered() {
  local begin=${EPOCHREALTIME/./}
  ffmpeg -v error -threads 1 -filter_threads 1 -i "$folder/take.png" \
    -vf "format=yuva444p,loop=loop=$count:size=1$1" -frames:v "$count" -f null - || return 1
  awk -v took=$((${EPOCHREALTIME/./} - begin)) -v count="$count" \
    'BEGIN { print took / count / 1e3 }'
}

declare -A best
note() {
  best[$1]=$(awk -v a="${best[$1]:-1e9}" -v b="$2" 'BEGIN { print a < b ? a : b }')
}

for ((i = 0; i < rounds; i++)); do
  note take "$(rows take)"
  note key "$(rows key)"
  note plain "$(filtered '')"
  note chromakey "$(filtered ,chromakey=0x2fb457:0.1:0.2)"
done

awk -v take="${best[take]}" -v key="${best[key]}" -v plain="${best[plain]}" \
  -v chromakey="${best[chromakey]}" 'BEGIN {
  printf "celspan %.1f ms (%.1f without)   ffmpeg %.1f ms (%.1f without)\n", key, take, chromakey,
    plain
  printf "the key: celspan %.1f ms, ffmpeg %.1f ms; %.2f times ffmpeg (at most 1)\n", key - take,
    chromakey - plain, (key - take) / (chromakey - plain)
}'
