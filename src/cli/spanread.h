/* Span files as rows of spans: linear light, premultiplied, as renderers make them.
 *
 * Only the rows asked for are read. Memory: one row.
 */
#ifndef CS_CLI_SPANREAD_H
#define CS_CLI_SPANREAD_H

#include <spanfile.h>

#include "celspan/celspan.h"

typedef struct cs_spanread cs_spanread;

/* Whether the file can be read and begins as span files do. */
bool cs_spanread_is(const char *path);

/* path: copied. out: new. Errors: INPUT with the byte and the reason, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_spanread_open(celspan_context *context, const char *path,
                                                cs_spanread **out);
void cs_spanread_close(cs_spanread *file);

spanfile_info cs_spanread_info(const cs_spanread *file);
uint64_t cs_spanread_bytes(const cs_spanread *file);

/* The columns [x0, x1) of row y, moved left by x0: sorted, without gap. Gradients come as arrays.
 * Valid until the next call. */
CELSPAN_CHECKED celspan_status cs_spanread_row(cs_spanread *file, int32_t y, int32_t x0, int32_t x1,
                                               const celspan_span **spans, size_t *span_count);
/* Reads the whole file and counts what it is made of. */
CELSPAN_CHECKED celspan_status cs_spanread_check(cs_spanread *file, spanfile_counts *counts);

#endif
