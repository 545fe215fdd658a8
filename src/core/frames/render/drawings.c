#include "frames/render/drawings.h"

#include <math.h>

#include "engine/map/brush.h"
#include "engine/map/keep.h"
#include "engine/map/turn.h"
#include "frames/render/parts.h"
#include "frames/render/ways.h"
#include "model/geometry/matrix.h"
#include "model/scene/bounds.h"
#include "model/scene/value.h"

/* ---------------------------------------------------------------- maps */

/* A cel in its place. If it has only one object, the transform and the fade of the object count as
 * part of the place, so that the object has the same map wherever it is moved. */
typedef struct placed_cel {
  const celspan_cel *cel;
  const cs_view *view; /* the view of the frame */
  size_t number;
  celspan_matrix matrix; /* the drawing's units to pixels */
  double opacity;
  double scale_x, scale_y; /* the drawing's units to pixels of the raster: a power of two, which is
                              negative where an upright drawing is mirrored */
  bool is_turned;          /* or sheared */
  bool is_made;            /* the map was made just now */
  /* a map of the rows that are asked for gives the same result as a map of all rows */
  bool is_cropped;
  cs_census census; /* the census of its shapes */
} placed_cel;

/* A map of some rows is made where they are at most this part of the frame. */
#define CROPPED 4

static const celspan_matrix identity = {{1, 0, 0, 0, 1, 0, 0, 0, 1}};

/* The drawing of a cel, without its place. only, objects: room for the result. */
static celspan_cel drawing_of(const placed_cel *d, celspan_object *only, celspan_object **objects) {
  celspan_cel drawing;
  cs_value_copy(&drawing, d->cel, sizeof drawing);
  drawing.matrix = identity;
  if (drawing.object_count == 1) {
    const celspan_object *from = drawing.objects[0];
    *only = (celspan_object){
        .hash = from->hash, .mark = from->mark, .data = from->data, .matrix = &identity, .fade = 1};
    objects[0] = only;
    drawing.objects = objects;
    drawing.blends_inside[d->view->space] = cs_object_blends(only, d->view->space);
  }
  return drawing;
}

/* The least power of two that is not less than a number. */
static double power_above(double number) {
  int exponent;
  double fraction = frexp(number, &exponent);
  return ldexp(1, fraction == 0.5 ? exponent - 1 : exponent);
}

/* Rounding does not double the scale of a cel that is turned without being stretched. */
#define STRETCH_ROUNDING 1e-9

/* The scale of a cel that is turned, sheared or in perspective: the largest scale at its
 * corners. */
static bool find_turned_scale(placed_cel *d) {
  celspan_box box = {0, 0, 0, 0};
  double stretch = 0;
  if (!cs_matrix_is_affine(&d->matrix)) {
    celspan_object only, *objects[1];
    celspan_cel drawing = drawing_of(d, &only, objects);
    (void)cs_bounds_around(drawing.objects, drawing.object_count, &drawing.matrix, &box);
  }
  for (int corner = 0; corner < 4; corner++)
    stretch = fmax(stretch, cs_matrix_stretch(&d->matrix, box.x + (corner & 1 ? box.width : 0),
                                              box.y + (corner & 2 ? box.height : 0)));
  d->scale_x = d->scale_y = power_above(stretch * (1 - STRETCH_ROUNDING));
  return stretch > 0 && isfinite(d->scale_x);
}

/* Finds the scale of the cel's map; false where the cel does not suit. */
static bool find_scale(placed_cel *d) {
  const double *m = d->matrix.m;
  d->is_turned = !cs_matrix_is_upright(&d->matrix) || m[8] != 1;
  if (d->is_turned)
    return find_turned_scale(d);
  double scale = power_above(fmax(fabs(m[0]), fabs(m[4])));
  d->scale_x = m[0] < 0 ? -scale : scale;
  d->scale_y = m[4] < 0 ? -scale : scale;
  return m[0] != 0 && m[4] != 0;
}

/* Finds a raster with a pixel more on each side than a drawing has, and moves the drawing there;
 * false where it is too large. */
