#include "frames/render/held.h"

#include <math.h>

#include "engine/compose/composer.h"
#include "engine/compose/over_table.h"
#include "frames/render/drawings.h"
#include "model/scene/walk.h"
#include "output/sinks/pixels.h"

/* ---------------------------------------------------------------- the cache */

#define MET 16384 /* keys that were met are remembered, at most: a power of two */
#define APART 256 /* bands one after the other that never take each other's places */

typedef struct entry {
  cs_cache_entry entry;
  cs_row_queue rows;
} entry;

typedef struct store {
  cs_service service;
  cs_cache cache;
  /* Half a key, in the place that the other half says; a later key takes the place of an earlier
   * one. 0: none was met. */
  _Atomic uint64_t met[MET];
} store;

typedef struct band {
  cs_hash key;
  entry *kept;               /* pinned; NULL: its rows must be made */
  bool is_wanted;            /* the rows of the band shall be copied */
  _Atomic(entry *) finished; /* the copy, which is not in the cache yet */
} band;

typedef struct cs_held {
  store *store;
  int32_t first_row, end_row; /* rows of the frame that are asked for */
  int32_t first_band;
  size_t count;
  atomic_size_t bytes; /* the bytes of the bands that are kept, or will be */
  band bands[];
} cs_held;

static void clear_entry(cs_cache_entry *cached, cs_memory *memory) {
  cs_row_queue_finish(&((entry *)cached)->rows, memory);
}

static celspan_status create(celspan_context *context, cs_service **out) {
  store *made;
  CS_TRY(CS_MAKE(context, made, 1));
  made->cache = (cs_cache){.memory = context->memory,
                           .entry_size = sizeof(entry),
                           .clear = clear_entry,
                           .shrinks_on_unpin = true,
                           .budget = context->root->held_bytes};
  cs_cache_init(&made->cache);
  *out = &made->service;
  return CELSPAN_OK;
}

static void destroy(cs_service *service) {
  store *old = (store *)service;
  cs_memory *memory = old->cache.memory;
  cs_cache_finish(&old->cache);
  cs_mem_free(memory, old, sizeof *old);
}

/* Forgets the keys, too: where caches are freed after each frame, no copy would be of use. */
static void trim(cs_service *service) {
  store *from = (store *)service;
  cs_cache_trim(&from->cache);
  for (size_t i = 0; i < MET; i++)
    atomic_store_explicit(&from->met[i], 0, memory_order_relaxed);
}

static const cs_service_kind kind = {create, destroy, trim};

cs_cache_counts cs_held_count(celspan_context *context) {
  cs_service *service = cs_context_find_service(context, &kind);
  return service ? cs_cache_count(&((store *)service)->cache) : (cs_cache_counts){0};
}

/* Whether the key of a band was met before; from now on it was. */
static bool was_met(store *from, size_t number, cs_hash key) {
  size_t place = number % APART + key.b % (MET / APART) * APART;
  return atomic_exchange(&from->met[place], key.a) == key.a;
}

/* ---------------------------------------------------------------- the parts of a key */

static int32_t first_of(const cs_held *held, const band *b) {
  int32_t row = (held->first_band + (int32_t)(b - held->bands)) * CS_FRAME_BAND;
  return row > held->first_row ? row : held->first_row;
}

static int32_t end_of(const cs_held *held, const band *b) {
  int32_t row = (held->first_band + (int32_t)(b - held->bands) + 1) * CS_FRAME_BAND;
  return row < held->end_row ? row : held->end_row;
}

static size_t band_at(const cs_held *held, double row) {
  double number = floor(row / CS_FRAME_BAND) - held->first_band;
  return number <= 0 ? 0 : number >= (double)held->count ? held->count : (size_t)number;
}

/* Adds something to the keys of the bands that it reaches, from `top` to `bottom`. */
static void add(cs_held *held, double top, double bottom, cs_hash hash) {
  if (!(top <= bottom))
    return;
  size_t end = band_at(held, bottom + CS_FRAME_BAND);
  for (size_t i = band_at(held, top); i < end; i++)
    cs_hash_hash(&held->bands[i].key, hash);
}

static void add_everywhere(cs_held *held, cs_hash hash) { add(held, -HUGE_VAL, HUGE_VAL, hash); }

/* What decides the codes of colours. The coding has the space of the frame. */
static void hash_coder(cs_hash *hash, const cs_frame *frame) {
  const cs_coder *coder = frame->coder;
  const int32_t numbers[] = {(int32_t)coder->coding.depth,
                             (int32_t)coder->coding.transfer,
                             (int32_t)coder->coding.alpha,
                             coder->dithers,
                             coder->x,
                             coder->y - frame->crop_y};
  cs_hash_bytes(hash, numbers, sizeof numbers);
}

