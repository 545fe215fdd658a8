#!/usr/bin/env bash
# The cost of a task on a farm apart from its frames: processor time in milliseconds, the mean of
# RUNS runs.
#
#   tests/farm/cost.sh [SCRIPT [SIZE]]     scripts/demo.lua 1920x1080
#
# Prints: the program alone; a task without frames, which has read the script; a frame, written and
# recorded; a frame left by an earlier run; and a frame of 50,000 x 50,000 whole, as 16 strips
# together, and their join.
set -eu -o pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
script=${1:-$root/scripts/demo.lua}
size=${2:-1920x1080}
celspan=${CELSPAN:-$root/build/celspan}
runs=${RUNS:-20}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# cost COUNT COMMAND...: milliseconds of processor time, user and system, of one run of COUNT.
cost() {
  local count=$1
  shift
  {
    TIMEFORMAT='%U %S'
    time for ((i = 0; i < count; i++)); do "$@" >/dev/null 2>"$work/said" || exit; done
  } 2>&1 | awk -v count="$count" '{ printf "%.2f\n", 1000 * ($1 + $2) / count }'
}

tell() { printf '%-44s %8s ms\n' "$1" "$2"; }

task() {
  "$celspan" render "$script" -o "$work/out/####.png" --size "$size" --workers 1 --resume "$@"
}

many=10
frames() { rm -rf "$work/out"; task --frames 1-$many; }
resumed() { task --frames 1-$many; }

start=$(cost "$runs" "$celspan" --version)
empty=$(cost "$runs" task --frames 1 --task 1/2)
made=$(cost 2 frames)
kept=$(cost "$runs" resumed)
large() { "$celspan" render "$script" --frames 1 --size 50000x50000 --workers 1 "$@"; }
in_strips() {
  for ((n = 1; n <= 16; n++)); do large --strip "$n/16" -o "$work/strips/$n.png"; done
}
join() { "$celspan" join "$work/strips/#.png" -o "$work/joined.png"; }

whole=$(cost 1 large -o "$work/whole.png")
strips=$(cost 1 in_strips)
joined=$(cost 1 join)
tell "the program" "$start"
tell "and the script ($(basename "$script"))" "$empty"
tell "a frame of $size, made" "$(awk "BEGIN { printf \"%.2f\", ($made - $empty) / $many }")"
tell "a frame of $size, kept by --resume" \
  "$(awk "BEGIN { printf \"%.2f\", ($kept - $empty) / $many }")"
tell "a frame of 50000x50000, whole" "$whole"
tell "the same as 16 strips together" "$strips"
tell "and their join" "$joined"
