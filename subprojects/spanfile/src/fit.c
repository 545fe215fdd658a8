#include "fit.h"

#include "pack.h"

/* Pixels of a run or gradient that are rather taken as raw than begin a row of packets. */
enum { SHORT = 32 };

typedef struct fitting {
  const sf_memory *memory;
  spanfile_format format;
  size_t pixel_size;
  sf_row *out;
  const unsigned char *values; /* of what follows in the row */
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

/* The rest of a span of the row, up to its end, as it is. */
static bool keep(fitting *f, const spanfile_span *span) {
  uint32_t length = span->end - sf_row_end(f->out);
  size_t size = f->pixel_size * (span->kind == SPANFILE_RAW ? length : span->kind);
  if (span->kind != SPANFILE_RUN) {
    if (!sf_bytes_add(f->memory, &f->out->values, f->values, size))
      return false;
    f->values += size;
  }
  return sf_row_add(f->memory, f->out, length, span->kind, span->pixel);
}

/* The rest of a run or gradient, or its first `count` pixels, as raw pixels. */
static bool keep_raw(fitting *f, const spanfile_span *span, uint32_t count) {
  unsigned char pixels[SHORT * 8];
  spanfile_row row = {&(spanfile_span){count, span->kind, span->pixel}, 1, f->values};
  spanfile_row_pixels(f->format, &row, 0, count, pixels);
  f->values = span->kind == SPANFILE_GRADIENT ? f->values + 2 * f->pixel_size : f->values;
  return sf_pack_raw(f->memory, f->out, f->pixel_size, pixels, count);
}

sf_fitted sf_fit(const sf_memory *memory, spanfile_format format, const sf_row *row,
                 const sf_row *above, sf_row *out) {
  fitting f = {memory, format, spanfile_pixel_size(format), out, row->values.at};
  const spanfile_span *now = row->spans, *end = now + row->count;
  const spanfile_span *model = above->spans, *model_end = model + above->count;
  bool is_widened = false;
  sf_row_clear(out);
  while (now < end) {
    uint32_t length = now->end - sf_row_end(out);
    bool is_kept, has_model = model < model_end;
    bool after_raw = out->count > 0 && out->spans[out->count - 1].kind == SPANFILE_RAW;
    if (has_model && is_alike(now, model)) {
      is_kept = keep(&f, now++);
      model++;
    } else if (now->kind == SPANFILE_RAW && (after_raw || (now + 1 < end && has_model))) {
      is_widened |= !after_raw;
      is_kept = keep(&f, now++);
    } else if (now->kind == SPANFILE_RUN && length > 1 && has_model && model->kind == SPANFILE_RAW) {
      is_kept = keep_raw(&f, now, 1);
      model++;
    } else if (now->kind != SPANFILE_RAW && length <= SHORT && after_raw) {
      is_kept = keep_raw(&f, now++, length);
    } else {
      return SF_FIT_NONE;
    }
    if (!is_kept)
      return SF_FIT_NO_MEMORY;
  }
  return model < model_end ? SF_FIT_NONE : is_widened ? SF_FIT_WIDENED : SF_FIT_ALIKE;
}
