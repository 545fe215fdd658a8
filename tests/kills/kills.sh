#!/usr/bin/env bash
# Renders a film again and again with --resume and ends the program at random times, by
# SIGKILL, SIGTERM and SIGINT in turn, until COUNT runs were ended so.
#
#   tests/kills/kills.sh CELSPAN COUNT
#
# After every end each file with a final name is a frame of the reference, made by a run that was
# not interrupted; after a signal that can be handled no temporary file is left; and whenever a run
# completes, all frames exist, equal to the reference, and no temporary file is left by this or an
# earlier run.
set -um # jobs of a shell with -m hear SIGINT
celspan=$(realpath "$1")
count=$2
RANDOM=${CELSPAN_SEED:-1}
film=$(realpath "$(dirname "$0")")/film.lua
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

signals=(KILL TERM INT)
endings=(png tga span)
most_milliseconds=120

die() {
  printf 'kills: %s\n' "$*" >&2
  exit 1
}

# check WHERE: the files with final names.
check() {
  local file
  for file in out/f.*; do
    [ -e "$file" ] || continue
    cmp -s "$file" "reference/${file#out/}" || die "$1: $file is not the frame of the reference"
  done
}

count_parts() { find out -name '*.part' 2>/dev/null | wc -l; }

render() { "$celspan" render "$film" --progress none "$@"; }

ended=(0 0 0) runs=0 films=0
for ending in "${endings[@]}"; do
  render -o "reference/f.##.$ending" || die "the reference cannot be rendered"
done
all=$(find reference -name "f.*.${endings[0]}" | wc -l)

while [ $((ended[0] + ended[1] + ended[2])) -lt "$count" ]; do
  which=$((runs % 3)) ending=${endings[films % 3]}
  "$celspan" render "$film" --progress none --resume --workers $((1 + runs % 2)) \
    -o "out/f.##.$ending" 2>stderr &
  process=$!
  sleep "$(printf '0.%03d' $((RANDOM % most_milliseconds)))"
  kill -s "${signals[which]}" $process 2>/dev/null
  wait $process 2>/dev/null
  code=$?
  runs=$((runs + 1)) where="run $runs, $ending, SIG${signals[which]}, exit code $code"
  check "$where"
  case $code in
  0)
    films=$((films + 1))
    [ "$(find out -name "f.*.$ending" | wc -l)" = "$all" ] || die "$where: a frame is missing"
    [ "$(count_parts)" = 0 ] || die "$where: a temporary file is left"
    rm -rf out
    ;;
  137) ended[0]=$((ended[0] + 1)) ;;
  130 | 143)
    ended[which]=$((ended[which] + 1))
    # A killed run may have left one; a run that was stopped may have been too early to find it.
    [ "$(count_parts)" -le "${parts:-0}" ] || die "$where: a temporary file is left"
    ;;
  *) die "$where: $(cat stderr)" ;;
  esac
  parts=$(count_parts)
done
render --resume -o "out/f.##.$ending" || die "the last run failed"
check "the last run"
[ "$(count_parts)" = 0 ] || die "the last run: a temporary file is left"

printf '%d runs were ended (%d by SIGKILL, %d by SIGTERM, %d by SIGINT), %d came to their end\n' \
  "$((ended[0] + ended[1] + ended[2]))" "${ended[@]}" "$films"
echo "every file under a final name was a frame of the reference; no temporary file was left"
