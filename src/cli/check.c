/* celspan check SCRIPT: every frame built, none rendered.
 *
 *   first pass   in order: frames that cannot be built, pictures that cannot be read
 *   second pass  a fresh film, last frame first: a frame whose scene now differs was not made by a
 *                pure function of its number
 *
 * All faults are reported, the same one only once; the exit code is that of the first.
 */
#include <stdio.h>
#include <string.h>

#include "base/context.h"
#include "base/hash.h"
#include "cli/interrupt.h"
#include "cli/shot.h"
#include "cli/verbs.h"
#include "scene/scene.h"

typedef struct scene_name {
  bool is_known; /* false: not built, or it holds procedures, which have no name but themselves */
  cs_hash hash;
} scene_name;

typedef struct checkup {
  celspan_context *context;
  const cs_request *request;
  scene_name *names;
  size_t fault_count, frames_at_fault;
  cs_hash *told; /* of the sentences reported so far; owned */
  size_t told_count, told_capacity;
  cs_exit outcome;
} checkup;

static bool is_new(checkup *check, const char *sentence) {
  cs_hash hash = cs_hash_begin(0);
  cs_hash_text(&hash, sentence);
  hash = cs_hash_end(hash);
  for (size_t i = 0; i < check->told_count; i++)
    if (check->told[i].a == hash.a && check->told[i].b == hash.b)
      return false;
  /* Without memory to remember it the sentence is only told again. */
  if (cs_mem_reserve(check->context, (void **)&check->told, &check->told_capacity,
                     check->told_count + 1, sizeof *check->told) == CELSPAN_OK)
    check->told[check->told_count++] = hash;
  return true;
}

/* Cuts "frame N: " out of a sentence of the film's, so that equal faults of many frames are told
 * once. */
static void copy_without_frame(char *out, size_t size, const char *sentence, int64_t frame) {
  char label[40];
  snprintf(label, sizeof label, "frame %lld: ", (long long)frame);
  const char *at = strstr(sentence, label);
  int before = at ? (int)(at - sentence) : 0;
  snprintf(out, size, "%.*s%s", before, sentence, at ? at + strlen(label) : sentence);
}

static void fault(checkup *check, int64_t frame, const char *told, cs_exit code) {
  char sentence[1024];
  copy_without_frame(sentence, sizeof sentence, told, frame);
  if (cs_interrupt_signal())
    return; /* what failed was stopped */
  check->frames_at_fault++;
  if (check->outcome == CS_EXIT_OK)
    check->outcome = code;
  if (!is_new(check, sentence))
    return;
  check->fault_count++;
  cs_report_error("frame %lld: %s", (long long)frame, sentence);
}

static void name_scene(const cs_shot *shot, scene_name *out) {
  const cs_film_frame *frame = &shot->frame;
  *out = (scene_name){!cs_scene_has_procedure(frame->exposures, frame->count),
                      cs_scene_hash(frame->exposures, frame->count)};
}

static bool is_same(const scene_name *a, const scene_name *b) {
  return a->is_known && b->is_known && a->hash.a == b->hash.a && a->hash.b == b->hash.b;
}

static void check_pictures(checkup *check, const cs_shot *shot, int64_t frame) {
  for (size_t i = 0; i < shot->frame.count; i++) {
    celspan_status status = celspan_rostrum_check(check->context, shot->frame.exposures[i].rostrum);
    if (status != CELSPAN_OK)
      fault(check, frame, celspan_context_error(check->context), cs_report_exit(status));
  }
}

static void first_pass(checkup *check, cs_shot *shot) {
  for (int64_t i = 0; i < shot->film.count && !cs_interrupt_signal(); i++) {
    int64_t frame = shot->film.first + i;
    celspan_status status = cs_shot_try(shot, frame);
    if (status != CELSPAN_OK) {
      fault(check, frame, celspan_context_error(check->context), cs_report_exit(status));
      continue;
    }
    name_scene(shot, &check->names[i]);
    check_pictures(check, shot, frame);
  }
}

static void second_pass(checkup *check, cs_shot *shot) {
  static const char *const IMPURE =
      "the frame function is not pure: asked again in another order it gave another scene; let it "
      "depend on nothing but its argument";
  for (int64_t i = shot->film.count - 1; i >= 0 && !cs_interrupt_signal(); i--) {
    scene_name again = {.is_known = false};
    if (!check->names[i].is_known)
      continue;
    if (cs_shot_try(shot, shot->film.first + i) == CELSPAN_OK)
      name_scene(shot, &again);
    if (!is_same(&again, &check->names[i]))
      fault(check, shot->film.first + i, IMPURE, CS_EXIT_SCRIPT);
  }
}

static void summarise(const checkup *check, const cs_shot *shot) {
  if (check->fault_count)
    cs_report_note("%zu %s, met %zu %s in %lld frames", check->fault_count,
                   check->fault_count == 1 ? "fault" : "faults", check->frames_at_fault,
                   check->frames_at_fault == 1 ? "time" : "times",
                   (long long)shot->film.count);
  else
    cs_report_note("%lld %s checked: no faults", (long long)shot->film.count,
                   shot->film.count == 1 ? "frame" : "frames");
}

static cs_exit run(checkup *check, cs_shot *shot) {
  check->names =
      cs_mem_array(check->context->memory, (size_t)shot->film.count, sizeof *check->names);
  if (!check->names) {
    cs_report_error("no memory to remember %lld frames", (long long)shot->film.count);
    return CS_EXIT_MEMORY;
  }
  first_pass(check, shot);
  cs_shot fresh;
  cs_exit outcome = cs_shot_open(check->context, check->request, &fresh);
  if (outcome == CS_EXIT_OK && fresh.film.count == shot->film.count)
    second_pass(check, &fresh);
  else if (outcome == CS_EXIT_OK)
    fault(check, shot->film.first, "the script made a film of another length when it was run again",
          CS_EXIT_SCRIPT);
  cs_shot_close(&fresh);
  cs_mem_free(check->context->memory, check->names,
              (size_t)shot->film.count * sizeof *check->names);
  if (outcome == CS_EXIT_OK && !cs_interrupt_signal())
    summarise(check, shot);
  return outcome == CS_EXIT_OK ? check->outcome : outcome;
}

cs_exit cs_check_run(celspan_context *context, const cs_request *request) {
  checkup check = {.context = context, .request = request};
  cs_shot shot;
  cs_exit outcome = cs_shot_open(context, request, &shot);
  if (outcome == CS_EXIT_OK)
    outcome = run(&check, &shot);
  cs_shot_close(&shot);
  cs_mem_free(context->memory, check.told, check.told_capacity * sizeof *check.told);
  return outcome;
}
