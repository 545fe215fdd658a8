/* The destination of frames: standard output, one file, or a numbered sequence of files. */
#pragma once

#include "frames/film/sequence.h"
#include "program/script.h"

/* OK if this version can write the output under the options. Otherwise the reason is reported: an
 * unknown format, a coding that the format lacks, or a video, which is not a picture. */
cs_exit cs_target_refuse(celspan_context *context, const char *path, const cs_request *request);
/* The coding of pixels under the options, with defaults, except --dither. */
celspan_coding cs_target_coding(const cs_request *request);
/* The description of a file under the options, without the metadata of frames, and without the
 * place of a strip. */
celspan_file_desc cs_target_file(const cs_request *request, celspan_coding *coding);
/* The frames of --frames, or all frames; with --task only its share of these, which may be empty.
 * Each frame exists in the film and has its own name in the output, unless the output is NULL. out:
 * new. OK, or reported. */
cs_exit cs_target_frames(const cs_script *script, const cs_request *request, const char *output,
                         cs_sequence *out);
/* Whether OUT is one plane file, for one frame or all of them. */
bool cs_target_is_plane_film(const cs_request *request);
/* The same for any file that several frames share, except videos: "plane" or "pdf"; NULL: it is
 * not such a file. */
const char *cs_target_shared(const cs_request *request);
/* Whether OUT is a Lottie animation, which verbs/render.lua writes. */
bool cs_target_is_lottie(const cs_request *request);
/* Whether the path means standard output, for raw frames. */
bool cs_target_is_stream(const char *path);
