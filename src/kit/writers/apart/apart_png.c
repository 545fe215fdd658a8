/* The frame and its layers as pictures: x.0001.png, x.hand.0001.png, x.wall.0001.png. The frame
 * comes first, so that a picture that cannot be read is reported with its place in the frame. */
#include <stdio.h>
#include <string.h>

#include "inside/frames.h"
#include "writers/apart/apart.h"

/* Bytes of a file's name, of its temporary name more, and of the number behind an equal name. */
enum { NAME_MOST = 255, MORE = 24, NUMBER = 24 };

/* The path with a layer's name, which is new. */
static celspan_status name_file(const cs_apart *apart, const char *path, size_t place,
                                const char *name, char **out, size_t *size) {
  bool has_rest = path[place] != '\0';
  *size = strlen(path) + strlen(name) + 2;
  CS_TRY(CS_MAKE(apart->context, *out, *size));
  snprintf(*out, *size, "%.*s%s%s%s%s", (int)place, path, has_rest ? "" : ".", name,
           has_rest ? "." : "", path + place);
  return CELSPAN_OK;
}

typedef struct writing {
  cs_apart apart;
  cs_apart_progress progress;
  size_t place; /* the place of the names of layers in the path */
  const char *path;
  const celspan_file_desc *file;
} writing;

static celspan_status write_picture(writing *w, const celspan_frame_desc *desc, const char *path,
                                    const celspan_file_desc *file) {
  celspan_frame_desc frame = *desc;
  cs_apart_report_to(&w->progress, &frame);
  return celspan_frame_write(w->apart.context, &frame, path, file, NULL);
}

static celspan_status write_layer(writing *w, const cs_apart_layer *layer) {
  celspan_frame_desc frame = *w->progress.desc;
  celspan_file_desc alone = *w->file;
  char *name;
  size_t size;
  frame.exposures = layer->exposures;
  frame.exposure_count = layer->count;
  alone.is_opaque = false; /* the frame may be */
  CS_TRY(name_file(&w->apart, w->path, w->place, layer->name, &name, &size));
  celspan_status status = write_picture(w, &frame, name, &alone);
  cs_mem_free(w->apart.context->memory, name, size);
  return status;
}

/* The contents that are noted of a frame are those of its own file. */
static celspan_status write_all(writing *w) {
  celspan_context *context = w->apart.context;
  struct cs_file_contents *noted = context->contents;
  w->progress.count = w->apart.count + 1;
  CS_TRY(write_picture(w, w->progress.desc, w->path, w->file));
  celspan_status status = CELSPAN_OK;
  context->contents = NULL;
  for (size_t i = 0; i < w->apart.count && status == CELSPAN_OK; i++)
    status = write_layer(w, &w->apart.layers[i]);
  context->contents = noted;
  return status;
}

celspan_status cs_apart_write_png(celspan_context *context, cs_apart_contents contents,
                                  const celspan_frame_desc *desc, const char *path,
                                  const celspan_file_desc *file) {
  const char *slash = strrchr(path, '/');
  size_t used = strlen(slash ? slash + 1 : path) + MORE;
  writing w = {.progress = {.desc = desc}, .place = contents.place, .path = path, .file = file};
  CS_TRY(cs_frame_check(context, desc));
  if (used + NUMBER > NAME_MOST)
    return cs_fail(context, CELSPAN_LIMIT, "%s: the name has no place for those of layers", path);
  CS_TRY(cs_apart_make(context, desc->exposures, desc->exposure_count, used, &w.apart));
  celspan_status status = write_all(&w);
  cs_apart_finish(&w.apart);
  return status;
}
