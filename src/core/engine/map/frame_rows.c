/* One file, because every row calls it, and its steps are inlined into one another. */
#include "engine/map/frame_rows.h"

#include "base/self_check.h"
#include "engine/map/reading.h"
#include "engine/paint/over_row.h"
#include "engine/paint/run.h"

/* ---------------------------------------------------------------- life */

/* Whether a sheet may change a fold where its drawing is clear. */
static bool has_back(const cs_map_sheet *sheet) {
  return sheet->plan || sheet->drawing.through || sheet->keep != 1 ||
         !cs_v4_same(sheet->back, cs_v4_all(0));
}

celspan_status cs_map_maker_init(cs_map_maker *maker, celspan_context *context,
                                 const cs_map_frame *frame) {
  *maker = (cs_map_maker){.context = context, .frame = frame, .row = -1};
  CS_TRY(cs_map_sums_init(context, frame->width, &maker->sums));
  CS_TRY(CS_ARRAY_MAKE(context, maker->rows, frame->count));
  CS_TRY(CS_ARRAY_MAKE(context, maker->brushes, frame->count));
  CS_TRY(CS_ARRAY_MAKE(context, maker->swept, frame->count));
  for (size_t i = 0; i < frame->count; i++) {
    const cs_map_sheet *sheet = &frame->sheets[i];
    const cs_map_drawing *drawing = sheet->plan ? &maker->swept[i].drawing : &sheet->drawing;
    if (sheet->plan)
      CS_TRY(cs_map_swept_init(&maker->swept[i], context, sheet->plan));
    maker->rows[i] = (cs_map_rows){
        .drawing = drawing, .brush = &maker->brushes[i], .row = -1, .has_back = has_back(sheet)};
    CS_TRY(cs_map_brush_init(&maker->brushes[i], context, drawing));
    maker->varies |= drawing->stack.layer_count > 0 || drawing->through;
  }
  return CELSPAN_OK;
}

void cs_map_maker_finish(cs_map_maker *maker) {
  if (!maker->context)
    return;
  cs_memory *memory = maker->context->memory;
  for (size_t i = 0; maker->rows && i < maker->frame->count; i++)
    cs_map_rows_finish(&maker->rows[i], memory);
  for (size_t i = 0; maker->brushes && i < maker->frame->count; i++)
    cs_map_brush_finish(&maker->brushes[i]);
  for (size_t i = 0; maker->swept && i < maker->frame->count; i++)
    cs_map_swept_finish(&maker->swept[i]);
  CS_ARRAYS_FREE(memory, maker, rows, swept);
  cs_row_finish(&maker->painted, memory);
  cs_map_sums_finish(&maker->sums, memory);
  cs_map_exact_finish(&maker->exact, memory);
  *maker = (cs_map_maker){0};
}

uint64_t cs_map_maker_evaluations(const cs_map_maker *maker) {
  uint64_t evaluations = 0;
  for (size_t i = 0; maker->brushes && i < maker->frame->count; i++)
    evaluations += maker->brushes[i].painter.evaluations;
  for (size_t i = 0; maker->swept && i < maker->frame->count; i++)
    evaluations += maker->swept[i].maker.composer.evaluations;
  return evaluations;
}

/* ---------------------------------------------------------------- which rows */

/* Pixels of a raster by which rounding may move a place. */
#define NEAR 0.5

static bool has_zones(const cs_map_sheet *sheet, int32_t row) {
  const cs_map *map = sheet->drawing.map;
  const double *m = sheet->drawing.to_raster.m;
  int32_t first, end;
  uint64_t missing = 0;
  if (sheet->plan)
    return true;
  cs_map_find_zones(map, row * m[4] + m[5] - NEAR, (row + CS_MAP_ROWS) * m[4] + m[5] + NEAR, &first,
                    &end);
  for (int32_t zone = first; zone < end; zone++)
    missing |= map->missing >> zone & 1;
  return missing == 0;
}

bool cs_map_frame_has(const cs_map_frame *frame, int32_t y) {
  bool has = true;
  for (size_t i = 0; has && i < frame->count; i++)
    has = has_zones(&frame->sheets[i], cs_map_swath(y));
  return has;
}

