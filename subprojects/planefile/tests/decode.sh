#!/bin/sh
# decode.sh MAKE_RANDOM LUA CHECK DECODER: random planes, drawn by the decoder that shares no code.
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
"$1" "$folder" 60 23 19 >/dev/null && "$2" "$3" "$4" "$folder" 60 23 19
