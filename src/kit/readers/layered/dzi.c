#include "readers/layered/dzi.h"

#include <string.h>
#include <strings.h>

#include "readers/layered/input.h"
#include "readers/type/xml.h"

enum { BYTES_MOST = 65536, DEPTH = 8, DIGITS_MOST = 9 };

bool cs_dzi_is(const char *name) {
  size_t length = strlen(name);
  return length > 4 && strcasecmp(name + length - 4, ".dzi") == 0;
}

static int32_t whole_of(const char *text) {
  size_t digits = strspn(text, "0123456789");
  int32_t number = 0;
  if (digits < 1 || digits > DIGITS_MOST || text[digits])
    return -1;
  while (*text)
    number = 10 * number + (*text++ - '0');
  return number;
}

/* Only of the image and its size: other elements have a width, too. */
static bool on_start(void *user, const char *name, const char *const *attributes, uint64_t line) {
  celspan_picture_tiles *tiles = user;
  const struct {
    const char *name;
    int32_t *number;
  } numbers[] = {{"Width", &tiles->width},
                 {"Height", &tiles->height},
                 {"TileSize", &tiles->size},
                 {"Overlap", &tiles->overlap}};
  const char *element = cs_xml_local_name(name);
  (void)line;
  if (strcmp(element, "Image") != 0 && strcmp(element, "Size") != 0)
    return true;
  for (; *attributes; attributes += 2) {
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
      if (strcmp(attributes[0], numbers[i].name) == 0)
        *numbers[i].number = whole_of(attributes[1]);
    if (strcmp(attributes[0], "Format") == 0)
      strcpy(tiles->ending, strlen(attributes[1]) < sizeof tiles->ending ? attributes[1] : "");
  }
  return true;
}

static bool on_end(void *user, const char *name, uint64_t line) {
  (void)user, (void)name, (void)line;
  return true;
}

static bool on_text(void *user, const char *bytes, size_t size, uint64_t line) {
  (void)user, (void)bytes, (void)size, (void)line;
  return true;
}

static celspan_status parse(celspan_context *context, const cs_input *input,
                            celspan_picture_tiles *out) {
  char bytes[BYTES_MOST];
  const celspan_status fine = CELSPAN_OK;
  const cs_xml_handler handler = {on_start, on_end, on_text, out, DEPTH};
  if (input->size > BYTES_MOST)
    return cs_input_fail(context, input, -1, CELSPAN_INPUT,
                         "has more than %d bytes; a description of tiles is shorter", BYTES_MOST);
  CS_TRY(cs_input_read(context, input, 0, bytes, (size_t)input->size));
  return cs_xml_parse(context, input->path, "reading a description of tiles", bytes,
                      (size_t)input->size, &handler, &fine);
}

celspan_status cs_dzi_read(celspan_context *context, const char *path, celspan_picture_tiles *out) {
  cs_input input = {.path = path};
  *out = (celspan_picture_tiles){-1, -1, -1, -1, ""};
  CS_TRY(cs_input_open(context, &input));
  celspan_status status = parse(context, &input, out);
  cs_input_close(&input);
  return status;
}
