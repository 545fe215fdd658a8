# shellcheck shell=bash
# What the tests of engines share: a folder, daemons that are stopped in the end, a film, and the
# comparison with the same film made in one run. Read by slurm.sh and grid_engine.sh.
set -u -o pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
celspan=$(realpath "${CELSPAN:-$root/build/celspan}")
work=$(mktemp -d)
processes=()

say() { printf '== %s\n' "$*"; }

die() {
  printf '%s: %s\n' "${0##*/}" "$*" >&2
  tail -n 20 "$work"/*.log 2>/dev/null >&2
  exit 1
}

# need PROGRAM ...
need() {
  local program
  [ "$(id -u)" = 0 ] || die "run it as root, in a container"
  for program in "$@"; do
    command -v "$program" >/dev/null ||
      die "$program is missing: the head of this file names the packages"
  done
}

# Stops the daemons, waits for them and removes the folder.
finish_engine() {
  local process
  for process in "${processes[@]}"; do kill "$process" 2>/dev/null; done
  wait 2>/dev/null
  rm -rf "$work"
}

film() {
  cat >"$work/film.lua" <<'TEXT'
local celspan = require "celspan"
return celspan.film { size = { 1000, 1000 }, frames = 240, frame = function(f)
  local discs = {}
  for i = 1, 200 do
    discs[i] = celspan.circle { centre = { i * 37 % 1000, i * 61 % 1000 }, radius = 5 + i % 50,
      texture = i % 2 == 0 and "#c04030" or "#30508080" }:translate(f.number, 0)
  end
  return celspan.rostrum { celspan.cel(discs) }
end }
TEXT
}

# same_frames FOLDER [PREFIX]: whether its 240 pictures are those of one run.
same_frames() {
  local frame count=0
  [ -d whole ] || "$celspan" render film.lua -o whole/####.png --progress none ||
    die "render failed"
  for frame in whole/*.png; do
    cmp "$frame" "$1/${2:-}${frame##*/}" || die "a frame differs"
    count=$((count + 1))
  done
  [ "$count" = 240 ] || die "there are $count frames"
  say "240 frames, the same as in one run"
}
