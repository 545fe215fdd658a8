#include "writers/tiles/rows.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "inside/context.h"
#include "inside/files.h"
#include "inside/sinks.h"
#include "inside/threads.h"
#include "process/interrupt.h"
#include "process/journal.h"

enum {
  PATH_SIZE = 4096,
  SHARE = 8 /* neighbouring tiles that a worker writes, so that it reads spans left to right */
};

/* ---------------------------------------------------------------- known tiles */

static void init_known(cs_tile_known *known) {
  *known = (cs_tile_known){.count = 0};
  pthread_mutex_init(&known->mutex, NULL);
}

static void finish_known(cs_tile_known *known, celspan_context *context) {
  cs_mem_free(context->memory, known->tiles, known->capacity * sizeof *known->tiles);
  cs_hash_table_finish(&known->indices, context);
  pthread_mutex_destroy(&known->mutex);
}

static bool find_known(cs_tile_known *known, cs_hash hash, cs_pyramid_tile *out) {
  size_t index;
  pthread_mutex_lock(&known->mutex);
  bool is_found = cs_hash_table_find(&known->indices, hash, &index);
  if (is_found)
    *out = known->tiles[index];
  pthread_mutex_unlock(&known->mutex);
  return is_found;
}

/* The mutex is held. */
static celspan_status add_locked(cs_tile_known *known, celspan_context *context, cs_hash hash,
                                 cs_pyramid_tile tile) {
  CS_TRY(CS_RESERVE(context, known->tiles, known->capacity, known->count + 1));
  CS_TRY(cs_hash_table_add(&known->indices, context, hash, known->count));
  known->tiles[known->count++] = tile;
  return CELSPAN_OK;
}

static celspan_status add_known(cs_tile_known *known, celspan_context *context, cs_hash hash,
                                cs_pyramid_tile tile) {
  pthread_mutex_lock(&known->mutex);
  celspan_status status = add_locked(known, context, hash, tile);
  pthread_mutex_unlock(&known->mutex);
  return status;
}

/* ---------------------------------------------------------------- shared state */

void cs_tile_output_init(cs_tile_output *output, celspan_context *context,
                         const cs_pyramid *pyramid, const celspan_file_desc *file) {
  *output = (cs_tile_output){.context = context, .pyramid = pyramid, .file = *file};
  output->coding = cs_pixels_resolve(file->coding, CELSPAN_DEPTH_8);
  output->file.coding = &output->coding;
  init_known(&output->known);
}

void cs_tile_output_finish(cs_tile_output *output) {
  finish_known(&output->known, output->context);
}

void cs_tile_output_skip(cs_tile_output *output, const float rgba[4]) {
  output->skips_empty = true;
  cs_pixels_code(&output->coding, rgba, output->empty);
}

/* ---------------------------------------------------------------- links */

/* Creates a link under a temporary name and renames it, because a link cannot replace a file.
 * false: the file system has no links, or the file has too many, so that the tile must be
 * written. */
static bool link_file(const char *from, char *to) {
  char temporary[PATH_SIZE + CS_TEMPORARY_EXTRA];
  cs_temporary_name(to, (unsigned)getpid(), temporary, sizeof temporary);
  unlink(temporary);
  bool is_linked = link(from, temporary) == 0;
  if (!is_linked && errno == ENOENT && cs_journal_make_folders(to))
    is_linked = link(from, temporary) == 0;
  is_linked = is_linked && rename(temporary, to) == 0;
  unlink(temporary); /* renaming has no effect when both are the same file already */
  return is_linked;
}

static bool link_to(const cs_pyramid *pyramid, cs_pyramid_tile tile, char *path) {
  char from[PATH_SIZE];
  return cs_pyramid_path(pyramid, tile, false, from, sizeof from) &&
         (strcmp(from, path) == 0 || link_file(from, path));
}

/* ---------------------------------------------------------------- one row of one tile */

static cs_row_queue *queue_of(const cs_tile_rows *rows, int32_t y) {
  return &rows->ring[y % rows->ring_count];
}

