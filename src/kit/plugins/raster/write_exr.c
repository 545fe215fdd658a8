/* OpenEXR: half or float. */
#include <stdlib.h>

#include "plugins/raster/write.h"
#include "writers/exr/exr.h"

typedef struct writing {
  cs_exr exr;
  cs_exr_picture picture;
  cs_exr_channel channels[CS_PICTURE_CHANNELS];
  cs_exr_timing timing;
  cs_exr_attribute attributes[5];
  size_t row; /* bytes */
  cs_write_target *target;
  void *memory;
} writing;

static const char *name_of(const cs_picture_output *output, int channel) {
  static const char *const usual[] = {"R", "G", "B", "A"};
  return output->names ? output->names[channel] : output->channels == 1 ? "Y" : usual[channel];
}

static void describe(writing *w, const cs_picture_output *output) {
  size_t value = output->depth == CELSPAN_DEPTH_FLOAT ? 4 : 2, count = (size_t)output->channels;
  for (size_t i = 0; i < count; i++)
    w->channels[i] = (cs_exr_channel){.name = name_of(output, (int)i),
                                      .type = value == 2 ? CS_EXR_HALF : CS_EXR_FLOAT,
                                      .offset = i * value,
                                      .stride = count * value};
  cs_exr_sort(w->channels, count);
  cs_exr_attribute *end = w->attributes;
  *end++ = cs_exr_text("celspan:colour", output->colour);
  *end++ = cs_exr_text("Software", output->software);
  cs_exr_time(&w->timing, output->frames_second, output->frame);
  for (size_t i = 0; i < w->timing.count; i++)
    *end++ = w->timing.attributes[i];
  if (output->title)
    *end++ = cs_exr_text("comments", output->title);
  w->picture = (cs_exr_picture){.width = output->width,
                                .height = output->height,
                                .channels = w->channels,
                                .channel_count = count,
                                .attributes = w->attributes,
                                .attribute_count = (size_t)(end - w->attributes),
                                .primaries = output->has_primaries ? output->primaries : NULL};
}

static bool put(void *user, uint64_t offset, const void *bytes, size_t size) {
  cs_write_target *target = user;
  target->at = offset;
  return cs_write_put(target, bytes, size);
}

static void destroy(void *self) {
  writing *w = self;
  free(w->memory);
  free(w);
}

static void *begin(const cs_picture_output *output, cs_write_target *target) {
  writing *w = calloc(1, sizeof *w);
  if (!w)
    return NULL;
  w->row = cs_write_row(output);
  w->target = target;
  describe(w, output);
  w->memory = malloc(cs_exr_memory(&w->picture));
  if (!w->memory) {
    destroy(w);
    return NULL;
  }
  /* A failure stays in the target. */
  (void)cs_exr_begin(&w->exr, &w->picture, (cs_exr_target){put, target}, w->memory);
  return w;
}

/* Only packing fails without a failure of the target: zlib takes memory for it. */
static bool put_rows(void *self, int32_t count, const unsigned char *rows) {
  writing *w = self;
  for (int32_t i = 0; i < count && !w->target->has_failed; i++)
    if (!cs_exr_row(&w->exr, rows + (size_t)i * w->row)) {
      w->target->lacks_memory = !w->target->has_failed;
      return false;
    }
  return true;
}

static bool end(void *self) {
  writing *w = self;
  return cs_exr_end(&w->exr);
}

const cs_write_format cs_write_exr = {"openexr", begin, put_rows, end, destroy};
