#!/usr/bin/env bash
# The cost of a displacement and of a blur along a line, beside those of ffmpeg's displace and dblur
# (beside_ffmpeg.sh).
#
#   tests/bench/displace.sh
cd "$(dirname "$0")/../.." || exit 1
. tests/bench/beside_ffmpeg.sh
frames=20

mapped() {
  filtered -i "$folder/take.png" -i "$folder/map.png" -filter_complex \
    "[0]format=gbrp,loop=$frames:size=1[a];[1]format=gbrp,loop=$frames:size=1[m];$1" -map '[o]'
}

picture take.png
picture map.png map
for ((i = 0; i < ${ROUNDS:-5}; i++)); do
  for what in take both displace blur; do
    note "$what" "$(rows "$what" "$folder/take.png" "$folder/map.png")"
  done
  note plain "$(mapped '[m]nullsink;[a]null[o]')"
  note ffdisplace "$(mapped '[m]split[x][y];[a][x][y]displace[o]')"
  note dblur "$(mapped '[m]nullsink;[a]dblur=angle=45:radius=20[o]')"
done
report displacement displace both ffdisplace plain
report "a blur of 20 pixels" blur take dblur plain
