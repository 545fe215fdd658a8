#!/bin/sh
# From nothing to a first film, and every verb that celspan has, where only celspan may be there:
#
#   packaging/verbs.sh CELSPAN
#
# What needs more than celspan must say so in a sentence, with the exit code that goes with it.
set -u
celspan=$1
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place" || exit 1
faults=0

# expect CODES ARGUMENT...: runs celspan, which must end with one of the codes.
expect() {
  codes=$1
  shift
  verbs="$verbs $1"
  "$celspan" "$@" >out.txt 2>err.txt
  code=$?
  case " $codes " in
  *" $code "*) ;;
  *)
    echo "celspan $*: exit code $code, not $codes: $(head -3 err.txt)"
    faults=$((faults + 1))
    ;;
  esac
  [ "$code" = 0 ] || [ -s err.txt ] || {
    echo "celspan $*: exit code $code without a sentence"
    faults=$((faults + 1))
  }
}
verbs=

start=$(date +%s)
times >before.txt
expect 0 init first
expect 0 render first/film.lua -o film/f.####.png --progress none
times >after.txt
# Where other programs run too, the clock says little: so the processors' time counts.
share=$(awk -v all="$(nproc)" 'FNR == 2 {
    split($0, t, /[ms ]+/)
    spent = 60 * (t[1] + t[3]) + t[2] + t[4] - spent
  }
  END { printf "%.0f", spent / all }' before.txt after.txt)
echo "   the first film, $(find film -name '*.png' | wc -l) frames: $(($(date +%s) - start)) s," \
  "$share s of all processors"
[ "$share" -lt 10 ] || {
  echo "the first film took too long"
  faults=$((faults + 1))
}

# What all verbs can work with: corners to follow, and no grade.
cat >tiles.lua <<'TEXT'
local celspan = require "celspan"
local tiles = {}
for i = 0, 24 do
  tiles[i + 1] = celspan.rect { 20 + i % 5 * 21, 10 + i // 5 * 20, 6 + i % 7, 9, texture = "#c42" }
end
return celspan.film { size = { 160, 120 }, frames = 3, frame = function(f)
  local cel = celspan.cel { celspan.union(tiles):translate(f.number, 0) }
  return celspan.rostrum { cel, back = "#fff" }
end }
TEXT
film=first/film.lua frame=film/f.0001.png
own=$(dirname "$(readlink -f "$(command -v "$celspan")")")
for example in "$own"/../share/celspan/examples/*.lua; do
  [ ! -e "$example" ] || expect 0 render "$example" --frames 1 -o example.png
done
expect 0 info "$film"
expect 0 info "$frame"
expect 0 check "$film"
expect 0 describe "$film"
expect 0 spans "$film" --stats
expect 0 probe "$film" 100 100
expect 0 render "$film" --frames 1 -o frame.span
for ending in jpg webp tif exr; do
  expect 0 render "$film" --frames 1 -o "frame.$ending"
  expect 0 info "frame.$ending"
done
expect 0 convert frame.exr other.png
expect 0 compare "$frame" "$frame"
expect 0 compare frame.span frame.span
expect 0 render tiles.lua -o tiles.#.png
expect 0 render tiles.lua -o frame.plane
expect 0 plane frame.plane -o page.html
expect 0 tiles "$film" --frame 1 -o tiles
expect 0 sheet "$film"
expect "0 4 5" sound "$film" -o sound.wav
expect "0 5" render "$film" --frames 1-5 -o film.mp4
expect 0 contact "$film" -o contact.png
expect 0 sprites "$film" --scale 0.25 -o sprites.png
expect 0 relight tiles.1.png -o light.png --light grey --to "#ffffff"
expect 0 trace tiles.1.png -o art.svg
expect 0 track tiles.#.png --from 1 --at 15,5,110,100 --frames 1-3
expect 0 farm "$film" -o 'f.####.png' --slurm
expect 0 render "$film" --frames 1 --strip 1/2 -o strip.1.png
expect 0 render "$film" --frames 1 --strip 2/2 -o strip.2.png
expect 0 join strip.1.png strip.2.png -o joined.png
expect "0 5" test first/spec
expect 0 help render
expect 0 --man
for verb in watch play; do
  timeout 3 "$celspan" "$verb" "$film" >out.txt 2>err.txt
  cat out.txt err.txt | grep -q 'http://' || {
    echo "celspan $verb shows no page: $(head -3 err.txt)"
    faults=$((faults + 1))
  }
  verbs="$verbs $verb"
done
list='/^celspan VERB/,/^celspan --version/s/^  \([a-z]*\) .*/\1/p'
for verb in $("$celspan" help | sed -n "$list"); do
  case "$verbs " in
  *" $verb "*) ;;
  *)
    echo "the verb $verb is not tried"
    faults=$((faults + 1))
    ;;
  esac
done
echo "   $("$celspan" --version): $faults faults"
[ "$faults" = 0 ]
