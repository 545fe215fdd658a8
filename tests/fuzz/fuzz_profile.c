/* Any bytes as a colour profile of a painting: there is always a table, and the light of every code
 * that it converts is finite and the same in every call.
 */
#include "tests/fuzz/target.h"

#include <math.h>
#include <string.h>

#include "readers/layered/profile_table.h"

enum { PIXELS = 64 };

/* The light of pixels from black to white, along each channel and along all. */
static void check_light(const cs_profile_table *table) {
  uint16_t codes[PIXELS][4];
  float light[PIXELS][4], again[PIXELS][4];
  for (int i = 0; i < PIXELS; i++)
    for (int c = 0; c < 4; c++)
      codes[i][c] = i % 4 == c || i % 4 == 3 ? (uint16_t)(65535 * i / (PIXELS - 1)) : 0;
  cs_profile_table_convert(table, 16, codes, PIXELS, light[0]);
  cs_profile_table_convert(table, 16, codes, PIXELS, again[0]);
  demand(memcmp(light, again, sizeof light) == 0, "the same codes have another light");
  for (int i = 0; i < PIXELS; i++)
    for (int c = 0; c < 4; c++)
      demand(isfinite(light[i][c]), "a light that is not finite");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const cs_input input = {.path = "a painting"};
  const cs_colour_request request = {.bytes = data, .size = size};
  celspan_context *context = NULL;
  cs_profile_table *table = NULL;
  if (size == 0)
    return 0;
  demand(celspan_context_create(NULL, &context) == CELSPAN_OK, "there is no context");
  celspan_status status = cs_profile_table_create(context, &input, &request, &table);
  demand(status == CELSPAN_OK, celspan_context_error(context));
  demand(memchr(table->light.name, 0, sizeof table->light.name), "a name without an end");
  if (table->codes == CS_PROFILE_CONVERTED)
    check_light(table);
  cs_profile_table_unref(table);
  celspan_context_destroy(context);
  return 0;
}

#ifdef REPLAY_MAIN
#include "tests/fuzz/replay.h"
#endif
