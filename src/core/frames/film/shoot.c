#include "frames/film/shoot.h"

#include <string.h>

#include "base/clock.h"
#include "base/hash_table.h"
#include "frames/film/frame_pipeline.h"
#include "model/scene/scene.h"
#include "model/scene/walk.h"
#include "output/sinks/coder.h"
#include "output/sinks/file_copy.h"
#include "output/sinks/pixels.h"
#include "output/sinks/sink.h"

/* ---------------------------------------------------------------- duplicates */

/* Frames that show the same scene: the first of them is made, and the others can be copied from it.
 *
 * INVARIANT: one frame of each scene is known, the first that was added. The file to copy is set
 * when that frame is finished.
 */
typedef struct known_frame {
  int64_t number;     /* the number of the frame */
  bool is_made;       /* the fields below are set */
  cs_file_stamp file; /* where frames are files */
  uint64_t digest[2]; /* the digest of its pixels, where digests are asked for */
} known_frame;

typedef struct known_frames {
  known_frame *known; /* in the order in which they were added */
  size_t count, capacity;
  cs_hash_table indices; /* from scenes to indices into known */
} known_frames;

/* Finds the frame of a scene, or adds frame `number` as its first; *is_new says which. *index: the
 * place of the frame in `known`. Errors: NO_MEMORY. */
static CELSPAN_CHECKED celspan_status add_duplicate(known_frames *duplicates,
                                                    celspan_context *context, cs_hash scene,
                                                    int64_t number, size_t *index, bool *is_new) {
  *is_new = !cs_hash_table_find(&duplicates->indices, scene, index);
  if (!*is_new)
    return CELSPAN_OK;
  CS_TRY(CS_RESERVE(context, duplicates->known, duplicates->capacity, duplicates->count + 1));
  CS_TRY(cs_hash_table_add(&duplicates->indices, context, scene, duplicates->count));
  *index = duplicates->count++;
  duplicates->known[*index] = (known_frame){.number = number};
  return CELSPAN_OK;
}

static void finish_duplicates(known_frames *duplicates, celspan_context *context) {
  cs_mem_free(context->memory, duplicates->known, duplicates->capacity * sizeof *duplicates->known);
  cs_hash_table_finish(&duplicates->indices, context);
  *duplicates = (known_frames){0};
}

/* ---------------------------------------------------------------- frames */

/* What a frame of a stream shows. */
typedef struct pictured {
  bool is_named; /* the fields below are set */
  cs_hash scene;
  uint64_t digest[2];
} pictured;

typedef struct job {
  const cs_shoot *shoot;
  bool has_duplicates; /* equal frames are searched for */
  known_frames duplicates;
  bool repeats;                    /* equal frames of a stream are given on again */
  pictured built_last, given_last; /* the last frames of a stream */
} job;

/* The data of a frame in the pipeline. */
typedef struct frame_task {
  cs_shoot_frame frame;
  cs_film_frame built;
  bool is_known; /* `duplicate` is set */
  bool is_first; /* the first of the frames that are equal */
  size_t duplicate;
  size_t slot;  /* the slot of a stream */
  bool repeats; /* the frame shows the same as its predecessor */
} frame_task;

/* ---------------------------------------------------------------- building */

static celspan_status name_frame(job *j, frame_task *task) {
  const cs_shoot *shoot = j->shoot;
  cs_shoot_frame *frame = &task->frame;
  frame->is_named = !cs_scene_has_procedure(task->built.exposures, task->built.count);
  frame->scene = shoot->hash ? shoot->hash(task->built.exposures, task->built.count)
                             : cs_scene_hash(task->built.exposures, task->built.count);
  if (shoot->keep)
    frame->inputs = cs_walk_hash_files(task->built.exposures, task->built.count);
  if (!shoot->pattern || shoot->put)
    return CELSPAN_OK;
  return cs_sequence_name(shoot->context, shoot->pattern, frame->number, frame->path,
                          sizeof frame->path);
}

static celspan_status find_duplicate(job *j, frame_task *task) {
  task->is_known = j->has_duplicates && task->frame.is_named;
  return task->is_known ? add_duplicate(&j->duplicates, j->shoot->context, task->frame.scene,
                                        task->frame.number, &task->duplicate, &task->is_first)
                        : CELSPAN_OK;
}

static pictured picture_of(const cs_shoot_frame *frame) {
  return (pictured){frame->is_named, frame->scene, {frame->digest[0], frame->digest[1]}};
}

static bool equals(const pictured *other, const cs_shoot_frame *frame) {
  return other->is_named && frame->is_named && other->scene.a == frame->scene.a &&
         other->scene.b == frame->scene.b;
}

