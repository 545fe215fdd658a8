#include "model/stroke/kept.h"

#include "model/geometry/matrix.h"
#include "model/stroke/outliner.h"

#define SHARE 8   /* the memory for maps is one part in this many */
#define WIDE 1e12 /* pixels: everywhere */
#define MOST 1024 /* pieces of the line and dashes */

/* ---------------------------------------------------------------- life */

static void clear(cs_cache_entry *entry, cs_memory *memory) {
  cs_outline_finish(&((cs_stroke_kept *)entry)->outline, memory);
}

/* A budget of 0 keeps nothing, because an outline that is too much goes with its last pin. */
static celspan_status create(celspan_context *context, cs_service **out) {
  CS_TRY(cs_cache_service_create(context, sizeof(cs_stroke_kept), clear,
                                 context->root->map_bytes / SHARE, out));
  cs_cache_of(*out)->shrinks_on_unpin = true;
  return CELSPAN_OK;
}

static const cs_service_kind kind = {create, cs_cache_service_destroy, cs_cache_service_trim};

cs_cache_counts cs_stroke_kept_count(celspan_context *context) {
  cs_service *service = cs_context_find_service(context, &kind);
  return service ? cs_cache_count(cs_cache_of(service)) : (cs_cache_counts){0};
}

/* ---------------------------------------------------------------- outlines */

bool cs_stroke_kept_suits(const cs_stroke *stroke, const cs_stroke_view *view) {
  cs_stroke_view all = *view;
  all.top = all.left = -WIDE;
  all.bottom = all.right = WIDE;
  return stroke->line.piece_count + stroke->part_count <= MOST &&
         cs_matrix_keeps_weights(&view->matrix) && cs_stroke_view_holds(&all, &stroke->around);
}

typedef struct order {
  const cs_stroke *stroke;
  cs_stroke_view view;
} order;

static cs_stroke_view unmoved(const cs_stroke_view *view) {
  cs_stroke_view all = {.matrix = view->matrix,
                        .frame = {-WIDE, WIDE, -WIDE, WIDE},
                        .tolerance = view->tolerance,
                        .top = -WIDE,
                        .bottom = WIDE,
                        .left = -WIDE,
                        .right = WIDE};
  all.matrix.m[2] = all.matrix.m[5] = 0;
  return all;
}

static celspan_status make(void *user, celspan_context *context, cs_cache_entry *entry) {
  const order *o = user;
  cs_outline *outline = &((cs_stroke_kept *)entry)->outline;
  cs_outline_init(outline);
  celspan_status status = cs_stroke_outline(context, o->stroke, &o->view, outline);
  entry->bytes = sizeof(cs_stroke_kept) + CS_ARRAYS_BYTES(outline, points, contours);
  return status;
}

static cs_cache_key key_of(const order *o) {
  static const int turns[] = {0, 1, 3, 4}; /* the numbers of a matrix without its translation */
  cs_hash hash = o->stroke->hash;
  for (int i = 0; i < 4; i++)
    cs_hash_number(&hash, o->view.matrix.m[turns[i]]);
  cs_hash_number(&hash, o->view.tolerance);
  hash = cs_hash_end(hash);
  return (cs_cache_key){hash.a, hash.b, 0};
}

celspan_status cs_stroke_kept_acquire(celspan_context *context, const cs_stroke *stroke,
                                      const cs_stroke_view *view, cs_stroke_kept **out) {
  order o = {stroke, unmoved(view)};
  cs_service *service;
  cs_cache_entry *entry;
  CS_TRY(cs_context_service(context, &kind, &service));
  CS_TRY(cs_cache_acquire(cs_cache_of(service), context, key_of(&o), make, &o, &entry));
  *out = (cs_stroke_kept *)entry;
  return CELSPAN_OK;
}

void cs_stroke_kept_release(celspan_context *context, cs_stroke_kept *kept) {
  cs_cache_unpin(cs_cache_of(cs_context_find_service(context, &kind)), &kept->entry);
}
