#!/usr/bin/env bash
# The cost of a displacement and of a blur along a line at 1920 x 1080 with one thread, beside those
# of ffmpeg's displace and dblur.
#
#   tests/bench/displace.sh
#
# Each is the time of a frame with the effect less that of a frame without it, which shows the same
# pictures: of celspan's rows, and of 20 frames of ffmpeg, which decodes each picture once. They
# take turns for ROUNDS rounds (5); the least times count.
set -u -o pipefail
cd "$(dirname "$0")/../.." || exit 1

celspan=${CELSPAN:-$PWD/build/celspan}
script=tests/bench/scripts/displace.lua
rounds=${ROUNDS:-5}
count=20
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

die() {
  printf 'displace.sh: %s\n' "$*" >&2
  exit 1
}

command -v ffmpeg >/dev/null || die "install the package ffmpeg"
"$celspan" render "$script" -o "$folder/take.png" --progress none || die "celspan failed"
"$celspan" render "$script" -o "$folder/map.png" --progress none -- map || die "celspan failed"

# The milliseconds of a frame.
rows() {
  "$celspan" spans "$script" --stats --pixels 8 --workers 1 --allow "$folder" \
    -- "$1" "$folder/take.png" "$folder/map.png" | awk 'NR == 1 { print 1000 * $NF }'
}
filtered() {
  local begin=${EPOCHREALTIME/./}
  ffmpeg -v error -threads 1 -filter_threads 1 -filter_complex_threads 1 -i "$folder/take.png" \
    -i "$folder/map.png" -filter_complex \
    "[0]format=gbrp,loop=$count:size=1[a];[1]format=gbrp,loop=$count:size=1[m];$1" \
    -map '[o]' -frames:v "$count" -f null - || return 1
  awk -v took=$((${EPOCHREALTIME/./} - begin)) -v count="$count" \
    'BEGIN { print took / count / 1e3 }'
}

declare -A best
note() {
  best[$1]=$(awk -v a="${best[$1]:-1e9}" -v b="$2" 'BEGIN { print a < b ? a : b }')
}

for ((i = 0; i < rounds; i++)); do
  for what in take both displace blur; do note "$what" "$(rows "$what")"; done
  note plain "$(filtered '[m]nullsink;[a]null[o]')"
  note ffdisplace "$(filtered '[m]split[x][y];[a][x][y]displace[o]')"
  note dblur "$(filtered '[m]nullsink;[a]dblur=angle=45:radius=20[o]')"
done

awk -v take="${best[take]}" -v both="${best[both]}" \
  -v displace="${best[displace]}" -v blur="${best[blur]}" \
  -v plain="${best[plain]}" -v ffdisplace="${best[ffdisplace]}" -v dblur="${best[dblur]}" 'BEGIN {
  line = "%s: celspan %.1f ms, ffmpeg %.1f ms; %.2f times ffmpeg (at most 1)\n"
  printf line, "displacement", displace - both, ffdisplace - plain,
    (displace - both) / (ffdisplace - plain)
  printf line, "a blur of 20 pixels", blur - take, dblur - plain, (blur - take) / (dblur - plain)
}'
