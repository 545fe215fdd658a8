#include "frames/render/parts.h"

#include "model/geometry/matrix.h"
#include "model/scene/value.h"

/* A cel whose parts are looked for. */
typedef struct search {
  const celspan_cel *cel;
  const cs_view *view;
  const celspan_rostrum *rostrum;
  size_t rich;  /* pieces of a rich object, at least */
  size_t least; /* pieces of a part, at least */
  cs_cel_parts *parts;
  size_t number;                  /* the number of the cel */
  size_t first;                   /* where its parts begin */
  size_t count, most;             /* cels of the frame so far, and room for them */
  size_t rich_pieces, all_pieces; /* of the parts of this cel, and of the objects between them */
  bool is_sane;                   /* none of its parts is enlarged or reduced too far */
} search;

/* ---------------------------------------------------------------- what is a part */

size_t cs_parts_pieces(celspan_object *const *objects, size_t count) {
  size_t pieces = 0;
  for (size_t i = 0; i < count; i++)
    pieces += objects[i]->data->piece_count;
  return pieces;
}

static bool is_moved(const celspan_object *object) { return object->matrix == object->own; }

/* Whether an object only holds its operands together. */
static bool is_open(const search *s, const celspan_object *object) {
  const cs_primitive_data *data = object->data;
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN || object->fade < 1)
    return false;
  const cs_boolean *boolean = data->boolean;
  return boolean->op == CELSPAN_OPERATOR_UNION && boolean->blend == CELSPAN_BLEND_NORMAL &&
         !(boolean->isolates && data->has_modes) && !cs_boolean_develops(boolean, s->view->space);
}

static bool holds_part(const search *s, const celspan_object *object);

static bool has_part(const search *s, celspan_object *object) {
  return cs_parts_pieces(&object, 1) >= s->least && (is_moved(object) || holds_part(s, object));
}

static bool holds_part(const search *s, const celspan_object *object) {
  if (!is_open(s, object))
    return false;
  const cs_boolean *boolean = object->data->boolean;
  for (size_t i = 0; i < boolean->operand_count; i++)
    if (has_part(s, boolean->operands[i]))
      return true;
  return false;
}

/* ---------------------------------------------------------------- parts as cels */

static celspan_matrix place(const celspan_rostrum *rostrum, const celspan_cel *cel,
                            const cs_view *view) {
  return celspan_matrix_then(cel->matrix,
                             cs_scene_view(rostrum, cel, view->film_width, view->film_height));
}

static void add(search *s, celspan_object **objects, size_t count, const celspan_matrix *matrix) {
  if (count == 0)
    return;
  if (s->count < s->most) {
    celspan_cel *part = &s->parts->cels[s->count];
    cs_value_copy(part, s->cel, sizeof *part);
    part->objects = objects;
    part->object_count = count;
    part->matrix = celspan_matrix_then(*matrix, s->cel->matrix);
    if (s->count > s->first)
      part->back = (cs_light){0};
    s->parts->numbers[s->count] = s->number;
    const celspan_matrix placed = place(s->rostrum, part, s->view);
    s->is_sane = s->is_sane && cs_matrix_is_sane(&placed);
  }
  size_t pieces = cs_parts_pieces(objects, count);
  s->all_pieces += pieces;
  s->rich_pieces += pieces >= s->rich ? pieces : 0;
  s->count++;
}

/* matrix: from the units of the objects to the units of the cel. */
static void split(search *s, celspan_object **objects, size_t count, const celspan_matrix *matrix) {
  size_t first = 0;
  for (size_t i = 0; i < count; i++) {
    celspan_object *object = objects[i];
    if (!has_part(s, object))
      continue;
    add(s, objects + first, i - first, matrix);
    first = i + 1;
    if (holds_part(s, object)) {
      const celspan_matrix inner = celspan_matrix_then(*object->matrix, *matrix);
      split(s, object->data->boolean->operands, object->data->boolean->operand_count, &inner);
    } else {
      add(s, objects + i, 1, matrix);
    }
  }
  add(s, objects + first, count - first, matrix);
}

