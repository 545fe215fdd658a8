#include "engine/paint/over_bare.h"

#include <assert.h>

static_assert(CS_OVER_ROW_BATCH == CS_SAMPLER_BATCH, "a batch of samples is a batch of the fold");

void cs_over_bare_begin(cs_over_bare *over, int32_t count) {
  over->shown = (cs_over_bare_range){0, count};
  over->count = count;
  over->is_first = true;
}

void cs_over_bare_add(cs_isa isa, cs_over_bare *over) {
  over->shown = CS_WIDE_CHOOSE(isa, cs_over_bare_fold)(over);
  over->is_first = false;
}

static const cs_back_light *light_behind(const cs_stack *stack) {
  static const cs_back_light none = {.keep = 1};
  return stack->light_count > 0 ? stack->lights : &none;
}

void cs_over_bare_end(cs_isa isa, const cs_stack *stack, const cs_over_bare *over,
                      float (*rgba)[4]) {
  CS_WIDE_CHOOSE(isa, cs_over_bare_mix_rgba)(light_behind(stack), over, rgba);
}

void cs_over_bare_codes(cs_isa isa, const cs_stack *stack, const cs_over_bare *over,
                        unsigned char *codes) {
  CS_WIDE_CHOOSE(isa, cs_over_bare_mix_codes)(light_behind(stack), over, codes);
}
