#include "bind/shoot.h"

#include <stdio.h>
#include <string.h>

#include "film/duplicates.h"
#include "film/frame_pipeline.h"
#include "output/sink.h"
#include "output/tee.h"
#include "scene/scene.h"

typedef struct job {
  const cs_shoot *shoot;
  cs_film_info film;
  bool has_duplicates; /* equal frames are looked for */
  cs_duplicates duplicates;
} job;

/* What a frame carries through the reel. */
typedef struct take {
  cs_shoot_frame frame;
  cs_film_frame built;
  bool is_known; /* `twin` is the frame's own index, or that of an earlier one that it equals */
  bool is_first;
  size_t duplicate;
} take;

/* ---------------------------------------------------------------- building */

static celspan_status name_take(job *j, take *t) {
  const cs_shoot *shoot = j->shoot;
  cs_shoot_frame *frame = &t->frame;
  frame->is_named = !cs_scene_has_procedure(t->built.exposures, t->built.count);
  frame->scene = cs_scene_hash(t->built.exposures, t->built.count);
  if (shoot->keep)
    frame->inputs = cs_scene_hash_files(t->built.exposures, t->built.count);
  if (!shoot->pattern || shoot->put)
    return CELSPAN_OK;
  return cs_sequence_name(shoot->context, shoot->pattern, frame->number, frame->path,
                          sizeof frame->path);
}

static celspan_status meet_duplicates(job *j, take *t) {
  t->is_known = j->has_duplicates && t->frame.is_named;
  return t->is_known ? cs_duplicates_meet(&j->duplicates, j->shoot->context, t->frame.scene,
                                          t->frame.number, &t->duplicate, &t->is_first)
                     : CELSPAN_OK;
}

static cs_frame_pipeline_step choose_step(const job *j, const take *t) {
  if (t->frame.way == CS_SHOOT_KEPT)
    return CS_FRAME_PIPELINE_NOTHING;
  if (!t->frame.is_named || j->shoot->put)
    return CS_FRAME_PIPELINE_HERE;
  return t->is_known && !t->is_first ? CS_FRAME_PIPELINE_IN_TURN : CS_FRAME_PIPELINE_ANYWHERE;
}

