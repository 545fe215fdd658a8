#include "writers/apart/mattes.h"

#include <stdio.h>
#include <string.h>

#include "inside/scene.h"
#include "writers/apart/apart.h"

/* ---------------------------------------------------------------- names */

static celspan_status find_matte(cs_mattes *mattes, const char *name, size_t *out) {
  for (*out = 0; *out < mattes->count; ++*out)
    if (strcmp(mattes->mattes[*out].name, name) == 0)
      return CELSPAN_OK;
  CS_TRY(CS_ARRAY_RESERVE(mattes->context, mattes->mattes, mattes->count + 1));
  snprintf(mattes->mattes[mattes->count++].name, sizeof mattes->mattes->name, "%s", name);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- pieces of an object */

static const cs_boolean *boolean_of(const celspan_object *object) {
  return object->data->kind == CS_PRIMITIVE_DATA_BOOLEAN ? object->data->boolean : NULL;
}

/* How many operands, from the first, are painted over each other: what is left without one of them
 * is what the others show. */
static size_t art_count(const cs_boolean *boolean) {
  switch ((unsigned)boolean->op) {
  case CELSPAN_OPERATOR_UNION:
    return boolean->operand_count;
  case CELSPAN_OPERATOR_DIFFERENCE:
  case CELSPAN_OPERATOR_CLIP:
  case CS_OPERATOR_MATTE:
    return boolean->operand_count > 0;
  default:
    return 0;
  }
}

static bool has_name(const celspan_object *object) { return object->mark.name != NULL; }

/* Whether names inside the object tell pieces of it apart. */
static bool is_divided(const celspan_object *object) {
  const cs_boolean *boolean = boolean_of(object);
  size_t count = boolean ? art_count(boolean) : 0;
  for (size_t i = 0; i < count; i++)
    if (has_name(boolean->operands[i]) || is_divided(boolean->operands[i]))
      return true;
  return false;
}

/* The pieces of a stack in their order. Each call of `piece` may end the walk by an error. */
typedef struct survey {
  celspan_status (*piece)(struct survey *survey, const char *name);
  void *user;
} survey;

static celspan_status survey_object(survey *s, const celspan_object *object, const char *name) {
  name = has_name(object) ? cs_mark_name(object->mark) : name;
  if (!is_divided(object))
    return s->piece(s, name);
  const cs_boolean *boolean = boolean_of(object);
  for (size_t i = 0; i < art_count(boolean); i++)
    CS_TRY(survey_object(s, boolean->operands[i], name));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- without the first pieces */

static void unref_all(celspan_object **objects, size_t count) {
  for (size_t i = 0; i < count; i++)
    celspan_object_unref(objects[i]);
}

static celspan_status leave_out(celspan_context *context, celspan_object *object, size_t *pieces,
                                celspan_object **out);

/* *left: how many objects are left of those in the list; they are new references in `out`, which
 * has room for all. */
static celspan_status leave_out_list(celspan_context *context, celspan_object *const *objects,
                                     size_t count, size_t *pieces, celspan_object **out,
                                     size_t *left) {
  *left = 0;
  for (size_t i = 0; i < count; i++) {
    celspan_status status = leave_out(context, objects[i], pieces, &out[*left]);
    if (status != CELSPAN_OK) {
      unref_all(out, *left);
      return status;
    }
    *left += out[*left] != NULL;
  }
  return CELSPAN_OK;
}

/* The operands that are not art stay; without art there is nothing. */
static celspan_status rebuild(celspan_context *context, celspan_object *object, size_t *pieces,
                              celspan_object **operands, celspan_object **out) {
  const cs_boolean *boolean = object->data->boolean;
  size_t art = art_count(boolean), left;
  CS_TRY(leave_out_list(context, boolean->operands, art, pieces, operands, &left));
  *out = NULL;
  if (left == 0)
    return CELSPAN_OK;
  size_t count = left;
  for (size_t i = art; i < boolean->operand_count; i++)
    operands[count++] = boolean->operands[i];
  celspan_status status = cs_boolean_with(context, object, operands, count, out);
  unref_all(operands, left);
  return status;
}

/* *out: the object without its first *pieces pieces, NULL if none is left; *pieces: how many are
 * still to be left out. */
static celspan_status leave_out(celspan_context *context, celspan_object *object, size_t *pieces,
                                celspan_object **out) {
  bool is_divisible = *pieces > 0 && is_divided(object);
  if (!is_divisible) {
    *out = *pieces > 0 ? NULL : celspan_object_ref(object);
    *pieces -= *pieces > 0;
    return CELSPAN_OK;
  }
  size_t count = object->data->boolean->operand_count;
  celspan_object **operands;
  CS_TRY(CS_MAKE(context, operands, count));
  celspan_status status = rebuild(context, object, pieces, operands, out);
  cs_mem_free(context->memory, operands, count * sizeof *operands);
  return status;
}

static celspan_status cel_without(celspan_context *context, celspan_cel *cel, size_t pieces,
                                  celspan_cel **out) {
  celspan_object **objects;
  size_t left;
  if (pieces == 0) {
    *out = celspan_cel_ref(cel);
    return CELSPAN_OK;
  }
  CS_TRY(CS_MAKE(context, objects, cel->object_count));
  celspan_status status =
      leave_out_list(context, cel->objects, cel->object_count, &pieces, objects, &left);
  if (status == CELSPAN_OK) {
    status = cs_cel_with(context, cel, objects, left, out);
    unref_all(objects, left);
  }
  cs_mem_free(context->memory, objects, cel->object_count * sizeof *objects);
  return status;
}

/* ---------------------------------------------------------------- steps */

/* The place in the stack of an exposure. */
typedef struct place {
  cs_mattes *mattes;
  const celspan_exposure *exposure;
  size_t cel, piece; /* before which everything is left out */
  size_t first;      /* the first step of this exposure */
} place;

/* The cel without the light through it, which would make all alphas whole. */
static celspan_status unlit(celspan_context *context, const celspan_cel *cel, celspan_cel **out) {
  return cs_cel_bare(context, cel, (cs_cel_without){.lights = true}, out);
}

/* The cels from the place on. *made: how many there are, also after an error. */
static celspan_status list_rest(const place *p, celspan_cel **cels, size_t *made) {
  const celspan_rostrum *from = p->exposure->rostrum;
  celspan_context *context = p->mattes->context;
  celspan_cel *first;
  *made = 0;
  CS_TRY(cel_without(context, from->cels[p->cel], p->piece, &first));
  celspan_status status = unlit(context, first, &cels[0]);
  celspan_cel_unref(first);
  CS_TRY(status);
  for (*made = 1; *made < from->cel_count - p->cel; ++*made)
    CS_TRY(unlit(context, from->cels[p->cel + *made], &cels[*made]));
  return CELSPAN_OK;
}

/* cels: with room for those from the place on. */
static celspan_status show_rest(const place *p, celspan_cel **cels, celspan_rostrum **out) {
  const cs_light none = {0};
  size_t made;
  celspan_status status = list_rest(p, cels, &made);
  if (status == CELSPAN_OK)
    status = cs_rostrum_change(p->mattes->context, p->exposure->rostrum, cels, made, none, out);
  for (size_t i = 0; i < made; i++)
    celspan_cel_unref(cels[i]);
  return status;
}

static celspan_status add_step(const place *p, size_t matte) {
  cs_mattes *mattes = p->mattes;
  celspan_context *context = mattes->context;
  size_t count = p->exposure->rostrum->cel_count - p->cel;
  celspan_rostrum *rostrum;
  celspan_cel **cels;
  if (mattes->step_count == CS_MATTES_MOST)
    return cs_fail(context, CELSPAN_LIMIT,
                   "the frame has more than %d pieces with different names over each other, and "
                   "as many mattes are made at most: name groups instead of their parts",
                   CS_MATTES_MOST);
  CS_TRY(CS_ARRAY_RESERVE(context, mattes->steps, mattes->step_count + 1));
  CS_TRY(CS_MAKE(context, cels, count));
  celspan_status status = show_rest(p, cels, &rostrum);
  cs_mem_free(context->memory, cels, count * sizeof *cels);
  CS_TRY(status);
  mattes->steps[mattes->step_count++] =
      (cs_matte_step){.exposure = {rostrum, p->exposure->weight}, .matte = matte};
  return CELSPAN_OK;
}

/* A piece of the same matte as the one behind it needs no step of its own, nor do pieces without a
 * name that nothing with a name is behind. */
static bool needs_step(const place *p, size_t matte) {
  const cs_mattes *mattes = p->mattes;
  bool is_first = mattes->step_count == p->first;
  return matte != (is_first ? CS_MATTE_NONE : mattes->steps[mattes->step_count - 1].matte);
}

/* name: "" for none. */
static celspan_status take_piece(place *p, const char *name) {
  size_t matte = CS_MATTE_NONE;
  if (name[0])
    CS_TRY(find_matte(p->mattes, name, &matte));
  celspan_status status = needs_step(p, matte) ? add_step(p, matte) : CELSPAN_OK;
  p->piece++;
  return status;
}

static celspan_status call_take_piece(survey *s, const char *name) {
  return take_piece(s->user, name);
}

static celspan_status take_objects(place *p, const celspan_cel *cel) {
  survey s = {call_take_piece, p};
  for (size_t i = 0; i < cel->object_count; i++)
    CS_TRY(survey_object(&s, cel->objects[i], cs_mark_name(cel->mark)));
  return CELSPAN_OK;
}

static celspan_status take_cel(place *p, const celspan_cel *cel) {
  char plain[32];
  const char *name = cs_mark_name(cel->mark);
  snprintf(plain, sizeof plain, "cel_%zu", p->cel + 1);
  return take_piece(p, name[0] ? name : plain);
}

static celspan_status take_exposure(cs_mattes *mattes, const celspan_exposure *exposure,
                                    bool by_objects) {
  place p = {.mattes = mattes, .exposure = exposure, .first = mattes->step_count};
  for (; p.cel < exposure->rostrum->cel_count; p.cel++) {
    const celspan_cel *cel = exposure->rostrum->cels[p.cel];
    p.piece = 0;
    CS_TRY(by_objects ? take_objects(&p, cel) : take_cel(&p, cel));
  }
  if (mattes->step_count > p.first)
    mattes->steps[mattes->step_count - 1].is_last = true;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- all */

celspan_status cs_mattes_make(celspan_context *context, const celspan_exposure *exposures,
                              size_t count, bool by_objects, cs_mattes *out) {
  *out = (cs_mattes){.context = context};
  for (size_t i = 0; i < count; i++)
    if (cs_apart_shows(&exposures[i]))
      CS_TRY(take_exposure(out, &exposures[i], by_objects));
  return CELSPAN_OK;
}

void cs_mattes_finish(cs_mattes *mattes) {
  if (!mattes->context)
    return;
  for (size_t i = 0; i < mattes->step_count; i++)
    celspan_rostrum_unref(mattes->steps[i].exposure.rostrum);
  CS_ARRAYS_FREE(mattes->context->memory, mattes, mattes, steps);
  *mattes = (cs_mattes){0};
}
