/* Programs in which nothing but one gradient varies, folded beforehand.
 *
 *     stops         at 0         at 0.4          at 1          along the gradient
 *                    |             |              |
 *     sections 0     |      1      |      2       |     3      and one more: behind the horizon
 *           constant |  a line from colour to     | constant
 *                    |  colour    |               |
 *
 * Everything that is done to its paint (light, fades, the layers in front and behind) is affine, so
 * the colour of the program is a mix of its colours at two stops. A pixel costs a search among the
 * stops and a mix. Several gradients are folded layer by layer: colours.h.
 *
 * Invariant: a pixel's colour depends on the program and the place alone. One store a painter; its
 * tables are right as long as the stack lives.
 */
#pragma once

#include "base/arena.h"
#include "base/number.h"
#include "base/wide.h"
#include "engine/compose/cell.h"
#include "engine/compose/stack.h"
#include "engine/paint/over_row.h"
#include "engine/paint/shade.h"

/* The section of a gradient from one stop to the next. */
typedef struct cs_gradient_table_section {
  /* premultiplied RGBA at the beginning of the section, and its change until the end */
  cs_v4 colour, step;
  double at, scale; /* its beginning, and 1 / its length; scale and step are 0 before the
                         first stop and after the last */
} cs_gradient_table_section;

typedef struct cs_gradient_table {
  const cs_shade *shade;
  /* before each stop, after the last, and behind the horizon */
  const cs_gradient_table_section *sections;
  cs_set_hash name; /* the name of the program's layers */
} cs_gradient_table;

typedef struct cs_gradient_tables cs_gradient_tables;

/* scratch: borrowed; it is reset whenever a table is made. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_gradient_tables_create(celspan_context *context,
                                                         const cs_stack *stack, cs_isa isa,
                                                         cs_arena *scratch,
                                                         cs_gradient_tables **out);
/* tables: NULL is nothing. */
void cs_gradient_tables_destroy(cs_gradient_tables *tables, cs_memory *memory);

/* *out: the table of a program, valid until the next request; NULL if the program has no table.
 * tables: if NULL, no program has a table. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_gradient_table_find(cs_gradient_tables *tables,
                                                      const cs_program *program,
                                                      const cs_gradient_table **out);

/* The section that a place along the stops belongs to. */
static inline size_t cs_gradient_table_section_at(const cs_shade *shade, double at) {
  return at != at ? shade->texture->variation->stop_count + 1
                  : cs_shade_stretch_stop_after(shade->texture, at);
}

/* How far along a section a place is, 0 to 1; any value where the step of the section is 0. */
static inline float cs_gradient_table_share(double begin, double scale, double at) {
  return (float)cs_number_most(cs_number_least((at - begin) * scale, 1), 0);
}

static inline cs_v4 cs_gradient_table_mix(const cs_gradient_table_section *section, double at) {
  return section->colour + section->step * cs_gradient_table_share(section->at, section->scale, at);
}

/* The colours of the middles of pixels, premultiplied RGBA: each depends on its place alone. */
void cs_gradient_table_colours(const cs_gradient_table *table, const cs_batch *batch,
                               float (*rgba)[4]);

/* Whether all points of a row from x to another lie in one section of a gradient. */
static inline bool cs_gradient_table_is_one_section(const cs_shade *shade, double x, double last,
                                                    double y) {
  return shade->is_affine && shade->texture->kind == CS_TEXTURE_LINEAR && /* at is monotone */
         cs_gradient_table_section_at(shade, cs_shade_at(shade, x, y)) ==
             cs_gradient_table_section_at(shade, cs_shade_at(shade, last, y));
}
