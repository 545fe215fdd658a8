#include "program/report/text_file.h"

#include <errno.h>
#include <string.h>

#include "inside/context.h"

#define SIZE_MOST ((size_t)64 << 20)
#define PIECE ((size_t)1 << 16)

cs_exit cs_text_file_read(celspan_context *context, FILE *file, const char *option,
                          const char *name, cs_text_file *out) {
  for (size_t got = 1; got > 0; out->size += got) {
    if (out->size > SIZE_MOST) {
      cs_report_error("%s%s: it has more than 64 MiB", option, name);
      return CS_EXIT_INPUT;
    }
    celspan_status status = cs_mem_reserve(context, (void **)&out->bytes, &out->capacity,
                                           out->size + PIECE, sizeof *out->bytes);
    if (status != CELSPAN_OK)
      return cs_report_failure(context, status, NULL);
    got = fread(out->bytes + out->size, 1, PIECE, file);
  }
  if (!ferror(file))
    return CS_EXIT_OK;
  cs_report_error("%s%s: %s", option, name, strerror(errno));
  return CS_EXIT_INPUT;
}

void cs_text_file_close(celspan_context *context, cs_text_file *input) {
  cs_mem_free(context->memory, input->bytes, input->capacity * sizeof *input->bytes);
  input->bytes = NULL;
}