/* ---------------------------------------------------------------- a row */

/* Whether nothing can be seen behind the last of the sheets that are shown. */
static bool is_rearmost(const cs_map_folding *f, const cs_map_fold *fold) {
  const cs_map_frame *frame = f->maker->frame;
  size_t last = f->shown_count - 1;
  bool has_backing = last + 1 < frame->count || frame->keep * fold->keep != 1 ||
                     !cs_v4_same(frame->sheets[last].back + frame->back, cs_v4_all(0));
  return !has_backing || cs_map_folding_hides(f->maker->rows[last].drawing, f->at[last]);
}

/* Whether only one cell is visible, with nothing in front of it. */
static bool is_bare(const cs_map_folding *f, const cs_map_folded *all) {
  size_t last = f->shown_count - 1;
  const cs_map_span *span = f->at[last];
  return all->varied == 1 && span->share_count > 0 && span->cell != CS_MAP_BROKEN &&
         is_rearmost(f, &all->fold) && cs_map_brush_is_bare(f->maker->rows[last].drawing) &&
         cs_v4_same(all->fold.t, cs_v4_all(1)) && cs_v4_same(all->fold.e, cs_v4_all(0));
}

/* Paints a cell of a sheet as a run. */
static celspan_status paint_run(cs_map_folding *f, size_t i, int32_t x, int32_t end, cs_row *out) {
  cs_map_brush *brush = f->maker->rows[i].brush;
  cs_program program = cs_map_brush_program(brush->drawing, f->at[i]->cell);
  return cs_painter_run_program(&brush->painter, &program, (cs_run){x, end, f->y + 0.5}, out);
}

/* ---------------------------------------------------------------- one that varies among flats */

/* If one sheet varies in a pixel, the pixel's colour is an affine function of the colour c of this
 * sheet: base + scale * c + cover * the alpha of c. */
typedef struct affine {
  cs_v4 base, scale, cover;
} affine;

/* The colour of the frame where the sheet that varies has this colour. */
static cs_v4 fold_with(const cs_map_folding *f, size_t varied, cs_v4 colour) {
  const cs_map_frame *frame = f->maker->frame;
  cs_map_fold fold = f->before[varied].fold;
  cs_map_fold_add(&fold, &frame->sheets[varied], colour, cs_map_even(colour));
  for (size_t i = varied + 1; i < f->shown_count; i++)
    cs_map_fold_add(&fold, &frame->sheets[i], f->at[i]->colour,
                    cs_map_folding_through(f, i, f->at[i]));
  return cs_map_fold_end(fold, frame);
}

static affine find_affine(const cs_map_folding *f, size_t varied) {
  cs_v4 light = f->maker->rows[varied].drawing->light;
  cs_v4 base = fold_with(f, varied, cs_v4_all(0));
  cs_v4 covered = fold_with(f, varied, (cs_v4){0, 0, 0, light[3]});
  cs_v4 scale = f->before[varied].fold.t * light;
  scale[3] = 0;
  return (affine){base, scale, covered - base};
}

static cs_v4 slope_through(const affine *p, cs_v4 slope) {
  return p->scale * slope + p->cover * slope[3];
}

static celspan_status put_array(const cs_map_maker *maker, const affine *p,
                                const celspan_span *span, cs_row *out) {
  float *colours;
  CS_TRY(cs_row_array(maker->context, out, span->x0, span->x1, &colours));
  for (size_t k = 0; k < (size_t)(span->x1 - span->x0); k++)
    cs_v4_store(colours + 4 * k, p->base + slope_through(p, cs_v4_load(span->array + 4 * k)));
  return CELSPAN_OK;
}

/* Appends a span as it is seen through the sheets in front of it and over the sheets behind it. */
static celspan_status put_through(const cs_map_maker *maker, const affine *p,
                                  const celspan_span *span, cs_row *out) {
  if (span->kind == CELSPAN_SPAN_ARRAY)
    return put_array(maker, p, span, out);
  cs_v4 colour = p->base + slope_through(p, cs_v4_load(span->colour));
  if (span->kind == CELSPAN_SPAN_SINGLE)
    return cs_row_single(maker->context, out, span->x0, span->x1, colour);
  return cs_row_gradient(maker->context, out, span->x0, span->x1, colour,
                         slope_through(p, cs_v4_load(span->slope)));
}

