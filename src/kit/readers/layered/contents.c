#include "readers/layered/contents.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "inside/context.h"

/* ---------------------------------------------------------------- names */

/* The bytes of the character at the start of a text; 0 if it is not valid UTF-8. */
static size_t character_size(const unsigned char *at, size_t left) {
  static const unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
  size_t size = at[0] < 0x80 ? 1 : at[0] < 0xC2 ? 0 : at[0] < 0xE0 ? 2 : at[0] < 0xF0 ? 3 : 4;
  if (size > left || at[0] > 0xF4)
    return 0;
  uint32_t code = size == 1 ? at[0] : at[0] & (0x7Fu >> size);
  for (size_t i = 1; i < size; i++) {
    if ((at[i] & 0xC0) != 0x80)
      return 0;
    code = code << 6 | (at[i] & 0x3Fu);
  }
  bool is_good =
      size > 0 && code >= least[size] && code <= 0x10FFFF && !(code >= 0xD800 && code < 0xE000);
  return is_good ? size : 0;
}

static bool is_control(const unsigned char *at, size_t size) {
  return (size == 1 && (at[0] < 0x20 || at[0] == 0x7F)) ||
         (size == 2 && at[0] == 0xC2 && at[1] < 0xA0);
}

/* Each byte that is not part of a character becomes a question mark. */
static void set_name(char out[CS_CONTENTS_TEXT], const char *name, size_t size) {
  const unsigned char *from = (const unsigned char *)name;
  size_t done = 0;
  for (size_t at = 0, step; at < size && from[at] != 0; at += step > 0 ? step : 1) {
    step = character_size(from + at, size - at);
    bool is_bad = step == 0 || is_control(from + at, step);
    size_t count = is_bad ? 1 : step;
    if (done + count >= CS_CONTENTS_TEXT)
      break;
    memcpy(out + done, is_bad ? "?" : name + at, count);
    done += count;
  }
  out[done] = 0;
}

/* ---------------------------------------------------------------- building */

celspan_status cs_contents_create(celspan_context *context, celspan_painting **out) {
  celspan_painting *painting;
  CS_TRY(CS_COUNTED_MAKE(context, painting));
  *out = painting;
  return CELSPAN_OK;
}

celspan_status cs_contents_add(celspan_context *context, const cs_input *input,
                               celspan_painting *painting, const char *name, size_t size,
                               cs_contents_layer **out) {
  if (painting->count == CS_CONTENTS_LAYERS)
    return cs_input_fail(context, input, -1, CELSPAN_LIMIT,
                         "has more than %d layers and groups, which is the limit",
                         CS_CONTENTS_LAYERS);
  CS_TRY(CS_ARRAY_RESERVE(context, painting->layers, painting->count + 1));
  cs_contents_layer *layer = &painting->layers[painting->count++];
  *layer = (cs_contents_layer){.blend = "normal",
                               .parent = CS_CONTENTS_NONE,
                               .is_visible = true,
                               .opacity = 1,
                               .colour = "srgb"};
  set_name(layer->name, name, size);
  *out = layer;
  return CELSPAN_OK;
}

celspan_status cs_contents_note(celspan_context *context, celspan_painting *painting, size_t layer,
                                const char *format, ...) {
  CS_TRY(CS_ARRAY_RESERVE(context, painting->notes, painting->note_count + 1));
  cs_contents_remark *note = &painting->notes[painting->note_count++];
  *note = (cs_contents_remark){.layer = layer};
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(note->text, sizeof note->text, format, arguments);
  va_end(arguments);
  return CELSPAN_OK;
}

celspan_status cs_contents_note_own(celspan_context *context, celspan_painting *painting,
                                    const char *sentence) {
  CS_TRY(cs_contents_note(context, painting, cs_contents_last(painting), "%s", sentence));
  painting->notes[painting->note_count - 1].is_own = true;
  return CELSPAN_OK;
}

celspan_status cs_contents_add_key(celspan_context *context, const cs_input *input,
                                   celspan_painting *painting, cs_contents_key **out) {
  if (painting->key_count == CS_CONTENTS_KEYS)
    return cs_input_fail(context, input, -1, CELSPAN_LIMIT,
                         "has more than %d keys, which is the limit", CS_CONTENTS_KEYS);
  CS_TRY(CS_ARRAY_RESERVE(context, painting->keys, painting->key_count + 1));
  *out = &painting->keys[painting->key_count++];
  **out = (cs_contents_key){.fields = CELSPAN_PAINTING_KEY};
  (*out)->fields.layer = cs_contents_last(painting);
  return CELSPAN_OK;
}

