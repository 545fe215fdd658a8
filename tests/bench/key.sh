#!/usr/bin/env bash
# The cost of a chroma key, beside that of ffmpeg's chromakey (beside_ffmpeg.sh).
#
#   tests/bench/key.sh
cd "$(dirname "$0")/../.." || exit 1
. tests/bench/beside_ffmpeg.sh
frames=60

keyed() {
  filtered -i "$folder/take.png" -vf "format=yuva444p,loop=loop=$frames:size=1$1"
}

picture take.png
for ((i = 0; i < ${ROUNDS:-9}; i++)); do
  for what in take key; do note "$what" "$(rows "$what" "$folder/take.png")"; done
  note plain "$(keyed '')"
  note chromakey "$(keyed ,chromakey=0x2fb457:0.1:0.2)"
done
report "the key" key take chromakey plain
