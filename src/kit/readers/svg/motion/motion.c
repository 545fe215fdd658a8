#include "readers/svg/motion/motion.h"

#include "inside/number.h"

celspan_status cs_svg_move(cs_svg_reading *reading, double *seconds) {
  const cs_svg_document *document = reading->document;
  cs_svg_extent extent = {0, 0};
  if (document->animation_count > 0)
    CS_TRY(cs_svg_smil_run(reading, &extent));
  if (document->has_motion)
    CS_TRY(cs_svg_keyframes_run(reading, &extent));
  *seconds = extent.end > 0 ? extent.end : extent.period;
  if (!cs_number_is_sane(*seconds))
    *seconds = 1e12;
  return CELSPAN_OK;
}
