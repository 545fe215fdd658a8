#!/usr/bin/env bash
# The speed of videos: wall time compared with a pipe to ffmpeg and with ffmpeg alone.
#
#   tests/bench/video.sh [SCRIPT [FRAMES [ENDING]]]
#
#   video   celspan render SCRIPT -o film.ENDING
#   pipe    celspan render SCRIPT -o - | ffmpeg, with the arguments that celspan gives it
#   alone   ffmpeg with the same arguments, over those frames as a raw file
#
# Where celspan passes planes of Y'CbCr to ffmpeg, the other two have ffmpeg convert RGBA to them.
#
# The three take turns for ROUNDS rounds (5), on two processors. Ratios are those of the best times:
# video to pipe should be 0.95 at least, video to alone 0.85.
set -u -o pipefail
cd "$(dirname "$0")/../.." || exit 1

celspan=${CELSPAN:-$PWD/build/celspan}
script=${1:-scripts/demo.lua}
frames=${2:-1-120}
ending=${3:-mp4}
rounds=${ROUNDS:-5}
size=1920x1080
from_rgb=scale=out_color_matrix=bt709:out_range=tv:flags=area+accurate_rnd+full_chroma_int
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

die() {
  printf 'video.sh: %s\n' "$*" >&2
  exit 1
}

real=$(command -v ffmpeg) || die "install the package ffmpeg"
pinned=(taskset -c 0,1)
command -v taskset >/dev/null || pinned=()

# An ffmpeg that records its arguments, so that the others get exactly the same.
mkdir "$folder/bin"
cat >"$folder/bin/ffmpeg" <<TEXT
#!/bin/sh
printf '%s\n' "\$@" >"$folder/arguments"
exec "$real" "\$@"
TEXT
chmod +x "$folder/bin/ffmpeg"

render() {
  "${pinned[@]}" "$celspan" render "$script" --size "$size" --frames "$frames" \
    --background '#000' --progress none "$@"
}
raw() { render -o - --alpha premultiplied --depth "$depth"; }
encode() { "${pinned[@]}" "$real" "${arguments[@]}" "file:$1"; }

video() { render -o "$folder/video.$ending"; }
pipe() { raw | encode "$folder/pipe.$ending"; }
alone() { encode "$folder/alone.$ending" <"$folder/raw"; }

PATH="$folder/bin:$PATH" video || die "celspan failed"
mapfile -t arguments <"$folder/arguments"
unset 'arguments[-1]'
for i in "${!arguments[@]}"; do
  case ${arguments[i]} in
  yuv4*) arguments[i]=rgb0 ;;
  format=yuv4*) arguments[i]=$from_rgb,${arguments[i]} ;;
  esac
done
depth=8
[[ " ${arguments[*]} " != *" rgba64le "* ]] || depth=16
raw >"$folder/raw" || die "celspan failed"

declare -A best
clock() {
  local begin=${EPOCHREALTIME/./} took
  "$1" || die "$1 failed"
  took=$((${EPOCHREALTIME/./} - begin))
  [ -n "${best[$1]:-}" ] && [ "${best[$1]}" -le "$took" ] || best[$1]=$took
}

for ((i = 0; i < rounds; i++)); do
  for way in video pipe alone; do clock "$way"; done
done

printf '%s, frames %s, %s, %s, best of %d, %d processors\n' "$script" "$frames" "$size" \
  "$ending" "$rounds" "$(nproc)"
awk -v video="${best[video]}" -v pipe="${best[pipe]}" -v alone="${best[alone]}" 'BEGIN {
  printf "video %.3f s   pipe %.3f s   alone %.3f s\n", video / 1e6, pipe / 1e6, alone / 1e6
  printf "video to pipe %.3f (at least 0.95)   video to alone %.3f (at least 0.85)\n",
    pipe / video, alone / video
}'
