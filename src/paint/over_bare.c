#include "paint/over_bare.h"

cs_over_bare_range cs_over_bare_add(cs_isa isa, bool is_first, const float (*rgba)[4],
                                    cs_over_bare_range range, float (*folded)[4]) {
  return CS_WIDE_CHOOSE(isa, cs_over_bare_fold)(is_first, rgba, range, folded);
}

/* Makes the last picture clear where it is not shown. Returns the light behind. */
static const cs_back_light *clear_beside(const cs_stack *stack, cs_over_bare *over) {
  static const cs_back_light none = {.keep = 1};
  const cs_over_bare_range *shown = &over->shown;
  memset(over->rgba, 0, (size_t)shown->first * sizeof *over->rgba);
  memset(over->rgba + shown->end, 0, (size_t)(over->count - shown->end) * sizeof *over->rgba);
  return stack->light_count > 0 ? stack->lights : &none;
}

void cs_over_bare_end(cs_isa isa, const cs_stack *stack, cs_over_bare *over, float (*rgba)[4]) {
  const cs_back_light *behind = clear_beside(stack, over);
  CS_WIDE_CHOOSE(isa, cs_over_bare_mix_rgba)
  (behind, over->is_first, (const float(*)[4])over->rgba, over->count,
   (const float(*)[4])over->folded, rgba);
}

void cs_over_bare_codes(cs_isa isa, const cs_stack *stack, cs_over_bare *over,
                        unsigned char *codes) {
  const cs_back_light *behind = clear_beside(stack, over);
  CS_WIDE_CHOOSE(isa, cs_over_bare_mix_codes)
  (behind, over->is_first, (const float(*)[4])over->rgba, over->count,
   (const float(*)[4])over->folded, codes);
}