static void add_frame(cs_held *held, const cs_frame *frame, const celspan_frame_desc *desc) {
  const cs_view *view = &frame->view;
  cs_hash hash = cs_hash_begin(0x68656c64u);
  const int32_t sizes[] = {frame->width,      frame->height,   frame->crop_x,
                           frame->crop_width, view->first_row, view->end_row};
  cs_hash_bytes(&hash, sizes, sizeof sizes);
  cs_hash_number(&hash, view->film_width);
  cs_hash_number(&hash, view->film_height);
  cs_hash_number(&hash, (double)view->span_error);
  cs_hash_word(&hash, view->space);
  cs_hash_word(&hash, frame->takes_codes);
  if (frame->coder)
    hash_coder(&hash, frame);
  if (frame->has_antialias)
    cs_antialias_hash(&hash, &frame->antialias);
  cs_hash_hash(&hash, cs_walk_hash_files(desc->exposures, desc->exposure_count));
  add_everywhere(held, cs_hash_end(hash));
}

/* What a stack was found to be: crowds are painted in another way where something elsewhere does
 * not suit them, with other last bits. Where light is folded by a table, it is
 * joined by the numbers of the layers. */
static void add_plan(cs_held *held, const cs_plan *plan) {
  const cs_stack *stack = &plan->stack;
  const bool is_flat = cs_composer_is_flat(stack);
  const bool is_numbered = is_flat && cs_over_table_suits(stack);
  cs_hash traits = cs_hash_begin((uint64_t)plan->cull.tile_height);
  cs_hash_word(&traits, is_flat && stack->tree_count == 0); /* crowds (engine/area/crowd.h) */
  add_everywhere(held, cs_hash_end(traits));
  for (size_t i = 0; i < plan->shown_count; i++) {
    const cs_plan_shown *shown = &plan->shown[i];
    cs_hash hash = cs_hash_begin(is_numbered ? 1 + shown->first : 0);
    cs_hash_hash(&hash, shown->hash);
    add(held, shown->top - plan->margin, shown->bottom + plan->margin, cs_hash_end(hash));
  }
}

static void add_sheet(cs_held *held, const cs_map_sheet *sheet) {
  cs_hash whole = cs_hash_begin(0);
  cs_hash_bytes(&whole, &sheet->back, sizeof sheet->back);
  cs_hash_number(&whole, (double)sheet->keep);
  add_everywhere(held, cs_hash_end(whole));
  if (sheet->plan)
    add_plan(held, sheet->plan);
  else
    add(held, sheet->top, sheet->bottom, sheet->hash);
}

static void add_exposure(cs_held *held, const cs_frame *frame, size_t index) {
  const cs_map_frame *maps = &frame->maps[index];
  cs_hash whole = cs_hash_begin(0);
  cs_hash_number(&whole, (double)frame->weights[index]);
  cs_rostrum_hash_own(&whole, frame->rostrums[index]);
  add_everywhere(held, cs_hash_end(whole));
  for (size_t i = 0; i < maps->count; i++)
    add_sheet(held, &maps->sheets[i]);
  if (!cs_drawings_are_used(maps))
    add_plan(held, &frame->plans[index]);
}

static void make_keys(cs_held *held, const cs_frame *frame, const celspan_frame_desc *desc) {
  for (size_t i = 0; i < held->count; i++)
    held->bands[i].key = cs_hash_begin((uint64_t)held->first_band + i);
  add_frame(held, frame, desc);
  for (size_t i = 0; i < frame->count; i++)
    add_exposure(held, frame, i);
  for (size_t i = 0; i < held->count; i++)
    held->bands[i].key = cs_hash_end(held->bands[i].key);
}

/* ---------------------------------------------------------------- the bands of a frame */

static cs_cache_key key_of(const band *b) { return (cs_cache_key){b->key.a, b->key.b, 0}; }

static void find_band(cs_held *held, band *b) {
  b->kept = (entry *)cs_cache_pin(&held->store->cache, key_of(b));
  if (b->kept)
    held->bytes += b->kept->entry.bytes;
  else
    b->is_wanted =
        was_met(held->store, (size_t)held->first_band + (size_t)(b - held->bands), b->key);
}

static bool suits(const celspan_context *context, const cs_frame *frame,
                  const celspan_frame_desc *desc) {
  bool suits = desc->repeats && context->root->held_bytes > 0 && !frame->is_crowded &&
               !cs_scene_has_procedure(desc->exposures, desc->exposure_count);
  for (size_t i = 0; suits && i < frame->count; i++)
    suits = !frame->maps[i].has_gaps;
  return suits;
}

/* Rows are kept, and wait in strips, as spans where the codes of the whole frame have no room: half
 * of them is added for what arenas leave free. So codes never take more memory than may be held. */
static void choose_form(cs_frame *frame, size_t budget) {
  size_t pixels = (size_t)frame->crop_width * (size_t)(frame->view.end_row - frame->view.first_row);
  size_t bytes = frame->coder ? pixels * cs_pixels_size(&frame->coder->coding) : 0;
  if (bytes + bytes / 2 > budget)
    frame->coder = NULL;
}

