#include "bind/subject.h"

#include "base/context.h"
#include "bind/holder.h"
#include "bind/host.h"
#include "bind/lua_film.h"
#include "bind/userdata.h"

#define FRAME "celspan.subject"

/* ---------------------------------------------------------------- the built frame */

static int finish_frame(lua_State *L) {
  cs_film_frame_finish(lua_touserdata(L, 1));
  return 0;
}

/* Pushes the owner of a frame that is built later. */
static cs_film_frame *push_frame(lua_State *L) {
  return cs_holder_push(L, FRAME, sizeof(cs_film_frame), finish_frame);
}

/* ---------------------------------------------------------------- films */

static int64_t read_number(const cs_form *form, const cs_film_info *film) {
  if (!cs_form_has(form, "frame"))
    return film->first;
  int64_t last = film->first + film->count - 1;
  int number = cs_form_integer_or(form, "frame", 0);
  if (number < film->first || number > last)
    cs_form_fail(form, "frame %d is not in the film, which has frames %I to %I", number,
                 (LUAI_UACINT)film->first, (LUAI_UACINT)last);
  return number;
}

static celspan_status read_film(const cs_form *form, celspan_frame_desc *desc) {
  lua_State *L = form->L;
  cs_film_info film;
  cs_lua_film_read(L, 1, &film);
  int64_t number = read_number(form, &film);
  if (!cs_form_has(form, "film")) {
    desc->film_width = film.width;
    desc->film_height = film.height;
  }
  if (!cs_form_has(form, "size")) {
    desc->width = film.width;
    desc->height = film.height;
  }
  cs_film_frame *frame = push_frame(L);
  CS_TRY(cs_lua_film_build(L, 1, number, frame));
  desc->exposures = frame->exposures;
  desc->exposure_count = frame->count;
  return CELSPAN_OK;
}

celspan_status cs_subject_read(const cs_form *form, celspan_frame_desc *desc) {
  lua_State *L = form->L;
  if (cs_userdata_test(L, 1, &cs_kind_film))
    return read_film(form, desc);
  if (cs_form_has(form, "frame"))
    cs_form_fail(form, "field 'frame' is for films, argument 1 is %s", cs_userdata_type(L, 1));
  const char *name = lua_pushfstring(L, "%s: argument 1", form->noun->name);
  cs_options_exposures(L, 1, name, desc);
  return CELSPAN_OK;
}
