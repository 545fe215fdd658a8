#!/bin/sh
# decode.sh MAKE_RANDOM LUA CHECK DECODER: random planes, drawn by the decoder that shares no code.
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
for coded in '' coded; do
  # shellcheck disable=SC2086
  "$1" "$folder" 60 23 19 $coded >/dev/null && "$2" "$3" "$4" "$folder" 60 23 19 || exit 1
done