/* The state of one thread that writes tiles. */
typedef struct cs_tile_writer {
  celspan_context context; /* a branch */
  const cs_tile_rows *rows;
  cs_tile_output *output;
  CS_ARRAY(size_t, starts);        /* for each row: the first span that overlaps the tile */
  CS_ARRAY(celspan_span, spans);   /* one row, cut to the tile */
  CS_ARRAY(unsigned char, pixels); /* one row */
} cs_tile_writer;

static void init_writer(cs_tile_writer *writer, const cs_tile_rows *rows) {
  *writer = (cs_tile_writer){.rows = rows, .output = rows->output};
  cs_context_branch(&writer->context, rows->output->context);
}

static void finish_writer(cs_tile_writer *writer) {
  CS_ARRAYS_FREE(writer->context.memory, writer, starts, pixels);
}

/* Called before a thread writes tiles of a row from left to right. rows: pixels. */
static celspan_status begin_writer(cs_tile_writer *writer, int32_t rows) {
  CS_TRY(CS_ARRAY_RESERVE(&writer->context, writer->starts, (size_t)rows));
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

/* Cuts the part of the tile out of a row. The search begins at the end of the tile to the left. */
static celspan_status cut_row(cs_tile_writer *writer, const cs_pyramid_box *box, int32_t y,
                              size_t *out_count) {
  const cs_row_queue_row row = cs_row_queue_get(queue_of(writer->rows, y), 0);
  int32_t left = writer->rows->pixels.x0, x0 = box->x0 - left, x1 = box->x1 - left;
  size_t *start = &writer->starts[y - box->y0], kept = 0;
  while (*start < row.count && row.spans[*start].x1 <= x0)
    ++*start;
  size_t end = *start;
  while (end < row.count && row.spans[end].x0 < x1)
    end++;
  CS_TRY(CS_ARRAY_RESERVE(&writer->context, writer->spans, end - *start));
  for (size_t i = *start; i < end; i++)
    writer->spans[kept++] = cut_span(row.spans[i], x0, x1);
  *out_count = kept;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- one tile */

typedef struct tile_content {
  cs_hash hash;
  bool is_empty;
  bool is_plain; /* it has one colour, if an option asks for that: */
  unsigned char pixel[16];
} tile_content;

static bool is_all(const unsigned char *row, size_t size, const unsigned char *pixel,
                   size_t pixel_size) {
  return memcmp(row, pixel, pixel_size) == 0 &&
         memcmp(row, row + pixel_size, size - pixel_size) == 0;
}

static celspan_status read_content(cs_tile_writer *writer, const cs_pyramid_box *box,
                                   tile_content *out) {
  const cs_tile_output *output = writer->output;
  const celspan_coding *coding = &output->coding;
  size_t pixel_size = cs_pixels_size(coding);
  size_t size = (size_t)(box->x1 - box->x0) * pixel_size, count;
  CS_TRY(CS_ARRAY_RESERVE(&writer->context, writer->pixels, size));
  cs_hash hash = cs_hash_begin((uint64_t)(box->x1 - box->x0));
  *out = (tile_content){.is_plain = output->skips_empty || output->is_sparse};
  for (int32_t y = box->y0; y < box->y1; y++) {
    CS_TRY(cut_row(writer, box, y, &count));
    cs_pixels_row(coding, writer->spans, count, writer->pixels);
    cs_hash_bytes(&hash, writer->pixels, size);
    if (y == box->y0)
      memcpy(out->pixel, writer->pixels, pixel_size);
    out->is_plain = out->is_plain && is_all(writer->pixels, size, out->pixel, pixel_size);
  }
  out->is_empty =
      output->skips_empty && out->is_plain && memcmp(out->pixel, output->empty, pixel_size) == 0;
  out->hash = cs_hash_end(hash);
  return CELSPAN_OK;
}

static celspan_status put_rows(cs_tile_writer *writer, const cs_pyramid_box *box,
                               const celspan_sink *sink) {
  size_t count;
  CS_TRY(sink->begin(sink->user, &writer->context, box->x1 - box->x0, box->y1 - box->y0));
  for (int32_t y = box->y0; y < box->y1; y++) {
    CS_TRY(cut_row(writer, box, y, &count));
    CS_TRY(sink->row(sink->user, &writer->context, y - box->y0, writer->spans, count));
  }
  return CELSPAN_OK;
}

static celspan_status write_tile(cs_tile_writer *writer, const cs_pyramid_box *box,
                                 const char *path) {
  celspan_sink sink;
  CS_TRY(cs_sink_file(&writer->context, path, &writer->output->file, &sink));
  return sink.end(sink.user, &writer->context, put_rows(writer, box, &sink));
}

static celspan_status refuse_path(cs_tile_writer *writer) {
  return cs_fail(&writer->context, CELSPAN_OUTPUT, "%.80s...: the names of its tiles are too long",
                 writer->output->pyramid->folder);
}

static celspan_status put_alias(cs_tile_writer *writer, const cs_pyramid_box *box,
                                cs_pyramid_tile tile) {
  char path[PATH_SIZE];
  const cs_pyramid *pyramid = writer->output->pyramid;
  if (!cs_pyramid_path(pyramid, tile, true, path, sizeof path) || link_to(pyramid, tile, path))
    return CELSPAN_OK;
  return write_tile(writer, box, path);
}

/* Of a plain tile: a hash of its place and colour. */
static cs_hash plain_hash(int32_t level, int32_t column, int32_t row, const tile_content *content) {
  cs_hash hash = cs_hash_begin((uint64_t)level);
  cs_hash_word(&hash, (uint64_t)column << 32 | (uint64_t)row);
  cs_hash_bytes(&hash, content->pixel, sizeof content->pixel);
  return cs_hash_end(hash);
}

/* Whether a tile is plain like the coarser tile that it is a part of, with the pixels around that;
 * it is then the same as that one enlarged, and so will be the tiles that are parts of it. */
static celspan_status holds_no_more(cs_tile_writer *writer, cs_pyramid_tile tile,
                                    const tile_content *content, bool *out) {
  cs_tile_known *known = &writer->output->known;
  cs_pyramid_tile coarser;
  *out = false;
  if (!writer->output->is_sparse || !content->is_plain)
    return CELSPAN_OK;
  *out = find_known(known, plain_hash(tile.level - 1, tile.column / 2, tile.row / 2, content),
                    &coarser);
  return add_known(known, &writer->context, plain_hash(tile.level, tile.column, tile.row, content),
                   tile);
}

static celspan_status put_tile(cs_tile_writer *writer, int32_t level, int32_t column, int32_t row) {
  cs_tile_output *output = writer->output;
  cs_pyramid_box tiles = {column, row, column + 1, row + 1};
  cs_pyramid_box box = cs_pyramid_pixels(output->pyramid, level, &tiles);
  char path[PATH_SIZE];
  tile_content content;
  cs_pyramid_tile tile = {level, column, row}, known;
  bool is_left_out;
  CS_TRY(read_content(writer, &box, &content));
  CS_TRY(holds_no_more(writer, tile, &content, &is_left_out));
  if (content.is_empty || is_left_out) {
    output->skipped++;
    return CELSPAN_OK;
  }
  if (!cs_pyramid_path(output->pyramid, tile, false, path, sizeof path))
    return refuse_path(writer);
  if (find_known(&output->known, content.hash, &known) && link_to(output->pyramid, known, path)) {
    output->linked++;
  } else {
    CS_TRY(write_tile(writer, &box, path));
    CS_TRY(add_known(&output->known, &writer->context, content.hash, tile));
    output->written++;
  }
  return put_alias(writer, &box, tile);
}

/* ---------------------------------------------------------------- a row of tiles */

typedef struct tile_row_job {
  cs_tile_rows *rows;
  int32_t row, row_count; /* a row of tiles; its rows of pixels */
  atomic_int failed;      /* 1 + the worker that failed first; 0: none */
  celspan_status status;  /* how that worker ended; its sentence is in its writer's context */
} tile_row_job;

static celspan_status write_share(tile_row_job *job, cs_tile_writer *writer, int32_t first,
                                  int32_t end) {
  CS_TRY(begin_writer(writer, job->row_count));
  for (int32_t column = first; column < end; column++) {
    if (cs_interrupt_signal())
      return CELSPAN_CANCELLED;
    CS_TRY(put_tile(writer, job->rows->level, column, job->row));
  }
  return CELSPAN_OK;
}

static void write_tiles(void *user, int worker, int32_t share) {
  tile_row_job *job = user;
  const cs_pyramid_box *tiles = &job->rows->tiles;
  int32_t first = tiles->x0 + share * SHARE;
  int32_t end = first + SHARE < tiles->x1 ? first + SHARE : tiles->x1;
  int none = 0;
  if (atomic_load(&job->failed))
    return;
  celspan_status status = write_share(job, &job->rows->writers[worker], first, end);
  if (status != CELSPAN_OK && atomic_compare_exchange_strong(&job->failed, &none, worker + 1))
    job->status = status;
}

static celspan_status write_tile_row(cs_tile_rows *rows, celspan_context *context, int32_t row) {
  cs_pyramid_box tiles = {rows->tiles.x0, row, rows->tiles.x1, row + 1};
  cs_pyramid_box pixels = cs_pyramid_pixels(rows->output->pyramid, rows->level, &tiles);
  tile_row_job job = {.rows = rows, .row = row, .row_count = pixels.y1 - pixels.y0};
  cs_thread_pool_run(rows->workers, (tiles.x1 - tiles.x0 + SHARE - 1) / SHARE, write_tiles, &job);
  if (job.status == CELSPAN_OK || job.status == CELSPAN_CANCELLED)
    return job.status;
  return cs_fail(context, job.status, "%s",
                 rows->writers[atomic_load(&job.failed) - 1].context.error);
}

/* ---------------------------------------------------------------- the sink */

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  cs_tile_rows *rows = user;
  const cs_pyramid *pyramid = rows->output->pyramid;
  const cs_pyramid_box *pixels = &rows->pixels;
  if (width != pixels->x1 - pixels->x0 || height != pixels->y1 - pixels->y0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "tiles of %d x %d pixels cannot show %d x %d",
                   pixels->x1 - pixels->x0, pixels->y1 - pixels->y0, width, height);
  rows->ring_count = pyramid->tile + 2 * pyramid->overlap;
  CS_TRY(CS_MAKE(context, rows->ring, (size_t)rows->ring_count));
  CS_TRY(CS_MAKE(context, rows->writers, (size_t)rows->workers));
  for (int i = 0; i < rows->workers; i++)
    init_writer(&rows->writers[i], rows);
  return CELSPAN_OK;
}

/* The last rows of a level can finish several rows of tiles at once. */
static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  cs_tile_rows *rows = user;
  y += rows->pixels.y0;
  cs_row_queue_clear(queue_of(rows, y));
  CS_TRY(cs_row_queue_add_small(context, queue_of(rows, y), spans, span_count));
  while (rows->next < rows->tiles.y1) {
    cs_pyramid_box tiles = {rows->tiles.x0, rows->next, rows->tiles.x1, rows->next + 1};
    if (y + 1 < cs_pyramid_pixels(rows->output->pyramid, rows->level, &tiles).y1)
      break;
    CS_TRY(write_tile_row(rows, context, rows->next));
    CS_TRY(rows->finished(rows->user, context,
                          (cs_tile_row){rows->level, rows->next, tiles.x0, tiles.x1}));
    rows->next++;
  }
  return CELSPAN_OK;
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  cs_tile_rows *rows = user;
  for (int i = 0; rows->writers && i < rows->workers; i++)
    if (rows->writers[i].output)
      finish_writer(&rows->writers[i]);
  for (int32_t i = 0; rows->ring && i < rows->ring_count; i++)
    cs_row_queue_finish(&rows->ring[i], context->memory);
  cs_mem_free(context->memory, rows->ring, (size_t)rows->ring_count * sizeof *rows->ring);
  cs_mem_free(context->memory, rows->writers, (size_t)rows->workers * sizeof *rows->writers);
  rows->ring = NULL;
  rows->writers = NULL;
  return outcome;
}

celspan_sink cs_tile_rows_sink(cs_tile_rows *rows) {
  rows->ring = NULL;
  rows->writers = NULL;
  return (celspan_sink){sizeof(celspan_sink), rows, begin, put_row, end, false};
}
