#include "common/hits.h"

#include <string.h>

/* A search from front to back. */
typedef struct search {
  const cs_hits_wanted *wanted;
  size_t count;     /* the count of the items found */
  int depth;        /* the depth of the items that are searched */
  double share;     /* the share of the exposures of what is searched */
  const char *part; /* the shot of a cut in which the search is; "": none. NULL: it is no cut */
} search;

/* *paint: new; the colour of an object at the point in white light, straight; 0 where nothing
 * is. */
static celspan_status probe_object(const search *s, celspan_object *object,
                                   const celspan_matrix *matrix, cs_light *paint) {
  celspan_context *context = s->wanted->context;
  celspan_object *placed;
  celspan_exposure exposure = {NULL, 1};
  celspan_frame_desc frame = *s->wanted->frame;
  double rgba[4];
  CS_TRY(celspan_object_transform(context, object, matrix, &placed));
  celspan_status status = cs_rostrum_alone(context, placed, &exposure.rostrum);
  celspan_object_unref(placed);
  CS_TRY(status);
  frame.exposures = &exposure;
  frame.exposure_count = 1;
  status = celspan_probe(context, &frame, s->wanted->point, rgba);
  *paint = (cs_light){0};
  if (status == CELSPAN_OK && rgba[3] > 0)
    paint->flat = (celspan_light){(float)(rgba[0] / rgba[3]), (float)(rgba[1] / rgba[3]),
                                  (float)(rgba[2] / rgba[3]), (float)rgba[3]};
  celspan_rostrum_unref(exposure.rostrum);
  return status;
}

static void add_hit(search *s, cs_hit hit) {
  hit.depth = s->depth;
  hit.share = s->share;
  hit.part = s->part;
  s->count++;
  s->wanted->found(s->wanted->user, &hit);
}

/* The size of the film of a rostrum: a nested rostrum has its own. */
typedef struct extent {
  double width, height;
} extent;

static celspan_status search_rostrum(search *s, const celspan_rostrum *rostrum, extent film,
                                     const celspan_matrix *matrix);

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static celspan_status search_objects(search *s, celspan_object *const *objects, size_t count,
                                     const celspan_matrix *matrix) {
  for (size_t i = count; i-- > 0;) {
    const cs_primitive_data *data = objects[i]->data;
    cs_light paint;
    CS_TRY(probe_object(s, objects[i], matrix, &paint));
    if (!(paint.flat.a > 0))
      continue;
    celspan_matrix inner = celspan_matrix_then(*objects[i]->matrix, *matrix);
    s->depth++;
    if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
      CS_TRY(search_objects(s, data->boolean->operands, data->boolean->operand_count, &inner));
    if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM)
      CS_TRY(search_rostrum(s, data->rostrum, (extent){data->rostrum->width, data->rostrum->height},
                            &inner));
    s->depth--;
    add_hit(s, (cs_hit){.mark = objects[i]->mark,
                        .opacity = objects[i]->fade,
                        .object = objects[i],
                        .light = &paint});
  }
  return CELSPAN_OK;
}

static celspan_status search_rostrum(search *s, const celspan_rostrum *rostrum, extent film,
                                     const celspan_matrix *matrix) {
  const char *outer = s->part;
  if (outer && !outer[0])
    s->part = cs_mark_name(rostrum->mark);
  for (size_t i = rostrum->cel_count; i-- > 0;) {
    const celspan_cel *cel = rostrum->cels[i];
    celspan_matrix placed;
    CS_TRY(cs_scene_cel_matrix(s->wanted->context, rostrum, i, film.width, film.height, &placed));
    celspan_matrix inner = celspan_matrix_then(placed, *matrix);
    size_t before = s->count;
    s->depth++;
    CS_TRY(search_objects(s, cel->objects, cel->object_count, &inner));
    s->depth--;
    const cs_light light = cs_scene_front(rostrum, cel);
    if (s->count > before)
      add_hit(s, (cs_hit){.mark = cel->mark, .opacity = cel->opacity, .light = &light});
  }
  s->part = outer;
  return CELSPAN_OK;
}

/* Whether two exposures show the same at two moments: of a cut the same shot. */
static bool is_same(const search *s, const celspan_exposure *a, const celspan_exposure *b) {
  const char *name = cs_mark_name(a->rostrum->mark);
  return a == b || !s->part || (name[0] && strcmp(name, cs_mark_name(b->rostrum->mark)) == 0);
}

/* Searches an exposure, if none before it shows the same. */
static celspan_status search_exposure(search *s, size_t i) {
  const celspan_frame_desc *frame = s->wanted->frame;
  const celspan_matrix none = celspan_matrix_identity();
  s->share = 0;
  for (size_t j = frame->exposure_count; j-- > 0;)
    if (is_same(s, &frame->exposures[i], &frame->exposures[j])) {
      if (j < i)
        return CELSPAN_OK;
      s->share += frame->exposures[j].weight;
    }
  return search_rostrum(s, frame->exposures[i].rostrum,
                        (extent){frame->film_width, frame->film_height}, &none);
}

celspan_status cs_hits_find(const cs_hits_wanted *wanted) {
  search s = {.wanted = wanted, .part = wanted->is_cut ? "" : NULL};
  for (size_t i = 0; i < wanted->frame->exposure_count; i++)
    CS_TRY(search_exposure(&s, i));
  return CELSPAN_OK;
}