static bool find_raster(celspan_cel *drawing, celspan_space space, cs_map *map, cs_view *out) {
  celspan_box box = {0, 0, 0, 0};
  /* an empty drawing is a drawing, too */
  (void)cs_bounds_around(drawing->objects, drawing->object_count, &drawing->matrix, &box);
  double left = floor(box.x) - 1, width = ceil(box.x + box.width) + 1 - left;
  double top = floor(box.y) - 1, height = ceil(box.y + box.height) + 1 - top;
  if (!(width <= CS_MAP_SIDE && height <= CS_MAP_SIDE && fabs(left) < 0x1p30 && fabs(top) < 0x1p30))
    return false;
  drawing->matrix.m[2] = -left;
  drawing->matrix.m[5] = -top;
  map->left = (int64_t)left;
  map->top = (int64_t)top;
  cs_map_divide(map, (int32_t)height);
  *out = (cs_view){.width = (int32_t)width,
                   .height = (int32_t)height,
                   .end_row = (int32_t)height,
                   .end_column = (int32_t)width,
                   .most_dashes = CS_COMPILE_DASHES,
                   .space = space};
  return true;
}

/* Keeps only the zones that can be seen in the swaths that are asked for. */
static void crop_raster(const placed_cel *d, const cs_map *map, cs_view *raster) {
  const double *m = d->matrix.m, down = d->scale_y / m[4], shift = -m[5] * down - (double)map->top;
  const double row = cs_map_swath(d->view->first_row) * down + shift;
  const double end_row = cs_map_swath(d->view->end_row + CS_MAP_ROWS - 1) * down + shift;
  int32_t first, end;
  cs_map_find_zones(map, row - 1, end_row + 1, &first, &end);
  raster->first_row = first * map->zone;
  raster->end_row = end * map->zone < map->height ? end * map->zone : map->height;
  raster->pieces = raster->points = 0; /* it has few of them */
}

static celspan_status make_alone(celspan_context *context, const placed_cel *d,
                                 celspan_cel *drawing, cs_map *map) {
  cs_view raster;
  cs_plan plan;
  if (!find_raster(drawing, d->view->space, map, &raster))
    return CELSPAN_OK;
  raster.pieces = d->census.pieces;
  raster.points = d->census.points;
  if (d->is_cropped)
    crop_raster(d, map, &raster);
  CS_TRY(cs_compile_drawing(context, drawing, d->number, &drawing->matrix, &raster, &plan));
  celspan_status status = cs_map_suits(&plan)
                              ? cs_map_make(context, &plan, raster.first_row, raster.end_row, map)
                              : CELSPAN_OK;
  if (status == CELSPAN_OK && d->is_turned && map->is_whole)
    status = cs_map_find_flats(context, map);
  cs_compile_free(&plan, context->memory);
  return status;
}

/* Makes the map of a drawing. */
static celspan_status make(void *user, celspan_context *context, cs_map *map) {
  placed_cel *d = user;
  d->is_made = true;
  celspan_object only, *objects[1];
  celspan_cel drawing = drawing_of(d, &only, objects);
  drawing.matrix = (celspan_matrix){{d->scale_x, 0, 0, 0, d->scale_y, 0, 0, 0, 1}};
  return make_alone(context, d, &drawing, map);
}

/* The hash of an object of a drawing; a single object has the same hash wherever it is moved. */
static cs_hash hash_of(const celspan_cel *cel, size_t object) {
  return cel->object_count == 1 ? cel->objects[0]->data->hash : cel->objects[object]->hash;
}

static cs_cache_key key_of(const placed_cel *d) {
  size_t count = d->cel->object_count;
  cs_hash hash = cs_hash_begin(0x6d6170u);
  cs_hash_word(&hash, count);
  cs_hash_word(&hash, d->view->space);
  cs_hash_word(&hash, d->is_turned);
  for (size_t i = 0; i < count; i++)
    cs_hash_hash(&hash, hash_of(d->cel, i));
  cs_hash_number(&hash, d->scale_x);
  cs_hash_number(&hash, d->scale_y);
  hash = cs_hash_end(hash);
  return (cs_cache_key){hash.a, hash.b, 0};
}

