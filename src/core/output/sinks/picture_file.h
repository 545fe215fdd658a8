/* A file that the picture module writes: its bytes go to the core's file, which appears whole or
 * not at all.
 *
 *   rows --cs_picture_file_rows--> module --put--> file.h --close: read back, commit--> file
 *
 * INVARIANT: an opened file is ended once, by close or by discard. It must not be moved, because
 * the module keeps its address.
 */
#pragma once

#include "model/pictures/module.h"
#include "output/sinks/file.h"

/* A film in AVIF has 16 bits for a side, and readers refuse more pixels, as they would need too
 * much memory. Videos of quality 75 have this factor, too. A WebP has 14 bits. */
#define CS_AVIF_SIDE 65535
#define CS_AVIF_PIXELS ((int64_t)1 << 28)
#define CS_AVIF_CRF 24
#define CS_WEBP_SIDE 16383

typedef struct cs_picture_file {
  celspan_context *context; /* the context of the call in progress, for put */
  const cs_picture_module *module;
  cs_picture_writer *writer;
  cs_file *file;
  cs_picture_output output;
  celspan_status put_status;
  bool is_abandoned;
} cs_picture_file;

/* output: its put and user are set here; the texts in it are borrowed until the file ends. After a
 * failure nothing must be ended. Errors: OUTPUT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_picture_file_open(celspan_context *context,
                                                    const cs_picture_output *output,
                                                    cs_picture_file *out);
/* Writes `count` rows from y on, in the form that the output describes; rows come in order. Errors:
 * OUTPUT. */
CELSPAN_CHECKED celspan_status cs_picture_file_rows(cs_picture_file *file, celspan_context *context,
                                                    int32_t y, int32_t count, const void *rows);
/* Completes the file, and closes it in any case. Errors: OUTPUT, also if the written file cannot be
 * read back. */
CELSPAN_CHECKED celspan_status cs_picture_file_close(cs_picture_file *file,
                                                     celspan_context *context);
/* Removes the file. A file that was never opened, and is all zero, is ignored. */
void cs_picture_file_discard(cs_picture_file *file, celspan_context *context);
