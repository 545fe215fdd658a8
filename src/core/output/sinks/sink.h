/* The sinks: where finished rows go.
 *
 *   create --> begin --> row, row, ... (top to bottom) --> end
 *      \----------\-- a failure or a change of mind: cs_sink_discard
 *
 * INVARIANT: a sink is destroyed by its `end` or by cs_sink_discard, and by nothing else: not by a
 * begin or a row that fails. Files appear whole or not at all (output/sinks/file.h).
 */
#pragma once

#include "base/context.h"
#include "celspan/celspan.h"
#include "output/sinks/file.h"

/* The calls of a sink, if the functions of the file have these names. */
#define CS_SINK_CALLS                                                                              \
  .struct_size = sizeof(celspan_sink), .begin = begin, .row = put_row, .end = end

/* PNG, 8 or 16 bit, straight from spans. coding: resolved, integer. */
CELSPAN_CHECKED celspan_status cs_sink_png(celspan_context *context, const char *path,
                                           const celspan_file_desc *file, celspan_sink *out);
/* The same at the end of a file that is open, which another caller ends; path: for messages. */
CELSPAN_CHECKED celspan_status cs_sink_png_part(celspan_context *context, const char *path,
                                                cs_file *into, const celspan_file_desc *file,
                                                celspan_sink *out);
/* Targa, 8 bit, straight from spans. LIMIT beyond 65,535 pixels a side. */
CELSPAN_CHECKED celspan_status cs_sink_tga(celspan_context *context, const char *path,
                                           const celspan_file_desc *file, celspan_sink *out);
/* Any other format through the picture module; checks the format's limits first. */
CELSPAN_CHECKED celspan_status cs_sink_picture(celspan_context *context, const char *path,
                                               const celspan_file_desc *file, celspan_sink *out);
/* Whether the picture sink writes the format of this name. */
bool cs_sink_picture_knows(const char *name);
/* The names of these formats, "exr, tif, ..."; cut if there is no room for all. */
void cs_sink_picture_list(char *out, size_t size);
/* A span file (docs/spanfile.md): depth 8 in sRGB, straight, or half in linear light,
 * premultiplied. */
CELSPAN_CHECKED celspan_status cs_sink_span(celspan_context *context, const char *path,
                                            const celspan_file_desc *file, celspan_sink *out);
/* RGBA pixels into the caller's memory; pixels NULL: they are coded and dropped, for measuring
 * speed. */
CELSPAN_CHECKED celspan_status cs_sink_memory(celspan_context *context,
                                              const celspan_coding *coding, void *pixels,
                                              size_t stride, celspan_sink *out);
/* A hash of all coded pixels, written to digest by `end`. */
CELSPAN_CHECKED celspan_status cs_sink_digest(celspan_context *context,
                                              const celspan_coding *coding, uint64_t digest[2],
                                              celspan_sink *out);
/* Chosen by the format or the path's ending: PNG, Targa, a span file, or the picture module. */
CELSPAN_CHECKED celspan_status cs_sink_file(celspan_context *context, const char *path,
                                            const celspan_file_desc *file, celspan_sink *out);
/* Whether the format of such a file is known. */
bool cs_sink_file_knows(const char *path, const celspan_file_desc *file);
/* The names of the formats, "png, tga, ...": for messages; cut if there is no place for all. */
enum { CS_SINK_LIST = 128 };
void cs_sink_file_list(char *out, size_t size);
/* Whether such a file contains the number of its frame, so that files of equal frames differ. */
bool cs_sink_file_is_numbered(const char *path, const celspan_file_desc *file);
/* Destroys a sink whose end was not called; the context's error does not change. */
void cs_sink_discard(celspan_context *context, celspan_sink *sink);

/* A sink that passes every row to two other sinks: a frame that is made once is written and hashed.
 *
 * INVARIANT: both sinks get the same calls, the second one only if the first succeeded; but `end`
 * always reaches both.
 */
typedef struct cs_tee {
  celspan_sink sinks[2]; /* they are ended in this order */
  bool is_ended;         /* false after a render: the caller must discard the sinks */
} cs_tee;

/* tee: its sinks are set; borrowed until the sink ends. */
celspan_sink cs_tee_sink(cs_tee *tee);
