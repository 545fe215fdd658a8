/* A walk over the spans of the row (`now`) and of the row above (`model`), side by side. Each step
 * appends to `out` a span that agrees with the model, if the pixels allow it. Where they do not,
 * the row continues with its own spans up to a run that both have.
 */
#include "fit.h"

#include "pack.h"

enum {
  SHORT = 32, /* pixels at most of a run or gradient that is turned into raw pixels */
  SIGHT = 8   /* spans of both rows that are searched for a common run */
};

typedef struct fitting {
  const sf_memory *memory;
  spanfile_format format;
  size_t pixel_size;
  sf_row *out;
  const unsigned char *values;            /* the values of the spans from `now` on */
  const spanfile_span *now, *end;         /* of the row: not yet in `out` */
  const spanfile_span *model, *model_end; /* of the row above: not yet matched */
  uint32_t model_start;                   /* the column where `model` begins */
  bool is_changed, has_memory;
} fitting;

static bool is_alike(const spanfile_span *a, const spanfile_span *b) {
  return a->pixel == b->pixel && a->kind == b->kind;
}

bool sf_fit_is_alike(const sf_row *row, const sf_row *above) {
  if (row->count != above->count)
    return false;
  for (size_t i = 0; i < row->count; i++)
    if (!is_alike(&row->spans[i], &above->spans[i]))
      return false;
  return true;
}

/* ---------------------------------------------------------------- keeping spans */

static bool is_after_raw(const fitting *f) {
  return f->out->count > 0 && f->out->spans[f->out->count - 1].kind == SPANFILE_RAW;
}

static uint32_t length_left(const fitting *f) { return f->now->end - sf_row_end(f->out); }

/* Appends the rest of the span unchanged. */
static void keep(fitting *f) {
  const spanfile_span *span = f->now;
  uint32_t length = length_left(f);
  size_t size = f->pixel_size * (span->kind == SPANFILE_RAW ? length : 2);
  if (span->kind != SPANFILE_RUN) {
    f->has_memory &= sf_bytes_add(f->memory, &f->out->values, f->values, size);
    f->values += size;
  }
  f->has_memory &= sf_row_add(f->memory, f->out, length, span->kind, span->pixel);
  f->now++;
}

/* Appends the next `count` pixels of a run, or all of a gradient, as raw pixels. */
static void keep_raw(fitting *f, uint32_t count) {
  unsigned char pixels[SHORT * 8];
  spanfile_span span = {count, f->now->kind, f->now->pixel};
  spanfile_row row = {&span, 1, f->values};
  spanfile_row_pixels(f->format, &row, 0, count, pixels);
  f->has_memory &= sf_pack_raw(f->memory, f->out, f->pixel_size, pixels, count);
  f->values += span.kind == SPANFILE_GRADIENT ? 2 * f->pixel_size : 0;
  f->now += sf_row_end(f->out) == f->now->end;
}

static void pass_model(fitting *f, ptrdiff_t count) {
  f->model += count;
  f->model_start = f->model[-1].end;
}

/* ---------------------------------------------------------------- steps */

/* Whether the row above has raw pixels between two runs of this colour: the edge of something that
 * this row does not cross. */
static bool is_split_above(const fitting *f) {
  const spanfile_span *now = f->now, *model = f->model;
  if (now->kind != SPANFILE_RUN || f->model_end - model < 3 || model[1].kind != SPANFILE_RAW ||
      !is_alike(&model[0], &model[2]) || length_left(f) < 3)
    return false;
  return f->end - now < 3 || now[1].kind != SPANFILE_RAW || !is_alike(now, &now[2]);
}

/* Cuts the run where the row above is cut, or as near to it as possible. */
static void split(fitting *f) {
  uint32_t left = length_left(f), length = f->model->end - f->model_start;
  length = length < left - 2 ? length : left - 2;
  f->has_memory &= sf_row_add(f->memory, f->out, length, SPANFILE_RUN, f->now->pixel);
  keep_raw(f, 1);
  pass_model(f, 2);
}

