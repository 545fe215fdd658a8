#!/usr/bin/env bash
# Defocus beside libvips: `defocus.sh CELSPAN [SIDE]`. A hundred flat shapes, Gaussians of radius 5,
# 50 and 500 pixels (sigma is half the radius), one thread each, user time of whole runs. celspan makes the frame from the
# scene, to spans and to 8-bit pixels; vips blurs the same sharp frame, given as pixels in its own
# format, and what it needs to copy that file is taken off. Needs `vips` (libvips-tools) for its
# half, and says so without.
set -euo pipefail
celspan=${1:?path of the celspan program}
side=${2:-4096}
limit=120 # seconds that a blur may take
scene=$(dirname "$0")/defocus.lua
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export VIPS_CONCURRENCY=1 TIMEFORMAT=%U

stats() { # radius kernel [more options]
  local radius=$1 kernel=$2
  shift 2
  "$celspan" spans "$scene" --stats --size "${side}x$side" --workers 1 "$@" -- "$radius" "$kernel"
}

field() { sed -n "s/.* $1 \([0-9.]*\).*/\1/p"; }

blur_seconds() { # sigma
  local spent
  if ! spent=$( { time timeout "$limit" vips gaussblur "$work/sharp.v" "$work/soft.v" "$1" \
    >/dev/null 2>&1; } 2>&1); then
    echo "over $limit"
    return
  fi
  LC_ALL=C awk -v t="$spent" -v c="$copying" 'BEGIN { printf "%.2f", t - c }'
}

has_vips=false
if command -v vips >/dev/null; then
  has_vips=true
  "$celspan" render "$scene" -o "$work/sharp.png" --size "${side}x$side" --progress none -- 0
  vips copy "$work/sharp.png" "$work/sharp.v"
  copying=$( { time vips copy "$work/sharp.v" "$work/copy.v"; } 2>&1)
else
  echo "vips is not there (Debian: libvips-tools): its column is left out"
fi

printf '%-10s %-9s %10s %9s %10s %10s\n' radius kernel spans seconds pixels vips
for radius in 5 50 500; do
  units=$(LC_ALL=C awk -v r="$radius" -v s="$side" 'BEGIN { print r * 1024 / s }')
  for kernel in gaussian box disc; do
    seconds=$( { time stats "$units" "$kernel" >"$work/line"; } 2>&1)
    pixels=$( { time stats "$units" "$kernel" --pixels 8 >/dev/null; } 2>&1)
    blur=-
    if $has_vips && [ "$kernel" = gaussian ]; then
      blur=$(blur_seconds "$(LC_ALL=C awk -v r="$radius" 'BEGIN { print r / 2 }')")
    fi
    printf '%-10s %-9s %10s %9s %10s %10s\n' "$radius" "$kernel" "$(field spans <"$work/line")" \
      "$seconds" "$pixels" "$blur"
  done
done
