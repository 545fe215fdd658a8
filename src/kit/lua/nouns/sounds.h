/* The fields `sound` and `marks` of a film.
 *
 *   sound = "a.wav" | { "a.wav", at = 1 } | { { "a.wav" }, { shot, at = 4 } }
 *      --cs_sounds_check, when the film is made--> the film keeps it as it was written
 *      --cs_sounds_push, when a sound is wanted--> a list with all fields and where the files are
 *
 *   marks = { title = 1, chase = 49 } --cs_marks_push--> cs_film_mark of frames/film/film.h
 */
#pragma once

#include "inside/films.h"
#include "lua/bind/form.h"

/* Checks the field `sound` of a film. Raises. */
void cs_sounds_check(const cs_form *film);
/* Pushes the list of the field `sound` of the fields of a film, at index:
 *
 *   { file or film, number =, path =, tried =, at =, from =, to = or nil, speed =, gain =,
 *     fade_in =, fade_out =, pan =, name =, duck =, under =, duck_depth =,
 *     duck_attack =, duck_release = }
 *
 * number: its place in the field. folder: where files are looked for first, or NULL. Raises only
 * where a file may not be read and out of memory. */
void cs_sounds_push(lua_State *L, int film, const char *folder);

/* Pushes the marks of a film, in the order of their frames, as one piece of memory that also has
 * their names; nil if the film has none. first, count: the frames of the film. Raises. */
void cs_marks_push(const cs_form *film, int64_t first, int64_t count);
/* The marks in the piece of memory at index. */
const cs_film_mark *cs_marks_read(lua_State *L, int index, size_t *count);
