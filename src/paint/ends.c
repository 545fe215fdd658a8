#include "paint/ends.h"

#include "base/number.h"
#include "base/sort.h"
#include "paint/gradient_table.h"

typedef struct finder {
  cs_painter *painter;
  const cs_program *program;
  cs_run run;
  cs_arena *arena;
} finder;

/* ---------------------------------------------------------------- breaks of one layer */

static size_t procedure_breaks(const cs_procedure_span *span, cs_run run, double *out) {
  size_t count = 0;
  for (size_t i = 1; i + 1 < span->paint_count; i++) {
    double u = (double)i / (double)(span->paint_count - 1);
    double x = span->x0 + u * (span->x1 - span->x0);
    if (x > run.x0 && x < run.x1)
      out[count++] = x;
  }
  return count;
}

static size_t break_limit(const finder *f, cs_item item) {
  const cs_stack *stack = f->painter->stack;
  const cs_layer *layer = &stack->layers[item.layer];
  switch ((cs_layer_kind)layer->kind) {
  case CS_LAYER_SHADED:
    return cs_shade_break_limit(&stack->shades[layer->index]);
  case CS_LAYER_SCANLINE:
    return f->program->procedure_spans[item.procedure_span].paint_count;
  case CS_LAYER_DEFOCUSED:
    return cs_defocused_break_limit(stack->defocused[layer->index]);
  case CS_LAYER_PICTURE:
    return cs_sampler_texel_edge_limit(&f->painter->images[layer->index].sampler, f->run);
  case CS_LAYER_FLAT:
    break;
  }
  return 0;
}

/* Where a formula bends inside the run, in any order. */
static celspan_status find_breaks(const finder *f, cs_item item, double *out, size_t *count) {
  const cs_stack *stack = f->painter->stack;
  const cs_layer *layer = &stack->layers[item.layer];
  *count = 0;
  if (layer->kind == CS_LAYER_SHADED) {
    *count = cs_shade_breaks(&stack->shades[layer->index], f->run, out);
  } else if (layer->kind == CS_LAYER_SCANLINE) {
    *count = procedure_breaks(&f->program->procedure_spans[item.procedure_span], f->run, out);
  } else if (layer->kind == CS_LAYER_DEFOCUSED) {
    const cs_defocused *defocused = stack->defocused[layer->index];
    cs_defocused_view *view = &f->painter->defocused[layer->index];
    CS_TRY(cs_defocused_move(defocused, f->painter->context, view, f->run.y));
    *count = cs_defocused_breaks(defocused, view, f->run, out);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the columns of all */

/* Merges the last `count` columns, which ascend, with those before. */
static void merge(cs_ends *list, size_t count) {
  size_t before = list->count, i = 0, j = before, end = before + count;
  list->count = end;
  if (before == 0 || count == 0 || list->columns[before - 1] <= list->columns[before])
    return;
  for (size_t k = 0; k < end; k++)
    list->other[k] = j == end || (i < before && list->columns[i] <= list->columns[j])
                         ? list->columns[i++]
                         : list->columns[j++];
  int32_t *merged = list->other;
  list->other = list->columns;
  list->columns = merged;
}

static inline bool is_before(const int32_t *a, const int32_t *b) { return *a < *b; }

CS_SORT_DEFINE(sort_columns, int32_t, is_before)

static celspan_status add_formula(const finder *f, cs_item item, cs_ends *list) {
  size_t count;
  double *breaks =
      cs_arena_take(f->painter->context, f->arena, break_limit(f, item) * sizeof *breaks);
  int32_t *columns = list->columns + list->count;
  if (!breaks)
    return CELSPAN_NO_MEMORY;
  CS_TRY(find_breaks(f, item, breaks, &count));
  for (size_t i = 0; i < count; i++)
    columns[i] = cs_number_first_centre(breaks[i]);
  sort_columns(columns, count);
  merge(list, count);
  return CELSPAN_OK;
}

static celspan_status add_item(const finder *f, cs_item item, cs_ends *list) {
  const cs_layer *layer = &f->painter->stack->layers[item.layer];
  if (layer->kind == CS_LAYER_FLAT)
    return CELSPAN_OK;
  if (layer->kind == CS_LAYER_SHADED &&
      cs_gradient_table_is_one_section(&f->painter->stack->shades[layer->index], f->run.x0 + 0.5,
                                       f->run.x1 - 0.5, f->run.y))
    return CELSPAN_OK;
  if (layer->kind != CS_LAYER_PICTURE)
    return add_formula(f, item, list);
  merge(list, cs_sampler_texel_edges(&f->painter->images[layer->index].sampler, f->run,
                                     list->columns + list->count));
  return CELSPAN_OK;
}

static celspan_status make_room(const finder *f, cs_ends *out) {
  size_t limit = 2;
  for (uint32_t i = 0; i < f->program->length; i++)
    limit += break_limit(f, f->program->items[i]);
  out->count = 0;
  out->columns = cs_arena_take(f->painter->context, f->arena, limit * sizeof(int32_t));
  out->other = cs_arena_take(f->painter->context, f->arena, limit * sizeof(int32_t));
  return out->columns && out->other ? CELSPAN_OK : CELSPAN_NO_MEMORY;
}

celspan_status cs_ends_find(cs_painter *painter, const cs_program *program, cs_run run, cs_row *row,
                            cs_ends *out) {
  finder f = {painter, program, run, &row->colours};
  CS_TRY(make_room(&f, out));
  for (uint32_t i = 0; i < program->length; i++)
    CS_TRY(add_item(&f, program->items[i], out));
  size_t kept = 1;
  out->other[0] = run.x0;
  for (size_t i = 0; i < out->count; i++)
    if (out->columns[i] > out->other[kept - 1] && out->columns[i] < run.x1)
      out->other[kept++] = out->columns[i];
  out->other[kept++] = run.x1;
  out->columns = out->other;
  out->count = kept;
  return CELSPAN_OK;
}
