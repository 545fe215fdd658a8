#include "scene/inspect.h"

#include <stdio.h>

#include "scene/check.h"
#include "scene/scene.h"
#include "scene/walk.h"

typedef struct listener {
  cs_inspection *inspection;
  bool (*report)(void *user, const celspan_fault *fault);
  void *user;
  size_t cel, primitive;    /* the place that the walk has reached */
  const celspan_cel *named; /* likewise */
  celspan_status first;     /* of the first fault */
  char sentence[CS_ERROR_SIZE];
} listener;

/* As cs_mark_describe, of what a fault tells. */
static cs_mark_text describe(const char *name, celspan_origin origin) {
  cs_mark_text out = {""};
  int length = 0;
  if (name && name[0])
    length = snprintf(out.text, sizeof out.text, " '%.255s'", name);
  if (origin.line > 0)
    snprintf(out.text + length, sizeof out.text - (size_t)length, " (%.255s:%d)", origin.source,
             (int)origin.line);
  return out;
}

void cs_inspect_place(const celspan_fault *fault, char out[CS_INSPECT_PLACE]) {
  cs_mark_text cel = describe(fault->cel_name, fault->cel_origin);
  cs_mark_text primitive = describe(fault->name, fault->origin);
  if (fault->cel == 0)
    snprintf(out, CS_INSPECT_PLACE, "a light of the rostrum");
  else if (fault->primitive == 0)
    snprintf(out, CS_INSPECT_PLACE, "cel %zu%s, a light", fault->cel, cel.text);
  else
    snprintf(out, CS_INSPECT_PLACE, "cel %zu%s, primitive %zu%s", fault->cel, cel.text,
             fault->primitive, primitive.text);
}

static bool is_fault(celspan_status status) {
  return status != CELSPAN_OK && status != CELSPAN_NO_MEMORY && status != CELSPAN_CANCELLED;
}

static celspan_status report(listener *to, const celspan_fault *fault) {
  char place[CS_INSPECT_PLACE];
  cs_inspect_place(fault, place);
  if (to->first == CELSPAN_OK)
    snprintf(to->sentence, sizeof to->sentence, "%.500s: %.500s", place, fault->message);
  if (to->first == CELSPAN_OK)
    to->first = fault->status;
  return to->report(to->user, fault) ? CELSPAN_OK : CELSPAN_CANCELLED;
}

static celspan_status examine(const cs_walk *walk, const cs_primitive_data *primitive,
                              const celspan_texture *texture) {
  listener *to = walk->user;
  to->primitive += primitive != NULL;
  if (!texture || !texture->variation->picture)
    return CELSPAN_OK;
  celspan_status status = cs_inspection_examine(to->inspection, texture->variation->picture);
  if (status == CELSPAN_OK && texture->variation->medium)
    status = cs_inspection_examine(to->inspection, texture->variation->medium);
  celspan_fault fault = {.status = status,
                         .message = celspan_context_error(walk->context),
                         .cel = to->cel,
                         .primitive = primitive ? to->primitive : 0,
                         .cel_name = "",
                         .name = "",
                         .cel_origin = {"", 0},
                         .origin = {"", 0}};
  if (to->named) {
    fault.cel_name = celspan_cel_name(to->named);
    fault.cel_origin = celspan_cel_origin(to->named);
  }
  if (primitive) {
    fault.name = celspan_object_name(walk->object);
    fault.origin = celspan_object_origin(walk->object);
  }
  return is_fault(status) ? report(to, &fault) : status;
}

static celspan_status examine_all(listener *to, const celspan_rostrum *rostrum) {
  cs_walk walk = {.context = to->inspection->context, .call = examine, .user = to};
  CS_TRY(cs_walk_lights(&walk, &rostrum->front, &rostrum->back));
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    to->cel = i + 1;
    to->named = rostrum->cels[i];
    to->primitive = 0;
    CS_TRY(cs_walk_cel(&walk, rostrum->cels[i]));
  }
  return CELSPAN_OK;
}

celspan_status cs_inspect_rostrum(cs_inspection *inspection, const celspan_rostrum *rostrum,
                                  bool (*call)(void *user, const celspan_fault *fault),
                                  void *user) {
  listener to = {.inspection = inspection, .report = call, .user = user, .first = CELSPAN_OK};
  celspan_status status = examine_all(&to, rostrum);
  if (status == CELSPAN_NO_MEMORY || to.first == CELSPAN_OK)
    return status;
  return cs_fail(inspection->context, to.first, "%s", to.sentence);
}

static bool report_nobody(void *user, const celspan_fault *fault) {
  (void)user, (void)fault;
  return true;
}

celspan_status celspan_rostrum_inspect(celspan_context *context, const celspan_rostrum *rostrum,
                                       const celspan_inspect_desc *desc) {
  CS_TRY(cs_check_given(context, "inspect", "rostrum", rostrum));
  CS_TRY(cs_check_given(context, "inspect", "desc", desc));
  CS_TRY(cs_check_version(context, "inspect", desc->struct_size, sizeof *desc));
  cs_inspection inspection = {
      .context = context, .is_deep = desc->is_deep, .progress = desc->progress, .user = desc->user};
  celspan_status status = cs_inspect_rostrum(
      &inspection, rostrum, desc->report ? desc->report : report_nobody, desc->user);
  cs_inspection_finish(&inspection);
  return status;
}
