/* The kind of a file, by its first bytes: artwork, which is shown as a film, or something else.
 *
 * INVARIANT: nothing here raises, except cs_artwork_push_film.
 */
#pragma once

#include <lua.h>

typedef enum cs_artwork {
  CS_ARTWORK_NONE,    /* also if the file does not exist */
  CS_ARTWORK_FOLDER,  /* layers of a painting, or pictures */
  CS_ARTWORK_ARCHIVE, /* OpenRaster or Krita */
  CS_ARTWORK_PSD,
  CS_ARTWORK_SVG,
  CS_ARTWORK_LOTTIE, /* JSON, or a dotLottie archive */
  CS_ARTWORK_FILES,  /* the pattern of numbered pictures, perhaps of none */
  CS_ARTWORK_MOVIE   /* what may be one: cs_artwork_push_film finds out */
} cs_artwork;

/* Never CS_ARTWORK_MOVIE. */
cs_artwork cs_artwork_of(const char *path);
/* Pushes the film of an archive, a PSD, an SVG, a Lottie animation, numbered pictures or a movie;
 * nil: the file is not a movie. Notes about parts that are not shown
 * are passed to the global function `print`. Raises. */
void cs_artwork_push_film(lua_State *L, const char *path, cs_artwork kind);
