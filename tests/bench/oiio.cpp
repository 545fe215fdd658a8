// OpenImageIO: the raster jobs, and PNG files of the same pixels.
//
//   oiio picture affine|perspective|shift
//   oiio png DRAWING SIDE LEVEL FILE     rows come from celspan; only the writing is timed
//   oiio recode PICTURE LEVEL FILE       a picture written as PNG; level 0: the default
//   oiio read PICTURE                    the digest of its 8-bit RGBA pixels, row by row
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "measure.h"
#include "pictures.h"
#include "scene.h"

namespace {

using namespace OIIO;

void check(bool is_good, const std::string &message) {
  if (!is_good)
    bench_stop("%s", message.c_str());
}

// ---------------------------------------------------------------- raster jobs

struct Pictures {
  ImageBuf ground, overlay, out;
  bench_job_kind kind;
  float matrix[3][3]; // for row vectors
};

void draw_picture(void *user) {
  auto *job = static_cast<Pictures *>(user);
  const ROI frame(0, BENCH_FRAME_WIDTH, 0, BENCH_FRAME_HEIGHT, 0, 1, 0, 4);
  ImageBuf placed;
  if (job->kind == BENCH_SHIFT) {
    placed = job->overlay;
    placed.set_origin(int(job->matrix[2][0]), int(job->matrix[2][1]));
  } else
    ImageBufAlgo::warp(placed, job->overlay, job->matrix, "triangle", 2.0f, true,
                       ImageBuf::WrapBlack, ROI(), 1); // as large as what it covers
  ImageBufAlgo::over(job->out, placed, job->ground, frame, 1);
  check(!job->out.has_error(), job->out.geterror());
}

ImageBuf wrap(const uint8_t *pixels, int width, int height) {
  ImageSpec spec(width, height, 4, TypeDesc::UINT8);
  ImageBuf image(spec);
  image.set_pixels(ROI::All(), TypeDesc::UINT8, pixels);
  return image;
}

void measure_picture(const char *name) {
  bench_job asked = bench_job_make(name, 0);
  const double *m = asked.matrix;
  Pictures job{wrap(asked.ground, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT),
               wrap(asked.overlay, BENCH_OVERLAY_WIDTH, BENCH_OVERLAY_HEIGHT),
               ImageBuf(),
               asked.kind,
               {{float(m[0]), float(m[3]), float(m[6])},
                {float(m[1]), float(m[4]), float(m[7])},
                {float(m[2]), float(m[5]), float(m[8])}}};
  bench_measure(draw_picture, &job);
  std::vector<uint8_t> pixels(size_t(4) * BENCH_FRAME_WIDTH * BENCH_FRAME_HEIGHT);
  job.out.get_pixels(job.out.roi(), TypeDesc::UINT8, pixels.data());
  bench_tell_picture(pixels.data(), BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT);
  bench_line_end();
  bench_job_free(&asked);
}

// ---------------------------------------------------------------- PNG files

struct Writer {
  std::unique_ptr<ImageOutput> output;
  std::vector<uint8_t> row;    // RGBA
  std::vector<uint8_t> pixels; // RGB, of a chunk of rows: the drawings are opaque
  int side, filled, first;
  double wall, processor;
};

constexpr int chunk_rows = 64;

std::unique_ptr<ImageOutput> open(const char *path, int width, int height, int channels,
                                  int level) {
  auto output = ImageOutput::create(path);
  ImageSpec spec(width, height, channels, TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (level > 0)
    spec.attribute("png:compressionLevel", level);
  check(output && output->open(path, spec), "the PNG file could not be begun");
  return output;
}

void flush(Writer &writer) {
  const double wall = bench_wall(), processor = bench_processor();
  check(writer.output->write_scanlines(writer.first, writer.first + writer.filled, 0,
                                       TypeDesc::UINT8, writer.pixels.data()),
        "the PNG file could not be written");
  writer.wall += bench_wall() - wall;
  writer.processor += bench_processor() - processor;
  writer.first += writer.filled;
  writer.filled = 0;
}

celspan_status put_row(void *user, celspan_context *, int32_t, const celspan_span *spans,
                       size_t span_count) {
  celspan_coding coded = {.struct_size = sizeof coded};
  coded.depth = CELSPAN_DEPTH_8;
  auto *writer = static_cast<Writer *>(user);
  celspan_spans_code(&coded, spans, span_count, writer->row.data());
  uint8_t *out = writer->pixels.data() + size_t(3) * writer->side * writer->filled;
  for (int x = 0; x < writer->side; x++)
    std::memcpy(out + 3 * x, writer->row.data() + 4 * x, 3);
  if (++writer->filled == chunk_rows)
    flush(*writer);
  return CELSPAN_OK;
}

void tell(double wall, double processor, const char *path) {
  bench_tell("wall", wall);
  bench_tell("best_wall", wall);
  bench_tell("processor", processor);
  bench_tell("best_processor", processor);
  bench_tell("runs", 1);
  bench_tell_file(path);
  bench_line_end();
}

void measure_png(char **words) {
  bench_drawing drawing = bench_drawing_read(words[0]);
  const int side = std::atoi(words[1]);
  celspan_context *context = nullptr;
  bench_check(context, celspan_context_create(nullptr, &context));
  celspan_rostrum *rostrum = bench_scene(context, &drawing, nullptr);
  const celspan_exposure exposure{rostrum, 1};
  const celspan_antialias_mode mode = CELSPAN_ANTIALIAS_AREA;
  const celspan_frame_desc desc = bench_frame(&exposure, side, side, &mode);
  Writer writer{open(words[3], side, side, 3, std::atoi(words[2])),
                std::vector<uint8_t>(size_t(4) * side),
                std::vector<uint8_t>(size_t(3) * side * chunk_rows),
                side,
                0,
                0,
                0,
                0};
  celspan_sink sink = CELSPAN_SINK;
  sink.user = &writer;
  sink.row = put_row;
  bench_check(context, celspan_frame_render(context, &desc, &sink, nullptr));
  if (writer.filled > 0)
    flush(writer);
  writer.output->close();
  tell(writer.wall, writer.processor, words[3]);
  celspan_rostrum_unref(rostrum);
  celspan_context_destroy(context);
  bench_drawing_free(&drawing);
}

void measure_recode(char **words) {
  ImageBuf picture(words[0]);
  check(picture.read(0, 0, true, TypeDesc::UINT8), picture.geterror());
  const ImageSpec spec = picture.spec();
  std::vector<uint8_t> pixels(size_t(spec.nchannels) * spec.width * spec.height);
  picture.get_pixels(picture.roi(), TypeDesc::UINT8, pixels.data());
  const double wall = bench_wall(), processor = bench_processor();
  auto output = open(words[2], spec.width, spec.height, spec.nchannels, std::atoi(words[1]));
  check(output->write_image(TypeDesc::UINT8, pixels.data()) && output->close(),
        "the PNG file could not be written");
  tell(bench_wall() - wall, bench_processor() - processor, words[2]);
}

void read_picture(const char *path) {
  auto input = ImageInput::open(path);
  check(bool(input), "the picture cannot be read");
  const ImageSpec spec = input->spec();
  const size_t channels = size_t(spec.nchannels);
  std::vector<uint8_t> row(channels * spec.width);
  uint64_t digest = BENCH_DIGEST_BEGIN;
  for (int y = 0; y < spec.height; y++) {
    check(input->read_scanline(y, 0, TypeDesc::UINT8, row.data()), input->geterror());
    digest = bench_digest(digest, row.data(), size_t(spec.width), channels);
  }
  bench_tell_digest(digest);
  bench_line_end();
}

} // namespace

int main(int argc, char **argv) {
  OIIO::attribute("threads", 1);
  const std::string verb = argc > 1 ? argv[1] : "";
  if (verb == "picture" && argc >= 3)
    measure_picture(argv[2]);
  else if (verb == "png" && argc == 6)
    measure_png(argv + 2);
  else if (verb == "recode" && argc == 5)
    measure_recode(argv + 2);
  else if (verb == "read" && argc == 3)
    read_picture(argv[2]);
  else
    bench_stop("usage: oiio picture|png|recode|read ...");
  return 0;
}
