/* One tile: cut, hashed, linked or written. */
#include "cli/tiles/file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/context.h"
#include "output/pixels.h"
#include "output/sink.h"

enum { PATH_SIZE = 4096, KNOWN_LEAST = 1024 };

/* ---------------------------------------------------------------- tiles written before */

void cs_tile_file_init(cs_tile_file *files, celspan_context *context, const cs_pyramid *pyramid,
                       const celspan_file_desc *file) {
  *files = (cs_tile_file){.context = context, .pyramid = pyramid, .file = *file};
  files->file.coding = cs_pixels_resolve(&file->coding, CELSPAN_DEPTH_8);
  pthread_mutex_init(&files->mutex, NULL);
}

void cs_tile_file_finish(cs_tile_file *files) {
  cs_mem_free(files->context->memory, files->known, files->known_capacity * sizeof *files->known);
  pthread_mutex_destroy(&files->mutex);
}

void cs_tile_file_skip(cs_tile_file *files, const float rgba[4]) {
  files->skips_empty = true;
  cs_pixels_code(&files->file.coding, rgba, files->empty);
}

/* The place of a hash, or the free one where it belongs. */
static cs_known_tile *place_of(cs_known_tile *known, size_t capacity, cs_hash hash) {
  size_t i = (size_t)hash.a & (capacity - 1);
  while ((known[i].hash.a || known[i].hash.b) &&
         (known[i].hash.a != hash.a || known[i].hash.b != hash.b))
    i = (i + 1) & (capacity - 1);
  return &known[i];
}

static celspan_status grow(cs_tile_file *files, celspan_context *context) {
  size_t capacity = files->known_capacity ? 2 * files->known_capacity : KNOWN_LEAST;
  cs_known_tile *known = cs_mem_array(context->memory, capacity, sizeof *known);
  if (!known)
    return cs_fail_memory(context);
  for (size_t i = 0; i < files->known_capacity; i++)
    if (files->known[i].hash.a || files->known[i].hash.b)
      *place_of(known, capacity, files->known[i].hash) = files->known[i];
  cs_mem_free(context->memory, files->known, files->known_capacity * sizeof *known);
  files->known = known;
  files->known_capacity = capacity;
  return CELSPAN_OK;
}

static bool find(cs_tile_file *files, cs_hash hash, cs_known_tile *out) {
  pthread_mutex_lock(&files->mutex);
  const cs_known_tile *place =
      files->known ? place_of(files->known, files->known_capacity, hash) : NULL;
  bool is_found = place && (place->hash.a || place->hash.b);
  if (is_found)
    *out = *place;
  pthread_mutex_unlock(&files->mutex);
  return is_found;
}

static celspan_status remember(cs_tile_file *files, celspan_context *context, cs_known_tile tile) {
  celspan_status status = CELSPAN_OK;
  pthread_mutex_lock(&files->mutex);
  if (2 * files->known_count >= files->known_capacity)
    status = grow(files, context);
  if (status == CELSPAN_OK) {
    cs_known_tile *place = place_of(files->known, files->known_capacity, tile.hash);
    files->known_count += !(place->hash.a || place->hash.b);
    *place = tile;
  }
  pthread_mutex_unlock(&files->mutex);
  return status;
}

static void add_one(cs_tile_file *files, uint64_t *count) {
  pthread_mutex_lock(&files->mutex);
  ++*count;
  pthread_mutex_unlock(&files->mutex);
}

/* ---------------------------------------------------------------- links */

/* Makes the folders that a path names, one after the other. */
static bool make_folders(char *path) {
  for (char *slash = path + 1; (slash = strchr(slash, '/')); slash++) {
    *slash = '\0';
    int result = mkdir(path, 0777);
    *slash = '/';
    if (result != 0 && errno != EEXIST)
      return false;
  }
  return true;
}

/* Links through a name of its own, because a link cannot replace what is there. false: this file
 * system or this file takes no (more) links, so that the tile is to be written. */
static bool link_file(const char *from, char *to) {
  char temporary[PATH_SIZE + 16];
  snprintf(temporary, sizeof temporary, "%s.link.part", to);
  unlink(temporary);
  bool is_linked = link(from, temporary) == 0;
  if (!is_linked && errno == ENOENT && make_folders(to))
    is_linked = link(from, temporary) == 0;
  is_linked = is_linked && rename(temporary, to) == 0;
  unlink(temporary); /* still there when both were one file already */
  return is_linked;
}

static bool link_to(const cs_pyramid *pyramid, const cs_known_tile *known, char *path) {
  char from[PATH_SIZE];
  return cs_pyramid_path(pyramid, known->level, known->column, known->row, false, from,
                         sizeof from) &&
         (strcmp(from, path) == 0 || link_file(from, path));
}

/* ---------------------------------------------------------------- one row of one tile */

void cs_tile_writer_init(cs_tile_writer *writer, cs_tile_file *files, cs_tile_source source) {
  *writer = (cs_tile_writer){.files = files, .source = source};
  cs_context_branch(&writer->context, files->context);
}

void cs_tile_writer_finish(cs_tile_writer *writer) {
  cs_memory *memory = writer->context.memory;
  cs_mem_free(memory, writer->starts, writer->start_capacity * sizeof *writer->starts);
  cs_mem_free(memory, writer->spans, writer->span_capacity * sizeof *writer->spans);
  cs_mem_free(memory, writer->pixels, writer->pixel_capacity);
}

celspan_status cs_tile_writer_begin(cs_tile_writer *writer, int32_t rows) {
  CS_TRY(cs_mem_reserve(&writer->context, (void **)&writer->starts, &writer->start_capacity,
                        (size_t)rows, sizeof *writer->starts));
  memset(writer->starts, 0, (size_t)rows * sizeof *writer->starts);
  return CELSPAN_OK;
}

