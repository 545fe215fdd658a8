/* celspan check SCRIPT: builds every frame and renders none.
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
#include "cli/script.h"
#include "cli/verbs.h"
#include "scene/scene.h"

typedef struct scene_name {
  bool is_known; /* false: not built, or it contains procedures, which cannot be compared */
  cs_hash hash;
} scene_name;

typedef struct checkup {
  celspan_context *context;
  const cs_request *request;
  scene_name *names;
  size_t fault_count, frames_at_fault;
  cs_hash *reported; /* of the sentences reported so far; owned */
  size_t reported_count, reported_capacity;
  cs_exit outcome;
} checkup;

static bool is_new(checkup *check, const char *sentence) {
  cs_hash hash = cs_hash_begin(0);
  cs_hash_text(&hash, sentence);
  hash = cs_hash_end(hash);
  for (size_t i = 0; i < check->reported_count; i++)
    if (check->reported[i].a == hash.a && check->reported[i].b == hash.b)
      return false;
  /* Without memory to remember it, the sentence may be reported twice. */
  if (cs_mem_reserve(check->context, (void **)&check->reported, &check->reported_capacity,
                     check->reported_count + 1, sizeof *check->reported) == CELSPAN_OK)
    check->reported[check->reported_count++] = hash;
  return true;
}

/* Leaves "frame N: " out of a sentence, so that equal faults of many frames are reported once. */
static void copy_without_frame(char *out, size_t size, const char *sentence, int64_t frame) {
  char label[40];
  snprintf(label, sizeof label, "frame %lld: ", (long long)frame);
  const char *at = strstr(sentence, label);
  int before = at ? (int)(at - sentence) : 0;
  snprintf(out, size, "%.*s%s", before, sentence, at ? at + strlen(label) : sentence);
}

static void fault(checkup *check, int64_t frame, const char *message, cs_exit code) {
  char sentence[1024];
  copy_without_frame(sentence, sizeof sentence, message, frame);
  if (cs_interrupt_signal())
    return; /* the frame did not fail: it was stopped */
  check->frames_at_fault++;
  if (check->outcome == CS_EXIT_OK)
    check->outcome = code;
  if (!is_new(check, sentence))
    return;
  check->fault_count++;
  cs_report_error("frame %lld: %s", (long long)frame, sentence);
}

static void name_scene(const cs_script *script, scene_name *out) {
  const cs_film_frame *frame = &script->frame;
  *out = (scene_name){!cs_scene_has_procedure(frame->exposures, frame->count),
                      cs_scene_hash(frame->exposures, frame->count)};
}

static bool is_same(const scene_name *a, const scene_name *b) {
  return a->is_known && b->is_known && a->hash.a == b->hash.a && a->hash.b == b->hash.b;
}

static void check_pictures(checkup *check, const cs_script *script, int64_t frame) {
  for (size_t i = 0; i < script->frame.count; i++) {
    celspan_status status =
        celspan_rostrum_check(check->context, script->frame.exposures[i].rostrum);
    if (status != CELSPAN_OK)
      fault(check, frame, celspan_context_error(check->context), cs_report_exit(status));
  }
}

static void first_pass(checkup *check, cs_script *script) {
  for (int64_t i = 0; i < script->film.count && !cs_interrupt_signal(); i++) {
    int64_t frame = script->film.first + i;
    celspan_status status = cs_script_try(script, frame);
    if (status != CELSPAN_OK) {
      fault(check, frame, celspan_context_error(check->context), cs_report_exit(status));
      continue;
    }
    name_scene(script, &check->names[i]);
    check_pictures(check, script, frame);
  }
}

static void second_pass(checkup *check, cs_script *script) {
  static const char *const IMPURE =
      "the frame function is not pure: asked again in another order it gave another scene; let it "
      "depend on nothing but its argument";
  for (int64_t i = script->film.count - 1; i >= 0 && !cs_interrupt_signal(); i--) {
    scene_name again = {.is_known = false};
    if (!check->names[i].is_known)
      continue;
    if (cs_script_try(script, script->film.first + i) == CELSPAN_OK)
      name_scene(script, &again);
    if (!is_same(&again, &check->names[i]))
      fault(check, script->film.first + i, IMPURE, CS_EXIT_SCRIPT);
  }
}

static void summarise(const checkup *check, const cs_script *script) {
  if (check->fault_count)
    cs_report_note("%zu %s, met %zu %s in %lld frames", check->fault_count,
                   check->fault_count == 1 ? "fault" : "faults", check->frames_at_fault,
                   check->frames_at_fault == 1 ? "time" : "times", (long long)script->film.count);
  else
    cs_report_note("%lld %s checked: no faults", (long long)script->film.count,
                   script->film.count == 1 ? "frame" : "frames");
}

static cs_exit run(checkup *check, cs_script *script) {
  check->names =
      cs_mem_array(check->context->memory, (size_t)script->film.count, sizeof *check->names);
  if (!check->names) {
    cs_report_error("no memory to remember %lld frames", (long long)script->film.count);
    return CS_EXIT_MEMORY;
  }
  first_pass(check, script);
  cs_script fresh;
  cs_exit outcome = cs_script_open(check->context, check->request, &fresh);
  if (outcome == CS_EXIT_OK && fresh.film.count == script->film.count)
    second_pass(check, &fresh);
  else if (outcome == CS_EXIT_OK)
    fault(check, script->film.first,
          "the script made a film of another length when it was run again", CS_EXIT_SCRIPT);
  cs_script_close(&fresh);
  cs_mem_free(check->context->memory, check->names,
              (size_t)script->film.count * sizeof *check->names);
  if (outcome == CS_EXIT_OK && !cs_interrupt_signal())
    summarise(check, script);
  return outcome == CS_EXIT_OK ? check->outcome : outcome;
}

cs_exit cs_verb_check(celspan_context *context, const cs_request *request) {
  checkup check = {.context = context, .request = request};
  cs_script script;
  cs_exit outcome = cs_script_open(context, request, &script);
  if (outcome == CS_EXIT_OK)
    outcome = run(&check, &script);
  cs_script_close(&script);
  cs_mem_free(context->memory, check.reported, check.reported_capacity * sizeof *check.reported);
  return outcome;
}
