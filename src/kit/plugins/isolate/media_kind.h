/* The containers of sounds and movies, found from the first bytes of a file, whatever its name.
 *
 *   container        first bytes                                 in ffmpeg       for
 *   wav              RIFF, RF64 or BW64, a size, WAVE            wav             sounds
 *   flac             fLaC                                        flac            sounds
 *   mp3              the header of a frame of layer 3            mp3             sounds
 *   mp3, flac        ID3, with a tag before one of the two       mp3, flac       sounds
 *   ogg, opus, ogv   OggS                                        ogg             both
 *   m4a, mp4, mov    a size, ftyp                                mov             both
 *   old mov          a size, moov, mdat, wide                    mov             movies
 *   mkv, webm        1a 45 df a3                                 matroska        both
 *   avi              RIFF, a size, AVI                           avi             both
 *   mxf              06 0e 2b 34                                 mxf             both
 *   ts               47 at 0 and at 188                          mpegts          both
 *   y4m              YUV4MPEG2                                   yuv4mpegpipe    movies
 *
 * An old mov may only name other files, which hold its sound, so it is refused as a sound.
 *
 * INVARIANT: all other files are refused, above all lists of files, addresses, texts, and the still
 * pictures that are packed like an mp4 (AVIF, HEIC, CR3).
 */
#pragma once

typedef enum cs_media_use { CS_MEDIA_SOUND = 1, CS_MEDIA_MOVIE = 2 } cs_media_use;

#define CS_MEDIA_SOUNDS "wav, mp3, flac, ogg, opus or m4a"
#define CS_MEDIA_MOVIES "mp4, mov, mkv, webm, avi, mxf, ogv, ts or y4m"

/* ffmpeg's name for the container of an open file; NULL: it has none that is of use, or, with errno
 * not 0, it cannot be read. */
const char *cs_media_kind(int descriptor, cs_media_use use);
