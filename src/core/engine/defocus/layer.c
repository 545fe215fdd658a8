#include "engine/defocus/layer.h"

#include "base/number.h"
#include "engine/defocus/fill.h"
#include "engine/defocus/shifted_place.h"
#include "model/scene/bounds.h"
#include "model/scene/extend.h"
#include "model/scene/nearby.h"
#include "model/scene/texture.h"
#include "model/scene/value.h"

#include <math.h>

#define LEAST_RADIUS (1.0 / 64) /* pixels; a smaller blur is not visible */
/* A layer whose radius is at most SHARP pixels is also averaged over each pixel. A layer of SMOOTH
 * pixels or more is smooth at the scale of pixels, and its value at their centres is shown. */
#define SHARP 0.5
#define SMOOTH 2.0
#define SHARP_MOST 500 /* pixels: the greatest radius of what is sharpened */
#define EXTENT 4       /* radii: farther than any kernel reaches, including its grid */

/* ---------------------------------------------------------------- the kernel */

/* The affine map that is tangent to a map at a point: the map itself where it is affine. Only the
 * film of a rostrum inside another rostrum lies on the frame in perspective. */
static celspan_matrix touching(const celspan_matrix *map, celspan_point at) {
  celspan_matrix facing = cs_matrix_facing(map);
  const double *m = facing.m;
  if (m[6] == 0 && m[7] == 0 && m[8] == 1)
    return facing;
  cs_hpoint p = cs_matrix_apply(&facing, (cs_hpoint){at.x, at.y, 1});
  double w = p.w > 0 ? p.w : 1;
  return (celspan_matrix){{(m[0] - p.x / w * m[6]) / w, (m[1] - p.x / w * m[7]) / w, 0,
                           (m[3] - p.y / w * m[6]) / w, (m[4] - p.y / w * m[7]) / w, 0, 0, 0, 1}};
}

/* The radius of a cel's own rule, and the distance of its samples, in the cel's units. */
static void find_rule(const cs_nearby *nearby, double *radius, double *step) {
  bool is_even = nearby && (nearby->kind == CS_NEARBY_WEIGHTS || nearby->kind == CS_NEARBY_LIGHT);
  *radius = nearby ? nearby->radius : 0;
  *step = is_even ? 1 : 0;
}

/* The cel's kernel in pixels of the frame; in perspective, in the middle of its film. */
static cs_blur find_blur(const cs_defocus_cel *place) {
  const celspan_point middle = {place->film_width / 2, place->film_height / 2};
  celspan_matrix camera = cs_scene_camera(place->rostrum, place->film_width, place->film_height);
  celspan_matrix whole = celspan_matrix_then(camera, place->to_pixels);
  celspan_matrix map = touching(&whole, middle);
  const double *m = map.m;
  bool is_pixel = place->cel->defocus_kernel == CELSPAN_DEFOCUS_PIXEL;
  double radius = place->cel->defocus_radius, step = 0;
  if (is_pixel)
    find_rule(place->cel->nearby, &radius, &step);
  cs_blur blur = {
      .kind = place->cel->defocus_kernel,
      .radius_x = radius * sqrt(m[0] * m[0] + m[1] * m[1]),
      .radius_y = radius * sqrt(m[3] * m[3] + m[4] * m[4]),
      .edges = {{radius * m[0], radius * m[3]}, {radius * m[1], radius * m[4]}},
      .steps = {step * sqrt(m[0] * m[0] + m[1] * m[1]), step * sqrt(m[3] * m[3] + m[4] * m[4])}};
  double least = fmin(blur.radius_x, blur.radius_y);
  if (place->is_antialiased && !is_pixel)
    blur.blur = cs_number_clamp((SMOOTH - least) / (SMOOTH - SHARP), 0, 1);
  return blur;
}

bool cs_defocus_layer_is_needed(const cs_defocus_cel *place) {
  if (!(place->cel->defocus_radius > 0))
    return false;
  if (place->cel->defocus_kernel == CELSPAN_DEFOCUS_PIXEL)
    return true;
  cs_blur blur = find_blur(place);
  return fmax(blur.radius_x, blur.radius_y) >= LEAST_RADIUS;
}