/* The spans differ: they are kept as they are, up to the nearest run that the row above has too, or
 * to the end of the row. */
static void resume(fitting *f) {
  f->is_changed = true;
  for (ptrdiff_t sum = 1; sum <= SIGHT; sum++)
    for (ptrdiff_t ahead = 0; ahead <= sum; ahead++) {
      const spanfile_span *now = f->now + ahead, *model = f->model + (sum - ahead);
      if (now >= f->end || model >= f->model_end || now->kind != SPANFILE_RUN ||
          !is_alike(now, model))
        continue;
      while (f->now < now)
        keep(f);
      if (sum > ahead)
        pass_model(f, sum - ahead);
      return;
    }
  while (f->now < f->end)
    keep(f);
}

/* Appends this span and those after it that the row above has too. The first may join with the span
 * before it; the others are copied at once. */
static void keep_alike(fitting *f) {
  keep(f);
  pass_model(f, 1);
  const spanfile_span *first = f->now;
  size_t pixels = 0;
  while (f->now < f->end && f->model < f->model_end && is_alike(f->now, f->model) &&
         !is_split_above(f)) {
    if (f->now->kind != SPANFILE_RUN)
      pixels += f->now->kind == SPANFILE_RAW ? f->now->end - f->now[-1].end : 2;
    f->now++;
    pass_model(f, 1);
  }
  size_t count = (size_t)(f->now - first), size = pixels * f->pixel_size;
  while (f->out->capacity - f->out->count < count && f->has_memory)
    f->has_memory &= sf_row_grow(f->memory, f->out);
  f->has_memory &= sf_bytes_add(f->memory, &f->out->values, f->values, size);
  if (!f->has_memory || count == 0)
    return;
  memcpy(f->out->spans + f->out->count, first, count * sizeof *first);
  f->out->count += count;
  f->values += size;
}

static void fit_span(fitting *f) {
  const spanfile_span *now = f->now, *model = f->model < f->model_end ? f->model : NULL;
  if (model && is_alike(now, model) && is_split_above(f)) {
    split(f);
  } else if (model && is_alike(now, model)) {
    keep_alike(f);
  } else if (now->kind == SPANFILE_RAW && is_after_raw(f)) {
    keep(f);
  } else if (model && model->kind == SPANFILE_RAW && now->kind == SPANFILE_RUN &&
             length_left(f) > 1) {
    keep_raw(f, 1);
    pass_model(f, 1);
  } else if (now->kind != SPANFILE_RAW && length_left(f) <= SHORT && is_after_raw(f)) {
    keep_raw(f, length_left(f));
  } else {
    resume(f);
  }
}

/* ---------------------------------------------------------------- a whole row */

/* The approximate number of bytes of its packets. */
static size_t cost(const fitting *f, const sf_row *row) {
  return row->count * (3 + f->pixel_size) + row->values.size;
}

sf_fitted sf_fit(const sf_memory *memory, spanfile_format format, const sf_row *row,
                 const sf_row *above, sf_row *out) {
  fitting f = {.memory = memory,
               .format = format,
               .pixel_size = spanfile_pixel_size(format),
               .out = out,
               .values = sf_bytes_start(&row->values),
               .now = row->spans,
               .end = row->spans + row->count,
               .model = above->spans,
               .model_end = above->spans + above->count,
               .has_memory = true};
  sf_row_clear(out);
  while (f.now < f.end && f.has_memory)
    fit_span(&f);
  if (!f.has_memory)
    return SF_FIT_NO_MEMORY;
  if (!f.is_changed && f.model == f.model_end)
    return SF_FIT_ALIKE;
  return cost(&f, out) <= cost(&f, row) / 4 * 5 ? SF_FIT_NEAR : SF_FIT_NONE;
}
