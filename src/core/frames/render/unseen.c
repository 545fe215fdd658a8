#include "frames/render/unseen.h"

#include <math.h>

#include "model/geometry/matrix.h"

#define OBJECTS_LEAST 1024 /* shorter lists are not searched */
#define SIDE 256           /* tiles in a row, and rows of tiles, at most */
#define WORDS (SIDE / 64)
/* Pixels: how far a rectangle's edge may be from the edge of a tile that it covers, because of
 * rounding, and how far outlines may reach beyond their bounds. Both are too little to be seen. */
#define NEAR 1e-9
#define BEYOND (2 * CS_BOUNDARY_TOLERANCE)

typedef struct tiles {
  const cs_boundary_frame *frame;
  double size; /* pixels, whole */
  int columns, rows;
  uint64_t covered[SIDE][WORDS];
} tiles;

/* Tiles [left, right) of rows [top, bottom). */
typedef struct range {
  int left, right, top, bottom;
} range;

/* ---------------------------------------------------------------- tiles */

static void begin(tiles *t, const cs_boundary_frame *frame) {
  double width = frame->right - frame->left, height = frame->bottom - frame->top;
  *t = (tiles){.frame = frame, .size = ceil(fmax(width, height) / SIDE)};
  t->columns = (int)ceil(width / t->size);
  t->rows = (int)ceil(height / t->size);
}

static int held(double tile, int count) {
  return tile <= 0 ? 0 : tile >= count ? count : (int)tile;
}

/* The tiles inside a rectangle. Places beyond the frame count as inside. */
static range tiles_inside(const tiles *t, const cs_boundary_frame *box) {
  const cs_boundary_frame *frame = t->frame;
  double right = box->right >= frame->right ? HUGE_VAL : box->right;
  double bottom = box->bottom >= frame->bottom ? HUGE_VAL : box->bottom;
  return (range){held(ceil((box->left - frame->left - NEAR) / t->size), t->columns),
                 held(floor((right - frame->left + NEAR) / t->size), t->columns),
                 held(ceil((box->top - frame->top - NEAR) / t->size), t->rows),
                 held(floor((bottom - frame->top + NEAR) / t->size), t->rows)};
}

/* The tiles of the frame that a rectangle touches. */
static range tiles_touched(const tiles *t, const cs_boundary_frame *box) {
  const cs_boundary_frame *frame = t->frame;
  return (range){held(floor((box->left - frame->left - BEYOND) / t->size), t->columns),
                 held(ceil((box->right - frame->left + BEYOND) / t->size), t->columns),
                 held(floor((box->top - frame->top - BEYOND) / t->size), t->rows),
                 held(ceil((box->bottom - frame->top + BEYOND) / t->size), t->rows)};
}

/* The bits of one word that lie in tiles [left, right). */
static uint64_t mask_of(const range *r, int word) {
  int from = r->left - 64 * word, to = r->right - 64 * word;
  if (from >= 64 || to <= 0 || from >= to)
    return 0;
  uint64_t mask = ~(uint64_t)0;
  mask &= from > 0 ? mask << from : mask;
  return to < 64 ? mask & (((uint64_t)1 << to) - 1) : mask;
}

static void cover(tiles *t, const range *r) {
  for (int row = r->top; row < r->bottom; row++)
    for (int word = r->left / 64; 64 * word < r->right; word++)
      t->covered[row][word] |= mask_of(r, word);
}

static bool is_covered(const tiles *t, const range *r) {
  bool is_there = r->left < r->right && r->top < r->bottom;
  for (int row = r->top; row < r->bottom && is_there; row++)
    for (int word = r->left / 64; 64 * word < r->right && is_there; word++)
      is_there = (mask_of(r, word) & ~t->covered[row][word]) == 0;
  return is_there;
}

/* ---------------------------------------------------------------- the search */

/* Whether an object that nobody sees can be left out. It can if only its paint is lost. But a
 * picture that cannot be read must be reported, and a procedure must be called, wherever they
 * are. */
static bool can_go(const cs_primitive_data *data) {
  return data->kind == CS_PRIMITIVE_DATA_OUTLINE && data->texture->kind != CS_TEXTURE_PICTURE;
}

static bool is_upright(const celspan_matrix *matrix) {
  const double *m = matrix->m;
  return m[1] == 0 && m[3] == 0 && m[6] == 0 && m[7] == 0;
}

/* Whether an upright object paints all of its bounds, and lets no light from behind through. */
static bool hides(const celspan_object *object) {
  const cs_primitive_data *data = object->data;
  const celspan_texture *texture = data->texture;
  return can_go(data) && data->is_box && object->fade == 1 && texture->kind == CS_TEXTURE_FLAT &&
         texture->flat.t[0] == 0 && texture->flat.t[1] == 0 && texture->flat.t[2] == 0;
}

/* Whether the object lies behind the objects that cover its tiles; if not, it covers the tiles
 * inside it. */
static bool is_behind(tiles *t, const celspan_object *object, const celspan_matrix *parent) {
  const cs_primitive_data *data = object->data;
  cs_boundary_frame box;
  if (!can_go(data))
    return false;
  celspan_matrix whole = celspan_matrix_then(*object->matrix, *parent);
  celspan_matrix matrix = cs_matrix_facing(&whole);
  if (!cs_boundary_around_box(&data->bounds, &matrix, &box))
    return false;
  const range touched = tiles_touched(t, &box), inside = tiles_inside(t, &box);
  if (is_covered(t, &touched))
    return true;
  if (hides(object) && is_upright(&matrix))
    cover(t, &inside);
  return false;
}

celspan_status cs_unseen_find(const cs_compiler *c, celspan_object *const *objects, size_t count,
                              const celspan_matrix *matrix, cs_unseen *out) {
  tiles t;
  *out = (cs_unseen){NULL, count};
  while (count > 0 && !hides(objects[count - 1])) /* none in front of these hides */
    count--;
  if (out->count < OBJECTS_LEAST || count == 0 || c->fades_out)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(c->context, out->bits, out->count / 64 + 1));
  begin(&t, &c->frame);
  for (size_t i = count; i-- > 0;)
    if (is_behind(&t, objects[i], matrix))
      out->bits[i / 64] |= (uint64_t)1 << (i % 64);
  return CELSPAN_OK;
}

void cs_unseen_finish(cs_unseen *list, cs_memory *memory) {
  if (list->bits)
    cs_mem_free(memory, list->bits, (list->count / 64 + 1) * sizeof *list->bits);
  *list = (cs_unseen){0};
}
