#include "frames/render/held.h"

#include <math.h>

#include "engine/compose/over_table.h"
#include "frames/render/drawings.h"
#include "model/scene/value.h"
#include "model/scene/walk.h"

/* ---------------------------------------------------------------- the cache */

/* The third word of a key. Of a band that was met, nothing but the key is in the cache. */
enum { MET, KEPT };

typedef struct entry {
  cs_cache_entry entry;
  cs_row_queue rows;
} entry;

typedef struct band {
  cs_hash key;
  entry *kept;               /* pinned; NULL: its rows must be made */
  bool is_wanted;            /* its rows shall be copied */
  _Atomic(entry *) finished; /* the copy, which is not in the cache yet */
} band;

typedef struct cs_held {
  cs_cache *cache;
  int32_t first_row, end_row; /* of the frame, as far as its rows are asked for */
  int32_t first_band;
  size_t count;
  atomic_size_t bytes; /* of the bands that are kept, or will be */
  band bands[];
} cs_held;

static void clear_entry(cs_cache_entry *cached, cs_memory *memory) {
  cs_row_queue_finish(&((entry *)cached)->rows, memory);
}

static celspan_status create(celspan_context *context, cs_service **out) {
  return cs_cache_service_create(context, sizeof(entry), clear_entry, context->root->held_bytes,
                                 out);
}

static const cs_service_kind kind = {create, cs_cache_service_destroy, cs_cache_service_trim};

cs_cache_counts cs_held_count(celspan_context *context) {
  cs_service *service = cs_context_find_service(context, &kind);
  return service ? cs_cache_count(cs_cache_of(service)) : (cs_cache_counts){0};
}

/* ---------------------------------------------------------------- what the frame adds to keys */

static void hash_back_lights(cs_hash *hash, const celspan_rostrum *rostrum) {
  for (size_t i = 0; i < rostrum->cel_count; i++)
    cs_light_hash(hash, &rostrum->cels[i]->back);
}

/* Mattes are behind all cels, and are made of all of them. */
static bool has_shaped_light(const celspan_rostrum *rostrum) {
  bool has = rostrum->back.texture;
  for (size_t i = 0; i < rostrum->cel_count; i++)
    has |= rostrum->cels[i]->back.texture != NULL;
  return has;
}

/* What a stack was found to be: other ways of painting may have other last bits. */
static void hash_plan(cs_hash *hash, const cs_plan *plan) {
  const cs_stack *stack = &plan->stack;
  const size_t counts[] = {stack->layer_count,
                           stack->shade_count,
                           stack->image_count,
                           stack->defocused_count,
                           stack->group_count,
                           stack->source_count,
                           stack->light_count,
                           stack->step_count,
                           stack->step_depth,
                           stack->tree_count,
                           (size_t)plan->cull.tile_rows,
                           (size_t)plan->cull.tile_height,
                           (size_t)plan->antialias,
                           plan->cel_count};
  cs_hash_bytes(hash, counts, sizeof counts);
  cs_hash_word(hash, (uint64_t)stack->has_root | (uint64_t)stack->has_group_light << 1 |
                         (uint64_t)stack->has_curves << 2 | (uint64_t)stack->has_sources << 3 |
                         (uint64_t)cs_over_table_suits(stack) << 4);
}

static void hash_sheet(cs_hash *hash, const cs_map_sheet *sheet) {
  cs_hash_word(hash, sheet->plan != NULL);
  cs_hash_word(hash, sheet->source_count);
  cs_hash_word(hash, sheet->drawing.stack.layer_count > 0);
  cs_hash_word(hash, sheet->drawing.through != NULL);
  cs_hash_bytes(hash, &sheet->back, sizeof sheet->back);
  cs_hash_number(hash, (double)sheet->keep);
  if (sheet->plan)
    hash_plan(hash, sheet->plan);
}

