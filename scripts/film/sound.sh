#!/bin/sh
# The sound of scripts/film.lua, FOLDER/sound.wav, from the top of the tree. espeak-ng speaks the
# lamplighter's lines, whose mouths are in scripts/film/voice.tsv.
#
#   scripts/film/sound.sh FOLDER
set -eu

# speak NAME SPEED PITCH WORDS
speak() { espeak-ng -z -v en-gb+m3 -a 150 -s "$2" -p "$3" -w "$1" "$4"; }

speak "$1/coaxing.wav" 118 30 "Come on... little one."
speak "$1/thanks.wav" 112 32 "There you are."
lua5.4 scripts/film/sound.lua "$1/sound.wav" "$1/coaxing.wav" "$1/thanks.wav"
