/* Any bytes as a font and a text: no fault, no endless work, no leak, every refusal with a
 * sentence, and a text that is set has plausible numbers.
 *
 *   byte 0   how the text is set, see the flags
 *   byte 1   how many of the next bytes are the text
 *   then     the text, and the file of the font
 */
#include "tests/fuzz/target.h"

#include <math.h>
#include <sys/mman.h>
#include <unistd.h>

#include "celspan/text.h"
#include "tests/support/memory.h"

enum { WRAPS = 1, LEFTWARD = 2, VARIES = 4, FEATURES = 8, LANGUAGE = 16, TWICE = 32, TRACKED = 64 };

static void check_letters(const celspan_glyphs *letters, size_t text_size) {
  size_t bytes = 0;
  for (size_t i = 0; i < celspan_glyphs_count(letters); i++) {
    const celspan_glyph *letter = celspan_glyphs_get(letters, i);
    celspan_box box;
    demand(isfinite(letter->x) && isfinite(letter->y) && isfinite(letter->advance),
           "the place of a letter is not finite");
    demand(letter->line >= 1 && letter->object, "a letter has no line or no object");
    if (celspan_object_bounds(letter->object, &box))
      demand(isfinite(box.x + box.y + box.width + box.height), "bounds are not finite");
    bytes += letter->text_size;
  }
  demand(bytes <= text_size, "letters have more text than was given");
}

static void check_status(celspan_context *context, celspan_status status) {
  demand(status == CELSPAN_OK || status == CELSPAN_INPUT || status == CELSPAN_BAD_ARGUMENT ||
             status == CELSPAN_LIMIT,
         "another status than those of bad input");
  demand(status == CELSPAN_OK || celspan_context_error(context)[0], "a refusal without a sentence");
}

static void set_text(const celspan_text_desc *desc) {
  memory_watch watch = {0};
  celspan_context *context = memory_watch_context(&watch);
  celspan_glyphs *letters = NULL;
  celspan_object *object = NULL;
  celspan_status status = celspan_glyphs_create(context, desc, &letters);
  check_status(context, status);
  demand((status == CELSPAN_OK) == (letters != NULL), "an answer and its value disagree");
  if (letters)
    check_letters(letters, desc->text_size);
  demand(celspan_object_create_text(context, desc, &object) == status,
         "letters and the whole text disagree");
  if (object)
    celspan_object_contains(object, (celspan_point){20, -10});
  celspan_object_unref(object);
  celspan_glyphs_destroy(letters);
  celspan_context_destroy(context);
  demand(watch.blocks == 0 && watch.size_errors == 0, "memory is kept, or its size mistaken");
}

static celspan_text_desc describe(const uint8_t *data, size_t text_size) {
  static const celspan_variation variations[] = {{"wght", 633.5}};
  static const celspan_feature features[] = {{"liga", 0}, {"ss01", 1}};
  celspan_text_desc desc = CELSPAN_TEXT_DESC;
  desc.text = (const char *)data + 2;
  desc.text_size = text_size;
  desc.has_width = data[0] & WRAPS;
  desc.width = 150;
  desc.direction = data[0] & LEFTWARD ? CELSPAN_DIRECTION_RTL : CELSPAN_DIRECTION_AUTO;
  desc.variations = variations;
  desc.variation_count = data[0] & VARIES ? 1 : 0;
  desc.features = features;
  desc.feature_count = data[0] & FEATURES ? 2 : 0;
  desc.language = data[0] & LANGUAGE ? "tr" : NULL;
  desc.tracking = data[0] & TRACKED ? -70 : 0;
  return desc;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size < 2)
    return 0;
  size_t text_size = data[1] < size - 2 ? data[1] : size - 2, font_size = size - 2 - text_size;
  char path[40];
  int descriptor = memfd_create("font", MFD_CLOEXEC);
  demand(descriptor >= 0 && write(descriptor, data + 2 + text_size, font_size) >= 0,
         "the file cannot be written");
  snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
  const char *const fonts[] = {path, path};
  celspan_text_desc desc = describe(data, text_size);
  desc.fonts = fonts;
  desc.font_count = data[0] & TWICE ? 2 : 1;
  set_text(&desc);
  close(descriptor);
  return 0;
}

#ifdef REPLAY_MAIN
#include "celspan/text.h"
#include "tests/fuzz/replay.h"
#endif
