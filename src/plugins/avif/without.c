/* The same functions where libavif is missing. */
#include <stdio.h>

#include "plugins/avif/avif.h"

celspan_status cs_avif_open(const cs_picture_output *output, cs_avif **out,
                            cs_picture_failure *failure) {
  (void)out;
  failure->status = CELSPAN_OUTPUT;
  snprintf(failure->text, sizeof failure->text,
           "%s: this celspan was built without libavif; build it with -Davif=enabled",
           output->name);
  return failure->status;
}

/* No file is ever open. */
celspan_status cs_avif_rows(cs_avif *avif, int32_t count, const void *rows,
                            cs_picture_failure *failure) {
  (void)avif, (void)count, (void)rows, (void)failure;
  return CELSPAN_OUTPUT;
}

celspan_status cs_avif_close(cs_avif *avif, cs_picture_failure *failure) {
  (void)avif, (void)failure;
  return CELSPAN_OUTPUT;
}

void cs_avif_abandon(cs_avif *avif) { (void)avif; }
