/* Span files for every program built on OpenImageIO: a reader plug-in, span.imageio.so.
 *
 * Memory is one row, and a tile costs no more than the rows it covers. Eight-bit files are sRGB and
 * come premultiplied, as the library wants them, unless "oiio:UnassociatedAlpha" asks for the
 * straight values of the file; half files are linear and premultiplied as they are.
 */
#include <spanfile.h>

#include "plugins/oiio/plugin/partinput.h"

namespace {

using OIIO::ImageSpec;
using OIIO::TypeDesc;

class SpanInput final : public PartInput {
public:
  ~SpanInput() override { close(); }
  const char *format_name() const override { return "span"; }
  bool valid_file(const std::string &name) const override {
    return begins(name, SPANFILE_MAGIC_BYTES, spanfile_is);
  }
  using PartInput::open;
  bool open(const std::string &name, ImageSpec &spec, const ImageSpec &config) override;
  bool close() override;

protected:
  bool is_open() const override { return reader_; }
  bool read_part(const Part &part, void *data, size_t stride) override;

private:
  bool create_reader();
  bool describe_file();
  bool read_row(const Part &part, int y, void *data);

  spanfile_reader *reader_ = nullptr;
  spanfile_info info_ = {};
  bool is_straight_ = false; /* asked for */
};

bool SpanInput::create_reader() {
  spanfile_source bytes = source<spanfile_source>();
  spanfile_fault fault;
  if (spanfile_reader_create(&bytes, &reader_, &fault) != SPANFILE_OK)
    return refuse(fault);
  info_ = spanfile_reader_info(reader_);
  return true;
}

bool SpanInput::describe_file() {
  bool is_half = info_.format == SPANFILE_HALF;
  if (!describe(info_.width, info_.height, is_half ? TypeDesc::HALF : TypeDesc::UINT8,
                is_half ? "Linear" : "sRGB"))
    return false;
  if (!is_half && is_straight_)
    m_spec.attribute("oiio:UnassociatedAlpha", 1);
  return true;
}

bool SpanInput::open(const std::string &name, ImageSpec &spec, const ImageSpec &config) {
  close();
  is_straight_ = config.get_int_attribute("oiio:UnassociatedAlpha", 0) == 1;
  if (!open_bytes(name, config))
    return false;
  return finish(create_reader() && describe_file(), spec);
}

bool SpanInput::close() {
  if (reader_)
    spanfile_reader_destroy(reader_);
  reader_ = nullptr;
  ioproxy_clear();
  return true;
}

bool SpanInput::read_row(const Part &part, int y, void *data) {
  spanfile_row row;
  spanfile_fault fault;
  if (spanfile_reader_row(reader_, uint32_t(y), &row, &fault) != SPANFILE_OK)
    return refuse(fault);
  spanfile_row_pixels(info_.format, &row, uint32_t(part.x), uint32_t(part.x + part.columns), data);
  if (info_.format == SPANFILE_SRGB8 && !is_straight_)
    OIIO::premult(4, part.columns, 1, 1, 0, 4, TypeDesc::UINT8, data, OIIO::AutoStride,
                  OIIO::AutoStride, OIIO::AutoStride, 3, -1);
  return true;
}

bool SpanInput::read_part(const Part &part, void *data, size_t stride) {
  for (int row = 0; row < part.rows; row++)
    if (!read_row(part, part.y + row, static_cast<char *>(data) + size_t(row) * stride))
      return false;
  return true;
}

} // namespace

PART_INPUT_PLUGIN(span, SpanInput)