static void hash_exposure(cs_hash *hash, const cs_frame *frame, size_t index) {
  const celspan_rostrum *rostrum = frame->rostrums[index];
  const cs_map_frame *maps = &frame->maps[index];
  cs_hash_number(hash, (double)frame->weights[index]);
  cs_rostrum_hash_own(hash, rostrum);
  hash_back_lights(hash, rostrum);
  if (has_shaped_light(rostrum))
    cs_hash_hash(hash, rostrum->hash);
  cs_hash_word(hash, maps->count);
  cs_hash_word(hash, cs_drawings_are_used(maps));
  for (size_t i = 0; i < maps->count; i++)
    hash_sheet(hash, &maps->sheets[i]);
  if (!cs_drawings_are_used(maps))
    hash_plan(hash, &frame->plans[index]);
}

static cs_hash hash_frame(const cs_frame *frame, const celspan_frame_desc *desc) {
  const cs_view *view = &frame->view;
  cs_hash hash = cs_hash_begin(0x68656c64u);
  const int32_t sizes[] = {frame->width, frame->height, frame->crop_x, frame->crop_width};
  cs_hash_bytes(&hash, sizes, sizeof sizes);
  cs_hash_number(&hash, view->film_width);
  cs_hash_number(&hash, view->film_height);
  cs_hash_number(&hash, (double)view->span_error);
  cs_hash_word(&hash, view->space);
  cs_hash_word(&hash, frame->takes_codes);
  cs_hash_word(&hash, frame->has_antialias);
  if (frame->has_antialias)
    cs_antialias_hash(&hash, &frame->antialias);
  cs_hash_hash(&hash, cs_walk_hash_files(desc->exposures, desc->exposure_count));
  cs_hash_word(&hash, frame->count);
  for (size_t i = 0; i < frame->count; i++)
    hash_exposure(&hash, frame, i);
  return cs_hash_end(hash);
}

/* ---------------------------------------------------------------- what cels add to keys */

static size_t band_at(const cs_held *held, double row) {
  double number = floor(row / CS_FRAME_BAND) - held->first_band;
  return number <= 0 ? 0 : number >= (double)held->count ? held->count : (size_t)number;
}

/* Adds something to the keys of the bands that it reaches, from `top` to `bottom`. */
static void add(cs_held *held, double top, double bottom, uint64_t place, cs_hash hash) {
  if (!(top <= bottom))
    return;
  size_t end = band_at(held, bottom + CS_FRAME_BAND);
  for (size_t i = band_at(held, top); i < end; i++) {
    cs_hash_word(&held->bands[i].key, place);
    cs_hash_hash(&held->bands[i].key, hash);
  }
}

/* The heights whose boundaries are decided by a cel: those of whole rows of tiles of the cull. */
static void widen(const cs_cull *cull, double *top, double *bottom) {
  if (cull->tile_rows == 0 || *top > *bottom)
    return;
  int32_t first = cs_cull_row(cull, *top), last = cs_cull_row(cull, *bottom);
  *top = first == 0 ? -HUGE_VAL : (double)first * cull->tile_height;
  *bottom = last + 1 == cull->tile_rows ? HUGE_VAL : (double)(last + 1) * cull->tile_height;
}

static void add_plan(cs_held *held, const cs_plan *plan, uint64_t place) {
  const double margin = plan->margin + 1; /* a pixel for rounding */
  for (size_t i = 0; i < plan->cel_count; i++) {
    const cs_plan_cel *cel = &plan->cels[i];
    double top = cel->top, bottom = cel->bottom;
    widen(&plan->cull, &top, &bottom);
    add(held, top - margin, bottom + margin, place + i, cel->hash);
  }
}

static void add_sheets(cs_held *held, const cs_map_frame *maps, uint64_t place) {
  for (size_t i = 0; i < maps->count; i++) {
    const cs_map_sheet *sheet = &maps->sheets[i];
    uint64_t at = place + ((uint64_t)i << 32);
    if (sheet->plan)
      add_plan(held, sheet->plan, at);
    else
      add(held, sheet->top - 1, sheet->bottom + 1, at, sheet->hash);
  }
}

