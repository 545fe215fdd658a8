/* The formats of sounds, found from the first bytes of a file, whatever its name.
 *
 *   format      first bytes                                  in ffmpeg
 *   wav         RIFF, RF64 or BW64, a size, WAVE             wav
 *   flac        fLaC                                         flac
 *   ogg, opus   OggS                                         ogg
 *   m4a         a size, ftyp                                 mov
 *   mp3         the header of a frame of layer 3             mp3
 *   mp3, flac   ID3, with a tag before one of the two        mp3, flac
 *
 * INVARIANT: all other files are refused, above all lists of files, addresses and texts.
 */
#pragma once

#include <stddef.h>

#define CS_SOUND_KINDS "wav, mp3, flac, ogg, opus or m4a"

/* The name in ffmpeg of the format of the file behind the descriptor; NULL: none of these, or it
 * cannot be read, with errno not 0. */
const char *cs_sound_kind(int descriptor);
