/* The captions of a film as a text for videos.
 *
 *   film --lua/celspan/film/subtitles.lua--> SubRip or WebVTT
 */
#pragma once

#include <lua.h>

#include "celspan/celspan.h"

/* Pushes the captions of the film at index in the given seconds from `first` on, as text in the
 * format "srt" or "webvtt": "" if there are none then. Errors: BAD_ARGUMENT, also if a file cannot
 * be read; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_subtitles_push(lua_State *L, int index, const char *form,
                                                 double first, double seconds);