static size_t size_of(size_t bands) { return sizeof(cs_held) + bands * sizeof(band); }

celspan_status cs_held_begin(celspan_context *context, const celspan_frame_desc *desc,
                             cs_frame *frame) {
  cs_service *service;
  int32_t first_row = frame->view.first_row, end_row = frame->view.end_row;
  choose_form(frame, context->root->held_bytes);
  if (!suits(context, frame, desc))
    return CELSPAN_OK;
  CS_TRY(cs_context_service(context, &kind, &service));
  int32_t first = first_row / CS_FRAME_BAND;
  size_t count = (size_t)((end_row - 1) / CS_FRAME_BAND + 1 - first);
  cs_held *held;
  CS_TRY(cs_mem_make(context, (void **)&held, 1, size_of(count)));
  frame->held = held;
  held->store = (store *)service;
  held->first_row = first_row;
  held->end_row = end_row;
  held->first_band = first;
  held->count = count;
  make_keys(held, frame, desc);
  for (size_t i = 0; i < count; i++)
    find_band(held, &held->bands[i]);
  return CELSPAN_OK;
}

void cs_held_end(celspan_context *context, cs_frame *frame, bool is_made) {
  cs_held *held = frame->held;
  for (size_t i = 0; held && i < held->count; i++) {
    band *b = &held->bands[i];
    entry *finished = b->finished;
    if (finished && is_made)
      (void)cs_cache_insert(&held->store->cache, &finished->entry, false);
    else if (finished)
      cs_cache_discard(&held->store->cache, &finished->entry);
    if (b->kept)
      cs_cache_unpin(&held->store->cache, &b->kept->entry);
  }
  if (held)
    cs_mem_free(context->memory, held, size_of(held->count));
  frame->held = NULL;
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

/* Gives out a row of a queue. */
static void give(cs_held_copy *copy, const cs_row_queue *rows, size_t index) {
  const cs_row_queue_row row = cs_row_queue_get(rows, index);
  /* the same span, which may be written: a row's member says so, though none is */
  copy->given = (cs_row){
      .spans = rows->spans + (row.spans - rows->spans), .count = row.count, .varied = row.varied};
}

const cs_row *cs_held_find(const cs_frame *frame, cs_held_copy *copy, int32_t y) {
  const band *b = band_of(frame, y);
  if (!b || !b->kept)
    return NULL;
  give(copy, &b->kept->rows, (size_t)(y - first_of(frame->held, b)));
  return &copy->given;
}

/* Takes the rows of a band that is complete, unless there is no room. Several workers may make a
 * band of one row, which lies above the share of one of them. */
static bool complete(celspan_context *context, cs_held *held, band *b, cs_row_queue *rows) {
  size_t bytes = sizeof(entry) + cs_row_queue_bytes(rows);
  cs_cache_entry *made;
  entry *none = NULL;
  if (atomic_fetch_add(&held->bytes, bytes) + bytes <= held->store->cache.budget &&
      cs_cache_create(&held->store->cache, context, key_of(b), bytes, &made) == CELSPAN_OK) {
    ((entry *)made)->rows = *rows;
    *rows = (cs_row_queue){0};
    if (atomic_compare_exchange_strong(&b->finished, &none, (entry *)made))
      return true;
    cs_cache_discard(&held->store->cache, made);
  }
  atomic_fetch_sub(&held->bytes, bytes);
  return false;
}

/* Copies row y of the frame, which is the next one, and gives the copy out; the last one completes
 * the copy of the band. */
static bool copy_row(celspan_context *context, const cs_frame *frame, band *b, cs_held_copy *copy,
                     int32_t y, const cs_row *row) {
  cs_held *held = frame->held;
  cs_row_queue *rows = &copy->rows;
  if (cs_frame_queue_row(context, frame, y - frame->crop_y, row, rows) != CELSPAN_OK ||
      cs_row_queue_bytes(rows) + held->bytes > held->store->cache.budget)
    return false;
  give(copy, rows, rows->count - 1);
  return y + 1 < end_of(held, b) || complete(context, held, b, rows);
}

/* A copy only saves time: where there is no room for it, it is given up, and the frame is made. */
const cs_row *cs_held_add(celspan_context *context, const cs_frame *frame, cs_held_copy *copy,
                          int32_t y, const cs_row *row) {
  band *b = band_of(frame, y);
  if (!b || !b->is_wanted)
    return row;
  if (y == first_of(frame->held, b)) {
    cs_row_queue_clear(&copy->rows);
    copy->next = y;
  }
  if (y != copy->next)
    return row;
  copy->next = y + 1;
  if (copy_row(context, frame, b, copy, y, row))
    return &copy->given;
  cs_held_copy_finish(copy, context->memory);
  copy->next = -1;
  return row;
}

void cs_held_copy_finish(cs_held_copy *copy, cs_memory *memory) {
  cs_row_queue_finish(&copy->rows, memory);
}
