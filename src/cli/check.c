/* celspan check SCRIPT: builds every frame and renders none.
 *
 *   frames of a part   1 2 3 ... n | n+1 ...        part by part, so that memory has a bound:
 *
 *   the film's sound
 *   first pass    -->  in order: frames that cannot be built, pictures that cannot be read
 *   second pass   <--  a fresh film, last frame first: a frame whose scene now differs was not made
 *                      by a pure function of its number
 *
 * All faults are reported, in the end, equal ones in one line (cli/faults.h).
 */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/context.h"
#include "cli/faults.h"
#include "cli/interrupt.h"
#include "cli/script.h"
#include "cli/target.h"
#include "cli/verbs.h"
#include "cli/video/sound.h"
#include "scene/inspect.h"
#include "scene/scene.h"

enum { PART = 4096 }; /* frames between two turns */

typedef struct scene_name {
  bool is_known; /* false: not built, or it contains procedures, which cannot be compared */
  cs_hash hash;
} scene_name;

typedef struct checkup {
  celspan_context *context;
  const cs_request *request;
  cs_script script, fresh;
  cs_sequence frames; /* those of --frames; without it, empty */
  int64_t count, done;
  scene_name *names; /* of a part */
  cs_inspection pictures;
  cs_faults faults;
  int64_t frame; /* whose pictures are looked at */
} checkup;

static int64_t frame_at(const checkup *check, int64_t index) {
  return check->frames.frames ? check->frames.frames[index] : check->script.film.first + index;
}

/* Leaves "frame N: " out of a sentence, so that equal faults of many frames are one. */
static void copy_without_frame(char *out, size_t size, const char *sentence, int64_t frame) {
  char label[40];
  snprintf(label, sizeof label, "frame %" PRId64 ": ", frame);
  const char *at = strstr(sentence, label);
  int before = at ? (int)(at - sentence) : 0;
  snprintf(out, size, "%.*s%s", before, sentence, at ? at + strlen(label) : sentence);
}

static void fault(checkup *check, int64_t frame, const char *where, const char *message,
                  cs_exit code) {
  char sentence[CS_ERROR_SIZE];
  copy_without_frame(sentence, sizeof sentence, message, frame);
  if (!cs_interrupt_signal()) /* else the frame did not fail: it was stopped */
    cs_faults_add(&check->faults, frame, where, sentence, code);
}

/* ---------------------------------------------------------------- the two passes */

static void name_scene(const cs_script *script, scene_name *out) {
  const cs_film_frame *frame = &script->frame;
  *out = (scene_name){!cs_scene_has_procedure(frame->exposures, frame->count),
                      cs_scene_hash(frame->exposures, frame->count)};
}

static bool is_same(const scene_name *a, const scene_name *b) {
  return a->is_known && b->is_known && a->hash.a == b->hash.a && a->hash.b == b->hash.b;
}

static bool add_picture(void *user, const celspan_fault *found) {
  checkup *check = user;
  char where[CS_INSPECT_PLACE];
  cs_inspect_place(found, where);
  fault(check, check->frame, where, found->message, cs_report_exit(found->status));
  return cs_interrupt_signal() == 0;
}

static void check_pictures(checkup *check, int64_t frame) {
  check->frame = frame;
  for (size_t i = 0; i < check->script.frame.count; i++) {
    const celspan_rostrum *rostrum = check->script.frame.exposures[i].rostrum;
    celspan_status status = cs_inspect_rostrum(&check->pictures, rostrum, add_picture, check);
    if (status == CELSPAN_NO_MEMORY)
      fault(check, frame, "", celspan_context_error(check->context), cs_report_exit(status));
  }
}

/* The film's sound is looked for, and under --deep listened to. OK, or reported. */
static cs_exit check_sound(checkup *check) {
  const char *path = NULL;
  celspan_status status = cs_sound_find(&check->script, &path);
  if (status == CELSPAN_OK && path && check->request->is_deep)
    status = cs_sound_listen(check->context, path);
  return cs_report_failure(check->context, status, NULL);
}

static void first_pass(checkup *check, int64_t begin, int64_t end) {
  for (int64_t i = begin; i < end && !cs_interrupt_signal(); i++) {
    int64_t frame = frame_at(check, i);
    scene_name *name = &check->names[i - begin];
    celspan_status status = cs_script_try(&check->script, frame);
    *name = (scene_name){.is_known = false};
    check->done++;
    if (status != CELSPAN_OK) {
      fault(check, frame, "", celspan_context_error(check->context), cs_report_exit(status));
      continue;
    }
    name_scene(&check->script, name);
    check_pictures(check, frame);
  }
}

