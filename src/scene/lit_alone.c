#include "scene/lit_alone.h"

static cs_light light_of(float x) { return (cs_light){.is_given = true, .flat = {x, x, x, 0}}; }

celspan_status cs_lit_alone_make(celspan_context *context, const celspan_rostrum *rostrum,
                                 size_t index, bool is_back, cs_lit_alone *out) {
  size_t count = rostrum->cel_count - index;
  cs_lit_alone alone = {.rostrum = *rostrum, .count = count};
  alone.cels = cs_mem_array(context->memory, count, sizeof *alone.cels);
  alone.rostrum.cels = cs_mem_array(context->memory, count, sizeof *alone.rostrum.cels);
  if (count > 0 && (!alone.cels || !alone.rostrum.cels)) {
    cs_lit_alone_finish(context, &alone);
    return cs_fail_memory(context);
  }
  for (size_t i = 0; i < count; i++) {
    alone.cels[i] = *rostrum->cels[index + i];
    alone.cels[i].front = light_of(i == 0 && !is_back ? 1 : 0);
    alone.cels[i].back = light_of(0);
    alone.rostrum.cels[i] = &alone.cels[i];
  }
  /* Behind the rearmost cel that is left the rostrum's back light is where the cel's own one is. */
  alone.rostrum.back = light_of(is_back ? 1 : 0);
  alone.rostrum.cel_count = count;
  alone.rostrum.brightness = 1;
  *out = alone;
  return CELSPAN_OK;
}

void cs_lit_alone_finish(celspan_context *context, cs_lit_alone *alone) {
  cs_mem_free(context->memory, alone->cels, alone->count * sizeof *alone->cels);
  cs_mem_free(context->memory, alone->rostrum.cels, alone->count * sizeof *alone->rostrum.cels);
  alone->cels = NULL;
  alone->rostrum.cels = NULL;
}
