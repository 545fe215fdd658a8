/* Layered paintings: finds the format of a file, and reads its layers. */
#include <pthread.h>
#include <string.h>

#include "celspan/layers.h"
#include "inside/context.h"
#include "inside/description.h"
#include "inside/hash.h"
#include "inside/pictures.h"
#include "readers/layered/document.h"
#include "readers/layered/profile_table.h"
#include "readers/layered/psd.h"
#include "readers/layered/rows.h"

/* ---------------------------------------------------------------- the pixels of a layer */

/* The pixels of a layer as a picture: a surface that reads them from the file when they are seen.
 *
 *   store of pictures --fill rows y..--> begin, or continue --rows--> pixels, or floats by a table
 *
 * The store asks for rows from top to bottom and keeps them within its budget, so a layer is
 * unpacked once. Where it asks for earlier rows, the layer is begun again.
 */

typedef struct reading {
  cs_memory *memory; /* the surface's */
  pthread_mutex_t lock;
  char *path;
  cs_input input;
  cs_rows_source *source;
  cs_profile_table *table; /* a reference; NULL: codes are not converted */
  cs_rows *rows;           /* NULL: reading has not begun */
  int32_t next;            /* the next row */
  unsigned char *row;      /* while begun */
} reading;

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

/* Columns of the row that was read last, converted to the surface's format. */
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

/* The state between two calls is kept in the surface's memory, whatever context asks. */
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

/* ---------------------------------------------------------------- the surface of a layer */

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

/* Owns the source from now on, also on failure. input: in the state in which the painting was read;
 * copied. index: the number of the layer, which distinguishes the surfaces of a file. table:
 * converts the codes; gets one more reference; NULL: codes are not converted. Errors: NO_MEMORY. */
static celspan_status create_surface(celspan_context *context, const cs_input *input, size_t index,
                                     cs_rows_source *source, cs_profile_table *table,
                                     celspan_surface **out) {
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

/* ---------------------------------------------------------------- reading */

static celspan_status read_archive(celspan_context *context, const cs_input *input,
                                   celspan_painting *painting) {
  static const cs_document_format *const formats[] = {&cs_openraster_format, &cs_krita_format};
  cs_zip zip;
  CS_TRY(cs_zip_read(context, input, &zip));
  celspan_status status = CELSPAN_OK;
  bool is_found = false;
  for (size_t i = 0; i < sizeof formats / sizeof *formats && !is_found; i++) {
    is_found = cs_zip_find(&zip, formats[i]->member);
    if (is_found)
      status = cs_document_read(context, input, &zip, formats[i], painting);
  }
  cs_zip_finish(&zip);
  return is_found ? status
                  : cs_input_fail(context, input, -1, CELSPAN_INPUT,
                                  "is a zip archive, but neither an OpenRaster file, which holds "
                                  "stack.xml, nor a Krita document, which holds maindoc.xml");
}

/* Reads the first four bytes; missing bytes are 0. */
static celspan_status read_start(celspan_context *context, const cs_input *input,
                                 unsigned char start[4]) {
  for (int i = 0; i < 4; i++)
    start[i] = 0;
  return cs_input_read(context, input, 0, start, input->size < 4 ? (size_t)input->size : 4);
}

static celspan_status read_format(celspan_context *context, const cs_input *input,
                                  celspan_painting *painting) {
  unsigned char start[4];
  CS_TRY(read_start(context, input, start));
  if (cs_psd_is(start))
    return cs_psd_read(context, input, painting);
  if (start[0] == 'P' && start[1] == 'K')
    return read_archive(context, input, painting);
  return cs_input_fail(context, input, -1, CELSPAN_INPUT,
                       "is not a layered painting; OpenRaster, Krita and Photoshop files are "
                       "read");
}

static void drop_tables(celspan_painting *painting) {
  while (painting->table_count > 0)
    cs_profile_table_unref(painting->tables[--painting->table_count]);
}

/* Gives each layer with pixels its surface. */
static celspan_status make_surfaces(celspan_context *context, const cs_input *input,
                                    celspan_painting *painting) {
  for (size_t i = 0; i < painting->count; i++) {
    cs_contents_layer *layer = &painting->layers[i];
    cs_rows_source *source = layer->source;
    layer->source = NULL;
    if (source)
      CS_TRY(create_surface(context, input, i, source, layer->table, &layer->surface));
  }
  drop_tables(painting);
  return CELSPAN_OK;
}

static celspan_status read_file(celspan_context *context, cs_input *input,
                                celspan_painting *painting) {
  CS_TRY(cs_input_open(context, input));
  celspan_status status = read_format(context, input, painting);
  if (status == CELSPAN_OK)
    status = cs_contents_check_whole(context, input, painting);
  cs_input_close(input);
  return status == CELSPAN_OK ? make_surfaces(context, input, painting) : status;
}

celspan_status celspan_painting_read(celspan_context *context, const char *file,
                                     celspan_painting **out) {
  cs_input input = {.path = file};
  celspan_painting *painting;
  if (!file || !*file)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "painting: file must name a file");
  CS_TRY(cs_contents_create(context, &painting));
  celspan_status status = read_file(context, &input, painting);
  return CS_GIVE(status, painting, celspan_painting_unref, out);
}

