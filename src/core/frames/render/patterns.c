#include "frames/render/patterns.h"

#include <math.h>

#include "base/number.h"
#include "engine/defocus/layer.h"
#include "engine/row/row.h"
#include "model/colour/space.h"
#include "model/geometry/matrix.h"
#include "model/scene/texture.h"
#include "model/scene/walk.h"

#define COPIES_EACH 4096 /* primitives in the boxes of one plane that are copied, at most */
#define COPIES_ALL 16384 /* the same for all patterns of a frame together */
#define FEW_BOXES 64     /* a plane's boxes up to this number are copied, whatever they hold */
#define SIDE 4096        /* texels of a picture, at most */
#define TEXELS 4194304   /* likewise */
#define TEXELS_A_PIXEL 4 /* in each direction: their mean is as sharp as an edge */
#define SLACK 1e-9       /* boxes: how near to an edge the next box is in view */

void cs_patterns_finish(cs_patterns *patterns, cs_memory *memory) {
  for (size_t i = 0; i < patterns->count; i++)
    celspan_texture_unref(patterns->pictures[i].texture);
  cs_mem_free(memory, patterns->pictures, patterns->capacity * sizeof *patterns->pictures);
  *patterns = (cs_patterns){0};
}

/* ---------------------------------------------------------------- boxes in view */

/* A plane in its place. */
typedef struct view {
  const cs_repeat *repeat;
  celspan_matrix to_pixels; /* from the pattern's units */
  double left, top;         /* the first boxes in view, counted from the pattern's own box */
  double columns, rows;     /* the columns and rows of boxes in view; 0: nothing is */
  double scale_x, scale_y;  /* pixels to a unit of the pattern, at most */
} view;

typedef struct extent {
  double left, top, right, bottom;
} extent;

static extent common(extent a, extent b) {
  return (extent){fmax(a.left, b.left), fmax(a.top, b.top), fmin(a.right, b.right),
                  fmin(a.bottom, b.bottom)};
}

static cs_hpoint corner(const extent *e, int i) {
  return (cs_hpoint){i & 1 ? e->right : e->left, i & 2 ? e->bottom : e->top, 1};
}

