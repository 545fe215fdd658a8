#include "readers/layered/document.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "inside/number.h"
#include "readers/type/xml.h"

celspan_status cs_document_fail(const cs_document *document, celspan_status status,
                                const char *format, ...) {
  char sentence[CS_ERROR_SIZE / 2];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(sentence, sizeof sentence, format, arguments);
  va_end(arguments);
  return cs_fail(document->context, status, "%s: %s:%llu: %s", document->input->path,
                 document->format->member, (unsigned long long)document->line, sentence);
}

/* ---------------------------------------------------------------- attributes */

const char *cs_document_text(const cs_document *document, const char *name) {
  for (const char *const *at = document->attributes; *at; at += 2)
    if (strcmp(at[0], name) == 0)
      return at[1];
  return NULL;
}

celspan_status cs_document_number(const cs_document *document, const char *name, double least,
                                  double most, double *out) {
  const char *text = cs_document_text(document, name);
  double number;
  if (!text)
    return CELSPAN_OK;
  const char *rest = cs_decimal_read(text, &number);
  if (!rest || *rest || !(number >= least && number <= most))
    return cs_document_fail(document, CELSPAN_INPUT,
                            "%s is \"%.40s\"; it must be a number from %.10g to %.10g", name, text,
                            least, most);
  *out = number;
  return CELSPAN_OK;
}

celspan_status cs_document_whole(const cs_document *document, const char *name, int32_t *out) {
  double number = *out, farthest = (double)CS_CONTENTS_FARTHEST;
  CS_TRY(cs_document_number(document, name, -farthest, farthest, &number));
  *out = (int32_t)floor(number + 0.5);
  return CELSPAN_OK;
}

celspan_status cs_document_size(cs_document *document, const char *width, const char *height) {
  int32_t size[2] = {0, 0};
  CS_TRY(cs_document_whole(document, width, &size[0]));
  CS_TRY(cs_document_whole(document, height, &size[1]));
  CS_TRY(
      cs_contents_check_size(document->context, document->input, "the painting", size[0], size[1]));
  document->painting->width = size[0];
  document->painting->height = size[1];
  document->has_size = true;
  return CELSPAN_OK;
}

bool cs_document_is_inside(const char *name) {
  for (const char *at = name; at; at = strchr(at, '/') ? strchr(at, '/') + 1 : NULL)
    if (strncmp(at, "..", 2) == 0 && (at[2] == '/' || at[2] == 0))
      return false;
  return name[0] != 0 && name[0] != '/' && !strchr(name, '\\');
}

/* ---------------------------------------------------------------- layers */

celspan_status cs_document_add(cs_document *document, bool is_group, cs_contents_layer **out) {
  const char *name = cs_document_text(document, "name");
  name = name ? name : "";
  CS_TRY(cs_contents_add(document->context, document->input, document->painting, name, strlen(name),
                         out));
  (*out)->parent = document->group;
  (*out)->is_group = is_group;
  if (is_group)
    document->group = document->painting->count - 1;
  return CELSPAN_OK;
}

void cs_document_close_group(cs_document *document) {
  document->group = document->painting->layers[document->group].parent;
}

celspan_status cs_document_scan(cs_document *document, int64_t count) {
  int64_t size = document->input->size, largest = (int64_t)1 << 50;
  int64_t most = CS_DOCUMENT_SCANNED + CS_DOCUMENT_SCANNED_EACH * (size < largest ? size : largest);
  document->scanned += count;
  if (document->scanned <= most)
    return CELSPAN_OK;
  return cs_document_fail(
      document, CELSPAN_LIMIT,
      "the layers up to here unpack to more than %lld bytes, which is the limit "
      "for a file of this size",
      (long long)most);
}

/* ---------------------------------------------------------------- reading */

static bool on_start(void *user, const char *name, const char *const *attributes, uint64_t line) {
  cs_document *document = user;
  document->attributes = attributes;
  document->line = line;
  document->status = document->format->start(document, cs_xml_local_name(name));
  return document->status == CELSPAN_OK;
}

static bool on_end(void *user, const char *name, uint64_t line) {
  cs_document *document = user;
  document->line = line;
  if (document->format->end)
    document->status = document->format->end(document, cs_xml_local_name(name));
  return document->status == CELSPAN_OK;
}

static bool on_text(void *user, const char *bytes, size_t size, uint64_t line) {
  (void)user, (void)bytes, (void)size, (void)line;
  return true;
}

static celspan_status parse(cs_document *document, const cs_zip_member *member) {
  const cs_document_format *format = document->format;
  const cs_xml_handler handler = {on_start, on_end, on_text, document, format->depth};
  char name[CS_ERROR_SIZE / 2];
  unsigned char *bytes;
  size_t size;
  CS_TRY(cs_zip_load(document->context, document->input, member, CS_DOCUMENT_BYTES, &bytes, &size));
  snprintf(name, sizeof name, "%s: %s", document->input->path, format->member);
  celspan_status status = cs_xml_parse(document->context, name, format->purpose,
                                       (const char *)bytes, size, &handler, &document->status);
  cs_mem_free(document->context->memory, bytes, size + 1);
  return status;
}

celspan_status cs_document_read_member(cs_document *document, const cs_zip_member *member,
                                       const cs_document_format *format) {
  const cs_document_format own = {member->name, document->format->purpose, format->start,
                                  format->end, document->format->depth};
  cs_document inner = *document;
  inner.format = &own;
  CS_TRY(parse(&inner, member));
  document->scanned = inner.scanned;
  return cs_document_scan(document, member->unpacked);
}

celspan_status cs_document_read(celspan_context *context, const cs_input *input, const cs_zip *zip,
                                const cs_document_format *format, celspan_painting *painting) {
  cs_document document = {.context = context,
                          .input = input,
                          .zip = zip,
                          .painting = painting,
                          .format = format,
                          .group = CS_CONTENTS_NONE};
  celspan_status status = parse(&document, cs_zip_find(zip, format->member));
  cs_mem_free(context->memory, document.shown, zip->count * sizeof *document.shown);
  CS_TRY(status);
  if (!document.has_size)
    return cs_document_fail(&document, CELSPAN_INPUT, "does not declare the size of the painting");
  cs_contents_reverse(painting);
  return CELSPAN_OK;
}