/* ---------------------------------------------------------------- life */

static void destroy(celspan_painting *painting) {
  cs_memory *memory = painting->memory;
  for (size_t i = 0; i < painting->count; i++) {
    celspan_surface_unref(painting->layers[i].surface);
    if (painting->layers[i].source)
      painting->layers[i].source->kind->destroy(painting->layers[i].source);
  }
  drop_tables(painting);
  CS_ARRAYS_FREE(memory, painting, layers, keys);
  cs_counted_free(memory, painting, sizeof *painting);
}

CS_COUNTED(celspan_painting)

/* ---------------------------------------------------------------- facts */

void celspan_painting_size(const celspan_painting *painting, int32_t *width, int32_t *height) {
  *width = painting->width;
  *height = painting->height;
}

size_t celspan_painting_layer_count(const celspan_painting *painting) { return painting->count; }

bool celspan_painting_layer_at(const celspan_painting *painting, size_t index,
                               celspan_painting_layer *out) {
  if (index >= painting->count)
    return false;
  const cs_contents_layer *layer = &painting->layers[index];
  bool has_pixels = layer->surface && !layer->is_group;
  const celspan_painting_layer whole = {
      .name = layer->name,
      .blend = layer->blend,
      .parent = layer->parent == CS_CONTENTS_NONE ? painting->count : layer->parent,
      .is_group = layer->is_group,
      .is_visible = layer->is_visible,
      .opacity = layer->opacity,
      .x = has_pixels ? layer->x : 0,
      .y = has_pixels ? layer->y : 0,
      .width = has_pixels ? layer->width : 0,
      .height = has_pixels ? layer->height : 0,
      .surface = has_pixels ? layer->surface : NULL,
      .colour = layer->colour,
  };
  return CS_RESULT(NULL, "painting", celspan_painting_layer, &whole, out) == CELSPAN_OK;
}

size_t celspan_painting_note_count(const celspan_painting *painting) {
  return painting->note_count;
}

const char *celspan_painting_note_at(const celspan_painting *painting, size_t index,
                                     size_t *layer) {
  if (index >= painting->note_count)
    return NULL;
  size_t place = painting->notes[index].layer;
  *layer = place == CS_CONTENTS_NONE ? painting->count : place;
  return painting->notes[index].text;
}

bool celspan_painting_clip(const celspan_painting *painting, double *rate, int32_t *from,
                           int32_t *to) {
  if (painting->rate <= 0)
    return false;
  *rate = painting->rate;
  *from = painting->from;
  *to = painting->to;
  return true;
}

size_t celspan_painting_key_count(const celspan_painting *painting) { return painting->key_count; }

bool celspan_painting_key_at(const celspan_painting *painting, size_t index,
                             celspan_painting_key *out) {
  return index < painting->key_count && CS_RESULT(NULL, "painting", celspan_painting_key,
                                                  &painting->keys[index].fields, out) == CELSPAN_OK;
}
