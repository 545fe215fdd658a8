/* Where frames go: standard output, one file, or a numbered sequence of files. */
#pragma once

#include "frames/film/sequence.h"
#include "program/script.h"

/* OK for what this version can write under the options. Everything else is reported: unknown
 * formats, codings that a format lacks, and video, which is not a picture. */
cs_exit cs_target_refuse(celspan_context *context, const char *path, const cs_request *request);
/* The coding of pixels under the options, with defaults, except --dither. */
celspan_coding cs_target_coding(const cs_request *request);
/* The description of a file under the options, without a frame's own metadata, and without the
 * place of a strip. */
celspan_file_desc cs_target_file(const cs_request *request, celspan_coding *coding);
/* The frames of --frames, or all, and of these only the share of --task, which may be empty. Each
 * is in the film and has a name of its own in the output, unless that is NULL. out: new. OK, or
 * reported. */
cs_exit cs_target_frames(const cs_script *script, const cs_request *request, const char *output,
                         cs_sequence *out);
/* Whether OUT is one plane file, for one frame or all of them. */
bool cs_target_is_plane_film(const cs_request *request);
/* Standard output, for raw frames. */
bool cs_target_is_stream(const char *path);
