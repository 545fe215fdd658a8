/* A whole text: of a file that an option names, or from standard input. */
#pragma once

#include <stdio.h>

#include "program/report/report.h"

typedef struct cs_text_file {
  char *bytes; /* owned */
  size_t size, capacity;
} cs_text_file;

/* Reads to the end of the file. option, name: for messages. OK, or reported; *out may be closed in
 * both cases. */
cs_exit cs_text_file_read(celspan_context *context, FILE *file, const char *option,
                          const char *name, cs_text_file *out);
void cs_text_file_close(celspan_context *context, cs_text_file *input);
