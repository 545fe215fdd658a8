#include "program/outputs/whole.h"

#include <stdio.h>

#include "lua/module/subtitles.h"
#include "program/film/soundtrack.h"
#include "program/outputs/poster.h"

celspan_status cs_whole_open(cs_whole *whole, const cs_script *script, const cs_request *request,
                             const celspan_frame_desc *frame) {
  whole->file = (cs_shoot_frame){.number = 0};
  snprintf(whole->file.path, sizeof whole->file.path, "%s", cs_request_text(request, "-o"));
  return cs_record_open(&whole->record, script, request, frame);
}

bool cs_whole_is_known(const cs_whole *whole) {
  const cs_record *record = &whole->record;
  return !record->needs_pixels &&
         (record->is_forced || cs_record_knows(record, whole->file.number));
}

/* The options that only files of whole films have. */
static void hash_options(cs_hash *hash, const cs_request *request) {
  static const char *const options[] = {"--codec", "--quality",  "--crf",     "--fps",
                                        "--loop",  "--max-size", "--loudness"};
  for (size_t i = 0; i < sizeof options / sizeof *options; i++)
    cs_hash_text(hash, cs_request_text(request, options[i]));
  cs_hash_text(hash, cs_request_text(request, "--background"));
  cs_hash_word(hash, cs_request_has(request, "--no-dither"));
}

/* Marks and captions, which are in videos. */
static celspan_status hash_texts(cs_hash *hash, cs_script *script) {
  const cs_film_info *film = &script->film;
  for (size_t i = 0; i < film->mark_count; i++) {
    cs_hash_text(hash, film->marks[i].name);
    cs_hash_word(hash, (uint64_t)film->marks[i].frame);
  }
  if (!film->has_captions)
    return CELSPAN_OK;
  CS_TRY(cs_subtitles_push(script->L, CS_SCRIPT_FILM, "srt", 0,
                           (double)film->count / film->frames_second));
  cs_hash_text(hash, lua_tostring(script->L, -1));
  lua_pop(script->L, 1);
  return CELSPAN_OK;
}

celspan_status cs_whole_begin(cs_whole *whole, cs_script *script, const cs_request *request,
                              const cs_sequence *frames) {
  cs_hash hash = cs_hash_begin(frames->count);
  hash_options(&hash, request);
  for (size_t i = 0; i < frames->count; i++)
    cs_hash_word(&hash, (uint64_t)frames->frames[i]);
  if (script->film.has_sound)
    CS_TRY(cs_soundtrack_hash(script, &hash));
  CS_TRY(hash_texts(&hash, script));
  CS_TRY(cs_poster_hash(script, &hash));
  whole->file.is_named = true;
  whole->file.scene = hash;
  return CELSPAN_OK;
}

void cs_whole_add(cs_whole *whole, const cs_shoot_frame *frame) {
  cs_shoot_frame *file = &whole->file;
  file->is_named = file->is_named && frame->is_named;
  cs_hash_hash(&file->scene, frame->scene);
  cs_hash_hash(&file->scene, frame->inputs);
}

bool cs_whole_is_kept(cs_whole *whole) {
  bool is_kept = cs_record_has(&whole->record, &whole->file);
  whole->file.way = is_kept ? CS_SHOOT_KEPT : CS_SHOOT_MADE;
  return is_kept;
}

celspan_status cs_whole_finish(cs_whole *whole) {
  return cs_record_add(&whole->record, &whole->file);
}

void cs_whole_close(cs_whole *whole) { cs_record_close(&whole->record); }
