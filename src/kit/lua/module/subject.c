#include "lua/module/subject.h"

#include "inside/context.h"
#include "lua/bind/userdata.h"
#include "lua/nouns/lua_film.h"
#include "lua/nouns/shown.h"

#define FRAME "celspan.subject"

CS_HOLDER_FINISH(finish_frame, cs_film_frame_finish)

static int64_t number_of(const cs_options *options, const cs_film_info *film) {
  if (!options->has_frame)
    return film->first;
  int64_t last = film->first + film->count - 1;
  if (options->frame < film->first || options->frame > last)
    cs_form_fail(&options->form, "frame %d is not in the film, which has frames %I to %I",
                 options->frame, (LUAI_UACINT)film->first, (LUAI_UACINT)last);
  return options->frame;
}

static celspan_status read_film(lua_State *L, cs_options *options) {
  cs_film_info film;
  cs_lua_film_read(L, 1, &film);
  int64_t number = number_of(options, &film);
  cs_film_frame *frame = cs_userdata_push_holder(L, FRAME, sizeof *frame, finish_frame);
  CS_TRY(cs_lua_film_build(L, 1, number, frame));
  cs_options_use_film(options, &film);
  cs_film_expose(&film, frame, &options->desc);
  return CELSPAN_OK;
}

celspan_status cs_subject_read(lua_State *L, const cs_noun *noun, cs_options *options) {
  cs_options_read(L, noun, 2, options);
  if (cs_userdata_test(L, 1, &cs_kind_film))
    return read_film(L, options);
  if (options->has_frame)
    cs_form_fail(&options->form, "field 'frame' is for films, argument 1 is %s",
                 cs_userdata_type(L, 1));
  const char *name = lua_pushfstring(L, "%s: argument 1", noun->name);
  cs_shown_read(L, 1, name, &options->desc);
  return CELSPAN_OK;
}
