#include "frames/film/slots.h"

#include "frames/render/frame.h"

/* Slots beyond one for each worker: for a frame that is given on, and one that is ready. */
enum { AHEAD = 2 };

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

/* Bytes that the caches may keep, and do not. */
static size_t bytes_left(const celspan_context *context) {
  const celspan_context *root = context->root;
  /* and an eighth of that of maps for outlines of strokes (model/stroke/kept.h) */
  size_t most = root->picture_bytes + root->defocus_bytes + root->map_bytes + root->map_bytes / 8 +
                root->held_bytes;
  size_t kept = atomic_load(&context->memory->kept);
  return kept < most ? most - kept : 0;
}

size_t cs_slots_count(celspan_context *context, size_t frame_size, int workers) {
  size_t room = bytes_left(context) / (frame_size ? frame_size : 1);
  size_t threads = (size_t)cs_frame_workers(context, workers);
  size_t count = threads < 2 ? 1 : least(threads + AHEAD, room);
  return count ? count : 1;
}

celspan_status cs_slots_open(cs_slots *out, celspan_context *context, size_t count,
                             size_t frame_size) {
  *out = (cs_slots){.count = count, .frame_size = frame_size};
  CS_TRY(CS_MAKE(context, out->frames, count));
  cs_account_keep(context->memory, count * frame_size);
  for (size_t i = 0; i < count; i++) {
    out->frames[i] = cs_mem_resize(context->memory, NULL, 0, frame_size);
    if (!out->frames[i])
      return cs_fail_memory(context);
  }
  return CELSPAN_OK;
}

void cs_slots_close(cs_slots *slots, celspan_context *context) {
  if (!slots->frames)
    return;
  for (size_t i = 0; i < slots->count; i++)
    cs_mem_free(context->memory, slots->frames[i], slots->frame_size);
  cs_account_give_up(context->memory, slots->count * slots->frame_size);
  cs_mem_free(context->memory, slots->frames, slots->count * sizeof *slots->frames);
  *slots = (cs_slots){0};
}