static void make_keys(cs_held *held, const cs_frame *frame, const celspan_frame_desc *desc) {
  const cs_hash whole = hash_frame(frame, desc);
  for (size_t i = 0; i < held->count; i++) {
    held->bands[i].key = whole;
    int32_t top = (held->first_band + (int32_t)i) * CS_FRAME_BAND, end = top + CS_FRAME_BAND;
    cs_hash_word(&held->bands[i].key, (uint64_t)(top > held->first_row ? top : held->first_row));
    cs_hash_word(&held->bands[i].key, (uint64_t)(end < held->end_row ? end : held->end_row));
  }
  for (size_t i = 0; i < frame->count; i++)
    if (cs_drawings_are_used(&frame->maps[i]))
      add_sheets(held, &frame->maps[i], (uint64_t)i << 48);
    else
      add_plan(held, &frame->plans[i], (uint64_t)i << 48);
  for (size_t i = 0; i < held->count; i++)
    held->bands[i].key = cs_hash_end(held->bands[i].key);
}

/* ---------------------------------------------------------------- the bands of a frame */

static cs_cache_key key_of(const band *b, uint64_t what) {
  return (cs_cache_key){b->key.a, b->key.b, what};
}

static celspan_status find_band(celspan_context *context, cs_held *held, band *b) {
  cs_cache_entry *met;
  b->kept = (entry *)cs_cache_pin(held->cache, key_of(b, KEPT));
  if (b->kept) {
    held->bytes += b->kept->entry.bytes;
    return CELSPAN_OK;
  }
  met = cs_cache_pin(held->cache, key_of(b, MET));
  b->is_wanted = met != NULL;
  if (met)
    cs_cache_unpin(held->cache, met);
  else {
    CS_TRY(cs_cache_create(held->cache, context, key_of(b, MET), sizeof(entry), &met));
    (void)cs_cache_insert(held->cache, met, false);
  }
  return CELSPAN_OK;
}

static bool suits(const celspan_context *context, const cs_frame *frame,
                  const celspan_frame_desc *desc) {
  bool suits = desc->repeats && context->root->held_bytes > 0 && frame->count > 0 &&
               !frame->is_crowded && !cs_scene_has_procedure(desc->exposures, desc->exposure_count);
  for (size_t i = 0; suits && i < frame->count; i++)
    suits = !frame->maps[i].has_gaps;
  return suits;
}

static size_t size_of(size_t bands) { return sizeof(cs_held) + bands * sizeof(band); }

celspan_status cs_held_begin(celspan_context *context, const celspan_frame_desc *desc,
                             cs_frame *frame) {
  cs_service *service;
  int32_t first_row = frame->view.first_row, end_row = frame->view.end_row;
  if (!suits(context, frame, desc))
    return CELSPAN_OK;
  CS_TRY(cs_context_service(context, &kind, &service));
  int32_t first = first_row / CS_FRAME_BAND;
  size_t count = (size_t)((end_row - 1) / CS_FRAME_BAND + 1 - first);
  cs_held *held = cs_mem_resize(context->memory, NULL, 0, size_of(count));
  if (!held)
    return cs_fail_memory(context);
  memset(held, 0, size_of(count));
  frame->held = held;
  held->cache = cs_cache_of(service);
  held->first_row = first_row;
  held->end_row = end_row;
  held->first_band = first;
  held->count = count;
  make_keys(held, frame, desc);
  for (size_t i = 0; i < count; i++)
    CS_TRY(find_band(context, held, &held->bands[i]));
  return CELSPAN_OK;
}

void cs_held_end(celspan_context *context, cs_frame *frame, bool is_made) {
  cs_held *held = frame->held;
  for (size_t i = 0; held && i < held->count; i++) {
    band *b = &held->bands[i];
    entry *finished = b->finished;
    if (finished && is_made)
      (void)cs_cache_insert(held->cache, &finished->entry, false);
    else if (finished)
      cs_cache_discard(held->cache, &finished->entry);
    if (b->kept)
      cs_cache_unpin(held->cache, &b->kept->entry);
  }
  if (held)
    cs_mem_free(context->memory, held, size_of(held->count));
  frame->held = NULL;
}