/* ---------------------------------------------------------------- where it is visible */

/* The box of the art on the frame, pixels. */
static bool find_art(const cs_defocus_cel *place, cs_boundary_frame *out) {
  const celspan_cel *cel = place->cel;
  celspan_box box;
  if (!cs_bounds_around(cel->objects, cel->object_count, &cel->matrix, &box))
    return false;
  celspan_matrix view = celspan_matrix_then(
      cs_scene_view(place->rostrum, cel, place->film_width, place->film_height), place->to_pixels);
  if (!cs_boundary_around_box(&box, &view, out))
    *out = place->frame; /* beyond the horizon of a rostrum in perspective */
  return true;
}

/* The art's box grown by the blur and by the distance between nodes, in whole pixels, cut to the
 * part of the frame that can be seen. */
static bool find_box(const cs_defocus_cel *place, const cs_blur *blur, const cs_defocused *grid,
                     cs_boundary_frame *out) {
  cs_boundary_frame art;
  if (!find_art(place, &art))
    return false;
  double grow_x = cs_defocus_extent(blur, 0) + 2 * grid->pitch_x + 1;
  double grow_y = cs_defocus_extent(blur, 1) + 2 * grid->pitch_y + 1;
  out->left = fmax(floor(art.left - grow_x), place->frame.left);
  out->right = fmin(ceil(art.right + grow_x), place->frame.right);
  out->top = fmax(floor(art.top - grow_y), place->frame.top);
  out->bottom = fmin(ceil(art.bottom + grow_y), place->frame.bottom);
  return out->left < out->right && out->top < out->bottom;
}

/* ---------------------------------------------------------------- planes */

/* Whether the cel is known to let the three channels through alike. */
static bool stack_is_grey(const cs_stack *stack) {
  if (stack->procedure_count > 0)
    return false;
  for (size_t i = 0; i < stack->defocused_count; i++)
    if (stack->defocused[i]->planes > 1)
      return false;
  for (size_t i = 0; i < stack->layer_count; i++)
    if (!cs_stack_layer_is_grey(stack, &stack->layers[i]))
      return false;
  return true;
}

static bool cel_varies(const celspan_cel *cel);

/* A composition inside the cel. */
static bool rostrum_varies(const celspan_rostrum *rostrum) {
  bool varies = rostrum->front.texture || rostrum->back.texture;
  for (size_t i = 0; i < rostrum->cel_count && !varies; i++) {
    const celspan_cel *cel = rostrum->cels[i];
    varies = cel->front.texture || cel->back.texture || cel->defocus_radius > 0 || cel_varies(cel);
  }
  return varies;
}

/* The recursion ends because nesting is at most CS_SCENE_DEPTH. */
static bool object_varies(const celspan_object *object) {
  const cs_primitive_data *data = object->data;
  if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM)
    return rostrum_varies(data->rostrum);
  if (data->kind == CS_PRIMITIVE_DATA_OUTLINE)
    return data->texture->kind != CS_TEXTURE_FLAT;
  if (data->kind == CS_PRIMITIVE_DATA_SCANLINE)
    return true;
  for (size_t i = 0; i < data->boolean->operand_count; i++)
    if (object_varies(data->boolean->operands[i]))
      return true;
  return false;
}

static bool cel_varies(const celspan_cel *cel) {
  for (size_t i = 0; i < cel->object_count; i++)
    if (object_varies(cel->objects[i]))
      return true;
  return false;
}

static celspan_status compile_plane(celspan_context *context, const cs_defocus_cel *place,
                                    const cs_defocus_compiler *compiler, int plane,
                                    cs_defocus *defocus) {
  cs_defocus_job job = {.cel = place->cel,
                        .matrix = celspan_matrix_then(place->matrix, cs_defocus_matrix(defocus)),
                        .is_through = plane == 1};
  cs_defocus_raster(defocus, &job.width, &job.height);
  CS_TRY(cs_defocus_kernel(context, defocus, &job.kernel));
  return compiler->compile(compiler->user, &job, &defocus->plans[plane]);
}