static celspan_span cut_span(celspan_span span, int32_t x0, int32_t x1) {
  int32_t from = span.x0 > x0 ? span.x0 : x0;
  if (span.kind == CELSPAN_SPAN_ARRAY)
    span.array += 4 * (size_t)(from - span.x0);
  span.x0 = from - x0;
  span.x1 = (span.x1 < x1 ? span.x1 : x1) - x0;
  span.origin -= x0;
  return span;
}

/* The tile's part of a row. *start: where the search begins, and where it can begin next time. */
static celspan_status cut_row(cs_tile_writer *writer, const cs_area *area, int32_t y,
                              size_t *out_count) {
  size_t count, kept = 0;
  size_t *start = &writer->starts[y - area->y0];
  const celspan_span *spans = writer->source.row(writer->source.user, y, &count);
  int32_t x0 = area->x0 - writer->source.left, x1 = area->x1 - writer->source.left;
  while (*start < count && spans[*start].x1 <= x0)
    ++*start;
  size_t end = *start;
  while (end < count && spans[end].x0 < x1)
    end++;
  CS_TRY(cs_mem_reserve(&writer->context, (void **)&writer->spans, &writer->span_capacity,
                        end - *start, sizeof *writer->spans));
  for (size_t i = *start; i < end; i++)
    writer->spans[kept++] = cut_span(spans[i], x0, x1);
  *out_count = kept;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- one tile */

typedef struct tile_look {
  cs_hash hash;
  bool is_empty;
} tile_look;

static bool is_all(const unsigned char *row, size_t size, const unsigned char *pixel,
                   size_t pixel_size) {
  return memcmp(row, pixel, pixel_size) == 0 &&
         memcmp(row, row + pixel_size, size - pixel_size) == 0;
}

static celspan_status look_at(cs_tile_writer *writer, const cs_area *area, tile_look *out) {
  const cs_tile_file *files = writer->files;
  const celspan_coding *coding = &files->file.coding;
  size_t pixel_size = celspan_coding_pixel_size(coding);
  size_t size = (size_t)(area->x1 - area->x0) * pixel_size, count;
  CS_TRY(
      cs_mem_reserve(&writer->context, (void **)&writer->pixels, &writer->pixel_capacity, size, 1));
  cs_hash hash = cs_hash_begin((uint64_t)(area->x1 - area->x0));
  out->is_empty = files->skips_empty;
  for (int32_t y = area->y0; y < area->y1; y++) {
    CS_TRY(cut_row(writer, area, y, &count));
    cs_pixels_row(coding, writer->spans, count, writer->pixels);
    cs_hash_bytes(&hash, writer->pixels, size);
    out->is_empty = out->is_empty && is_all(writer->pixels, size, files->empty, pixel_size);
  }
  out->hash = cs_hash_end(hash);
  return CELSPAN_OK;
}

static celspan_status put_rows(cs_tile_writer *writer, const cs_area *area,
                               const celspan_sink *sink) {
  size_t count;
  CS_TRY(sink->begin(sink->user, &writer->context, area->x1 - area->x0, area->y1 - area->y0));
  for (int32_t y = area->y0; y < area->y1; y++) {
    CS_TRY(cut_row(writer, area, y, &count));
    CS_TRY(sink->row(sink->user, &writer->context, y - area->y0, writer->spans, count));
  }
  return CELSPAN_OK;
}

static celspan_status write_tile(cs_tile_writer *writer, const cs_area *area, const char *path) {
  celspan_sink sink;
  CS_TRY(cs_sink_file(&writer->context, path, &writer->files->file, &sink));
  return sink.end(sink.user, &writer->context, put_rows(writer, area, &sink));
}

static celspan_status refuse_path(cs_tile_writer *writer) {
  return cs_fail(&writer->context, CELSPAN_OUTPUT, "%s: the names of its tiles are too long",
                 writer->files->pyramid->folder);
}

static celspan_status put_alias(cs_tile_writer *writer, const cs_area *area,
                                const cs_known_tile *tile) {
  char path[PATH_SIZE];
  const cs_pyramid *pyramid = writer->files->pyramid;
  if (!cs_pyramid_path(pyramid, tile->level, tile->column, tile->row, true, path, sizeof path) ||
      link_to(pyramid, tile, path))
    return CELSPAN_OK;
  return write_tile(writer, area, path);
}

celspan_status cs_tile_writer_put(cs_tile_writer *writer, int32_t level, int32_t column,
                                  int32_t row) {
  cs_tile_file *files = writer->files;
  cs_area tile = {column, row, column + 1, row + 1};
  cs_area area = cs_pyramid_pixels(files->pyramid, level, &tile);
  char path[PATH_SIZE];
  tile_look look;
  cs_known_tile known;
  CS_TRY(look_at(writer, &area, &look));
  if (look.is_empty) {
    add_one(files, &files->counts.skipped);
    return CELSPAN_OK;
  }
  if (!cs_pyramid_path(files->pyramid, level, column, row, false, path, sizeof path))
    return refuse_path(writer);
  cs_known_tile made = {look.hash, level, column, row};
  if (find(files, look.hash, &known) && link_to(files->pyramid, &known, path)) {
    add_one(files, &files->counts.linked);
  } else {
    CS_TRY(write_tile(writer, &area, path));
    CS_TRY(remember(files, &writer->context, made));
    add_one(files, &files->counts.written);
  }
  return put_alias(writer, &area, &made);
}
