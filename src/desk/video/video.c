#include "video/video.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "inside/files.h"
#include "inside/sinks.h"

/* ---------------------------------------------------------------- opening */

static size_t frame_size(const cs_video *video, int32_t width, int32_t height) {
  return video->layout == CS_VIDEO_RGBA ? video->stride * (size_t)height
                                        : cs_ycc_size(width, height, video->layout == CS_VIDEO_420);
}

static celspan_status open_file(const cs_video *video, cs_file **file, const char **name) {
  CS_TRY(cs_file_create(video->context, NULL, video->path, file));
  return cs_file_temporary(*file, video->context, name);
}

/* Writes a file that ffmpeg reads. *name: of the file. */
static celspan_status write_extra(cs_video *video, const void *bytes, size_t size, cs_file **file,
                                  const char **name) {
  if (!bytes)
    return CELSPAN_OK;
  CS_TRY(open_file(video, file, name));
  CS_TRY(cs_file_write(*file, video->context, bytes, size));
  return cs_file_temporary(*file, video->context, name);
}

static celspan_status write_extras(cs_video *video, const cs_video_desc *desc) {
  const size_t pixels = (size_t)desc->frames.width * (size_t)desc->frames.height;
  cs_video_extras *extras = &video->extras;
  CS_TRY(write_extra(video, desc->captions, desc->captions ? strlen(desc->captions) : 0,
                     &video->captions, &extras->captions));
  return write_extra(video, desc->poster, 4 * pixels, &video->poster, &extras->poster);
}

/* The files, and the command that writes the first of them. */
static celspan_status prepare(cs_video *video, const cs_video_desc *desc, cs_arguments *command) {
  const char *name;
  CS_TRY(open_file(video, &video->file, &name));
  CS_TRY(write_extras(video, desc));
  if (desc->most_bytes == 0 && !desc->options.codec->is_indexed) {
    cs_video_extras extras = video->extras;
    extras.chapters = desc->chapters;
    cs_video_command_encode(command, desc->format, &desc->options, &desc->frames, &desc->sound,
                            &extras, name);
    return CELSPAN_OK;
  }
  CS_TRY(open_file(video, &video->master, &name));
  cs_video_command_master(command, &desc->options, &desc->frames, &desc->sound, desc->chapters,
                          name);
  return CELSPAN_OK;
}

static void discard_sources(cs_video *video) {
  cs_file_discard(video->master, video->context);
  cs_file_discard(video->captions, video->context);
  cs_file_discard(video->poster, video->context);
}

static void discard_files(cs_video *video) {
  discard_sources(video);
  cs_file_discard(video->file, video->context);
}

static bool is_of_module(const cs_video *video) { return video->options.codec->module != NULL; }

/* Counts what the module will hold. */
static celspan_status reserve(cs_video *video, const cs_video_desc *desc) {
  cs_memory *memory = video->context->memory;
  size_t pixels = (size_t)desc->frames.width * (size_t)desc->frames.height,
         bytes = pixels * desc->options.codec->pixel_bytes;
  if (!cs_account_allows(memory, bytes))
    return cs_fail_memory(video->context);
  cs_account_beside(memory, bytes);
  video->beside = bytes;
  return CELSPAN_OK;
}

static celspan_status open_picture(cs_video *video, const cs_video_desc *desc) {
  const cs_video_options *options = &desc->options;
  const celspan_coding coding = cs_pixels_resolve(&video->coding, CELSPAN_DEPTH_8);
  const cs_picture_output output = {.name = video->path,
                                    .format = options->codec->module,
                                    .width = desc->frames.width,
                                    .height = desc->frames.height,
                                    .channels = 4,
                                    .depth = coding.depth,
                                    .is_straight = coding.alpha == CELSPAN_ALPHA_STRAIGHT,
                                    .colour = cs_pixels_colour(&coding),
                                    .title = desc->title,
                                    .frames_second = desc->frames.frames_second,
                                    .moving = {.quality = cs_video_quality(options),
                                               .plays = options->plays,
                                               .is_opaque = options->is_opaque,
                                               .primaries = options->primaries,
                                               .transfer = options->transfer}};
  CS_TRY(reserve(video, desc));
  CS_TRY(cs_mem_make(video->context, (void **)&video->pixels, (size_t)desc->frames.height,
                     video->stride));
  return cs_picture_file_open(video->context, &output, &video->picture);
}

static void close_picture(cs_video *video) {
  cs_picture_file_discard(&video->picture, video->context);
  cs_mem_free(video->context->memory, video->pixels, video->stride * (size_t)video->extras.height);
  video->pixels = NULL;
  cs_account_beside(video->context->memory, 0 - video->beside);
  video->beside = 0;
}

static celspan_status give_picture(cs_video *video) {
  return cs_picture_file_rows(&video->picture, video->context, 0, video->extras.height,
                              video->pixels);
}