/* ---------------------------------------------------------------- sheets */

static cs_v4 colour_of(celspan_light light) { return (cs_v4){light.r, light.g, light.b, 0}; }

/* The transmission of the cells of a coloured map where the cel has this opacity. */
static celspan_status fade_media(celspan_context *context, cs_map_drawing *drawing) {
  const cs_map *map = drawing->map;
  const float opacity = drawing->light[3];
  if (!map->is_coloured)
    return CELSPAN_OK;
  CS_TRY(CS_ARRAY_MAKE(context, drawing->through, map->cell_count));
  for (size_t i = 0; i < map->cell_count; i++)
    if (map->cells[i].length == 0)
      drawing->through[i] = cs_v4_all(1 - opacity) + opacity * map->through[i];
  return CELSPAN_OK;
}

/* The colours of the map's cells in the light of the cel, which includes its opacity. */
static celspan_status light_cells(celspan_context *context, cs_map_drawing *drawing) {
  const cs_map *map = drawing->map;
  CS_TRY(CS_ARRAY_MAKE(context, drawing->colours, map->cell_count));
  for (size_t i = 0; i < map->cell_count; i++)
    if (map->cells[i].length == 0)
      drawing->colours[i] = cs_map_brush_light(drawing, map->cells[i].colour);
  CS_TRY(fade_media(context, drawing));
  return cs_map_brush_place(context, drawing);
}

static void place_upright(const placed_cel *d, cs_map_drawing *out) {
  const double *m = d->matrix.m;
  out->lines = &out->map->lines;
  out->left = out->map->left;
  out->top = out->map->top;
  out->scale_x = m[0] / d->scale_x / CS_MAP_UNIT;
  out->scale_y = m[4] / d->scale_y / CS_MAP_UNIT;
  out->shift_x = m[2];
  out->shift_y = m[5];
  double across = 1 / (out->scale_x * CS_MAP_UNIT), down = 1 / (out->scale_y * CS_MAP_UNIT);
  out->to_raster = (celspan_matrix){{across, 0, -out->shift_x * across - (double)out->left, 0, down,
                                     -out->shift_y * down - (double)out->top, 0, 0, 1}};
}

