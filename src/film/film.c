#include "film/film.h"

#include <stdlib.h>

bool cs_film_frame_init(cs_film_frame *out, const celspan_exposure *exposures, size_t count) {
  celspan_exposure *copies = malloc((count ? count : 1) * sizeof *copies);
  if (!copies)
    return false;
  for (size_t i = 0; i < count; i++) {
    copies[i] = exposures[i];
    celspan_rostrum_ref(exposures[i].rostrum);
  }
  *out = (cs_film_frame){copies, count};
  return true;
}

void cs_film_frame_finish(cs_film_frame *frame) {
  for (size_t i = 0; i < frame->count; i++)
    celspan_rostrum_unref(frame->exposures[i].rostrum);
  free(frame->exposures);
  *frame = (cs_film_frame){0};
}
