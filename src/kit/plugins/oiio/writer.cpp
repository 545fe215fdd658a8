/* Writing: coded rows to any format whose writer accepts a file of ours.
 *
 *   rows --> ImageOutput --bytes, in any order--> Target --put--> the core's file
 *
 * INVARIANT: the first failure of `put` is reported, by close_writer at the latest. In several
 * formats the library ignores it (a full disk) and reports success; so Target remembers it.
 */
#include <OpenImageIO/filesystem.h>
#include <cstring>

#include <algorithm>
#include <memory>

#include "plugins/moving/moving.h"
#include "plugins/oiio/shared.h"
#include "writers/exr/rate.h"

using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace {

/* The file's name without its folders: headers of film scans contain the file's name, but must not
 * reveal the folder on the maker's disk. */
const char *own_name(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

class Target : public OIIO::Filesystem::IOProxy {
public:
  explicit Target(const cs_picture_output &output)
      : IOProxy(own_name(output.name), Write), put_(output.put), user_(output.user) {}
  const char *proxytype() const override { return "celspan"; }
  void close() override {}
  bool seek(int64_t offset) override {
    if (offset < 0)
      return false;
    m_pos = offset;
    return true;
  }
  size_t write(const void *bytes, size_t size) override {
    size_t done = pwrite(bytes, size, m_pos);
    m_pos += int64_t(done);
    return done;
  }
  size_t pwrite(const void *bytes, size_t size, int64_t offset) override {
    has_failed_ = has_failed_ || !put_(user_, uint64_t(offset), bytes, size);
    if (has_failed_)
      return 0;
    size_ = std::max(size_, size_t(offset) + size);
    return size;
  }
  size_t size() const override { return size_; }

  void check() const {
    if (has_failed_)
      throw Failure(CELSPAN_OUTPUT, "cannot be written");
  }

private:
  bool (*put_)(void *user, uint64_t offset, const void *bytes, size_t size);
  void *user_;
  bool has_failed_ = false;
  size_t size_ = 0;
};

} // namespace

struct cs_picture_writer {
  cs_moving *moving = nullptr; /* then the rest is empty: the library does not write such a file */
  std::string name;
  std::unique_ptr<Target> target;
  std::unique_ptr<ImageOutput> output;
  ImageSpec spec;
};

namespace {

[[noreturn]] void fail_output(const cs_picture_writer &writer, const std::string &message) {
  writer.target->check();
  throw Failure(CELSPAN_OUTPUT, "cannot be written: " + first_line(message));
}

TypeDesc type_of(celspan_depth depth) {
  switch (depth) {
  case CELSPAN_DEPTH_16:
    return TypeDesc::UINT16;
  case CELSPAN_DEPTH_HALF:
    return TypeDesc::HALF;
  case CELSPAN_DEPTH_FLOAT:
    return TypeDesc::FLOAT;
  default:
    return TypeDesc::UINT8;
  }
}

struct ColourNames {
  const char *colour; /* as celspan reads it back */
  const char *space;  /* in OpenImageIO */
  const char *film;   /* in the header of a film scan */
};

/* Of another space than these, only OpenEXR has the name. */
ColourNames names_of(const cs_picture_output &output) {
  static const ColourNames known[] = {{"linear", "Linear", "Linear"},
                                      {"rec709", "Rec709", "ITU-R 709-4"},
                                      {"cineon", "KodakLog", "Printing density"},
                                      {"srgb", "sRGB", "Undefined"}};
  for (const ColourNames &names : known)
    if (strcmp(names.colour, output.colour) == 0)
      return names;
  return {output.colour, nullptr, "User defined"};
}

void describe_rate(ImageSpec &spec, double rate) {
  int32_t fraction[2];
  if (cs_rate_fraction(rate, fraction))
    spec.attribute("FramesPerSecond", OIIO::TypeRational, fraction);
}

ImageSpec make_spec(const cs_picture_output &output) {
  ImageSpec spec(output.width, output.height, output.channels, type_of(output.depth));
  std::string format = output.format;
  if (output.names) {
    spec.channelnames.assign(output.names, output.names + output.channels);
    spec.alpha_channel = 3;
  }
  spec.attribute("Software", output.software);
  if (output.title)
    spec.attribute("ImageDescription", output.title);
  describe_rate(spec, output.frames_second);
  spec.attribute("celspan:frame", int(output.frame));
  /* In a TIFF this would add a second directory, and the library would read the file again. */
  const ColourNames names = names_of(output);
  if (format != "tiff" && names.space)
    spec.attribute("oiio:ColorSpace", names.space);
  /* The library would write the present time, and equal frames would differ. */
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  if (output.bits)
    spec.attribute("oiio:BitsPerSample", output.bits);
  if (output.channels == 4 && output.is_straight)
    spec.attribute("oiio:UnassociatedAlpha", 1);
  if (format == "openexr")
    spec.attribute("celspan:colour", names.colour);
  if (format == "openexr" && output.has_primaries)
    spec.attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), output.primaries);
  if (format == "openexr" || format == "tiff")
    spec.attribute("compression", "zip");
  if (format == "jpeg") {
    spec.attribute("CompressionQuality", 95);
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  if (format == "webp")
    spec.attribute("compression", "webp:100");
  if (format == "dpx")
    spec.attribute("dpx:Transfer", names.film);
  if (format == "dpx" && !names.space)
    spec.attribute("DocumentName", std::string(CS_PICTURE_PROJECT) + names.colour);
  return spec;
}

} // namespace