/* *suits: whether the lines of the map can be turned. */
static celspan_status place_turned(celspan_context *context, const placed_cel *d,
                                   cs_map_drawing *out, bool *suits) {
  const cs_map *map = out->map;
  const celspan_matrix to_units =
      celspan_matrix_then(celspan_matrix_translation((double)map->left, (double)map->top),
                          celspan_matrix_scaling(1 / d->scale_x, 1 / d->scale_y));
  const celspan_matrix matrix = celspan_matrix_then(to_units, d->matrix);
  out->lines = &out->turned;
  out->scale_x = out->scale_y = 1.0 / CS_MAP_UNIT;
  *suits = celspan_matrix_inverse(matrix, &out->to_raster);
  const int32_t size[2] = {d->view->width, d->view->height};
  return *suits ? cs_map_turn(context, map, &matrix, size, suits, &out->turned) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- cels that are swept */

/* Compiles cels by themselves, with all their lights except the back light, which is compiled only
 * if nothing else is behind it. All rows are compiled, so that the dashes of the whole frame are
 * counted. *suits: whether there are not too many dashes. */
static celspan_status compile_cels(celspan_context *context, const cs_cel_parts *parts,
                                   const cs_view *view, const cs_antialias *antialias,
                                   cs_map_sheet *sheet, size_t first, bool *suits) {
  const celspan_rostrum *rostrum = parts->rostrum;
  cs_view whole = *view;
  celspan_rostrum part;
  celspan_cel rearmost, *cels[CS_MAP_DRAWINGS];
  cs_value_copy(&part, rostrum, sizeof part);
  cs_value_copy(&rearmost, rostrum->cels[first], sizeof rearmost);
  memcpy(cels, rostrum->cels + first, sheet->source_count * sizeof *cels);
  part.cels = cels;
  part.cel_count = sheet->source_count;
  if (first > 0) {
    part.back = rearmost.back = (cs_light){0};
    cels[0] = &rearmost;
  }
  whole.first_row = whole.first_column = 0;
  whole.end_row = view->height;
  whole.end_column = view->width;
  whole.cel_numbers = parts->numbers + first;
  CS_TRY(CS_MAKE(context, sheet->plan, 1));
  CS_TRY(cs_compile(context, &part, &whole, antialias, 1, sheet->plan));
  *suits = !sheet->plan->is_crowded;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- a frame */

static void set_back(const celspan_rostrum *rostrum, const cs_light *light, celspan_space space,
                     cs_v4 *back, float *keep) {
  const cs_light lit = cs_scene_back(rostrum, light);
  *back = colour_of(cs_light_in(&lit, space));
  *keep = 1 - lit.flat.a;
}

static void place_object(placed_cel *d, const celspan_object *object) {
  d->matrix = celspan_matrix_then(*object->matrix, d->matrix);
  d->opacity *= object->fade;
}

static bool is_same_drawing(const celspan_cel *a, const celspan_cel *b) {
  bool is_same = a->object_count == b->object_count && a->object_count > 0;
  for (size_t i = 0; is_same && i < a->object_count; i++) {
    const cs_hash from = hash_of(a, i), to = hash_of(b, i);
    is_same = from.a == to.a && from.b == to.b;
  }
  return is_same;
}

/* Whether another cel of the exposure, or one of another exposure, has the drawing of a cel. */
static bool occurs_again(const cs_cel_parts *parts, size_t cel, const celspan_rostrum *other) {
  const celspan_rostrum *rostrum = parts->rostrum;
  bool occurs = false;
  for (size_t i = 0; !occurs && i < rostrum->cel_count; i++)
    occurs = i != cel && is_same_drawing(rostrum->cels[cel], rostrum->cels[i]);
  for (size_t i = 0; !occurs && other && i < other->cel_count; i++)
    occurs = is_same_drawing(rostrum->cels[cel], other->cels[i]);
  return occurs;
}

/* The drawings of all cels, which are judged in their places. */
static celspan_status place_cels(celspan_context *context, const cs_cel_parts *parts,
                                 const cs_view *view, const celspan_rostrum *other,
                                 placed_cel *drawings, cs_ways *ways) {
  const celspan_rostrum *rostrum = parts->rostrum;
  const celspan_matrix to_pixels =
      celspan_matrix_scaling(view->width / view->film_width, view->height / view->film_height);
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    placed_cel *d = &drawings[i];
    *d = (placed_cel){.cel = rostrum->cels[i], .view = view, .number = parts->numbers[i]};
    CS_TRY(cs_parts_place(context, parts, i, view, &d->matrix));
    d->matrix = celspan_matrix_then(d->matrix, to_pixels);
    d->opacity = d->cel->opacity;
    d->census = cs_census_take(d->cel->objects, d->cel->object_count, &d->matrix, view->width,
                               view->height);
    cs_ways_judge(ways, i, cs_parts_pieces(d->cel->objects, d->cel->object_count), &d->census,
                  occurs_again(parts, i, other));
    if (d->cel->object_count == 1)
      place_object(d, d->cel->objects[0]);
  }
  return CELSPAN_OK;
}

/* A frame that is being made. */
typedef struct making {
  celspan_context *context;
  const celspan_rostrum *rostrum; /* the rostrum of the parts */
  const celspan_rostrum *other;   /* in another exposure; NULL: there is none */
  bool repeats;                   /* see celspan_frame_desc */
  cs_cel_parts parts;
  const cs_view *view;
  const cs_antialias *antialias;
  cs_ways ways;
  placed_cel drawings[CS_MAP_DRAWINGS];
} making;

/* Whether a map can be made of some rows alone: it can for an upright drawing, because only the
 * zones in these rows decide whether it can be a map. */
static bool is_cropped(const making *m, const placed_cel *d) {
  const cs_view *view = m->view;
  return !m->repeats && CROPPED * (view->end_row - view->first_row) <= view->height &&
         !d->is_turned && !d->census.may_have_dashes && !cs_ways_is_uneven(d->cel);
}

/* The rows that the raster of an upright map reaches, or the lines of a turned one. */
static void find_rows(const placed_cel *d, cs_map_sheet *sheet) {
  const cs_map_drawing *drawing = &sheet->drawing;
  const cs_map_lines *lines = &drawing->turned;
  const double down = drawing->to_raster.m[4], first = -drawing->to_raster.m[5] / down;
  sheet->top = d->is_turned ? HUGE_VAL : first;
  sheet->bottom = d->is_turned ? -HUGE_VAL : first + drawing->map->height / down;
  for (size_t i = 0; i < lines->border_count; i++) {
    const cs_map_border *border = &lines->borders[i];
    sheet->top = fmin(sheet->top, lines->points[border->first].y * drawing->scale_y);
    sheet->bottom = fmax(sheet->bottom, border->foot * drawing->scale_y);
  }
}

/* All that a map shows. */
static cs_hash hash_sheet(const placed_cel *d, const cs_map_sheet *sheet) {
  const cs_cache_key key = key_of(d);
  cs_hash hash = cs_hash_begin(0);
  cs_hash_hash(&hash, (cs_hash){key.a, key.b});
  cs_value_hash_matrix(&hash, &d->matrix);
  cs_hash_bytes(&hash, &sheet->drawing.light, sizeof sheet->drawing.light);
  cs_grade_hash(&hash, d->cel->grade);
  return cs_hash_end(hash);
}

/* *suits: whether the cel can be a map in its place. */
static celspan_status make_drawing(const making *m, placed_cel *d, cs_map_sheet *sheet,
                                   bool *suits) {
  cs_map_drawing *drawing = &sheet->drawing;
  celspan_context *context = m->context;
  const cs_light front = cs_scene_front(m->rostrum, d->cel);
  float opacity = (float)d->opacity;
  drawing->light = opacity * colour_of(cs_light_in(&front, d->view->space));
  drawing->light[3] = opacity;
  drawing->grade = d->cel->grade ? &d->cel->grade->steps : NULL;
  drawing->space = d->view->space;
  d->is_cropped = is_cropped(m, d);
  const cs_map_keeping keeping = d->is_cropped ? CS_MAP_KEEP_NOT
                                 : m->repeats  ? CS_MAP_KEEP_FIRST
                                               : CS_MAP_KEEP_BESIDE;
  CS_TRY(cs_map_keep_acquire(context, key_of(d), keeping, make, d, &drawing->map));
  *suits = drawing->map->is_whole && !(d->is_turned && drawing->map->missing);
  if (*suits && d->is_turned)
    CS_TRY(place_turned(context, d, drawing, suits));
  else if (*suits)
    place_upright(d, drawing);
  if (!*suits)
    return CELSPAN_OK;
  find_rows(d, sheet);
  sheet->hash = hash_sheet(d, sheet);
  return light_cells(context, drawing);
}

/* Makes the sheet that begins with a cel. *suits: as in make_drawing and compile_cels. */
static celspan_status make_sheet(making *m, size_t first, cs_map_sheet *sheet, bool *suits) {
  const celspan_rostrum *rostrum = m->rostrum;
  *sheet = (cs_map_sheet){.source_count = cs_ways_end(rostrum, &m->ways, first) - first, .keep = 1};
  if (first > 0 || m->ways.mapped[0])
    set_back(rostrum, &rostrum->cels[first]->back, m->view->space, &sheet->back, &sheet->keep);
  if (!m->ways.mapped[first])
    return compile_cels(m->context, &m->parts, m->view, m->antialias, sheet, first, suits);
  return make_drawing(m, &m->drawings[first], sheet, suits);
}

static size_t count_sheets(const making *m) {
  size_t count = 0;
  for (size_t first = 0; first < m->rostrum->cel_count; count++)
    first = cs_ways_end(m->rostrum, &m->ways, first);
  return count;
}

/* Makes the sheets, from the rear, until one of them does not suit. *unsuited: the first cel of
 * this sheet; the number of cels if all sheets suit. */
static celspan_status make_sheets(making *m, cs_map_frame *out, size_t *unsuited) {
  const celspan_rostrum *rostrum = m->rostrum;
  size_t left = count_sheets(m), first = 0;
  CS_TRY(CS_MAKE(m->context, out->sheets, left));
  out->count = left;
  for (bool suits = true; left-- > 0; first += out->sheets[left].source_count) {
    CS_TRY(make_sheet(m, first, &out->sheets[left], &suits));
    out->made += m->ways.mapped[first] && m->drawings[first].is_made;
    out->has_gaps |= m->ways.mapped[first] && out->sheets[left].drawing.map->missing;
    *unsuited = first;
    if (!suits)
      return CELSPAN_OK;
  }
  *unsuited = rostrum->cel_count;
  out->keep = 1;
  if (m->ways.mapped[0])
    set_back(rostrum, &rostrum->back, m->view->space, &out->back, &out->keep);
  out->width = m->view->width;
  out->height = m->view->height;
  return CELSPAN_OK;
}

static celspan_status make_frame(making *m, cs_map_frame *out) {
  const celspan_rostrum *rostrum = m->rostrum = m->parts.rostrum;
  CS_TRY(place_cels(m->context, &m->parts, m->view, m->other, m->drawings, &m->ways));
  cs_ways_find(rostrum, m->view, &m->ways);
  for (size_t i = 0; i < rostrum->cel_count; i++)
    if (m->ways.suits[i] && !find_scale(&m->drawings[i]))
      cs_ways_sweep(rostrum, &m->ways, i);
  while (cs_ways_choose(rostrum, &m->ways)) {
    size_t unsuited = rostrum->cel_count;
    CS_TRY(make_sheets(m, out, &unsuited));
    if (unsuited == rostrum->cel_count)
      return CELSPAN_OK;
    cs_drawings_finish(out, m->context->memory);
    if (!m->ways.mapped[unsuited])
      return CELSPAN_OK;
    cs_ways_sweep(rostrum, &m->ways, unsuited);
  }
  return CELSPAN_OK;
}

celspan_status cs_drawings_create(celspan_context *context, const celspan_rostrum *rostrum,
                                  const celspan_rostrum *other, const cs_view *view,
                                  const cs_antialias *antialias, bool repeats, cs_map_frame *out) {
  making m = {.context = context,
              .other = other,
              .view = view,
              .antialias = antialias,
              .repeats = repeats,
              .ways.forced = (cs_ways_forced)context->root->forced_way};
  if (m.ways.forced == CS_WAYS_SWEPT || !cs_ways_exist(rostrum, view, antialias))
    return CELSPAN_OK;
  celspan_status status = cs_parts_create(context, rostrum, view, CS_WAYS_PIECES, &m.parts);
  if (status == CELSPAN_OK)
    status = make_frame(&m, out);
  cs_parts_finish(&m.parts, context->memory);
  return status;
}

static void finish_sheet(cs_map_sheet *sheet, cs_memory *memory) {
  cs_map_drawing *drawing = &sheet->drawing;
  CS_ARRAYS_FREE(memory, drawing, colours, through);
  cs_map_brush_displace(drawing, memory);
  cs_map_lines_finish(&drawing->turned, memory);
  cs_map_unref(drawing->map);
  if (sheet->plan)
    cs_compile_free(sheet->plan, memory);
  cs_mem_free(memory, sheet->plan, sizeof *sheet->plan);
}

void cs_drawings_finish(cs_map_frame *frame, cs_memory *memory) {
  for (size_t i = 0; i < frame->count; i++)
    finish_sheet(&frame->sheets[i], memory);
  cs_mem_free(memory, frame->sheets, frame->count * sizeof *frame->sheets);
  *frame = (cs_map_frame){0};
}