static celspan_status open_module(cs_video *out, const cs_video_desc *desc) {
  celspan_status status = open_picture(out, desc);
  if (status != CELSPAN_OK)
    close_picture(out);
  return status;
}

static celspan_status open_encoder(cs_video *out, const cs_video_desc *desc,
                                   cs_sound_stream *samples) {
  cs_arguments command;
  celspan_status status = prepare(out, desc, &command);
  if (status == CELSPAN_OK)
    status = cs_encoder_open(&out->encoder, out->context, out->path, command.list,
                             out->slots.frame_size, samples);
  if (status != CELSPAN_OK)
    discard_files(out);
  return status;
}

static celspan_status open_slots(cs_video *out, const cs_video_desc *desc) {
  size_t size = frame_size(out, desc->frames.width, desc->frames.height);
  size_t count = desc->keeps_nothing ? 1 : cs_slots_count(out->context, size, desc->workers);
  return cs_slots_open(&out->slots, out->context, count, size);
}

celspan_status cs_video_open(cs_video *out, celspan_context *context, const cs_video_desc *desc) {
  cs_sound_stream samples = desc->sound;
  *out = (cs_video){.context = context,
                    .path = desc->path,
                    .format = desc->format,
                    .coding = cs_video_coding(&desc->options),
                    .layout = cs_video_layout_of(&desc->options),
                    .options = desc->options,
                    .extras = {.title = desc->title,
                               .maker = cs_context_maker(context),
                               .width = desc->frames.width,
                               .height = desc->frames.height},
                    .most_bytes = desc->most_bytes,
                    .has_sound = desc->sound.user != NULL,
                    .has_digests = desc->has_digests};
  out->stride = (size_t)desc->frames.width * cs_pixels_size(&out->coding);
  celspan_status status = open_slots(out, desc);
  if (status == CELSPAN_OK)
    status = is_of_module(out) ? open_module(out, desc) : open_encoder(out, desc, &samples);
  if (status != CELSPAN_OK)
    cs_slots_close(&out->slots, context);
  cs_sound_stream_close(&samples);
  return status;
}

/* ---------------------------------------------------------------- frames */

/* The coding of the frame's spans, without dithering. */
static celspan_coding plain_coding(const cs_video *video, const celspan_frame_desc *desc) {
  celspan_coding plain = cs_pixels_resolve(&video->coding, CELSPAN_DEPTH_8);
  plain.space = desc->space;
  return plain;
}

static celspan_sink ycc_sink(const cs_video *video, const celspan_frame_desc *desc,
                             unsigned char *pixels, cs_ycc *ycc) {
  *ycc = (cs_ycc){.coder = cs_coder_of(&video->coding, desc->crop_x, desc->crop_y),
                  .is_halved = video->layout == CS_VIDEO_420,
                  .bytes = pixels};
  ycc->coder.coding.space = desc->space;
  if (celspan_frame_is_opaque(desc)) /* the same result, faster */
    ycc->coder.coding.alpha = CELSPAN_ALPHA_STRAIGHT;
  return cs_ycc_sink(ycc);
}

/* A sink for the pixels in the layout of the encoder. ycc: must live as long as the sink. */
static celspan_status open_sink(const cs_video *video, celspan_context *context,
                                const celspan_frame_desc *desc, unsigned char *pixels, cs_ycc *ycc,
                                celspan_sink *out) {
  if (video->layout != CS_VIDEO_RGBA) {
    *out = ycc_sink(video, desc, pixels, ycc);
    return CELSPAN_OK;
  }
  celspan_coding plain = plain_coding(video, desc);
  CS_TRY(cs_sink_memory(context, &plain, pixels, video->stride, out));
  return cs_coder_dither(context, &video->coding, &plain, desc->crop_x, desc->crop_y, out);
}

/* A sink that hashes RGBA pixels. */
static celspan_status open_digest(const cs_video *video, celspan_context *context,
                                  const celspan_frame_desc *desc, uint64_t digest[2],
                                  celspan_sink *out) {
  celspan_coding plain = plain_coding(video, desc);
  CS_TRY(cs_sink_digest(context, &plain, digest, out));
  return cs_coder_dither(context, &video->coding, &plain, desc->crop_x, desc->crop_y, out);
}

/* Makes and hashes the frame in one pass over its rows. */
static celspan_status make_both(const cs_video *video, celspan_context *context,
                                const celspan_frame_desc *desc, unsigned char *pixels,
                                uint64_t digest[2]) {
  cs_ycc ycc;
  cs_tee tee;
  CS_TRY(open_sink(video, context, desc, pixels, &ycc, &tee.sinks[0]));
  celspan_status status = open_digest(video, context, desc, digest, &tee.sinks[1]);
  if (status != CELSPAN_OK) {
    cs_sink_discard(context, &tee.sinks[0]);
    return status;
  }
  celspan_sink sink = cs_tee_sink(&tee);
  status = celspan_frame_render(context, desc, &sink, NULL);
  for (int i = 0; i < 2 && !tee.is_ended; i++)
    cs_sink_discard(context, &tee.sinks[i]);
  return status;
}

