/* celspan info SCRIPT|FILE: a film, a picture, artwork or a span file in figures, one "name value" a
 * line. Which of them it is, its content tells. */
#include <inttypes.h>
#include <stdio.h>

#include "base/context.h"
#include "base/hash_table.h"
#include "bind/lua_text.h"
#include "cli/artwork_info.h"
#include "cli/confine.h"
#include "cli/interrupt.h"
#include "cli/names.h"
#include "cli/picture_info.h"
#include "cli/script.h"
#include "cli/span_reader.h"
#include "cli/verbs.h"
#include "scene/scene.h"

static void keep_larger(size_t *most, size_t count) {
  if (count > *most)
    *most = count;
}

enum { DIFFERENT_MOST = 1 << 19 }; /* scenes that are told from one another, in some 25 MB */

typedef struct totals {
  celspan_rostrum_counts most; /* the largest count of each in any frame */
  size_t different;            /* frames that are not equal to one before */
  bool is_least;               /* there may be more of them */
  cs_hash_table scenes;
  cs_names names;
} totals;

static void count_frame(const cs_film_frame *frame, celspan_rostrum_counts *most) {
  celspan_rostrum_counts all = {0, 0, 0};
  for (size_t e = 0; e < frame->count; e++) {
    celspan_rostrum_counts counts;
    celspan_rostrum_count(frame->exposures[e].rostrum, &counts);
    all.cels += counts.cels;
    all.primitives += counts.primitives;
    all.pictures += counts.pictures;
  }
  keep_larger(&most->cels, all.cels);
  keep_larger(&most->primitives, all.primitives);
  keep_larger(&most->pictures, all.pictures);
}

static celspan_status count_scene(cs_script *script, totals *s) {
  const cs_film_frame *frame = &script->frame;
  CS_TRY(cs_names_add(&s->names, frame->exposures, frame->count, script->number));
  cs_hash hash = cs_scene_hash(frame->exposures, frame->count);
  bool is_named = !cs_scene_has_procedure(frame->exposures, frame->count);
  size_t number;
  if (is_named && cs_hash_table_find(&s->scenes, hash, &number))
    return CELSPAN_OK;
  if (is_named && s->scenes.count == DIFFERENT_MOST) {
    s->is_least = true;
    return CELSPAN_OK;
  }
  s->different++;
  return is_named ? cs_hash_table_add(&s->scenes, script->context, hash, 0) : CELSPAN_OK;
}

static cs_exit count_all(cs_script *script, totals *s) {
  for (int64_t i = 0; i < script->film.count && !cs_interrupt_signal(); i++) {
    cs_exit outcome = cs_script_build(script, script->film.first + i);
    if (outcome == CS_EXIT_OK)
      outcome = cs_report_failure(script->context, count_scene(script, s), NULL);
    if (outcome != CS_EXIT_OK)
      return outcome;
    count_frame(&script->frame, &s->most);
  }
  return CS_EXIT_OK;
}

static void print_info(const cs_script *script, const totals *s) {
  const celspan_rostrum_counts *most = &s->most;
  if (script->film.title)
    printf("title %s\n", script->film.title);
  printf("frames %lld\nfirst %lld\nlast %lld\n", (long long)script->film.count,
         (long long)script->film.first, (long long)(script->film.first + script->film.count - 1));
  printf("fps %.9g\nseconds %.9g\nsize %dx%d\n", script->film.frames_second,
         (double)script->film.count / script->film.frames_second, script->film.width,
         script->film.height);
  printf("cels %zu\nprimitives %zu\npictures %zu\n", most->cels, most->primitives, most->pictures);
  printf("different%s %zu\n", s->is_least ? "_at_least" : "", s->different);
  cs_names_print(&s->names);
}

/* Prints what the whole file consists of. */
static void print_spans(const cs_span_reader *file, const spanfile_counts *counts) {
  spanfile_info info = cs_span_reader_info(file);
  printf("format span\nsize %" PRIu32 "x%" PRIu32 "\ndepth %s\nbytes %" PRIu64 "\n", info.width,
         info.height, info.format == SPANFILE_HALF ? "half" : "8", cs_span_reader_bytes(file));
  printf("rows_same %" PRIu64 "\nrows_moved %" PRIu64 "\nrows_literal %" PRIu64 "\n",
         counts->same_rows, counts->moved_rows, counts->literal_rows);
  printf("runs %" PRIu64 "\nraw_spans %" PRIu64 "\ngradients %" PRIu64 "\n",
         counts->spans[SPANFILE_RUN], counts->spans[SPANFILE_RAW],
         counts->spans[SPANFILE_GRADIENT]);
}

static cs_exit inform_spans(celspan_context *context, const char *path) {
  cs_span_reader *file = NULL;
  spanfile_counts counts;
  celspan_status status = cs_span_reader_open(context, path, &file);
  if (status == CELSPAN_OK)
    status = cs_span_reader_check(file, &counts);
  if (status == CELSPAN_OK)
    print_spans(file, &counts);
  cs_span_reader_close(file);
  return cs_report_failure(context, status, NULL);
}

static cs_exit inform_script(celspan_context *context, const cs_request *request) {
  cs_script script;
  cs_exit outcome = cs_script_open(context, request, &script);
  totals s = {.names.context = context};
  if (outcome == CS_EXIT_OK)
    outcome = count_all(&script, &s);
  if (outcome == CS_EXIT_OK && !cs_interrupt_signal())
    print_info(&script, &s);
  cs_names_finish(&s.names);
  cs_hash_table_finish(&s.scenes, context);
  cs_script_close(&script);
  return outcome;
}

/* A Photoshop document is a picture with subimages for `layer`, and a painting with more of it. */
static cs_exit inform_artwork(celspan_context *context, const char *path, cs_artwork kind) {
  cs_exit outcome = kind == CS_ARTWORK_PSD ? cs_picture_info_print(context, path) : CS_EXIT_OK;
  return outcome == CS_EXIT_OK ? cs_artwork_info_print(context, path, kind) : outcome;
}

static cs_exit inform_file(celspan_context *context, const char *path, cs_artwork kind) {
  if (kind != CS_ARTWORK_NONE)
    return inform_artwork(context, path, kind);
  if (cs_span_reader_accepts(path))
    return inform_spans(context, path);
  return cs_picture_info_print(context, path);
}

cs_exit cs_verb_info(celspan_context *context, const cs_request *request) {
  const char *path = request->operands[0];
  cs_artwork kind = cs_artwork_info_kind(path);
  if (kind == CS_ARTWORK_NONE && !cs_span_reader_accepts(path) && cs_lua_text_accepts(path))
    return inform_script(context, request);
  cs_exit outcome = cs_confine_refuse(request);
  return outcome == CS_EXIT_OK ? inform_file(context, path, kind) : outcome;
}
