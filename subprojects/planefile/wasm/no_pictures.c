/* In place of what reads and draws pictures, for pages of planes without any: their decoder is
 * smaller.
 */
#include "../src/picture.h"

const char pf_no_memory[] = "no memory";

const char *pf_picture_decode(const planefile_source *source, const pf_memory *memory,
                              const pf_light_curve *curve, pf_picture_code code, pf_picture *out) {
  (void)source, (void)memory, (void)curve, (void)code, (void)out;
  return "this decoder has no pictures";
}

void pf_picture_colours(const pf_picture *picture, const planefile_axis *axis,
                        const pf_pixels *pixels, pf_colours *out) {
  (void)picture, (void)axis, (void)pixels, (void)out;
}
