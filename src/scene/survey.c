/* Going through everything a rostrum holds: counting, and reading the headers of its pictures. */
#include "scene/scene.h"

/* Called for every primitive, as often as it is reached. */
typedef celspan_status (*visitor)(celspan_context *context, void *user, const cs_body *primitive);

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static celspan_status visit(celspan_context *context, celspan_object *const *objects, size_t count,
                            visitor call, void *user) {
  for (size_t i = 0; i < count; i++) {
    const cs_body *body = objects[i]->body;
    CS_TRY(body->kind == CS_BODY_BOOLEAN
               ? visit(context, body->operands, body->operand_count, call, user)
               : call(context, user, body));
  }
  return CELSPAN_OK;
}

static celspan_status visit_rostrum(celspan_context *context, const celspan_rostrum *rostrum,
                                    visitor call, void *user) {
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    const celspan_cel *cel = rostrum->cels[i];
    CS_TRY(visit(context, cel->objects, cel->object_count, call, user));
  }
  return CELSPAN_OK;
}

static const cs_picture *picture_of(const cs_body *primitive) {
  return primitive->texture ? primitive->texture->picture : NULL;
}

static celspan_status count_primitive(celspan_context *context, void *user,
                                      const cs_body *primitive) {
  (void)context;
  celspan_rostrum_counts *counts = user;
  counts->primitives++;
  counts->pictures += picture_of(primitive) != NULL;
  return CELSPAN_OK;
}

void celspan_rostrum_count(const celspan_rostrum *rostrum, celspan_rostrum_counts *out) {
  *out = (celspan_rostrum_counts){.cels = rostrum->cel_count};
  celspan_status never_fails = visit_rostrum(NULL, rostrum, count_primitive, out);
  (void)never_fails;
}

static celspan_status check_primitive(celspan_context *context, void *user,
                                      const cs_body *primitive) {
  (void)user;
  celspan_picture_info info;
  const cs_picture *picture = picture_of(primitive);
  return picture ? cs_picture_info(context, picture, &info) : CELSPAN_OK;
}

celspan_status celspan_rostrum_check(celspan_context *context, const celspan_rostrum *rostrum) {
  return visit_rostrum(context, rostrum, check_primitive, NULL);
}