static bool may_be_split(const search *s) {
  const celspan_cel *cel = s->cel;
  return !cs_cel_isolates(cel) && !cel->blends_inside[s->view->space] && !cel->front.texture &&
         !cel->back.texture && cs_parts_pieces(cel->objects, cel->object_count) >= s->least;
}

/* Appends the parts of a cel, or the cel itself. left: how many cels follow it. */
static void split_cel(search *s, size_t left) {
  const celspan_matrix identity = celspan_matrix_identity();
  s->first = s->count;
  s->most = CS_MAP_DRAWINGS - left;
  s->rich_pieces = s->all_pieces = 0;
  s->is_sane = true;
  if (may_be_split(s))
    split(s, s->cel->objects, s->cel->object_count, &identity);
  if (s->count > s->first + 1 && s->count <= s->most && s->is_sane &&
      2 * s->rich_pieces >= s->all_pieces)
    return;
  s->count = s->first;
  cs_value_copy(&s->parts->cels[s->count], s->cel, sizeof *s->cel);
  s->parts->numbers[s->count++] = s->number;
}

/* ---------------------------------------------------------------- a rostrum */

/* If the only object of a cel has a transform, drawings.c has already made it part of the place. */
static bool cel_has_part(const search *s) {
  const celspan_cel *cel = s->cel;
  bool has = cel->object_count == 1 && holds_part(s, cel->objects[0]);
  for (size_t i = 0; !has && cel->object_count > 1 && i < cel->object_count; i++)
    has = has_part(s, cel->objects[i]);
  return has && may_be_split(s);
}

/* Searches a cel next. */
static void begin_cel(search *s, size_t index) {
  s->cel = s->rostrum->cels[index];
  s->number = index + 1;
  size_t share = cs_parts_pieces(s->cel->objects, s->cel->object_count) / CS_PARTS_MOST;
  s->least = share > s->rich ? share : s->rich;
}

static celspan_status split_cels(celspan_context *context, search *s) {
  const celspan_rostrum *rostrum = s->rostrum;
  cs_cel_parts *parts = s->parts;
  CS_TRY(CS_MAKE(context, parts->cels, CS_MAP_DRAWINGS));
  CS_TRY(CS_MAKE(context, parts->list, CS_MAP_DRAWINGS));
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    begin_cel(s, i);
    split_cel(s, rostrum->cel_count - 1 - i);
  }
  for (size_t i = 0; i < s->count; i++)
    parts->list[i] = &parts->cels[i];
  cs_value_copy(&parts->own, rostrum, sizeof *rostrum);
  parts->own.cels = parts->list;
  parts->own.cel_count = s->count;
  parts->rostrum = &parts->own;
  return CELSPAN_OK;
}

celspan_status cs_parts_create(celspan_context *context, const celspan_rostrum *rostrum,
                               const cs_view *view, size_t rich, cs_cel_parts *out) {
  search s = {.rostrum = rostrum, .view = view, .rich = rich, .parts = out};
  bool has_parts = false;
  *out = (cs_cel_parts){.rostrum = rostrum, .from = rostrum};
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    out->numbers[i] = i + 1;
    begin_cel(&s, i);
    has_parts = has_parts || cel_has_part(&s);
  }
  return has_parts ? split_cels(context, &s) : CELSPAN_OK;
}

celspan_status cs_parts_place(celspan_context *context, const cs_cel_parts *parts, size_t index,
                              const cs_view *view, celspan_matrix *out) {
  CS_TRY(cs_scene_cel_matrix(context, parts->from, parts->numbers[index] - 1, view->film_width,
                             view->film_height, out));
  *out = place(parts->rostrum, parts->rostrum->cels[index], view);
  return CELSPAN_OK;
}

void cs_parts_finish(cs_cel_parts *parts, cs_memory *memory) {
  cs_mem_free(memory, parts->cels, CS_MAP_DRAWINGS * sizeof *parts->cels);
  cs_mem_free(memory, parts->list, CS_MAP_DRAWINGS * sizeof *parts->list);
  parts->cels = NULL;
  parts->list = NULL;
}
