#include "frames/film/film.h"

#include <stddef.h>

#include "base/context.h"

/* The exposures of a frame, and what is needed to free them from any thread. */
typedef struct kept {
  cs_memory *memory; /* counted: frames may outlive their context */
  size_t size;
  celspan_exposure exposures[];
} kept;

celspan_status cs_film_frame_init(cs_film_frame *out, celspan_context *context,
                                  const celspan_exposure *exposures, size_t count) {
  size_t size;
  kept *k = NULL;
  if (!__builtin_mul_overflow(count, sizeof *exposures, &size) &&
      !__builtin_add_overflow(size, sizeof *k, &size))
    k = cs_mem_resize(context->memory, NULL, 0, size);
  if (!k)
    return cs_fail_memory(context);
  k->memory = cs_memory_ref(context->memory);
  k->size = size;
  for (size_t i = 0; i < count; i++) {
    k->exposures[i] = exposures[i];
    celspan_rostrum_ref(exposures[i].rostrum);
  }
  *out = (cs_film_frame){.exposures = k->exposures, .count = count};
  return CELSPAN_OK;
}

void cs_film_frame_finish(cs_film_frame *frame) {
  if (!frame->exposures)
    return;
  for (size_t i = 0; i < frame->count; i++)
    celspan_rostrum_unref(frame->exposures[i].rostrum);
  kept *k = (kept *)((char *)frame->exposures - offsetof(kept, exposures));
  cs_memory *memory = k->memory;
  cs_mem_free(memory, k, k->size);
  cs_memory_unref(memory);
  *frame = (cs_film_frame){0};
}

/* The mark's own last frame if it has one. Otherwise the frame before the next mark that is at a
 * later frame; without such a mark the film's last frame. */
int64_t cs_film_mark_last(const cs_film_info *film, size_t mark) {
  if (film->marks[mark].has_last)
    return film->marks[mark].last;
  for (size_t i = mark + 1; i < film->mark_count; i++)
    if (film->marks[i].frame > film->marks[mark].frame)
      return film->marks[i].frame - 1;
  return film->first + film->count - 1;
}

void cs_film_expose(const cs_film_info *film, const cs_film_frame *frame, celspan_frame_desc *out) {
  if (out->film_width == 0 && out->film_height == 0) {
    out->film_width = film->width;
    out->film_height = film->height;
  }
  out->space = film->space;
  out->exposures = frame->exposures;
  out->exposure_count = frame->count;
  out->repeats = frame->repeats;
}
