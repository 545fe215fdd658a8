/* Where the frames of a run go that are no files of their own: one file, which appears under its
 * name when it is complete, or standard output.
 *
 *   open --> put ... (or put into slots, give, repeat) --> commit | discard
 */
#pragma once

#include "inside/films.h"
#include "program/film/script.h"
#include "video/video.h"
#include "writers/parcels/plot.h"
#include "writers/plane/plane.h"

/* An open outlet. */
typedef struct cs_into {
  cs_script *script;
  const cs_request *request;
  const char *path;
  const celspan_frame_desc *frame; /* the view */
  const cs_sequence *frames;
  const cs_sequence *played; /* the frames whose sound is heard */
  const char *chapters;      /* chapters in a video, as in cs_video_extras; NULL: none */
  const char *captions;      /* subtitles in a video, in the form of its format; NULL: none */
  bool keeps_nothing;
  bool has_noted; /* it was noted that a page has a picture */
  cs_slots raw;   /* for standard output; none: frames are written in rows */
  cs_video video;
  cs_plane_film *plane;
  cs_plot *pages;
} cs_into;

/* `into` is a cs_into, or begins with one: put, give and repeat are functions of a cs_shoot
 * (frames/film/shoot.h), whose user it is. */
typedef struct cs_outlet {
  bool is_file; /* which all frames share */
  cs_exit (*open)(cs_into *into);
  celspan_status (*put)(void *into, const cs_shoot_put *one);
  /* Only outlets whose frames are made in slots have it. */
  size_t (*slots)(const cs_into *into);
  celspan_status (*give)(void *into, size_t slot);
  celspan_status (*repeat)(void *into);
  celspan_status (*commit)(cs_into *into);
  void (*discard)(cs_into *into);
} cs_outlet;

extern const cs_outlet cs_outlet_raw, cs_outlet_video, cs_outlet_plane, cs_outlet_pages;