static int32_t first_of(const cs_held *held, const band *b) {
  int32_t row = (held->first_band + (int32_t)(b - held->bands)) * CS_FRAME_BAND;
  return row > held->first_row ? row : held->first_row;
}

static int32_t end_of(const cs_held *held, const band *b) {
  int32_t row = (held->first_band + (int32_t)(b - held->bands) + 1) * CS_FRAME_BAND;
  return row < held->end_row ? row : held->end_row;
}

uint64_t cs_held_rows(const cs_frame *frame) {
  const cs_held *held = frame->held;
  uint64_t rows = 0;
  for (size_t i = 0; held && i < held->count; i++)
    if (held->bands[i].kept)
      rows += (uint64_t)(end_of(held, &held->bands[i]) - first_of(held, &held->bands[i]));
  return rows;
}

/* ---------------------------------------------------------------- rows */

static band *band_of(const cs_frame *frame, int32_t y) {
  cs_held *held = frame->held;
  return held ? &held->bands[y / CS_FRAME_BAND - held->first_band] : NULL;
}

const cs_row *cs_held_find(const cs_frame *frame, cs_held_copy *copy, int32_t y) {
  const band *b = band_of(frame, y);
  if (!b || !b->kept)
    return NULL;
  const cs_row_queue *rows = &b->kept->rows;
  const cs_row_queue_row row = cs_row_queue_get(rows, (size_t)(y - first_of(frame->held, b)));
  /* the same span, which may be written: a row's member says so, though none is */
  copy->given = (cs_row){
      .spans = rows->spans + (row.spans - rows->spans), .count = row.count, .varied = row.varied};
  return &copy->given;
}

/* Takes the rows of a band that is complete, unless there is no room. Several workers may make a
 * band of one row, which lies above the share of one of them. */
static celspan_status complete(celspan_context *context, cs_held *held, band *b,
                               cs_row_queue *rows) {
  size_t bytes = sizeof(entry) + cs_row_queue_bytes(rows);
  cs_cache_entry *made;
  entry *none = NULL;
  if (atomic_fetch_add(&held->bytes, bytes) + bytes > held->cache->budget) {
    atomic_fetch_sub(&held->bytes, bytes);
    return CELSPAN_OK;
  }
  CS_TRY(cs_cache_create(held->cache, context, key_of(b, KEPT), bytes, &made));
  ((entry *)made)->rows = *rows;
  *rows = (cs_row_queue){0};
  if (!atomic_compare_exchange_strong(&b->finished, &none, (entry *)made)) {
    atomic_fetch_sub(&held->bytes, bytes);
    cs_cache_discard(held->cache, made);
  }
  return CELSPAN_OK;
}

/* Copies the next row; the last one completes the copy. */
static celspan_status copy_row(celspan_context *context, cs_held *held, band *b, cs_held_copy *copy,
                               const cs_row *row) {
  CS_TRY(cs_row_queue_add(context, &copy->rows, row->spans, row->count));
  if (++copy->next < end_of(held, b))
    return CELSPAN_OK;
  copy->next = -1;
  return complete(context, held, b, &copy->rows);
}

/* A copy only saves time: where there is no room for it, it is given up, and the frame is made. */
void cs_held_add(celspan_context *context, const cs_frame *frame, cs_held_copy *copy, int32_t y,
                 const cs_row *row) {
  cs_held *held = frame->held;
  band *b = band_of(frame, y);
  if (!b || !b->is_wanted)
    return;
  if (y == first_of(held, b)) {
    cs_row_queue_clear(&copy->rows);
    copy->next = y;
  }
  if (y != copy->next)
    return;
  celspan_status status = copy_row(context, held, b, copy, row);
  if (status != CELSPAN_OK || cs_row_queue_bytes(&copy->rows) + held->bytes > held->cache->budget) {
    cs_held_copy_finish(copy, context->memory);
    copy->next = -1;
  }
}

void cs_held_copy_finish(cs_held_copy *copy, cs_memory *memory) {
  cs_row_queue_finish(&copy->rows, memory);
}
