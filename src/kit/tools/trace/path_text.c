#include "tools/trace/path_text.h"

#include <math.h>
#include <string.h>

#include "common/steps.h"

static celspan_status add(celspan_context *context, cs_writing *writing, const char *bytes,
                          size_t size) {
  CS_TRY(CS_RESERVE(context, writing->bytes, writing->capacity, writing->count + size + 1));
  memcpy(writing->bytes + writing->count, bytes, size);
  writing->count += size;
  writing->bytes[writing->count] = '\0';
  return CELSPAN_OK;
}

celspan_status cs_writing_add(celspan_context *context, cs_writing *writing, const char *text) {
  return add(context, writing, text, strlen(text));
}

/* Returns the length of the text, without its zero. */
static size_t put_number(char out[CS_STEPS_SIZE], double number) {
  return cs_steps_put(out, (int64_t)floor(number * 1000 + 0.5), 3, true);
}

cs_decimal cs_decimal_of(double number) {
  cs_decimal decimal;
  put_number(decimal.text, number);
  return decimal;
}

celspan_status cs_writing_draw(celspan_context *context, cs_writing *writing, char letter,
                               const celspan_point *points, int count) {
  char text[8 + 3 * 2 * CS_STEPS_SIZE];
  size_t size = 0;
  text[size++] = letter;
  for (int i = 0; i < count; i++) {
    if (i > 0)
      text[size++] = ' ';
    size += put_number(text + size, points[i].x);
    text[size++] = ' ';
    size += put_number(text + size, points[i].y);
  }
  return add(context, writing, text, size);
}

void cs_writing_finish(celspan_context *context, cs_writing *writing) {
  cs_mem_free(context->memory, writing->bytes, writing->capacity);
  *writing = (cs_writing){.bytes = NULL};
}
