#!/usr/bin/env bash
# Read by key.sh and displace.sh: the cost of effects at 1920 x 1080 with one thread, beside ffmpeg.
# Each is the time of a frame with the effect less that of a frame without it: of rows, and
# of `frames` frames of ffmpeg, which decodes each picture once. They take turns for ROUNDS rounds;
# the least times count, in milliseconds, in `best`.
set -u -o pipefail
name=$(basename "$0" .sh)
celspan=${CELSPAN:-$PWD/build/celspan}
script=tests/bench/scripts/$name.lua
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
declare -A best

die() {
  printf '%s.sh: %s\n' "$name" "$*" >&2
  exit 1
}
command -v ffmpeg >/dev/null || die "install the package ffmpeg"

# A picture of the script: picture FILE ARGUMENT...
picture() {
  local file=$1
  shift
  "$celspan" render "$script" -o "$folder/$file" --progress none -- "$@" || die "celspan failed"
}
# The milliseconds of a frame of the script: rows ARGUMENT...
rows() {
  "$celspan" spans "$script" --stats --pixels 8 --workers 1 --allow "$folder" \
    -- "$@" | awk 'NR == 1 { print 1000 * $NF }'
}
# Those of a frame of ffmpeg: filtered ARGUMENT..., its inputs and filters.
filtered() {
  local begin=${EPOCHREALTIME/./}
  ffmpeg -v error -threads 1 -filter_threads 1 -filter_complex_threads 1 "$@" \
    -frames:v "${frames:?}" -f null - || return 1
  awk -v took=$((${EPOCHREALTIME/./} - begin)) -v count="${frames:?}" \
    'BEGIN { print took / count / 1e3 }'
}
# note WHAT MILLISECONDS
note() {
  best[$1]=$(awk -v a="${best[$1]:-1e9}" -v b="$2" 'BEGIN { print a < b ? a : b }')
}
# report EFFECT WITH WITHOUT FFMPEG_WITH FFMPEG_WITHOUT
report() {
  awk -v what="$1" -v ours="${best[$2]}" -v plain="${best[$3]}" -v theirs="${best[$4]}" \
    -v bare="${best[$5]}" 'BEGIN {
    printf "%s: celspan %.1f ms (%.1f without), ffmpeg %.1f ms (%.1f without); %.2f times ffmpeg " \
      "(at most 1)\n", what, ours - plain, plain, theirs - bare, bare,
      (ours - plain) / (theirs - bare)
  }'
}