static size_t mirror(const celspan_painting *painting, size_t index) {
  return index == CS_CONTENTS_NONE ? index : painting->count - 1 - index;
}

void cs_contents_reverse(celspan_painting *painting) {
  for (size_t low = 0, high = painting->count; low + 1 < high; low++) {
    cs_contents_layer other = painting->layers[--high];
    painting->layers[high] = painting->layers[low];
    painting->layers[low] = other;
  }
  for (size_t i = 0; i < painting->count; i++)
    painting->layers[i].parent = mirror(painting, painting->layers[i].parent);
  for (size_t i = 0; i < painting->note_count; i++)
    painting->notes[i].layer = mirror(painting, painting->notes[i].layer);
  for (size_t i = 0; i < painting->key_count; i++) {
    celspan_painting_key *key = &painting->keys[i].fields;
    key->layer = mirror(painting, key->layer);
    key->drawing = mirror(painting, key->drawing);
  }
}

/* ---------------------------------------------------------------- limits */

static celspan_status check_depth(celspan_context *context, const cs_input *input,
                                  celspan_painting *painting) {
  cs_contents_layer *layers = painting->layers;
  for (size_t i = painting->count; i-- > 0;) {
    size_t parent = layers[i].parent;
    if (parent == CS_CONTENTS_NONE)
      continue;
    if (!layers[parent].is_group)
      return cs_input_fail(context, input, -1, CELSPAN_INPUT,
                           "the layer \"%s\" lies in \"%s\", which is not a group", layers[i].name,
                           layers[parent].name);
    layers[i].depth = layers[parent].depth + 1;
    if (layers[i].depth > CS_CONTENTS_DEPTH)
      return cs_input_fail(context, input, -1, CELSPAN_LIMIT,
                           "groups lie in one another more than %d deep", CS_CONTENTS_DEPTH);
  }
  return CELSPAN_OK;
}

celspan_status cs_contents_check_whole(celspan_context *context, const cs_input *input,
                                       celspan_painting *painting) {
  int64_t pixels = 0;
  for (size_t i = 0; i < painting->count; i++)
    pixels += (int64_t)painting->layers[i].width * painting->layers[i].height;
  if (pixels > CS_CONTENTS_PIXELS_ALL)
    return cs_input_fail(context, input, -1, CELSPAN_LIMIT,
                         "its layers have %lld pixels in all; at most %lld are read",
                         (long long)pixels, (long long)CS_CONTENTS_PIXELS_ALL);
  return check_depth(context, input, painting);
}

celspan_status cs_contents_check_size(celspan_context *context, const cs_input *input,
                                      const char *what, int64_t width, int64_t height) {
  if (width < 1 || height < 1)
    return cs_input_fail(context, input, -1, CELSPAN_INPUT, "%s has a size of %lld x %lld pixels",
                         what, (long long)width, (long long)height);
  if (width > CS_CONTENTS_SIDE || height > CS_CONTENTS_SIDE || width * height > CS_CONTENTS_PIXELS)
    return cs_input_fail(context, input, -1, CELSPAN_LIMIT,
                         "%s has %lld x %lld pixels; at most %d a side and %lld in all are read",
                         what, (long long)width, (long long)height, CS_CONTENTS_SIDE,
                         (long long)CS_CONTENTS_PIXELS);
  return CELSPAN_OK;
}

celspan_status cs_contents_check_corner(celspan_context *context, const cs_input *input,
                                        const char *what, int64_t x, int64_t y) {
  if (x >= -CS_CONTENTS_FARTHEST && x <= CS_CONTENTS_FARTHEST && y >= -CS_CONTENTS_FARTHEST &&
      y <= CS_CONTENTS_FARTHEST)
    return CELSPAN_OK;
  return cs_input_fail(context, input, -1, CELSPAN_LIMIT,
                       "%s lies at %lld, %lld; at most %lld pixels from the painting's corner are "
                       "read",
                       what, (long long)x, (long long)y, (long long)CS_CONTENTS_FARTHEST);
}

void cs_contents_set_pixels(cs_contents_layer *layer, int32_t x, int32_t y,
                            cs_rows_source *source) {
  layer->x = x;
  layer->y = y;
  layer->width = source->width;
  layer->height = source->height;
  layer->source = source;
}