static celspan_status build(void *user, size_t index, void *carried, cs_frame_pipeline_step *step) {
  job *j = user;
  take *t = carried;
  const cs_shoot *shoot = j->shoot;
  t->frame.number = shoot->frames->frames[index];
  CS_TRY(cs_film_build(shoot->L, shoot->film, t->frame.number, &t->built));
  CS_TRY(name_take(j, t));
  if (shoot->keep && shoot->keep(shoot->user, &t->frame))
    t->frame.way = CS_SHOOT_KEPT;
  CS_TRY(meet_duplicates(j, t));
  *step = choose_step(j, t);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- making */

/* Writes the file and hashes its pixels in one go. */
static celspan_status make_both(celspan_context *context, const celspan_frame_desc *frame,
                                const char *path, const celspan_file_desc *file,
                                uint64_t digest[2]) {
  cs_tee tee;
  CS_TRY(cs_sink_file(context, path, file, &tee.sinks[0]));
  celspan_status status = cs_sink_digest(context, &file->coding, digest, &tee.sinks[1]);
  if (status != CELSPAN_OK) {
    cs_sink_discard(context, &tee.sinks[0]);
    return status;
  }
  celspan_sink sink = cs_tee_sink(&tee);
  status = celspan_frame_render(context, frame, &sink, NULL);
  for (int i = 0; i < 2 && !tee.is_ended; i++)
    cs_sink_discard(context, &tee.sinks[i]);
  return status;
}

static celspan_file_desc describe_file(const job *j, int64_t number,
                                       const celspan_frame_desc *frame) {
  celspan_file_desc file = j->shoot->file;
  file.title = j->film.title;
  file.frames_second = j->film.frames_second;
  file.frame = number >= INT32_MIN && number <= INT32_MAX ? (int32_t)number : 0;
  file.is_opaque = celspan_frame_is_opaque(frame);
  file.workers = frame->workers;
  return file;
}

static celspan_status make_frame(const job *j, celspan_context *context,
                                 const celspan_frame_desc *desc, cs_shoot_frame *frame) {
  const cs_shoot *shoot = j->shoot;
  if (shoot->put)
    return shoot->put(shoot->user, desc);
  if (!shoot->pattern)
    return celspan_frame_digest(context, desc, &shoot->file.coding, frame->digest);
  celspan_file_desc file = describe_file(j, frame->number, desc);
  return shoot->has_digests ? make_both(context, desc, frame->path, &file, frame->digest)
                            : celspan_frame_write(context, desc, frame->path, &file, NULL);
}

/* Takes the frame from the one that it equals, where that is still to be had. Calling thread. */
static celspan_status copy_duplicate(const job *j, celspan_context *context, take *t) {
  const cs_duplicate *duplicate = &j->duplicates.known[t->duplicate];
  char from[CS_SHOOT_PATH];
  bool is_copied = duplicate->is_made;
  if (is_copied && j->shoot->pattern) {
    CS_TRY(cs_sequence_name(context, j->shoot->pattern, duplicate->number, from, sizeof from));
    CS_TRY(cs_file_copy(context, from, &duplicate->file, t->frame.path, &is_copied));
  }
  if (is_copied)
    t->frame.way = CS_SHOOT_COPIED;
  memcpy(t->frame.digest, duplicate->digest, sizeof duplicate->digest);
  return CELSPAN_OK;
}

/* The sentence gets the frame's number before it; a stop is nobody's fault. */
static celspan_status place_failure(celspan_context *context, int64_t number,
                                    celspan_status status) {
  char sentence[sizeof context->error];
  if (status == CELSPAN_OK || status == CELSPAN_CANCELLED)
    return status;
  memcpy(sentence, context->error, sizeof sentence);
  return cs_fail(context, status, "frame %lld: %s", (long long)number, sentence);
}

static celspan_status make_or_copy(const job *j, celspan_context *context, take *t,
                                   const celspan_frame_desc *desc) {
  if (t->is_known && !t->is_first)
    CS_TRY(copy_duplicate(j, context, t));
  return t->frame.way == CS_SHOOT_COPIED ? CELSPAN_OK : make_frame(j, context, desc, &t->frame);
}

static celspan_status make(void *user, celspan_context *context, void *carried, int workers,
                           cs_frame_pipeline_turn *turn) {
  const job *j = user;
  take *t = carried;
  celspan_frame_desc desc = j->shoot->frame;
  desc.exposures = t->built.exposures;
  desc.exposure_count = t->built.count;
  desc.workers = workers;
  desc.progress = cs_frame_pipeline_progress;
  desc.progress_user = turn;
  celspan_status status = make_or_copy(j, context, t, &desc);
  if (j->shoot->keeps_nothing)
    cs_context_trim(context);
  return place_failure(context, t->frame.number, status);
}

/* ---------------------------------------------------------------- the end */

/* What the frame leaves for those that equal it. */
static void note_duplicate(job *j, const take *t) {
  cs_duplicate *duplicate = &j->duplicates.known[t->duplicate];
  duplicate->number = t->frame.number;
  duplicate->is_made = !j->shoot->pattern || cs_file_stamp_take(t->frame.path, &duplicate->file);
  memcpy(duplicate->digest, t->frame.digest, sizeof duplicate->digest);
}

static celspan_status finish(void *user, void *carried, celspan_status status) {
  job *j = user;
  take *t = carried;
  if (status == CELSPAN_OK && t->is_known && t->frame.way != CS_SHOOT_COPIED)
    note_duplicate(j, t);
  return j->shoot->told(j->shoot->user, &t->frame, status);
}

static void release(void *user, void *carried) {
  (void)user;
  cs_film_finish_frame(&((take *)carried)->built);
}

static bool tick(void *user, double share) {
  const cs_shoot *shoot = ((const job *)user)->shoot;
  return shoot->tick(shoot->user, share);
}

/* Files that tell the number of their frame are never equal. */
static bool has_duplicates(const cs_shoot *shoot) {
  if (shoot->put || shoot->keeps_nothing || shoot->frames->count < 2)
    return false;
  return !shoot->pattern || !cs_sink_file_is_numbered(shoot->pattern, &shoot->file);
}

celspan_status cs_shoot_run(const cs_shoot *shoot) {
  job j = {.shoot = shoot, .has_duplicates = has_duplicates(shoot)};
  cs_film_read(shoot->L, shoot->film, &j.film);
  const cs_frame_pipeline pipeline = {.count = shoot->frames->count,
                                      .workers = shoot->frame.workers,
                                      .keeps_going = shoot->keeps_going,
                                      .frame_size = sizeof(take),
                                      .user = &j,
                                      .build = build,
                                      .make = make,
                                      .finish = finish,
                                      .release = release,
                                      .tick = shoot->tick ? tick : NULL};
  celspan_status status = cs_frame_pipeline_run(shoot->context, &pipeline);
  cs_duplicates_finish(&j.duplicates, shoot->context);
  return status;
}
