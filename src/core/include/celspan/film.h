/* What a film says of itself. Functions of celspan/lua.h read it from the film of a script.
 *
 *   parameters   values that the film takes from outside      marks   names of its frames
 *   sounds       the files that are heard, and when
 *
 * Texts and lists live as long as the value in Lua that they were read from. A structure that is
 * read is begun with its macro, which sets struct_size.
 */
#ifndef CELSPAN_FILM_H
#define CELSPAN_FILM_H

#include "celspan/celspan.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct celspan_film {
  size_t struct_size;
  int32_t width, height; /* film units, and pixels unless another size is wanted */
  double frames_second;
  /* the frames are first .. first + count - 1; count 0: the structure is not a film */
  int64_t first, count;
  const char *title; /* NULL: none */
  size_t mark_count;
} celspan_film;

CELSPAN_RESULT(celspan_film)
#define CELSPAN_FILM (celspan_film_initial())

typedef enum celspan_parameter_kind {
  CELSPAN_PARAMETER_TEXT = 0,
  CELSPAN_PARAMETER_FILE,
  CELSPAN_PARAMETER_NUMBER,
  CELSPAN_PARAMETER_BOOLEAN,
  CELSPAN_PARAMETER_CHOICE,
  CELSPAN_PARAMETER_COLOUR,
  CELSPAN_PARAMETER_POINT, /* text: "120,80" */
  CELSPAN_PARAMETER_EASE   /* text: the name of a curve */
} celspan_parameter_kind;

typedef struct celspan_parameter {
  size_t struct_size;
  const char *name;
  celspan_parameter_kind kind;
  const char *text;           /* the default, as celspan_lua_set takes a value */
  double number;              /* the default of a number; of a boolean 1 or 0 */
  double least, most;         /* the range of a number; without a bound -INFINITY and INFINITY */
  const char *const *choices; /* the choices of a choice */
  size_t choice_count;
  const char *about; /* NULL: none */
} celspan_parameter;

CELSPAN_RESULT(celspan_parameter)
#define CELSPAN_PARAMETER (celspan_parameter_initial())

typedef struct celspan_mark {
  size_t struct_size;
  const char *name;
  int64_t first, last; /* frames; without a last frame of its own, it extends to the next mark */
} celspan_mark;

CELSPAN_RESULT(celspan_mark)
#define CELSPAN_MARK (celspan_mark_initial())

/* Seconds of the film in which a sound is heard, with linear fades at its ends. */
typedef struct celspan_sound_passage {
  double begin, end; /* end: INFINITY where the file ends by itself */
  double fade_in, fade_out;
} celspan_sound_passage;

/* A sound that makes another one lower while it is heard. */
typedef struct celspan_sound_ducker {
  size_t sound;           /* its place among the sounds of the film, from 0 */
  double gain;            /* the gain of the other sound, 0..1 */
  double attack, release; /* seconds of the ramps before and after */
} celspan_sound_ducker;

/* A file that is heard. */
typedef struct celspan_sound {
  size_t struct_size;
  const char *path; /* the path of a file, or an address data:... that contains it */
  double start;     /* second of the film at which second 0 of the file is or would be heard */
  double speed;     /* 2: twice as fast, at the same pitch */
  double gain[2];   /* the gain of the left and the right channel: factors of the amplitude */
  const celspan_sound_passage *passages; /* the sound's own, and of films in films: all are open */
  size_t passage_count;                  /* while it is heard; 1 or more */
  const celspan_sound_ducker *duckers;
  size_t ducker_count;
} celspan_sound;

CELSPAN_RESULT(celspan_sound)
#define CELSPAN_SOUND (celspan_sound_initial())

#ifdef __cplusplus
}
#endif
#endif
