#include "base/mark.h"

#include <stdio.h>
#include <string.h>

struct cs_text {
  atomic_size_t references;
  cs_memory *memory;
  size_t size; /* the size of the whole text */
  char bytes[];
};

static cs_text *create_text(cs_memory *memory, const char *bytes, size_t length) {
  size_t size = sizeof(cs_text) + length + 1;
  cs_text *text = cs_mem_resize(memory, NULL, 0, size);
  if (!text)
    return NULL;
  atomic_init(&text->references, 1);
  text->memory = cs_memory_ref(memory);
  text->size = size;
  memcpy(text->bytes, bytes, length);
  text->bytes[length] = 0;
  return text;
}

void cs_mark_keep_text(cs_text *text) {
  atomic_fetch_add_explicit(&text->references, 1, memory_order_relaxed);
}

void cs_mark_drop_text(cs_text *text) {
  if (atomic_fetch_sub_explicit(&text->references, 1, memory_order_acq_rel) != 1)
    return;
  cs_memory *memory = text->memory;
  cs_mem_free(memory, text, text->size);
  cs_memory_unref(memory);
}

cs_mark cs_mark_now(const celspan_context *context) {
  const cs_mark *at = &context->origin;
  return at->line > 0 ? *at : (cs_mark){NULL, NULL, 0, 0};
}

const char *cs_mark_name(cs_mark mark) { return mark.name ? mark.name->bytes : ""; }

celspan_origin cs_mark_origin(cs_mark mark) {
  return (celspan_origin){mark.source ? mark.source : "", mark.line};
}

cs_mark_text cs_mark_describe(cs_mark mark) {
  cs_mark_text out = {""};
  int length = 0;
  if (mark.name)
    length = snprintf(out.text, sizeof out.text, " '%s'", mark.name->bytes);
  if (mark.source)
    snprintf(out.text + length, sizeof out.text - (size_t)length, " (%s:%d)", mark.source,
             (int)mark.line);
  return out;
}

/* ---------------------------------------------------------------- names */

/* Bytes of the UTF-8 character at `at`; 0 when it is invalid or a control character. Overlong
 * forms, surrogates and numbers above U+10FFFF are invalid. */
static size_t character(const unsigned char *at) {
  static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  size_t size = at[0] < 0x80       ? 1
                : at[0] >> 5 == 6  ? 2
                : at[0] >> 4 == 14 ? 3
                : at[0] >> 3 == 30 ? 4
                                   : 0;
  if (size == 0)
    return 0;
  uint32_t code = size == 1 ? at[0] : at[0] & (0x7fu >> size);
  for (size_t i = 1; i < size; i++) {
    if (at[i] >> 6 != 2)
      return 0;
    code = code << 6 | (at[i] & 0x3fu);
  }
  bool is_control = code < 0x20 || (code >= 0x7f && code < 0xa0);
  bool is_surrogate = code >= 0xd800 && code < 0xe000;
  return is_control || is_surrogate || code < least[size] || code > 0x10ffff ? 0 : size;
}

static celspan_status check_name(celspan_context *context, const char *name) {
  if (!name)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "named: the name is missing");
  size_t length = strlen(name);
  if (length < 1 || length > CS_MARK_NAME)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "named: the name has %zu bytes; it must have 1 to %d", length, CS_MARK_NAME);
  for (size_t i = 0, size; i < length; i += size) {
    size = character((const unsigned char *)name + i);
    if (size == 0)
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "named: byte %zu of the name is not text; it must be UTF-8 without control "
                     "characters",
                     i + 1);
  }
  return CELSPAN_OK;
}

celspan_status cs_mark_named(celspan_context *context, cs_mark mark, const char *name,
                             cs_mark *out) {
  CS_TRY(check_name(context, name));
  cs_text *text = create_text(context->memory, name, strlen(name));
  if (!text)
    return cs_fail_memory(context);
  *out = (cs_mark){text, mark.source, mark.line, mark.callers};
  return CELSPAN_OK;
}