/* The first sheet that varies. */
static size_t first_varied(const cs_map_folding *f) {
  size_t i = 0;
  while (f->before[i + 1].varied == 0)
    i++;
  return i;
}

/* Whether a sheet, the first that varies, is the only one, and its spans can be seen among flat
 * ones. */
static bool varies_alone(const cs_map_folding *f, const cs_map_folded *all, size_t sheet) {
  return all->varied == 1 && f->at[sheet]->cell != CS_MAP_BROKEN &&
         !f->maker->rows[sheet].drawing->grade;
}

/* Whether spans that are seen among flat ones deviate from their curve by at most twice their own
 * error, which is half of the allowed error. */
static bool keeps_error(const affine *p) {
  return !cs_v4_any_above(p->scale, cs_v4_all(1)) && !cs_v4_any_above(p->base, cs_v4_all(1));
}

static celspan_status paint_affine(cs_map_folding *f, const affine *p, size_t varied, int32_t x,
                                   int32_t end, cs_row *out) {
  cs_row *painted = &f->maker->painted;
  cs_row_clear(painted);
  CS_TRY(paint_run(f, varied, x, end, painted));
  for (size_t i = 0; i < painted->count; i++)
    CS_TRY(put_through(f->maker, p, &painted->spans[i], out));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- all that vary */

/* Adds a sheet that varies to the folds of the pixels [x, end). */
static celspan_status add_varied(cs_map_folding *f, size_t i, int32_t x, int32_t end,
                                 cs_map_fold *folds) {
  const cs_map_sheet *sheet = &f->maker->frame->sheets[i];
  const cs_v4 clear = cs_map_folding_clear(f, i);
  cs_v4 colours[CS_OVER_ROW_BATCH];
  CS_TRY(cs_map_folding_colours(f, i, x, end, colours));
  for (int32_t k = 0; k < end - x; k++)
    cs_map_fold_add(&folds[k], sheet, colours[k], clear - cs_v4_all(colours[k][3]));
  return CELSPAN_OK;
}

/* Folds the sheets pixel by pixel, from the first one that varies. */
static celspan_status fold_batch(cs_map_folding *f, size_t varied, int32_t x, int32_t end,
                                 float *out) {
  const cs_map_frame *frame = f->maker->frame;
  cs_map_fold folds[CS_OVER_ROW_BATCH];
  for (int32_t k = 0; k < end - x; k++)
    folds[k] = f->before[varied].fold;
  for (size_t i = varied; i < f->shown_count; i++) {
    if (f->at[i]->share_count > 0) {
      CS_TRY(add_varied(f, i, x, end, folds));
      continue;
    }
    const cs_v4 colour = f->at[i]->colour, through = cs_map_folding_through(f, i, f->at[i]);
    for (int32_t k = 0; k < end - x; k++)
      cs_map_fold_add(&folds[k], &frame->sheets[i], colour, through);
  }
  for (int32_t k = 0; k < end - x; k++)
    cs_v4_store(out + (size_t)4 * (size_t)k, cs_map_fold_end(folds[k], frame));
  return CELSPAN_OK;
}

/* The columns [x, end), in which something varies. */
static celspan_status paint_varied(cs_map_folding *f, const cs_map_folded *all, int32_t x,
                                   int32_t end, cs_row *out) {
  float *colours, one[4];
  if (is_bare(f, all))
    return paint_run(f, f->shown_count - 1, x, end, out);
  const size_t varied = first_varied(f);
  if (end == x + 1) {
    CS_TRY(fold_batch(f, varied, x, end, one));
    return cs_row_single(f->maker->context, out, x, end, cs_v4_load(one));
  }
  if (varies_alone(f, all, varied)) {
    const affine p = find_affine(f, varied);
    if (keeps_error(&p))
      return paint_affine(f, &p, varied, x, end, out);
  }
  CS_TRY(cs_row_array(f->maker->context, out, x, end, &colours));
  for (int32_t next; x < end; colours += (size_t)4 * (size_t)(next - x), x = next) {
    next = end - x < CS_OVER_ROW_BATCH ? end : x + CS_OVER_ROW_BATCH;
    CS_TRY(fold_batch(f, varied, x, next, colours));
  }
  return CELSPAN_OK;
}

static celspan_status make_varied_row(cs_map_folding *f, cs_row *out) {
  const cs_map_maker *maker = f->maker;
  int32_t width = maker->frame->width;
  for (int32_t x = 0, end; x < width; x = end) {
    const cs_map_folded all = cs_map_fold_sheets(f, x, maker->frame->count, true);
    cs_v4 colour = cs_map_fold_end(all.fold, maker->frame);
    end = all.broken > 1 ? x + 1 : all.end;
    if (all.broken > 1)
      CS_TRY(cs_map_folding_solve(f, x, all.broken, &colour));
    if (all.broken <= 1 && all.varied > 0)
      CS_TRY(paint_varied(f, &all, x, end, out));
    else
      CS_TRY(cs_row_single(maker->context, out, x, end, colour));
  }
  return CELSPAN_OK;
}

static celspan_status make_row(cs_map_folding *f, cs_row *out) {
  const cs_map_maker *maker = f->maker;
  for (size_t i = 0; i < maker->frame->count; i++)
    f->at[i] = maker->rows[i].spans + maker->rows[i].first[f->y - maker->row];
  f->before[0] = (cs_map_folded){.fold = cs_map_fold_begin, .end = maker->frame->width};
  f->shown_count = 0;
  return maker->varies || maker->frame->count == 0
             ? make_varied_row(f, out)
             : CS_WIDE_CHOOSE(maker->sums.isa, cs_map_fold_flat)(f, out);
}

static celspan_status make_swath(cs_map_maker *maker, int32_t row) {
  maker->row = -1;
  for (size_t i = 0; i < maker->frame->count; i++) {
    if (maker->frame->sheets[i].plan) {
      CS_TRY(cs_map_swept_sweep(&maker->swept[i], row));
      maker->rows[i].row = -1; /* because its borders are new */
    }
    CS_TRY(cs_map_rows_make(maker->context, &maker->sums, &maker->rows[i], row));
  }
  maker->row = row;
  return CELSPAN_OK;
}

/* A row of a frame of one sheet, in which nothing varies: it is read from the sums at once. */
static celspan_status make_alone(cs_map_maker *maker, int32_t y, cs_row *out) {
  cs_map_sums *sums = &maker->sums;
  cs_map_rows *rows = &maker->rows[0];
  const uint32_t k = (uint32_t)(y % CS_MAP_ROWS);
  if (rows->row != cs_map_swath(y) || !(sums->unread >> k & 1))
    CS_TRY(cs_map_rows_sum(maker->context, sums, rows, cs_map_swath(y)));
  CS_TRY(cs_row_room(maker->context, out, (size_t)sums->width));
  CS_WIDE_CHOOSE(sums->isa, cs_map_read_alone)(sums, rows, maker->frame, k, out);
  sums->unread &= ~(1U << k);
  CS_SELF_CHECK(cs_row_is_whole(out, sums->width));
  return CELSPAN_OK;
}

celspan_status cs_map_maker_row(cs_map_maker *maker, int32_t y, cs_row *out) {
  cs_map_folding f;
  f.maker = maker;
  f.y = y;
  int32_t row = cs_map_swath(y);
  cs_row_clear(out);
  if (maker->frame->count == 1 && !maker->varies && !maker->frame->sheets[0].plan)
    return make_alone(maker, y, out);
  if (row != maker->row)
    CS_TRY(make_swath(maker, row));
  cs_map_exact_clear(&maker->exact);
  CS_TRY(make_row(&f, out));
  CS_SELF_CHECK(cs_row_is_whole(out, maker->frame->width));
  return CELSPAN_OK;
}