static celspan_status open_moving(const cs_picture_output *output, cs_picture_writer **out,
                                  cs_picture_failure *failure) {
  std::unique_ptr<cs_picture_writer> writer(new (std::nothrow) cs_picture_writer);
  if (!writer) {
    failure->text[0] = '\0';
    return failure->status = CELSPAN_NO_MEMORY;
  }
  celspan_status status = cs_moving_open(output, &writer->moving, failure);
  if (status == CELSPAN_OK)
    *out = writer.release();
  return status;
}

celspan_status open_writer(const cs_picture_output *output, cs_picture_writer **out,
                           cs_picture_failure *failure) {
  if (cs_moving_has(output))
    return open_moving(output, out, failure);
  return fence(failure, CELSPAN_OUTPUT, output->name, [&] {
    prepare_library();
    auto writer = std::make_unique<cs_picture_writer>();
    writer->name = output->name;
    writer->target = std::make_unique<Target>(*output);
    writer->output = ImageOutput::create(output->format);
    if (!writer->output || !writer->output->supports("ioproxy"))
      throw Failure(CELSPAN_OUTPUT,
                    std::string("the format \"") + output->format + "\" cannot be written");
    writer->spec = make_spec(*output);
    void *proxy = writer->target.get();
    writer->spec.attribute("oiio:ioproxy", TypeDesc::PTR, &proxy);
    if (!writer->output->open(own_name(output->name), writer->spec))
      fail_output(*writer, writer->output->geterror());
    writer->target->check();
    check_memory();
    *out = writer.release();
  });
}

celspan_status write_writer(cs_picture_writer *writer, int32_t y, int32_t count, const void *rows,
                            cs_picture_failure *failure) {
  if (writer->moving)
    return cs_moving_rows(writer->moving, count, rows, failure);
  return fence(failure, CELSPAN_OUTPUT, writer->name, [&] {
    if (!writer->output->write_scanlines(y, y + count, 0, writer->spec.format, rows))
      fail_output(*writer, writer->output->geterror());
    writer->target->check();
    check_memory();
  });
}

celspan_status close_writer(cs_picture_writer *writer, cs_picture_failure *failure) {
  if (writer->moving) {
    celspan_status status = cs_moving_close(writer->moving, failure);
    delete writer;
    return status;
  }
  std::string name = writer->name;
  return fence(failure, CELSPAN_OUTPUT, name, [&] {
    std::unique_ptr<cs_picture_writer> owned(writer);
    if (!owned->output->close())
      fail_output(*owned, owned->output->geterror());
    owned->target->check();
    check_memory();
  });
}

void abandon_writer(cs_picture_writer *writer) {
  if (writer->moving)
    cs_moving_abandon(writer->moving);
  cs_picture_failure ignored;
  std::string name = writer->name;
  celspan_status status = fence(&ignored, CELSPAN_OUTPUT, name, [&] { delete writer; });
  (void)status;
}