static celspan_status make_one(const cs_video *video, celspan_context *context,
                               const celspan_frame_desc *desc, unsigned char *pixels) {
  cs_ycc ycc;
  if (video->layout == CS_VIDEO_RGBA)
    return celspan_frame_pixels(context, desc, &video->coding, pixels, video->stride, NULL);
  celspan_sink sink = ycc_sink(video, desc, pixels, &ycc);
  return celspan_frame_render(context, desc, &sink, NULL);
}

celspan_status cs_video_put(const cs_video *video, celspan_context *context,
                            const celspan_frame_desc *desc, size_t slot, uint64_t digest[2]) {
  unsigned char *pixels = video->slots.frames[slot];
  return video->has_digests ? make_both(video, context, desc, pixels, digest)
                            : make_one(video, context, desc, pixels);
}

celspan_status cs_video_give(cs_video *video, size_t slot) {
  unsigned char **pixels = &video->slots.frames[slot], *given = *pixels;
  if (!is_of_module(video))
    return cs_encoder_give(&video->encoder, pixels);
  *pixels = video->pixels;
  video->pixels = given;
  return give_picture(video);
}

celspan_status cs_video_repeat(cs_video *video) {
  return is_of_module(video) ? give_picture(video) : cs_encoder_repeat(&video->encoder);
}

/* ---------------------------------------------------------------- the end */

/* Reads the first bytes of a file. Returns their number, or -1 and errno. */
static ssize_t read_head(const char *name, char *bytes, size_t size) {
  int descriptor = cs_open_to_read(name);
  if (descriptor < 0)
    return -1;
  ssize_t got = cs_open_read_at(descriptor, bytes, size, 0);
  close(descriptor);
  return got;
}

/* Checks that the encoder has written a file of its format. */
static celspan_status check_mark(const cs_video *video, const char *name) {
  char bytes[16] = {0};
  ssize_t size = read_head(name, bytes, sizeof bytes);
  const char *mark = video->format->mark.bytes;
  if (size < 0)
    return cs_fail(video->context, CELSPAN_OUTPUT, "%s: cannot be read back: %s", video->path,
                   strerror(errno));
  if (size == sizeof bytes && memcmp(bytes + video->format->mark.offset, mark, 4) == 0)
    return CELSPAN_OK;
  return cs_fail(video->context, CELSPAN_OUTPUT, "%s: the output of ffmpeg is not in the format %s",
                 video->path, video->format->name);
}

/* Makes the video of its master with one palette. */
static celspan_status index_colours(const cs_video *video, const char *master, const char *name) {
  cs_arguments command;
  cs_file *file = NULL;
  const char *palette;
  celspan_status status = open_file(video, &file, &palette);
  if (status == CELSPAN_OK) {
    cs_video_command_swatches(&command, &video->options, master, palette);
    status = cs_encoder_run(video->context, video->path, command.list);
  }
  if (status == CELSPAN_OK) {
    cs_video_command_index(&command, video->format, &video->options, master, palette, name);
    status = cs_encoder_run(video->context, video->path, command.list);
  }
  if (file)
    cs_file_discard(file, video->context);
  return status;
}

static celspan_status complete(cs_video *video) {
  const char *name, *master;
  CS_TRY(cs_encoder_finish(&video->encoder));
  CS_TRY(cs_file_temporary(video->file, video->context, &name));
  if (video->master) {
    CS_TRY(cs_file_temporary(video->master, video->context, &master));
    CS_TRY(video->options.codec->is_indexed ? index_colours(video, master, name)
                                            : cs_video_limit(video, master, name));
  }
  CS_TRY(check_mark(video, name));
  return cs_file_adopt(video->file, video->context);
}

celspan_status cs_video_finish(cs_video *video) {
  cs_slots_close(&video->slots, video->context);
  if (is_of_module(video)) {
    celspan_status outcome = cs_picture_file_close(&video->picture, video->context);
    close_picture(video);
    return outcome;
  }
  celspan_status status = complete(video);
  if (status != CELSPAN_OK) {
    cs_video_discard(video);
    return status;
  }
  discard_sources(video);
  return cs_file_commit(video->file, video->context);
}

void cs_video_discard(cs_video *video) {
  cs_slots_close(&video->slots, video->context);
  if (is_of_module(video)) {
    close_picture(video);
    return;
  }
  cs_encoder_discard(&video->encoder);
  discard_files(video);
}
