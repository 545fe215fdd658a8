#include "readers/layered/layer_surface.h"

#include <pthread.h>
#include <string.h>

#include "base/hash.h"
#include "model/pictures/surface.h"

typedef struct reading {
  cs_memory *memory; /* the surface's */
  pthread_mutex_t lock;
  char *path;
  cs_input input;
  cs_rows_source *source;
  cs_profile_table *table; /* a reference; NULL: codes are not converted */
  cs_rows *rows;           /* NULL: not begun */
  int32_t next;            /* the row that comes next */
  unsigned char *row;      /* while begun */
} reading;

/* ---------------------------------------------------------------- rows */

static void stop(reading *r) {
  if (!r->rows)
    return;
  r->source->kind->end(r->rows);
  cs_mem_free(r->memory, r->row, cs_rows_size(r->source));
  r->rows = NULL;
  r->row = NULL;
  r->next = 0;
}

static celspan_status start(reading *r, celspan_context *context) {
  r->row = cs_mem_resize(r->memory, NULL, 0, cs_rows_size(r->source));
  celspan_status status = r->row ? CELSPAN_OK : cs_fail_memory(context);
  if (status == CELSPAN_OK)
    status = r->source->kind->begin(r->source, context, &r->input, &r->rows);
  if (status != CELSPAN_OK) {
    cs_mem_free(r->memory, r->row, cs_rows_size(r->source));
    r->row = NULL;
  }
  return status;
}

static celspan_status next_row(reading *r, celspan_context *context) {
  r->next++;
  return r->source->kind->next(r->rows, context, r->row);
}

/* Columns of the row that was read last, in the surface's format. */
static void put_columns(const reading *r, const celspan_rectangle *rectangle, unsigned char *out) {
  size_t pixel = 4 * (size_t)(r->source->bits / 8), count = (size_t)rectangle->width;
  const unsigned char *from = r->row + (size_t)rectangle->x * pixel;
  if (r->table)
    cs_profile_table_convert(r->table, r->source->bits, from, count, (float *)(void *)out);
  else
    memcpy(out, from, count * pixel);
}

static celspan_status read_rows(reading *r, celspan_context *context,
                                const celspan_rectangle *rectangle, unsigned char *destination,
                                size_t stride) {
  if (r->rows && r->next > rectangle->y)
    stop(r);
  if (!r->rows)
    CS_TRY(start(r, context));
  while (r->next < rectangle->y)
    CS_TRY(next_row(r, context));
  for (int32_t i = 0; i < rectangle->height; i++) {
    CS_TRY(next_row(r, context));
    put_columns(r, rectangle, destination + (size_t)i * stride);
  }
  return CELSPAN_OK;
}

static celspan_status read_rectangle(reading *r, celspan_context *context,
                                     const celspan_rectangle *rectangle, void *destination,
                                     size_t stride) {
  CS_TRY(cs_input_open(context, &r->input));
  celspan_status status = read_rows(r, context, rectangle, destination, stride);
  if (status != CELSPAN_OK || r->next == r->source->height)
    stop(r);
  cs_input_close(&r->input);
  return status;
}

/* The state from one call to the next lies in the surface's memory, whatever context asks. */
static celspan_status fill(void *user, celspan_context *context, const celspan_rectangle *rectangle,
                           void *destination, size_t stride, int32_t *rows) {
  reading *r = user;
  celspan_context own;
  cs_context_branch(&own, context);
  own.memory = r->memory;
  pthread_mutex_lock(&r->lock);
  celspan_status status = read_rectangle(r, &own, rectangle, destination, stride);
  pthread_mutex_unlock(&r->lock);
  *rows = status == CELSPAN_OK ? rectangle->height : 0;
  return status == CELSPAN_OK ? status : cs_fail(context, status, "%s", own.error);
}

/* ---------------------------------------------------------------- life */

static void free_reading(reading *r) {
  stop(r);
  r->source->kind->destroy(r->source);
  cs_profile_table_unref(r->table);
  cs_mem_free(r->memory, r->path, r->path ? strlen(r->path) + 1 : 0);
  cs_mem_free(r->memory, r, sizeof *r);
}

static void release(void *user) {
  reading *r = user;
  pthread_mutex_destroy(&r->lock);
  free_reading(r);
}

static celspan_status create_reading(celspan_context *context, const cs_input *input,
                                     cs_rows_source *source, cs_profile_table *table,
                                     reading **out) {
  reading *r = cs_mem_array(context->memory, 1, sizeof *r);
  if (!r) {
    source->kind->destroy(source);
    return cs_fail_memory(context);
  }
  *r = (reading){.memory = context->memory, .source = source, .input = *input};
  r->table = table ? cs_profile_table_ref(table) : NULL;
  r->path = cs_mem_resize(r->memory, NULL, 0, strlen(input->path) + 1);
  if (!r->path) {
    free_reading(r);
    return cs_fail_memory(context);
  }
  strcpy(r->path, input->path);
  r->input.path = r->path;
  *out = r;
  return CELSPAN_OK;
}

static cs_hash key_of(const reading *r, size_t index) {
  cs_hash hash = cs_hash_begin(0x6c617972u);
  cs_hash_text(&hash, r->path);
  cs_hash_word(&hash, (uint64_t)r->input.size);
  cs_hash_word(&hash, (uint64_t)r->input.time);
  cs_hash_word(&hash, (uint64_t)index);
  return cs_hash_end(hash);
}

celspan_status cs_layer_surface_create(celspan_context *context, const cs_input *input,
                                       size_t index, cs_rows_source *source,
                                       cs_profile_table *table, celspan_surface **out) {
  reading *r = NULL;
  CS_TRY(create_reading(context, input, source, table, &r));
  cs_hash key = key_of(r, index);
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  desc.width = source->width;
  desc.height = source->height;
  desc.format = table                ? CELSPAN_SURFACE_RGBAF
                : source->bits == 16 ? CELSPAN_SURFACE_RGBA16
                                     : CELSPAN_SURFACE_RGBA8;
  desc.alpha = CELSPAN_ALPHA_STRAIGHT;
  desc.fill = fill;
  desc.user = r;
  desc.release = release;
  desc.any_thread = true;
  desc.has_key = true;
  desc.key[0] = key.a;
  desc.key[1] = key.b;
  pthread_mutex_init(&r->lock, NULL);
  celspan_status status = cs_surface_create_reader(context, &desc, out);
  if (status != CELSPAN_OK)
    release(r);
  return status;
}