static void second_pass(checkup *check, int64_t begin, int64_t end) {
  static const char *const IMPURE =
      "the frame function is not pure: asked again in another order it gave another scene; let it "
      "depend on nothing but its argument";
  for (int64_t i = end - 1; i >= begin && !cs_interrupt_signal(); i--) {
    scene_name again = {.is_known = false};
    const scene_name *name = &check->names[i - begin];
    if (!name->is_known)
      continue;
    if (cs_script_try(&check->fresh, frame_at(check, i)) == CELSPAN_OK)
      name_scene(&check->fresh, &again);
    if (!is_same(&again, name))
      fault(check, frame_at(check, i), "", IMPURE, CS_EXIT_SCRIPT);
  }
}

/* The fresh film, made when it is first needed. */
static cs_exit open_fresh(checkup *check) {
  if (check->fresh.L)
    return CS_EXIT_OK;
  cs_exit outcome = cs_script_open(check->context, check->request, &check->fresh);
  const cs_film_info *film = &check->script.film, *again = &check->fresh.film;
  if (outcome != CS_EXIT_OK || (again->count == film->count && again->first == film->first))
    return outcome;
  cs_report_error("the script made a film of other frames when it was run again: %" PRId64
                  " from %" PRId64 ", not %" PRId64 " from %" PRId64,
                  again->count, again->first, film->count, film->first);
  return CS_EXIT_SCRIPT;
}

static cs_exit check_parts(checkup *check) {
  cs_exit outcome = CS_EXIT_OK;
  for (int64_t begin = 0; begin < check->count && !cs_interrupt_signal(); begin += PART) {
    int64_t end = check->count - begin < PART ? check->count : begin + PART;
    first_pass(check, begin, end);
    outcome = open_fresh(check);
    if (outcome != CS_EXIT_OK)
      break;
    second_pass(check, begin, end);
  }
  return outcome;
}

/* ---------------------------------------------------------------- the report */

static const char *plural(uint64_t count) { return count == 1 ? "" : "s"; }

static void report(const checkup *check, cs_exit sound) {
  const cs_faults *faults = &check->faults;
  uint64_t done = (uint64_t)check->done;
  cs_faults_report(faults);
  if (check->done < check->count)
    cs_report_note("stopped after %" PRIu64 " of %" PRId64 " frames", done, check->count);
  if (faults->met > 0)
    cs_report_note("%s%zu fault%s, met %" PRIu64 " time%s in %" PRIu64 " frame%s",
                   faults->beyond > 0 ? "more than " : "", faults->count, plural(faults->count),
                   faults->met, plural(faults->met), done, plural(done));
  else if (check->done == check->count)
    cs_report_note("%" PRIu64 " frame%s checked: no faults%s", done, plural(done),
                   sound == CS_EXIT_OK ? "" : " but the sound");
}

/* ---------------------------------------------------------------- the verb */

static cs_exit list_frames(checkup *check) {
  check->count = check->script.film.count;
  if (!check->request->frames)
    return CS_EXIT_OK;
  cs_exit outcome = cs_target_frames(&check->script, check->request, &check->frames);
  check->count = (int64_t)check->frames.count;
  return outcome;
}

static cs_exit run(checkup *check) {
  check->names = cs_mem_array(check->context->memory, PART, sizeof *check->names);
  if (!check->names) {
    cs_report_error("no memory to compare frames");
    return CS_EXIT_MEMORY;
  }
  cs_exit sound = check_sound(check), outcome = check_parts(check);
  cs_mem_free(check->context->memory, check->names, PART * sizeof *check->names);
  report(check, sound);
  outcome = outcome == CS_EXIT_OK ? sound : outcome;
  return check->faults.outcome == CS_EXIT_OK ? outcome : check->faults.outcome;
}

cs_exit cs_verb_check(celspan_context *context, const cs_request *request) {
  checkup check = {.context = context,
                   .request = request,
                   .pictures = {.context = context,
                                .is_deep = request->is_deep,
                                .progress = cs_interrupt_progress},
                   .faults = {.context = context}};
  cs_exit outcome = cs_script_open(context, request, &check.script);
  if (outcome == CS_EXIT_OK)
    outcome = list_frames(&check);
  if (outcome == CS_EXIT_OK)
    outcome = run(&check);
  cs_script_close(&check.fresh);
  cs_script_close(&check.script);
  cs_faults_finish(&check.faults);
  cs_inspection_finish(&check.pictures);
  cs_sequence_finish(&check.frames);
  return outcome;
}