static void find_repeat(job *j, frame_task *task) {
  task->repeats = j->repeats && equals(&j->built_last, &task->frame);
  j->built_last = picture_of(&task->frame);
}

static cs_pipeline_step choose_step(const job *j, const frame_task *task) {
  const cs_shoot *shoot = j->shoot;
  if (task->frame.way == CS_SHOOT_KEPT)
    return CS_PIPELINE_NOTHING;
  if (!task->frame.is_named || (shoot->put && !shoot->give))
    return CS_PIPELINE_HERE;
  return task->repeats || (task->is_known && !task->is_first) ? CS_PIPELINE_IN_ORDER
                                                              : CS_PIPELINE_ANYWHERE;
}

static celspan_status build(void *user, size_t index, void *carried, cs_pipeline_step *step) {
  job *j = user;
  frame_task *task = carried;
  const cs_shoot *shoot = j->shoot;
  double begun = cs_clock_seconds();
  task->frame.number = shoot->frames->frames[index];
  task->slot = shoot->slots ? index % shoot->slots : 0;
  CS_TRY(shoot->build(shoot->user, task->frame.number, &task->built));
  CS_TRY(name_frame(j, task));
  if (shoot->keep && shoot->keep(shoot->user, &task->frame))
    task->frame.way = CS_SHOOT_KEPT;
  CS_TRY(find_duplicate(j, task));
  find_repeat(j, task);
  *step = choose_step(j, task);
  task->frame.seconds = cs_clock_seconds() - begun;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- making */

/* Writes the file and hashes its pixels in one pass over the rows. */
static celspan_status make_both(celspan_context *context, const celspan_frame_desc *frame,
                                const char *path, const celspan_file_desc *file,
                                uint64_t digest[2]) {
  cs_tee tee;
  celspan_file_desc placed = *file;
  celspan_coding coding = cs_pixels_resolve(file->coding, CELSPAN_DEPTH_8);
  celspan_coding asked = file->coding ? *file->coding : CELSPAN_CODING;
  coding.space = asked.space = frame->space;
  placed.coding = &asked;
  placed.place_x = frame->crop_x;
  placed.place_y = frame->crop_y;
  CS_TRY(cs_sink_file(context, path, &placed, &tee.sinks[0]));
  celspan_status status = cs_sink_digest(context, &coding, digest, &tee.sinks[1]);
  if (status == CELSPAN_OK)
    status = cs_coder_dither(context, &asked, &coding, frame->crop_x, frame->crop_y, &tee.sinks[1]);
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
  file.title = j->shoot->film.title;
  file.frames_second = j->shoot->film.frames_second;
  file.frame = number >= INT32_MIN && number <= INT32_MAX ? (int32_t)number : 0;
  file.is_opaque = celspan_frame_is_opaque(frame);
  file.workers = frame->workers;
  return file;
}

static celspan_status make_frame(const job *j, celspan_context *context,
                                 const celspan_frame_desc *desc, frame_task *task) {
  const cs_shoot *shoot = j->shoot;
  cs_shoot_frame *frame = &task->frame;
  if (shoot->put)
    return shoot->put(shoot->user, &(cs_shoot_put){context, desc, task->slot, frame});
  if (!shoot->pattern)
    return celspan_frame_digest(context, desc, shoot->file.coding, frame->digest);
  celspan_file_desc file = describe_file(j, frame->number, desc);
  if (shoot->write)
    return shoot->write(shoot->user, context, desc, frame->path, &file);
  return shoot->has_digests ? make_both(context, desc, frame->path, &file, frame->digest)
                            : celspan_frame_write(context, desc, frame->path, &file, NULL);
}

/* Copies the frame from the earlier frame that it equals, unless the file of that frame is gone or
 * was changed. Calling thread. */
static celspan_status copy_duplicate(const job *j, celspan_context *context, frame_task *task) {
  const known_frame *duplicate = &j->duplicates.known[task->duplicate];
  char from[CS_SHOOT_PATH];
  bool is_copied = duplicate->is_made;
  if (is_copied && j->shoot->pattern) {
    CS_TRY(cs_sequence_name(context, j->shoot->pattern, duplicate->number, from, sizeof from));
    CS_TRY(cs_file_copy(context, from, &duplicate->file, task->frame.path, &is_copied));
  }
  if (is_copied)
    task->frame.way = CS_SHOOT_COPIED;
  memcpy(task->frame.digest, duplicate->digest, sizeof duplicate->digest);
  return CELSPAN_OK;
}

/* Leaves a frame to `repeat` if it shows the same as the one that was given last, which is the
 * frame before it unless that failed. Calling thread. */
static void copy_last(const job *j, frame_task *task) {
  if (!equals(&j->given_last, &task->frame))
    return;
  task->frame.way = CS_SHOOT_COPIED;
  memcpy(task->frame.digest, j->given_last.digest, sizeof task->frame.digest);
}

celspan_status cs_shoot_failure(celspan_context *context, int64_t number, celspan_status status) {
  char sentence[sizeof context->error];
  if (status == CELSPAN_OK || status == CELSPAN_CANCELLED)
    return status;
  memcpy(sentence, context->error, sizeof sentence);
  return cs_fail(context, status, "frame %lld: %s", (long long)number, sentence);
}

static celspan_status make_or_copy(const job *j, celspan_context *context, frame_task *task,
                                   const celspan_frame_desc *desc) {
  if (task->is_known && !task->is_first)
    CS_TRY(copy_duplicate(j, context, task));
  if (task->repeats)
    copy_last(j, task);
  return task->frame.way == CS_SHOOT_COPIED ? CELSPAN_OK : make_frame(j, context, desc, task);
}

static celspan_status make(void *user, celspan_context *context, void *carried, int workers,
                           cs_frame_pipeline_frame *turn) {
  const job *j = user;
  frame_task *task = carried;
  celspan_frame_desc desc = j->shoot->frame;
  cs_film_expose(&j->shoot->film, &task->built, &desc);
  desc.workers = workers;
  desc.progress = cs_frame_pipeline_progress;
  desc.progress_user = turn;
  context->contents = &task->frame.contents;
  double begun = cs_clock_seconds();
  celspan_status status = make_or_copy(j, context, task, &desc);
  context->contents = NULL;
  task->frame.seconds += cs_clock_seconds() - begun;
  if (j->shoot->keeps_nothing)
    cs_context_trim(context);
  return cs_shoot_failure(context, task->frame.number, status);
}

/* ---------------------------------------------------------------- the end */

/* Notes the file from which later frames that equal this one can be copied. */
static void note_duplicate(job *j, const frame_task *task) {
  known_frame *duplicate = &j->duplicates.known[task->duplicate];
  duplicate->number = task->frame.number;
  duplicate->is_made = !j->shoot->pattern || cs_file_stamp_read(task->frame.path, &duplicate->file);
  memcpy(duplicate->digest, task->frame.digest, sizeof duplicate->digest);
}

/* Gives a frame of a stream on. */
static celspan_status give(job *j, const frame_task *task) {
  const cs_shoot *shoot = j->shoot;
  if (!shoot->give || task->frame.way == CS_SHOOT_KEPT)
    return CELSPAN_OK;
  celspan_status status = task->frame.way == CS_SHOOT_COPIED ? shoot->repeat(shoot->user)
                                                             : shoot->give(shoot->user, task->slot);
  if (status == CELSPAN_OK)
    j->given_last = picture_of(&task->frame);
  return cs_shoot_failure(shoot->context, task->frame.number, status);
}

static celspan_status finish(void *user, void *carried, celspan_status status) {
  job *j = user;
  frame_task *task = carried;
  if (status == CELSPAN_OK)
    status = give(j, task);
  if (status == CELSPAN_OK && task->is_known && task->frame.way != CS_SHOOT_COPIED)
    note_duplicate(j, task);
  return j->shoot->finished(j->shoot->user, &task->frame, status);
}

static void release(void *user, void *carried) {
  (void)user;
  cs_film_frame_finish(&((frame_task *)carried)->built);
}

static bool tick(void *user, double share) {
  const cs_shoot *shoot = ((const job *)user)->shoot;
  return shoot->tick(shoot->user, share);
}

/* Files that contain the number of their frame are never equal. */
static bool has_duplicates(const cs_shoot *shoot) {
  if (shoot->put || shoot->write || shoot->keeps_nothing || shoot->frames->count < 2)
    return false;
  return !shoot->pattern || !cs_sink_file_is_numbered(shoot->pattern, &shoot->file);
}

celspan_status cs_shoot_run(const cs_shoot *shoot) {
  job j = {.shoot = shoot,
           .has_duplicates = has_duplicates(shoot),
           .repeats = shoot->repeat && !shoot->keeps_nothing};
  const cs_frame_pipeline pipeline = {.count = shoot->frames->count,
                                      .workers = shoot->frame.workers,
                                      .keeps_going = shoot->keeps_going,
                                      .frame_size = sizeof(frame_task),
                                      .slots = shoot->slots,
                                      .user = &j,
                                      .build = build,
                                      .make = make,
                                      .finish = finish,
                                      .release = release,
                                      .tick = shoot->tick ? tick : NULL};
  celspan_status status = cs_frame_pipeline_run(shoot->context, &pipeline);
  finish_duplicates(&j.duplicates, shoot->context);
  return status;
}