/* defocus: gets the number of its planes. */
static celspan_status compile_planes(celspan_context *context, const cs_defocus_cel *place,
                                     const cs_defocus_compiler *compiler, cs_defocus *defocus) {
  defocus->extended = place->extended ? celspan_object_ref(place->extended) : NULL;
  CS_TRY(compile_plane(context, place, compiler, 0, defocus));
  defocus->grid.planes = 1;
  if (defocus->way == CS_DEFOCUS_NEIGHBOURS || stack_is_grey(&defocus->plans[0].stack))
    return CELSPAN_OK;
  CS_TRY(compile_plane(context, place, compiler, 1, defocus));
  defocus->grid.planes = 2;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the key */

/* Everything that the nodes depend on. */
static cs_hash find_key(const cs_defocus_cel *place, const cs_blur *blur, double samples) {
  const celspan_cel *cel = place->cel;
  cs_hash hash = cs_hash_begin(0x736f6674u);
  cs_hash_word(&hash, cel->object_count);
  for (size_t i = 0; i < cel->object_count; i++)
    cs_hash_hash(&hash, cel->objects[i]->hash);
  for (int i = 0; i < 9; i++)
    cs_hash_number(&hash, place->matrix.m[i]);
  cs_hash_word(&hash, (uint64_t)place->width);
  cs_hash_word(&hash, (uint64_t)place->height);
  cs_hash_word(&hash, blur->kind);
  cs_hash_number(&hash, blur->radius_x);
  cs_hash_number(&hash, blur->radius_y);
  for (int k = 0; k < 4; k++)
    cs_hash_number(&hash, blur->edges[k / 2][k % 2]);
  cs_hash_number(&hash, blur->blur);
  cs_hash_number(&hash, blur->steps[0]);
  cs_hash_number(&hash, blur->steps[1]);
  cs_hash_number(&hash, samples);
  cs_hash_word(&hash, place->space);
  if (cel->nearby)
    cs_hash_hash(&hash, cel->nearby->hash);
  return cs_hash_end(hash);
}

/* ---------------------------------------------------------------- what was made before */

/* A new reference to the layer with this key; NULL: there is none. */
static cs_defocus *find_made(const cs_defocus_made *made, cs_hash key) {
  size_t number;
  if (!cs_hash_table_find(&made->numbers, key, &number))
    return NULL;
  made->list[number]->owners++;
  return made->list[number];
}

/* Compiles a cel for the chosen way, and keeps it under its key. */
static celspan_status compile_new(celspan_context *context, const cs_defocus_cel *place,
                                  const cs_defocus_compiler *compiler, cs_defocus *defocus) {
  cs_defocus_made *made = compiler->made;
  CS_TRY(compile_planes(context, place, compiler, defocus));
  cs_defocus_fill_bands(defocus);
  CS_TRY(CS_ARRAY_RESERVE(context, made->list, made->count + 1));
  CS_TRY(cs_hash_table_add(&made->numbers, context, defocus->key, made->count));
  made->list[made->count++] = defocus;
  defocus->owners++;
  return CELSPAN_OK;
}

void cs_defocus_made_finish(cs_defocus_made *made, celspan_context *context) {
  for (size_t i = 0; i < made->count; i++)
    cs_defocus_layer_unref(made->list[i], context->memory);
  CS_ARRAYS_FREE(context->memory, made, list, list);
  cs_hash_table_finish(&made->numbers, context);
  *made = (cs_defocus_made){0};
}

/* ---------------------------------------------------------------- the cel's own grid */

static celspan_status make_own(celspan_context *context, const cs_defocus_cel *on_grid, bool varies,
                               const cs_own_grid *grid, const cs_defocus_compiler *compiler,
                               cs_defocus **out) {
  const cs_hash key = find_key(on_grid, &grid->blur, grid->samples);
  cs_defocus *own = find_made(compiler->made, key);
  *out = own;
  if (own)
    return CELSPAN_OK;
  CS_TRY(cs_defocus_create_own(context, &grid->blur, varies, grid->size, grid->samples, &own));
  own->key = key;
  celspan_status status = compile_new(context, on_grid, compiler, own);
  if (status == CELSPAN_OK)
    *out = own;
  else
    cs_defocus_layer_unref(own, context->memory);
  return status;
}

/* Gives the layer the cel's own grid to mix its nodes from. */
static celspan_status use_own(celspan_context *context, const cs_defocus_cel *place, bool varies,
                              const cs_own_grid *grid, const cs_defocus_compiler *compiler,
                              cs_defocus *defocus) {
  cs_defocus_cel on_grid = *place;
  cs_defocus *own;
  on_grid.matrix = grid->matrix;
  on_grid.width = grid->size[0];
  on_grid.height = grid->size[1];
  CS_TRY(make_own(context, &on_grid, varies, grid, compiler, &own));
  cs_defocus_use_own(defocus, own, grid->scale, grid->offset);
  return CELSPAN_OK;
}

/* Blended layers are made pixel by pixel, where they can be seen. */
static void use_pixels(const cs_boundary_frame *visible, cs_defocus *defocus) {
  const int32_t first[2] = {(int32_t)visible->left, (int32_t)visible->top};
  const int32_t end[2] = {(int32_t)visible->right, (int32_t)visible->bottom};
  cs_defocus_use_pixels(defocus, first, end);
}

static celspan_status use_sharpness(celspan_context *context, const cs_nearby *nearby,
                                    cs_defocus *defocus) {
  const cs_blur *blur = &defocus->blur;
  defocus->way = CS_DEFOCUS_SUMS;
  CS_TRY(cs_defocus_sums_init(context, fmin(blur->radius_x, SHARP_MOST),
                              fmin(blur->radius_y, SHARP_MOST), 0, &defocus->sums));
  defocus->sums.sharpens = true;
  defocus->sums.amount = (float)nearby->amount;
  return CELSPAN_OK;
}

/* From a cel's units to pixels, about the middle of its rule's box. */
static celspan_matrix rule_matrix(const cs_defocus_cel *place) {
  const celspan_box *box = &place->cel->nearby->box;
  return touching(&place->matrix,
                  (celspan_point){box->x + box->width / 2, box->y + box->height / 2});
}

/* Whether the cel has an area on the frame for its rule: a middle on the horizon has none. */
static bool rule_is_visible(const cs_defocus_cel *place) {
  const cs_nearby *nearby = place->cel->nearby;
  celspan_matrix back;
  return !nearby || nearby->kind == CS_NEARBY_SHARPEN ||
         celspan_matrix_inverse(rule_matrix(place), &back);
}

/* Finds the way of a cel that is changed by a rule of its own. */
static celspan_status use_nearby(celspan_context *context, const cs_defocus_cel *place,
                                 cs_defocus *defocus) {
  cs_nearby *nearby = place->cel->nearby;
  if (nearby->kind == CS_NEARBY_SHARPEN)
    return use_sharpness(context, nearby, defocus);
  const celspan_matrix matrix = rule_matrix(place);
  defocus->way = CS_DEFOCUS_NEIGHBOURS;
  cs_defocus_neighbours_init(&defocus->neighbours, nearby);
  const celspan_matrix to_samples = celspan_matrix_then(matrix, cs_defocus_matrix(defocus));
  return cs_defocus_neighbours_place(context, &defocus->neighbours, &to_samples, place->space);
}

/* A layer whose nodes are made for the frame. *defocus: is replaced where there is one already. */
static celspan_status make_for_frame(celspan_context *context, const cs_defocus_cel *place,
                                     bool varies, const cs_defocus_compiler *compiler,
                                     cs_defocus **defocus) {
  cs_defocus *before = find_made(compiler->made, (*defocus)->key);
  if (before) {
    cs_defocus_layer_unref(*defocus, context->memory);
    *defocus = before;
    return CELSPAN_OK;
  }
  CS_TRY(place->cel->nearby ? use_nearby(context, place, *defocus)
                            : cs_defocus_find_way(context, *defocus, varies));
  return compile_new(context, place, compiler, *defocus);
}

static celspan_status make(celspan_context *context, const cs_defocus_cel *place,
                           const cs_blur *blur, const cs_defocus_compiler *compiler,
                           const cs_boundary_frame *visible, cs_defocus **defocus) {
  bool varies = cel_varies(place->cel);
  cs_own_grid grid;
  (*defocus)->key = find_key(place, blur, CS_DEFOCUS_SAMPLES);
  if (blur->kind == CELSPAN_DEFOCUS_PIXEL || !cs_own_grid_find(place, blur, varies, &grid))
    return make_for_frame(context, place, varies, compiler, defocus);
  CS_TRY(use_own(context, place, varies, &grid, compiler, *defocus));
  if (place->is_source)
    use_pixels(visible, *defocus);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- shifted cels */

/* The grid of means over a rectangle of pixels of a cel in the same place. */
static celspan_status make_means(celspan_context *context, const cs_defocus_cel *place,
                                 const celspan_cel *cel, const cs_defocus_compiler *compiler,
                                 const cs_shifted_part *part, cs_defocus **out) {
  cs_own_grid grid = {.blur = {.kind = CELSPAN_DEFOCUS_PIXEL}, .samples = CS_DEFOCUS_SAMPLES};
  cs_defocus_cel alone = *place;
  alone.cel = cel;
  alone.matrix = celspan_matrix_then(place->matrix,
                                     celspan_matrix_translation(-part->first[0], -part->first[1]));
  alone.width = grid.size[0] = part->end[0] - part->first[0];
  alone.height = grid.size[1] = part->end[1] - part->first[1];
  return make_own(context, &alone, cel_varies(cel), &grid, compiler, out);
}

static cs_hash shifted_key(const cs_defocus_cel *place, const cs_shifted_place *where,
                           const cs_blur *blur) {
  cs_hash hash = find_key(place, blur, CS_DEFOCUS_SAMPLES);
  cs_hash_hash(&hash, place->cel->shift->hash);
  for (int k = 0; k < 2; k++) {
    cs_hash_word(&hash, (uint64_t)where->shown.first[k]);
    cs_hash_word(&hash, (uint64_t)where->shown.end[k]);
  }
  return cs_hash_end(hash);
}

/* A layer whose nodes are read along the shift of its cel. */
static celspan_status make_shifted(celspan_context *context, const cs_defocus_cel *place,
                                   const cs_shifted_place *where, const cs_blur *blur,
                                   const cs_defocus_compiler *compiler, cs_defocus *defocus) {
  cs_shift *shift = place->cel->shift;
  cs_defocus *own, *by = NULL;
  celspan_status status = CELSPAN_OK;
  defocus->key = shifted_key(place, where, blur);
  CS_TRY(make_means(context, place, place->cel, compiler, &where->read, &own));
  if (cs_shifted_part_has_pixels(&where->by))
    status = make_means(context, place, shift->by, compiler, &where->by, &by);
  cs_defocus_use_shift(defocus, &where->map, own, by);
  cs_defocus_fill_bands(defocus);
  return status == CELSPAN_OK ? cs_shifted_init(context, shift, &defocus->shifted) : status;
}

static celspan_status create_shifted(celspan_context *context, const cs_defocus_cel *place,
                                     const cs_blur *blur, const cs_defocus_compiler *compiler,
                                     bool *is_seen, cs_boundary_frame *visible,
                                     cs_defocus *defocus) {
  cs_shifted_place where;
  CS_TRY(cs_shifted_place_find(context, place, is_seen, visible, &where));
  return *is_seen ? make_shifted(context, place, &where, blur, compiler, defocus) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- life */

static celspan_status add_box(celspan_context *context, const cs_boundary_frame *visible,
                              cs_outline *box) {
  return cs_outline_rect(context, box, visible->left, visible->top, visible->right - visible->left,
                         visible->bottom - visible->top, 0);
}

/* The cel's objects. Objects on the border of the film continue outside it, as far as the blur
 * reaches. */
static celspan_status extend(celspan_context *context, const cs_defocus_cel *place,
                             const cs_blur *blur, celspan_object **out) {
  const celspan_point middle = {place->film_width / 2, place->film_height / 2};
  const celspan_box border = {0, 0, place->film_width, place->film_height};
  celspan_matrix pixels = touching(&place->to_pixels, middle), back;
  if (!celspan_matrix_inverse(place->to_pixels, &back))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "defocus: the film has no area on the frame");
  const double *m = pixels.m;
  double scale = sqrt(fmin(m[0] * m[0] + m[3] * m[3], m[1] * m[1] + m[4] * m[4]));
  double reach = EXTENT * fmax(blur->radius_x, blur->radius_y) / scale;
  const celspan_matrix placed = celspan_matrix_then(place->matrix, back);
  return cs_extend(context, place->cel->objects, place->cel->object_count, &placed, &border, reach,
                   out);
}

static celspan_status create(celspan_context *context, const cs_defocus_cel *place,
                             const cs_defocus_compiler *compiler, cs_outline *box,
                             cs_defocus **out) {
  cs_blur blur = find_blur(place);
  cs_boundary_frame visible;
  cs_defocus *defocus;
  *out = NULL;
  CS_TRY(cs_defocus_create(context, &blur, place->width, place->height, &defocus));
  celspan_status status = CELSPAN_OK;
  bool is_seen;
  if (place->cel->shift)
    status = create_shifted(context, place, &blur, compiler, &is_seen, &visible, defocus);
  else if ((is_seen = find_box(place, &blur, &defocus->grid, &visible) && rule_is_visible(place)))
    status = make(context, place, &blur, compiler, &visible, &defocus);
  if (is_seen && status == CELSPAN_OK)
    status = add_box(context, &visible, box);
  if (is_seen && status == CELSPAN_OK)
    *out = defocus;
  else
    cs_defocus_layer_unref(defocus, context->memory);
  return status;
}

celspan_status cs_defocus_layer_create(celspan_context *context, const cs_defocus_cel *place,
                                       const cs_defocus_compiler *compiler, cs_outline *box,
                                       cs_defocus **out) {
  const cs_blur blur = find_blur(place);
  cs_defocus_cel wider = *place;
  celspan_cel cel;
  if (place->cel->defocus_edge == CELSPAN_BLUR_CLEAR)
    return create(context, place, compiler, box, out);
  CS_TRY(extend(context, place, &blur, &wider.extended));
  cs_value_copy(&cel, place->cel, sizeof cel);
  cel.objects = &wider.extended;
  cel.object_count = 1;
  wider.cel = &cel;
  celspan_status status = create(context, &wider, compiler, box, out);
  celspan_object_unref(wider.extended);
  return status;
}

void cs_defocus_layer_free_plan(cs_plan *plan, cs_memory *memory) {
  for (size_t i = 0; i < plan->defocus_count; i++)
    cs_defocus_layer_unref(plan->defocus[i], memory);
  cs_plan_finish(plan, memory);
}

void cs_defocus_layer_unref(cs_defocus *defocus, cs_memory *memory) {
  if (--defocus->owners > 0)
    return;
  cs_defocus_layer_free_plan(&defocus->plans[0], memory);
  cs_defocus_layer_free_plan(&defocus->plans[1], memory);
  celspan_object_unref(defocus->extended);
  if (defocus->own)
    cs_defocus_layer_unref(defocus->own, memory);
  if (defocus->by)
    cs_defocus_layer_unref(defocus->by, memory);
  cs_defocus_free(defocus, memory);
}