/* The extent of a box under a matrix; false where a part of it lies behind the horizon. */
static bool map_extent(const celspan_matrix *matrix, const extent *from, extent *out) {
  *out = (extent){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (int i = 0; i < 4; i++) {
    cs_hpoint p = cs_matrix_apply(matrix, corner(from, i));
    if (!(p.w > 0))
      return false;
    out->left = fmin(out->left, p.x / p.w);
    out->right = fmax(out->right, p.x / p.w);
    out->top = fmin(out->top, p.y / p.w);
    out->bottom = fmax(out->bottom, p.y / p.w);
  }
  return true;
}

/* The part of the frame that the plane covers, in the pattern's units, as far as that is known
 * without the horizon. */
static extent find_visible(const cs_compiler *c, const cs_primitive_data *plane,
                           const celspan_matrix *matrix, const view *v) {
  const celspan_box *box = &plane->bounds;
  const extent frame = {c->frame.left, c->frame.top, c->frame.right, c->frame.bottom};
  const extent bounds = {box->x, box->y, box->x + box->width, box->y + box->height};
  const celspan_matrix inside = cs_matrix_facing(&plane->repeat->inverse);
  celspan_matrix back;
  extent pixels, seen, around;
  (void)map_extent(&inside, &bounds, &seen); /* cannot fail, because this map is affine */
  if (!celspan_matrix_inverse(v->to_pixels, &back))
    return (extent){0, 0, 0, 0};
  back = cs_matrix_facing(&back);
  pixels = map_extent(matrix, &bounds, &pixels) ? common(pixels, frame) : frame;
  if (map_extent(&back, &pixels, &around))
    seen = common(seen, around);
  return seen;
}

/* The greatest scale at the corners of the visible area. */
static void find_scale(const extent *seen, view *v) {
  const double *m = v->to_pixels.m;
  for (int i = 0; i < 4; i++) {
    cs_hpoint at = corner(seen, i), p = cs_matrix_apply(&v->to_pixels, at);
    if (!(p.w > 0))
      continue;
    double x = p.x / p.w, y = p.y / p.w;
    v->scale_x = fmax(v->scale_x, cs_number_length(m[0] - x * m[6], m[3] - y * m[6]) / p.w);
    v->scale_y = fmax(v->scale_y, cs_number_length(m[1] - x * m[7], m[4] - y * m[7]) / p.w);
  }
}

static view find_view(const cs_compiler *c, const cs_primitive_data *plane,
                      const celspan_matrix *matrix) {
  view v = {.repeat = plane->repeat};
  const celspan_box *box = &plane->repeat->box;
  const celspan_matrix whole = celspan_matrix_then(plane->repeat->matrix, *matrix);
  v.to_pixels = cs_matrix_facing(&whole);
  const extent seen = find_visible(c, plane, matrix, &v);
  if (!(seen.right > seen.left && seen.bottom > seen.top))
    return v;
  v.left = floor((seen.left - box->x) / box->width - SLACK);
  v.top = floor((seen.top - box->y) / box->height - SLACK);
  v.columns = ceil((seen.right - box->x) / box->width + SLACK) - v.left;
  v.rows = ceil((seen.bottom - box->y) / box->height + SLACK) - v.top;
  find_scale(&seen, &v);
  return v;
}

/* ---------------------------------------------------------------- copies */

/* One box in its place, in the plane's units. */
static celspan_status copy_box(cs_compiler *c, celspan_object *tile, const view *v, double column,
                               double row, celspan_object **out) {
  const celspan_box *box = &v->repeat->box;
  celspan_matrix to =
      celspan_matrix_translation(box->x + column * box->width, box->y + row * box->height);
  to = celspan_matrix_then(to, v->repeat->matrix);
  return celspan_object_transform(c->context, tile, &to, out);
}

static celspan_status copy_boxes(cs_compiler *c, celspan_object *tile, const view *v,
                                 celspan_object **copies, size_t *made) {
  for (double row = 0; row < v->rows; row++)
    for (double column = 0; column < v->columns; column++) {
      CS_TRY(copy_box(c, tile, v, v->left + column, v->top + row, &copies[*made]));
      (*made)++;
    }
  return CELSPAN_OK;
}

static celspan_status copy_tile(cs_compiler *c, celspan_object *tile, const view *v,
                                celspan_object **out) {
  size_t count = (size_t)(v->rows * v->columns), made = 0;
  celspan_object **copies = cs_mem_array(c->context->memory, count, sizeof *copies);
  celspan_status status =
      !copies && count > 0 ? cs_fail_memory(c->context) : copy_boxes(c, tile, v, copies, &made);
  if (status == CELSPAN_OK)
    status = celspan_object_create_boolean(c->context, CELSPAN_OPERATOR_UNION, copies, made, out);
  for (size_t i = 0; i < made; i++)
    celspan_object_unref(copies[i]);
  cs_mem_free(c->context->memory, copies, count * sizeof(celspan_object *));
  return status;
}

static celspan_status copy(cs_compiler *c, const cs_primitive_data *plane, const view *v,
                           celspan_object **out) {
  celspan_object *tile;
  c->patterns->copies += (size_t)(v->rows * v->columns) * plane->primitive_count;
  CS_TRY(celspan_object_create_rostrum(c->context, plane->rostrum, &tile));
  celspan_status status = copy_tile(c, tile, v, out);
  celspan_object_unref(tile);
  return status;
}

static bool is_copied(const cs_compiler *c, const cs_primitive_data *plane, const view *v) {
  double boxes = v->rows * v->columns, primitives = boxes * plane->primitive_count;
  bool has_room = (double)c->patterns->copies + primitives <= COPIES_ALL;
  return boxes == 0 || (has_room && (boxes <= FEW_BOXES || primitives <= COPIES_EACH));
}

/* ---------------------------------------------------------------- pictures */

/* The least power of two that is not less, so that few different sizes occur. */
static int32_t side_of(double pixels) {
  int32_t side = 1;
  while (side < SIDE && side < TEXELS_A_PIXEL * pixels)
    side *= 2;
  return side;
}

static void spread(const cs_row *row, cs_v4 *line) {
  for (size_t i = 0; i < row->count; i++) {
    const celspan_span *span = &row->spans[i];
    cs_row_spread_span(span, span->x0, span->x1, line + span->x0);
  }
}

/* Texels in linear light. space: of the plan's rows. */
static celspan_status make_rows(celspan_context *context, const cs_plan *plan, celspan_space space,
                                cs_v4 *texels) {
  cs_row_maker maker;
  cs_row row;
  cs_row_init(&row);
  celspan_status status = cs_row_maker_init(&maker, context, plan);
  for (int32_t y = 0; y < plan->height && status == CELSPAN_OK; y++) {
    cs_v4 *line = texels + (size_t)y * (size_t)plan->width;
    status = cs_row_make(&maker, y, &row);
    if (status == CELSPAN_OK)
      spread(&row, line);
    for (int32_t x = 0; status == CELSPAN_OK && x < plan->width; x++) {
      float rgba[4];
      cs_v4_store(rgba, line[x]);
      cs_space_decode(space, rgba);
      line[x] = cs_v4_load(rgba);
    }
  }
  cs_row_maker_finish(&maker);
  cs_row_finish(&row, context->memory);
  return status;
}

/* The texels of one box as a surface. */
static celspan_status make_surface(cs_compiler *c, const cs_defocus_job *job, cs_v4 *texels,
                                   celspan_surface **out) {
  cs_plan plan;
  CS_TRY(c->compile_alone(c, job, &plan));
  celspan_space space = job->is_through ? CELSPAN_SPACE_LINEAR : c->space;
  celspan_status status = make_rows(c->context, &plan, space, texels);
  for (int32_t i = 0; job->is_through && i < job->width * job->height; i++)
    texels[i][3] = 1; /* the light let through, all of it through a medium */
  c->free_alone(&plan, c->context->memory);
  CS_TRY(status);
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  desc.width = job->width;
  desc.height = job->height;
  desc.format = CELSPAN_SURFACE_RGBAF;
  desc.pixels = texels;
  return celspan_surface_create(c->context, &desc, out);
}

static celspan_status make_desc(cs_compiler *c, const cs_defocus_job *job, const celspan_box *box,
                                celspan_picture_desc *out) {
  cs_v4 *texels;
  size_t count = (size_t)job->width * (size_t)job->height;
  CS_TRY(CS_MAKE(c->context, texels, count));
  *out = (celspan_picture_desc){.struct_size = sizeof(celspan_picture_desc),
                                .wrap = CELSPAN_WRAP_REPEAT,
                                .has_box = true,
                                .box = *box};
  celspan_status status = make_surface(c, job, texels, &out->surface);
  cs_mem_free(c->context->memory, texels, count * sizeof *texels);
  return status;
}

static celspan_status note_colour(const cs_walk *walk, const cs_primitive_data *primitive,
                                  const celspan_texture *texture) {
  bool *is_coloured = walk->user;
  (void)primitive;
  *is_coloured = *is_coloured || !texture || !cs_texture_is_grey(texture);
  return CELSPAN_OK;
}

/* Whether light through the box may change its colour: then the picture has a medium. */
static bool has_gels(const celspan_rostrum *tile) {
  bool is_coloured = false;
  cs_walk walk = {.call = note_colour, .user = &is_coloured};
  celspan_status never_fails = cs_walk_rostrum(&walk, tile);
  (void)never_fails;
  return is_coloured;
}

static celspan_status add_medium(cs_compiler *c, cs_defocus_job *job, const celspan_box *box,
                                 celspan_texture **texture) {
  celspan_picture_desc medium;
  celspan_texture *made = NULL;
  job->is_through = true;
  CS_TRY(make_desc(c, job, box, &medium));
  celspan_status status = celspan_texture_with_medium(c->context, *texture, &medium, &made);
  celspan_surface_unref(medium.surface);
  CS_TRY(status);
  celspan_texture_unref(*texture);
  *texture = made;
  return CELSPAN_OK;
}

static celspan_status make_picture(cs_compiler *c, const celspan_rostrum *tile,
                                   const celspan_box *box, cs_patterns_picture *picture) {
  const celspan_cel *cel = tile->cels[0];
  const celspan_matrix to_texels =
      celspan_matrix_scaling(picture->width / box->width, picture->height / box->height);
  cs_defocus_job job = {.cel = cel,
                        .matrix = celspan_matrix_then(cel->matrix, to_texels),
                        .width = picture->width,
                        .height = picture->height};
  celspan_picture_desc desc;
  CS_TRY(make_desc(c, &job, box, &desc));
  celspan_status status = celspan_texture_create_picture(c->context, &desc, &picture->texture);
  celspan_surface_unref(desc.surface);
  if (status == CELSPAN_OK && has_gels(tile))
    status = add_medium(c, &job, box, &picture->texture);
  if (status != CELSPAN_OK)
    celspan_texture_unref(picture->texture);
  return status;
}

/* *out: borrowed. */
static celspan_status find_picture(cs_compiler *c, const cs_primitive_data *plane,
                                   cs_patterns_picture wanted, celspan_texture **out) {
  cs_patterns *p = c->patterns;
  for (size_t i = 0; i < p->count; i++) {
    const cs_patterns_picture *there = &p->pictures[i];
    if (there->tile.a == wanted.tile.a && there->tile.b == wanted.tile.b &&
        there->width == wanted.width && there->height == wanted.height &&
        there->space == wanted.space) {
      *out = there->texture;
      return CELSPAN_OK;
    }
  }
  CS_TRY(make_picture(c, plane->rostrum, &plane->repeat->box, &wanted));
  *out = wanted.texture;
  celspan_status status = CS_APPEND(c->context, p->pictures, p->count, p->capacity, wanted);
  if (status != CELSPAN_OK)
    celspan_texture_unref(wanted.texture);
  return status;
}

/* A rectangle over the boxes in view, with the picture. */
static celspan_status make_rectangle(cs_compiler *c, const view *v, celspan_texture *texture,
                                     celspan_object **out) {
  const celspan_box *box = &v->repeat->box;
  const celspan_rect_desc desc = {sizeof desc,
                                  box->x + v->left * box->width,
                                  box->y + v->top * box->height,
                                  v->columns * box->width,
                                  v->rows * box->height,
                                  0,
                                  texture};
  celspan_object *plain, *placed = NULL;
  CS_TRY(celspan_object_create_rect(c->context, &desc, &plain));
  celspan_status status = celspan_object_transform(c->context, plain, &v->repeat->matrix, &placed);
  celspan_object_unref(plain);
  if (status == CELSPAN_OK)
    status = celspan_object_create_boolean(c->context, CELSPAN_OPERATOR_UNION, &placed, 1, out);
  celspan_object_unref(placed);
  return status;
}

static celspan_status show_picture(cs_compiler *c, const cs_primitive_data *plane, const view *v,
                                   celspan_object **out) {
  cs_stack *stack = &c->plan->stack;
  const celspan_box *box = &v->repeat->box;
  cs_patterns_picture wanted = {.tile = plane->rostrum->hash,
                                .width = side_of(v->scale_x * box->width),
                                .height = side_of(v->scale_y * box->height),
                                .space = c->space};
  while ((int64_t)wanted.width * wanted.height > TEXELS) {
    wanted.width -= wanted.width >= wanted.height ? wanted.width / 2 : 0;
    wanted.height -= wanted.height > wanted.width ? wanted.height / 2 : 0;
  }
  celspan_texture *texture;
  CS_TRY(CS_COMPILER_APPEND(c, coded, coded_count));
  CS_TRY(find_picture(c, plane, wanted, &texture));
  stack->coded[stack->coded_count++] = celspan_texture_ref(texture);
  return make_rectangle(c, v, texture, out);
}

celspan_status cs_patterns_expand(cs_compiler *c, const cs_primitive_data *plane,
                                  const celspan_matrix *matrix, celspan_object **out) {
  const view v = find_view(c, plane, matrix);
  return is_copied(c, plane, &v) ? copy(c, plane, &v, out) : show_picture(c, plane, &v, out);
}
